// SPDX-License-Identifier: MIT
//
// Shader resource, unordered access and constant buffer views: checks, then 32 bytes in a heap
// slot.
#include <cstring>

#include "rtapi/src/device_impl.h"

namespace rtapi {

using namespace detail;

namespace {

using shader::Descriptor;
using shader::DescriptorAccess;
using shader::DescriptorKind;

// What the SRVs and UAVs of buffers have in common.
struct BufferView {
  Format format;
  uint64_t first;
  uint64_t count;  // 0: all the rest
  uint32_t stride;
  bool raw;
  DescriptorAccess access;
  const Buffer* counter = nullptr;
  uint64_t counter_offset = 0;
};

Status WriteSlot(const DeviceImpl& device, CpuDescriptorHandle dest, const Descriptor& value) {
  const auto slot = device.FindSlot(dest);
  if (!slot || slot->type != DescriptorHeapType::kCbvSrvUav) {
    return MakeError(Id::kDescriptorHandle, "view: ", Hex(dest.ptr),
                     slot ? " is in a heap of another type" : " is not in a live descriptor heap");
  }
  std::memcpy(slot->slot, &value, sizeof value);
  return {};
}

// Determines element size and kind by the rules of format and stride. [D3D12: D3D12_BUFFER_SRV]
Result<uint32_t> CheckElement(const DeviceImpl& device, const BufferView& view,
                              const std::string& name, Descriptor& out) {
  const bool uav = view.access == DescriptorAccess::kUnorderedAccess;
  if (view.raw) {
    if (view.format != Format::kR32Typeless || view.stride != 0) {
      return MakeError(Id::kViewFormat, "raw view of ", name, " has format ",
                       static_cast<uint32_t>(view.format), " and stride ", view.stride,
                       "; it must have format kR32Typeless and no stride");
    }
    if (view.first * 4 % kRawUavSrvByteAlignment != 0) {
      return MakeError(Id::kViewStride, "raw view of ", name, " starts at byte ", view.first * 4,
                       "; it must be a multiple of 16");
    }
    out.kind = DescriptorKind::kRawBuffer;
    return 4u;
  }
  if (view.stride != 0) {
    if (view.format != Format::kUnknown) {
      return MakeError(Id::kViewFormat, "structured view of ", name, " has format ",
                       static_cast<uint32_t>(view.format), "; it must be kUnknown");
    }
    // Elements of 16-bit types have strides such as 2, 6 and 10.
    if (view.stride % 2 != 0 || view.stride > 2048) {
      return MakeError(Id::kViewStride, "structured view of ", name, " has a stride of ",
                       view.stride, " bytes; it must be a multiple of 2, at most 2048");
    }
    out.kind = DescriptorKind::kStructuredBuffer;
    out.stride_bytes = view.stride;
    return view.stride;
  }
  const FormatInfo info = GetFormatInfo(view.format);
  // Formats of textures with depth, or depth and stencil, are none of buffers.
  const uint32_t family = FormatFamily(view.format);
  const bool of_depth = IsDepthFormat(view.format) ||
                        family == static_cast<uint32_t>(Format::kR32G8X24Typeless) ||
                        family == static_cast<uint32_t>(Format::kR24G8Typeless);
  const bool typed = info.type != FormatClass::kUnsupported &&
                     info.type != FormatClass::kTypeless && info.block_side == 1 && !of_depth;
  if (!typed || !device.backend->supports_format(view.format, uav)) {
    return MakeError(Id::kViewFormat, "typed view of ", name, " has format ",
                     static_cast<uint32_t>(view.format),
                     view.format == Format::kUnknown
                         ? "; a structured view needs StructureByteStride, a raw one the raw flag"
                         : "; it must be a typed format that buffers support");
  }
  out.kind = DescriptorKind::kTypedBuffer;
  out.format = static_cast<uint32_t>(view.format);
  out.stride_bytes = info.bytes;
  return uint32_t{info.bytes};
}

constexpr uint64_t kCounterAlignment = 4096;  // D3D12_UAV_COUNTER_PLACEMENT_ALIGNMENT

Status WriteCounter(const std::shared_ptr<DeviceImpl>& device, const BufferView& view,
                    Descriptor& descriptor) {
  const uint64_t offset = view.counter_offset;
  if (view.counter == nullptr) {
    if (offset == 0) return {};
    return MakeError(Id::kViewCounter, "CounterOffsetInBytes is ", offset,
                     ", but no buffer for a counter is given; it must be 0 then");
  }
  const Buffer& counter = *view.counter;
  if (Status s = CheckHandle(device, counter, "the counter's buffer"); !s.ok()) return s;
  const std::string name = Named("buffer", counter.name());
  if (descriptor.kind != DescriptorKind::kStructuredBuffer) {
    return MakeError(Id::kViewCounter, "a counter in ", name,
                     " is given for a view that is not structured");
  }
  if (!HasAny(counter.GetDesc().Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return MakeError(Id::kViewCounter, name,
                     ", which holds the counter, was created without kAllowUnorderedAccess");
  }
  if (offset % kCounterAlignment != 0 || counter.size() < 4 || offset > counter.size() - 4) {
    return MakeError(Id::kViewCounter, "CounterOffsetInBytes is ", offset,
                     "; it must be a multiple of 4096, with 4 bytes from there on in ", name,
                     ", which has ", counter.size(), " bytes");
  }
  set_counter(descriptor, counter.GetGPUVirtualAddress() + offset);
  return {};
}

Status WriteBufferView(const std::shared_ptr<DeviceImpl>& device, const Buffer& buffer,
                       const BufferView& view, CpuDescriptorHandle dest) {
  if (Status s = CheckHandle(device, buffer, "the viewed buffer"); !s.ok()) return s;
  const std::string name = Named("buffer", buffer.name());
  const bool uav = view.access == DescriptorAccess::kUnorderedAccess;
  if (uav && !HasAny(buffer.GetDesc().Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return MakeError(Id::kViewAccess, name,
                     " was created without kAllowUnorderedAccess; add the flag to its BufferDesc");
  }
  Descriptor descriptor;
  const auto element = CheckElement(*device, view, name, descriptor);
  if (!element.ok()) return element.error();
  // Compare counts first, so that the products below cannot overflow.
  const uint64_t total = buffer.size() / *element;
  const uint64_t count = view.count ? view.count : (view.first < total ? total - view.first : 0);
  if (view.first > total || count > total - view.first) {
    return MakeError(Id::kViewRange, "elements ", view.first, "..", view.first + count,
                     " are outside ", name, ", which has ", total, " elements of ", *element,
                     " bytes");
  }
  descriptor.access = view.access;
  descriptor.address = buffer.GetGPUVirtualAddress() + view.first * *element;
  descriptor.size_bytes = count * *element;
  if (Status s = WriteCounter(device, view, descriptor); !s.ok()) return s;
  return WriteSlot(*device, dest, descriptor);
}

// The part of a texture that a view asks for, before "all the rest" is resolved.
struct TextureView {
  Format format;
  SrvDimension dimension;
  bool uav = false;
  uint32_t first_mip = 0;
  uint32_t mips = 1;
  uint32_t first_slice = 0;
  uint32_t slices = 1;
  float min_lod = 0;
};

bool FitsDimension(SrvDimension view, ResourceDimension resource) {
  switch (view) {
    case SrvDimension::kTexture1D:
    case SrvDimension::kTexture1DArray:
      return resource == ResourceDimension::kTexture1D;
    case SrvDimension::kTexture2D:
    case SrvDimension::kTexture2DArray:
    case SrvDimension::kTextureCube:
    case SrvDimension::kTextureCubeArray:
      return resource == ResourceDimension::kTexture2D;
    case SrvDimension::kTexture3D:
      return resource == ResourceDimension::kTexture3D;
    default:
      return false;
  }
}

Status CheckViewFormat(const DeviceImpl& device, const Texture& texture, const TextureView& view) {
  const Format own = texture.GetDesc().Format;
  const FormatInfo info = GetFormatInfo(view.format);
  const bool castable = view.format == own || (GetFormatInfo(own).type == FormatClass::kTypeless &&
                                               FormatFamily(own) == FormatFamily(view.format));
  if (IsDepthFormat(view.format)) {
    return MakeError(Id::kViewFormat, "view format ", static_cast<uint32_t>(view.format), " of ",
                     Named("texture", texture.name()),
                     " is a depth format, which shaders cannot read; create the texture with the "
                     "typeless format of the family, and view it as R32_FLOAT, R16_UNORM, "
                     "R24_UNORM_X8_TYPELESS or R32_FLOAT_X8X24_TYPELESS");
  }
  if (info.type == FormatClass::kUnsupported || info.type == FormatClass::kTypeless || !castable) {
    return MakeError(Id::kViewFormat, "view format ", static_cast<uint32_t>(view.format), " of ",
                     Named("texture", texture.name()), " with format ", static_cast<uint32_t>(own),
                     "; it must be the same, or a typed member of a typeless format's family");
  }
  if (!device.backend->supports_format(view.format, view.uav)) {
    return MakeError(Id::kViewFormat, "the backend does not support ",
                     view.uav ? "unordered access" : "shader resource", " views of format ",
                     static_cast<uint32_t>(view.format));
  }
  return {};
}

Status CheckSubresources(const Texture& texture, TextureView& view) {
  const TextureDesc& desc = texture.GetDesc();
  const std::string name = Named("texture", desc.Name);
  if (view.first_mip >= desc.MipLevels) {
    return MakeError(Id::kViewSubresources, "mip ", view.first_mip, " is outside ", name,
                     ", which has ", desc.MipLevels, " mips");
  }
  if (view.mips == 0xFFFFFFFFu) view.mips = desc.MipLevels - view.first_mip;
  if (view.mips == 0 || view.mips > desc.MipLevels - view.first_mip) {
    return MakeError(Id::kViewSubresources, view.mips, " mips from mip ", view.first_mip,
                     " on are outside ", name, ", which has ", desc.MipLevels, " mips");
  }
  const bool volume = view.dimension == SrvDimension::kTexture3D;
  const uint32_t total =
      volume ? GetMipExtent(desc, view.first_mip).depth : detail::ArraySize(desc);
  const bool cube = view.dimension == SrvDimension::kTextureCube ||
                    view.dimension == SrvDimension::kTextureCubeArray;
  if (view.slices == 0xFFFFFFFFu && view.first_slice < total) {
    view.slices = total - view.first_slice;
    if (cube) view.slices -= view.slices % 6;
  }
  if (view.first_slice >= total || view.slices == 0 || view.slices > total - view.first_slice) {
    return MakeError(Id::kViewSubresources, volume ? "w slices " : "array elements ",
                     view.first_slice, "..", uint64_t{view.first_slice} + view.slices,
                     " are outside ", name, ", which has ", total);
  }
  if (cube && (view.slices % 6 != 0 || desc.Width != desc.Height)) {
    return MakeError(Id::kViewSubresources, "a cube view needs 6 square faces, but this has ",
                     view.slices, " faces of ", desc.Width, "x", desc.Height);
  }
  return {};
}

// As shader::texture_shape() counts.
uint32_t NumberClass(Format format) {
  switch (GetFormatInfo(format).type) {
    case FormatClass::kSint:
      return 1;
    case FormatClass::kUint:
      return 2;
    default:
      return 0;
  }
}

Status WriteTextureView(const std::shared_ptr<DeviceImpl>& device, const Texture& texture,
                        TextureView view, uint32_t mapping, CpuDescriptorHandle dest) {
  if (Status s = CheckHandle(device, texture, "the viewed texture"); !s.ok()) return s;
  const TextureDesc& desc = texture.GetDesc();
  if (!FitsDimension(view.dimension, desc.Dimension)) {
    return MakeError(Id::kViewResource, "view dimension ", static_cast<uint32_t>(view.dimension),
                     " does not fit ", Named("texture", desc.Name), ", whose dimension is ",
                     static_cast<uint32_t>(desc.Dimension));
  }
  if (view.uav && GetFormatInfo(desc.Format).block_side != 1) {
    return MakeError(Id::kBlockAccess, Named("texture", desc.Name), " has DXGI format ",
                     static_cast<uint32_t>(desc.Format), "; only shader resource views read it");
  }
  if (view.uav && !HasAny(desc.Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return MakeError(Id::kViewAccess, Named("texture", desc.Name),
                     " was created without kAllowUnorderedAccess; add the flag to its TextureDesc");
  }
  if (!view.uav && HasAny(desc.Flags, ResourceFlags::kDenyShaderResource)) {
    return MakeError(Id::kViewAccess, Named("texture", desc.Name),
                     " was created with kDenyShaderResource; shaders cannot read it");
  }
  if (view.format == Format::kUnknown) view.format = desc.Format;
  if (Status s = CheckViewFormat(*device, texture, view); !s.ok()) return s;
  if (Status s = CheckSubresources(texture, view); !s.ok()) return s;
  runtime::TextureViewDesc resolved;
  resolved.format = view.format;
  resolved.dimension = view.dimension;
  resolved.unordered_access = view.uav;
  resolved.first_mip = view.first_mip;
  resolved.mip_count = view.mips;
  resolved.first_slice = view.first_slice;
  resolved.slice_count = view.slices;
  resolved.min_lod = view.min_lod;
  for (int i = 0; i < 4; ++i) {
    resolved.swizzle[i] = static_cast<uint8_t>((mapping >> (3 * i)) & 7);
    if (resolved.swizzle[i] > 5) {
      return MakeError(Id::kViewFormat, "Shader4ComponentMapping ", Hex(mapping), " of ",
                       Named("texture", desc.Name), " selects component ", int{resolved.swizzle[i]},
                       "; it must be 0 to 5");
    }
  }
  auto object = device->backend->create_texture_view(*texture.impl()->memory, resolved);
  if (!object.ok()) return object.error();
  device->views.AddView(*object, {desc.Name, desc, resolved, texture.impl()->memory});
  const uint64_t key = kaamos::shader::view_key(*object, view.uav);
  device->addresses.insert_view(key, texture.impl()->memory);
  if (device->checks) {
    device->checks->textures().add_view(key, texture.impl()->memory,
                                        {view.first_mip, view.mips, view.first_slice, view.slices});
  }
  Descriptor descriptor;
  descriptor.kind = DescriptorKind::kTexture;
  descriptor.access =
      view.uav ? DescriptorAccess::kUnorderedAccess : DescriptorAccess::kShaderResource;
  descriptor.stride_bytes = kaamos::shader::texture_shape(static_cast<uint32_t>(view.dimension),
                                                          NumberClass(view.format));
  descriptor.address = *object;
  descriptor.format = static_cast<uint32_t>(view.format);
  return WriteSlot(*device, dest, descriptor);
}

TextureView FromSrv(const ShaderResourceViewDesc& d) {
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

TextureView FromUav(const UnorderedAccessViewDesc& d) {
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

// The dimension of a view of the whole texture. As in D3D12, 2-D textures with several elements get
// an array view.
SrvDimension WholeDimension(const TextureDesc& desc) {
  switch (desc.Dimension) {
    case ResourceDimension::kTexture1D:
      return desc.DepthOrArraySize > 1 ? SrvDimension::kTexture1DArray : SrvDimension::kTexture1D;
    case ResourceDimension::kTexture3D:
      return SrvDimension::kTexture3D;
    default:
      return desc.DepthOrArraySize > 1 ? SrvDimension::kTexture2DArray : SrvDimension::kTexture2D;
  }
}

Status WriteAccelerationStructureView(const DeviceImpl& device, const Resource& resource,
                                      GpuVirtualAddress location, CpuDescriptorHandle dest) {
  if (!std::holds_alternative<std::monostate>(resource)) {
    return MakeError(Id::kAccelerationStructureView,
                     "the resource must be empty: the view's Location names the structure");
  }
  if (location % kRaytracingAccelerationStructureByteAlignment != 0) {
    return MakeError(Id::kAccelerationStructureView, "Location is ",
                     device.DescribeAddress(location), "; it must be a multiple of 256");
  }
  Descriptor descriptor;
  if (location != 0) {
    if (!device.addresses.find(location)) {
      return MakeError(Id::kAccelerationStructureView, "Location is ",
                       device.DescribeAddress(location));
    }
    descriptor.kind = DescriptorKind::kAccelerationStructure;
    descriptor.address = location;
  }
  return WriteSlot(device, dest, descriptor);
}

const char* KindName(const Resource& resource) {
  return std::holds_alternative<Buffer>(resource) ? "a buffer" : "a texture";
}

}  // namespace

Status Device::CreateShaderResourceView(const Resource& resource,
                                        const ShaderResourceViewDesc& desc,
                                        CpuDescriptorHandle dest) const {
  if (!impl_) return MakeError(Id::kNullHandle, "CreateShaderResourceView on an empty device");
  if (desc.ViewDimension == SrvDimension::kRaytracingAccelerationStructure) {
    return WriteAccelerationStructureView(*impl_, resource,
                                          desc.RaytracingAccelerationStructure.Location, dest);
  }
  if (std::holds_alternative<std::monostate>(resource)) return WriteSlot(*impl_, dest, {});
  const bool wants_buffer = desc.ViewDimension == SrvDimension::kBuffer;
  if (wants_buffer != std::holds_alternative<Buffer>(resource)) {
    return MakeError(Id::kViewResource, "view dimension ",
                     static_cast<uint32_t>(desc.ViewDimension), " does not fit ",
                     KindName(resource));
  }
  if (wants_buffer) {
    const BufferSrv& b = desc.Buffer;
    return WriteBufferView(
        impl_, std::get<Buffer>(resource),
        {desc.Format, b.FirstElement, b.NumElements, b.StructureByteStride,
         HasAny(b.Flags, BufferSrvFlags::kRaw), DescriptorAccess::kShaderResource},
        dest);
  }
  return WriteTextureView(impl_, std::get<Texture>(resource), FromSrv(desc),
                          desc.Shader4ComponentMapping, dest);
}

Status Device::CreateShaderResourceView(const Texture& texture, CpuDescriptorHandle dest) const {
  ShaderResourceViewDesc desc;
  desc.ViewDimension = WholeDimension(texture.GetDesc());
  return CreateShaderResourceView(Resource(texture), desc, dest);
}

Status Device::CreateUnorderedAccessView(const Resource& resource,
                                         const UnorderedAccessViewDesc& desc,
                                         CpuDescriptorHandle dest) const {
  return CreateUnorderedAccessView(resource, Buffer(), desc, dest);
}

Status Device::CreateUnorderedAccessView(const Resource& resource, const Buffer& counter,
                                         const UnorderedAccessViewDesc& desc,
                                         CpuDescriptorHandle dest) const {
  if (!impl_) return MakeError(Id::kNullHandle, "CreateUnorderedAccessView on an empty device");
  if (std::holds_alternative<std::monostate>(resource)) return WriteSlot(*impl_, dest, {});
  const bool wants_buffer = desc.ViewDimension == UavDimension::kBuffer;
  if (wants_buffer != std::holds_alternative<Buffer>(resource)) {
    return MakeError(Id::kViewResource, "view dimension ",
                     static_cast<uint32_t>(desc.ViewDimension), " does not fit ",
                     KindName(resource));
  }
  if (wants_buffer) {
    const BufferUav& b = desc.Buffer;
    return WriteBufferView(
        impl_, std::get<Buffer>(resource),
        {desc.Format, b.FirstElement, b.NumElements, b.StructureByteStride,
         HasAny(b.Flags, BufferUavFlags::kRaw), DescriptorAccess::kUnorderedAccess,
         counter ? &counter : nullptr, b.CounterOffsetInBytes},
        dest);
  }
  if (counter) {
    return MakeError(Id::kViewCounter, "a counter in ", Named("buffer", counter.name()),
                     " is given for a view of a texture");
  }
  return WriteTextureView(impl_, std::get<Texture>(resource), FromUav(desc),
                          kDefaultShader4ComponentMapping, dest);
}

Status Device::CreateUnorderedAccessView(const Texture& texture, CpuDescriptorHandle dest) const {
  UnorderedAccessViewDesc desc;
  desc.ViewDimension = static_cast<UavDimension>(WholeDimension(texture.GetDesc()));
  return CreateUnorderedAccessView(Resource(texture), desc, dest);
}

Status Device::CreateConstantBufferView(const ConstantBufferViewDesc& desc,
                                        CpuDescriptorHandle dest) const {
  if (!impl_) return MakeError(Id::kNullHandle, "CreateConstantBufferView on an empty device");
  Descriptor descriptor;
  descriptor.access = DescriptorAccess::kOther;
  if (desc.BufferLocation != 0) {
    if (desc.BufferLocation % 256 != 0 || desc.SizeInBytes % 256 != 0 || desc.SizeInBytes == 0 ||
        desc.SizeInBytes > 65536) {
      return MakeError(Id::kConstantBufferView, desc.SizeInBytes, " bytes at ",
                       impl_->DescribeAddress(desc.BufferLocation),
                       "; address and size must be multiples of 256, the size at most 65536");
    }
    if (!impl_->addresses.contains(desc.BufferLocation, desc.SizeInBytes)) {
      return MakeError(Id::kConstantBufferView, desc.SizeInBytes, " bytes at ",
                       impl_->DescribeAddress(desc.BufferLocation),
                       " are not inside one live buffer");
    }
    descriptor.kind = DescriptorKind::kConstantBuffer;
    descriptor.address = desc.BufferLocation;
    descriptor.size_bytes = desc.SizeInBytes;
  }
  return WriteSlot(*impl_, dest, descriptor);
}

}  // namespace rtapi
