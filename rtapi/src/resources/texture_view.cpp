// SPDX-License-Identifier: MIT
#include "rtapi/src/resources/texture_view.h"

#include <algorithm>
#include <cmath>

#include "rtapi/src/resources/resource_impl.h"

namespace rtapi::detail {

namespace {

bool fits_dimension(SrvDimension view, ResourceDimension resource) {
  switch (view) {
    case SrvDimension::kTexture1D:
    case SrvDimension::kTexture1DArray:
      return resource == ResourceDimension::kTexture1D;
    case SrvDimension::kTexture2D:
    case SrvDimension::kTexture2DArray:
    case SrvDimension::kTexture2DMS:
    case SrvDimension::kTexture2DMSArray:
    case SrvDimension::kTextureCube:
    case SrvDimension::kTextureCubeArray:
      return resource == ResourceDimension::kTexture2D;
    case SrvDimension::kTexture3D:
      return resource == ResourceDimension::kTexture3D;
    default:
      return false;
  }
}

bool is_multisampled(SrvDimension dimension) {
  return dimension == SrvDimension::kTexture2DMS || dimension == SrvDimension::kTexture2DMSArray;
}

Status check_view_format(const DeviceImpl& device, const Texture& texture,
                         const TextureView& view) {
  const Format own = texture.GetDesc().Format;
  const FormatInfo info = GetFormatInfo(view.format);
  if (IsDepthFormat(view.format)) {
    return make_error(Id::kViewFormat, "view format ", static_cast<uint32_t>(view.format), " of ",
                      named("texture", texture.name()),
                      " is a depth format, which shaders cannot read; create the texture with the "
                      "typeless format of the family, and view it as R32_FLOAT, R16_UNORM, "
                      "R24_UNORM_X8_TYPELESS or R32_FLOAT_X8X24_TYPELESS");
  }
  if (info.type == FormatClass::kUnsupported || info.type == FormatClass::kTypeless ||
      !castable(own, view.format)) {
    return make_error(
        Id::kViewFormat, "view format ", static_cast<uint32_t>(view.format), " of ",
        named("texture", texture.name()), " with format ", static_cast<uint32_t>(own),
        "; it must be the same, or a typed member of its family: FLOAT only for FLOAT, "
        "and no SNORM for UNORM or the other way round");
  }
  if (!device.backend->supports_format(view.format, view.uav)) {
    return make_error(Id::kViewFormat, "the backend does not support ",
                      view.uav ? "unordered access" : "shader resource", " views of format ",
                      static_cast<uint32_t>(view.format));
  }
  return {};
}

Status check_subresources(const Texture& texture, TextureView& view) {
  const TextureDesc& desc = texture.GetDesc();
  const std::string name = named("texture", desc.Name);
  if (view.first_mip >= desc.MipLevels) {
    return make_error(Id::kViewSubresources, "mip ", view.first_mip, " is outside ", name,
                      ", which has ", desc.MipLevels, " mips");
  }
  if (view.mips == 0xFFFFFFFFu) view.mips = desc.MipLevels - view.first_mip;
  if (view.mips == 0 || view.mips > desc.MipLevels - view.first_mip) {
    return make_error(Id::kViewSubresources, view.mips, " mips from mip ", view.first_mip,
                      " on are outside ", name, ", which has ", desc.MipLevels, " mips");
  }
  const bool volume = view.dimension == SrvDimension::kTexture3D;
  const uint32_t total =
      volume ? get_mip_extent(desc, view.first_mip).depth : detail::array_size(desc);
  const bool cube = view.dimension == SrvDimension::kTextureCube ||
                    view.dimension == SrvDimension::kTextureCubeArray;
  if (view.slices == 0xFFFFFFFFu && view.first_slice < total) {
    view.slices = total - view.first_slice;
    if (cube) view.slices -= view.slices % 6;
  }
  if (view.first_slice >= total || view.slices == 0 || view.slices > total - view.first_slice) {
    return make_error(Id::kViewSubresources, volume ? "w slices " : "array elements ",
                      view.first_slice, "..", uint64_t{view.first_slice} + view.slices,
                      " are outside ", name, ", which has ", total);
  }
  if (cube && (view.slices % 6 != 0 || desc.Width != desc.Height)) {
    return make_error(Id::kViewSubresources, "a cube view needs 6 square faces, but this has ",
                      view.slices, " faces of ", desc.Width, "x", desc.Height);
  }
  return {};
}

// As shader::texture_shape() counts.
uint32_t number_class(Format format) {
  switch (GetFormatInfo(format).type) {
    case FormatClass::kSint:
      return 1;
    case FormatClass::kUint:
      return 2;
    default:
      return 0;
  }
}

// ResourceMinLODClamp has eight bits of fraction, as other levels of detail. [D3D11.3: LOD]
float mip_clamp(float asked) {
  return asked > 0 ? std::floor(std::min(asked, 255.0f) * 256 + 0.5f) / 256 : 0.0f;
}

}  // namespace

Result<shader::Descriptor> make_texture_descriptor(const std::shared_ptr<DeviceImpl>& device,
                                                   const Texture& texture, TextureView view,
                                                   uint32_t mapping) {
  if (Status s = CheckHandle(device, texture, "the viewed texture"); !s.ok()) return s.error();
  const TextureDesc& desc = texture.GetDesc();
  if (!fits_dimension(view.dimension, desc.Dimension)) {
    return make_error(Id::kViewResource, "view dimension ", static_cast<uint32_t>(view.dimension),
                      " does not fit ", named("texture", desc.Name), ", whose dimension is ",
                      static_cast<uint32_t>(desc.Dimension));
  }
  if (is_multisampled(view.dimension) != (desc.SampleDesc.Count > 1)) {
    return make_error(
        Id::kSampleMismatch, "view dimension ", static_cast<uint32_t>(view.dimension),
        " does not fit ", named("texture", desc.Name), ", which has ", desc.SampleDesc.Count,
        " samples; it must be ",
        desc.SampleDesc.Count > 1 ? "one with MS, and no unordered access" : "one without MS");
  }
  if (view.uav && GetFormatInfo(desc.Format).block_side != 1) {
    return make_error(Id::kBlockAccess, named("texture", desc.Name), " has DXGI format ",
                      static_cast<uint32_t>(desc.Format), "; only shader resource views read it");
  }
  if (view.uav && !HasAny(desc.Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(
        Id::kViewAccess, named("texture", desc.Name),
        " was created without kAllowUnorderedAccess; add the flag to its TextureDesc");
  }
  if (!view.uav && HasAny(desc.Flags, ResourceFlags::kDenyShaderResource)) {
    return make_error(Id::kViewAccess, named("texture", desc.Name),
                      " was created with kDenyShaderResource; shaders cannot read it");
  }
  if (view.format == Format::kUnknown) view.format = desc.Format;
  if (Status s = check_view_format(*device, texture, view); !s.ok()) return s.error();
  if (Status s = check_subresources(texture, view); !s.ok()) return s.error();
  runtime::TextureViewDesc resolved;
  resolved.format = view.format;
  resolved.dimension = view.dimension;
  resolved.unordered_access = view.uav;
  resolved.first_mip = view.first_mip;
  resolved.mip_count = view.mips;
  resolved.first_slice = view.first_slice;
  resolved.slice_count = view.slices;
  const float clamp = mip_clamp(view.min_lod);
  if (clamp > static_cast<float>(view.first_mip + view.mips - 1)) {
    // No mip is left, and reads of none are out of bounds. [D3D12: D3D12_TEX2D_SRV]
    return shader::Descriptor();
  }
  resolved.min_lod = std::max(clamp - static_cast<float>(view.first_mip), 0.0f);
  for (int i = 0; i < 4; ++i) {
    resolved.swizzle[i] = static_cast<uint8_t>((mapping >> (3 * i)) & 7);
    if (resolved.swizzle[i] > 5) {
      return make_error(Id::kViewFormat, "Shader4ComponentMapping ", hex(mapping), " of ",
                        named("texture", desc.Name), " selects component ",
                        int{resolved.swizzle[i]}, "; it must be 0 to 5");
    }
  }
  auto object = device->backend->create_texture_view(*texture.impl()->memory, resolved);
  if (!object.ok()) return object.error();
  device->views.add_view(*object, {desc.Name, desc, resolved, texture.impl()->memory});
  const uint64_t key = kaamos::shader::view_key(*object, view.uav);
  device->addresses.insert_view(key, texture.impl()->memory);
  if (device->checks) {
    device->checks->textures().add_view(key, texture.impl()->memory,
                                        {view.first_mip, view.mips, view.first_slice, view.slices,
                                         runtime::shows_stencil(view.format) ? 1u : 0u, 1});
  }
  shader::Descriptor descriptor;
  descriptor.kind = shader::DescriptorKind::kTexture;
  descriptor.access = view.uav ? shader::DescriptorAccess::kUnorderedAccess
                               : shader::DescriptorAccess::kShaderResource;
  descriptor.stride_bytes = kaamos::shader::texture_shape(static_cast<uint32_t>(view.dimension),
                                                          number_class(view.format));
  descriptor.address = *object;
  descriptor.format = static_cast<uint32_t>(view.format);
  return descriptor;
}

TextureView from_srv(const ShaderResourceViewDesc& d) {
  TextureView v;
  v.format = d.Format;
  v.dimension = d.ViewDimension;
  auto take = [&v](uint32_t mip, uint32_t mips, uint32_t slice, uint32_t slices, float lod) {
    v.first_mip = mip;
    v.mips = mips;
    v.first_slice = slice;
    v.slices = slices;
    v.min_lod = lod;
  };
  switch (d.ViewDimension) {
    case SrvDimension::kTexture1D: {
      const auto& t = d.Texture1D;
      take(t.MostDetailedMip, t.MipLevels, 0, 1, t.ResourceMinLODClamp);
      break;
    }
    case SrvDimension::kTexture1DArray: {
      const auto& t = d.Texture1DArray;
      take(t.MostDetailedMip, t.MipLevels, t.FirstArraySlice, t.ArraySize, t.ResourceMinLODClamp);
      break;
    }
    case SrvDimension::kTexture2D: {
      const auto& t = d.Texture2D;
      take(t.MostDetailedMip, t.MipLevels, 0, 1, t.ResourceMinLODClamp);
      break;
    }
    case SrvDimension::kTexture2DArray: {
      const auto& t = d.Texture2DArray;
      take(t.MostDetailedMip, t.MipLevels, t.FirstArraySlice, t.ArraySize, t.ResourceMinLODClamp);
      break;
    }
    case SrvDimension::kTexture2DMS:
      take(0, 1, 0, 1, 0);
      break;
    case SrvDimension::kTexture2DMSArray:
      take(0, 1, d.Texture2DMSArray.FirstArraySlice, d.Texture2DMSArray.ArraySize, 0);
      break;
    case SrvDimension::kTexture3D: {
      const auto& t = d.Texture3D;
      take(t.MostDetailedMip, t.MipLevels, 0, 0xFFFFFFFFu, t.ResourceMinLODClamp);
      break;
    }
    case SrvDimension::kTextureCube: {
      const auto& t = d.TextureCube;
      take(t.MostDetailedMip, t.MipLevels, 0, 6, t.ResourceMinLODClamp);
      break;
    }
    case SrvDimension::kTextureCubeArray: {
      const auto& t = d.TextureCubeArray;
      const uint32_t faces = t.NumCubes > 0xFFFFu ? 0xFFFFFFFFu : t.NumCubes * 6;
      take(t.MostDetailedMip, t.MipLevels, t.First2DArrayFace, faces, t.ResourceMinLODClamp);
      break;
    }
    default:
      break;
  }
  return v;
}

TextureView from_uav(const UnorderedAccessViewDesc& d) {
  TextureView v;
  v.format = d.Format;
  v.dimension = static_cast<SrvDimension>(d.ViewDimension);  // the numbers agree
  v.uav = true;
  switch (d.ViewDimension) {
    case UavDimension::kTexture1D:
      v.first_mip = d.Texture1D.MipSlice;
      break;
    case UavDimension::kTexture1DArray:
      v.first_mip = d.Texture1DArray.MipSlice;
      v.first_slice = d.Texture1DArray.FirstArraySlice;
      v.slices = d.Texture1DArray.ArraySize;
      break;
    case UavDimension::kTexture2D:
      v.first_mip = d.Texture2D.MipSlice;
      break;
    case UavDimension::kTexture2DArray:
      v.first_mip = d.Texture2DArray.MipSlice;
      v.first_slice = d.Texture2DArray.FirstArraySlice;
      v.slices = d.Texture2DArray.ArraySize;
      break;
    case UavDimension::kTexture3D:
      v.first_mip = d.Texture3D.MipSlice;
      v.first_slice = d.Texture3D.FirstWSlice;
      v.slices = d.Texture3D.WSize;
      break;
    default:
      break;
  }
  return v;
}

SrvDimension whole_dimension(const TextureDesc& desc) {
  switch (desc.Dimension) {
    case ResourceDimension::kTexture1D:
      return desc.DepthOrArraySize > 1 ? SrvDimension::kTexture1DArray : SrvDimension::kTexture1D;
    case ResourceDimension::kTexture3D:
      return SrvDimension::kTexture3D;
    default:
      if (desc.SampleDesc.Count > 1) {
        return desc.DepthOrArraySize > 1 ? SrvDimension::kTexture2DMSArray
                                         : SrvDimension::kTexture2DMS;
      }
      return desc.DepthOrArraySize > 1 ? SrvDimension::kTexture2DArray : SrvDimension::kTexture2D;
  }
}

}  // namespace rtapi::detail
