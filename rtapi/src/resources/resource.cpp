// SPDX-License-Identifier: MIT
#include <rtapi/resource.h>

#include <algorithm>

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/device/device_level.h"
#include "rtapi/src/resources/resource_impl.h"

namespace rtapi {

namespace detail {

namespace {

constexpr uint64_t kMaxBufferBytes = uint64_t{1} << 40;

Status check_buffer(const DeviceImpl& device, const BufferDesc& desc) {
  const std::string name = named("buffer", desc.Name);
  if (desc.SizeInBytes == 0 || desc.SizeInBytes > kMaxBufferBytes) {
    return make_error(Id::kBufferSize, name, " has ", desc.SizeInBytes,
                      " bytes; it must have 1 to 2^40");
  }
  if (desc.Heap < HeapType::kDefault || desc.Heap > HeapType::kCustom) {
    return make_error(Id::kBufferHeap, name, " has heap type ", static_cast<uint32_t>(desc.Heap),
                      "; it must be kDefault, kUpload, kReadback or kCustom");
  }
  const bool unordered = HasAny(desc.Flags, ResourceFlags::kAllowUnorderedAccess);
  if ((desc.Flags & ~ResourceFlags::kAllowUnorderedAccess) != ResourceFlags::kNone) {
    return make_error(Id::kBufferHeap, name, " has undefined flags ",
                      hex(static_cast<uint32_t>(desc.Flags)));
  }
  const bool is_free = runtime::has_free_state(desc.Heap);
  if (unordered && !is_free) {
    return make_error(Id::kBufferHeap, name,
                      " has kAllowUnorderedAccess, which needs the default heap or a custom one");
  }
  if (desc.InitialState == ResourceStates::kRaytracingAccelerationStructure) {
    if (Status s = check_has_raytracing(device, name + ", which starts in state "
                                                       "kRaytracingAccelerationStructure,");
        !s.ok()) {
      return s;
    }
    if (!is_free || !unordered) {
      return make_error(Id::kAccelerationStructureBuffer, name,
                        " starts in state kRaytracingAccelerationStructure, which needs ",
                        is_free ? "the flag kAllowUnorderedAccess" : "the default heap");
    }
  } else if (HasAny(desc.InitialState, ResourceStates::kRaytracingAccelerationStructure)) {
    return make_error(Id::kAccelerationStructureBuffer, name,
                      " combines kRaytracingAccelerationStructure with another state");
  } else if (!is_free && desc.InitialState != ResourceStates::kCommon) {
    const ResourceStates fixed =
        desc.Heap == HeapType::kUpload ? ResourceStates::kGenericRead : ResourceStates::kCopyDest;
    if (desc.InitialState != fixed) {
      return make_error(Id::kBufferHeap, name, " starts in state ",
                        hex(static_cast<uint32_t>(desc.InitialState)), "; its heap allows only ",
                        hex(static_cast<uint32_t>(fixed)));
    }
  }
  return {};
}

uint32_t axis_limit(const TextureDesc& desc) {
  switch (desc.Dimension) {
    case ResourceDimension::kTexture1D:
      return kReqTexture1DUDimension;
    case ResourceDimension::kTexture2D:
      return kReqTexture2DUOrVDimension;
    default:
      return kReqTexture3DUVOrWDimension;
  }
}

// [D3D12: D3D12_RESOURCE_FLAGS]
Status check_texture_flags(const TextureDesc& desc, const std::string& name) {
  using F = ResourceFlags;
  constexpr F kKnown = F::kAllowRenderTarget | F::kAllowDepthStencil | F::kAllowUnorderedAccess |
                       F::kDenyShaderResource;
  const auto fail = [&](const auto&... text) {
    return make_error(Id::kTextureFormat, name, " has ", text...);
  };
  if ((desc.Flags & ~kKnown) != F::kNone) {
    return fail("undefined flags ", hex(static_cast<uint32_t>(desc.Flags)));
  }
  const bool depth = HasAny(desc.Flags, F::kAllowDepthStencil);
  if (depth && HasAny(desc.Flags, F::kAllowRenderTarget | F::kAllowUnorderedAccess)) {
    return fail("kAllowDepthStencil, which does not go with render targets or unordered access");
  }
  if (depth && desc.Dimension != ResourceDimension::kTexture2D) {
    return fail("kAllowDepthStencil, which must be a 2-D texture");
  }
  if (HasAny(desc.Flags, F::kDenyShaderResource) && !depth) {
    return fail("kDenyShaderResource without kAllowDepthStencil");
  }
  if (depth && GetDepthFormat(desc.Format) == Format::kUnknown) {
    return fail("kAllowDepthStencil and DXGI format ", static_cast<uint32_t>(desc.Format),
                "; it must be a depth format or typeless: R32, R16, R24G8 or R32G8X24");
  }
  if (!depth && IsDepthFormat(desc.Format)) {
    return fail("depth format ", static_cast<uint32_t>(desc.Format),
                ", which needs the flag kAllowDepthStencil");
  }
  return {};
}

// [D3D12: D3D12_RESOURCE_DESC; DXGI_SAMPLE_DESC]
Status check_samples(const TextureDesc& desc, const std::string& name) {
  if (Status s = check_sample_desc(desc.SampleDesc, name); !s.ok()) return s;
  if (desc.SampleDesc.Count == 1) return {};
  const auto fail = [&](const auto&... text) {
    return make_error(Id::kSampleCount, name, " has ", desc.SampleDesc.Count, " samples and ",
                      text...);
  };
  if (desc.Dimension != ResourceDimension::kTexture2D) {
    return fail("dimension ", static_cast<uint32_t>(desc.Dimension), "; it must be kTexture2D");
  }
  if (!HasAny(desc.Flags, ResourceFlags::kAllowRenderTarget | ResourceFlags::kAllowDepthStencil)) {
    return fail(
        "neither kAllowRenderTarget nor kAllowDepthStencil, so that nothing could write it");
  }
  if (HasAny(desc.Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return fail("kAllowUnorderedAccess; shaders can only read it");
  }
  if (desc.MipLevels > 1) return fail(desc.MipLevels, " mip levels; it must have 1");
  return {};
}

Status check_backend_samples(const DeviceImpl& device, const TextureDesc& desc) {
  const bool depth = HasAny(desc.Flags, ResourceFlags::kAllowDepthStencil);
  return check_sample_support(device, depth ? GetDepthFormat(desc.Format) : desc.Format,
                              desc.SampleDesc.Count, named("texture", desc.Name));
}

// Checks that draws can write to a texture as its flags say. Typeless formats are tried by their
// views.
Status check_target_support(const DeviceImpl& device, const TextureDesc& desc) {
  const bool depth = HasAny(desc.Flags, ResourceFlags::kAllowDepthStencil);
  if (!depth && !HasAny(desc.Flags, ResourceFlags::kAllowRenderTarget)) return {};
  const Format format = depth ? GetDepthFormat(desc.Format) : desc.Format;
  if (GetFormatInfo(format).type == FormatClass::kTypeless) return {};
  if (device.backend->supports_target(format, false)) return {};
  return make_error(Id::kTargetFormat, named("texture", desc.Name), " has DXGI format ",
                    static_cast<uint32_t>(desc.Format), ", which this backend cannot draw to");
}

// Sides need not be multiples of 4: as with UnalignedBlockTexturesSupported.
Status check_block_texture(const TextureDesc& desc, const std::string& name) {
  if (GetFormatInfo(desc.Format).block_side == 1) return {};
  if (HasAny(desc.Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(Id::kBlockAccess, name, " has block-compressed DXGI format ",
                      static_cast<uint32_t>(desc.Format),
                      " and kAllowUnorderedAccess; it must have no flags");
  }
  if (desc.Dimension == ResourceDimension::kTexture1D) {
    return make_error(Id::kBlockDimension, name,
                      " is kTexture1D and has block-compressed DXGI format ",
                      static_cast<uint32_t>(desc.Format), "; it must be kTexture2D or kTexture3D");
  }
  return {};
}

Status check_texture(const TextureDesc& desc) {
  const std::string name = named("texture", desc.Name);
  const auto d = desc.Dimension;
  if (d != ResourceDimension::kTexture1D && d != ResourceDimension::kTexture2D &&
      d != ResourceDimension::kTexture3D) {
    return make_error(Id::kTextureSize, name, " has dimension ", static_cast<uint32_t>(d),
                      "; it must be kTexture1D, kTexture2D or kTexture3D");
  }
  const uint32_t limit = axis_limit(desc);
  const uint32_t depth_limit = d == ResourceDimension::kTexture3D ? kReqTexture3DUVOrWDimension
                                                                  : kReqTexture2DArrayAxisDimension;
  const uint32_t height_limit = d == ResourceDimension::kTexture1D ? 1 : limit;
  if (desc.Width == 0 || desc.Height == 0 || desc.DepthOrArraySize == 0 || desc.Width > limit ||
      desc.Height > height_limit || desc.DepthOrArraySize > depth_limit) {
    return make_error(Id::kTextureSize, name, " is ", desc.Width, "x", desc.Height, "x",
                      desc.DepthOrArraySize, "; it must be 1x1x1 to ", limit, "x", height_limit,
                      "x", depth_limit);
  }
  if (desc.MipLevels > full_mip_count(desc)) {
    return make_error(Id::kTextureSize, name, " has ", desc.MipLevels, " mip levels, but ",
                      desc.Width, "x", desc.Height, " texels allow at most ", full_mip_count(desc));
  }
  if (GetFormatInfo(desc.Format).type == FormatClass::kUnsupported) {
    return make_error(Id::kTextureFormat, name, " has DXGI format ",
                      static_cast<uint32_t>(desc.Format),
                      "; only the colour formats of rtapi/format.h are supported");
  }
  if (Status s = check_block_texture(desc, name); !s.ok()) return s;
  if (Status s = check_texture_flags(desc, name); !s.ok()) return s;
  if (Status s = check_samples(desc, name); !s.ok()) return s;
  if (HasAny(desc.InitialState, ResourceStates::kRaytracingAccelerationStructure)) {
    return make_error(Id::kAccelerationStructureBuffer, name,
                      " is a texture; only buffers hold acceleration structures");
  }
  return {};
}

}  // namespace

Status check_sample_desc(const SampleDesc& desc, const std::string& name) {
  constexpr uint32_t kStandardPattern = 0xFFFFFFFFu;
  const bool level = desc.Quality == 0 || (desc.Count > 1 && desc.Quality == kStandardPattern);
  if (desc.Count != 0 && level) return {};
  return make_error(Id::kSampleCount, name, " has SampleDesc {", desc.Count, ", ", desc.Quality,
                    "}; the count must be at least 1, and the quality 0");
}

Status check_sample_support(const DeviceImpl& device, Format format, uint32_t count,
                            const std::string& name) {
  if (sample_levels(device, format, count) != 0) return {};
  std::string allowed;
  for (const uint32_t other : {1u, 2u, 4u, 8u, 16u}) {
    if (sample_levels(device, format, other) == 0) continue;
    allowed += concat(allowed.empty() ? "" : ", ", other);
  }
  return make_error(Id::kSampleCount, name, " has ", count, " samples; this backend has ", allowed,
                    " for DXGI format ", static_cast<uint32_t>(format));
}

uint32_t sample_levels(const DeviceImpl& device, Format format, uint32_t count) {
  if (count <= 1) return count;
  // Views of typeless textures have the formats.
  const bool typeless = GetFormatInfo(format).type == FormatClass::kTypeless;
  return device.backend->supports_samples(typeless ? Format::kUnknown : format, count) ? 1 : 0;
}

MipExtent get_mip_extent(const TextureDesc& desc, uint32_t mip) {
  auto at = [mip](uint32_t size) { return std::max(1u, mip < 32 ? size >> mip : 0u); };
  const bool volume = desc.Dimension == ResourceDimension::kTexture3D;
  return {at(desc.Width), at(desc.Height), volume ? at(desc.DepthOrArraySize) : 1};
}

MipExtent get_mip_elements(const TextureDesc& desc, uint32_t mip) {
  const uint32_t side = GetFormatInfo(desc.Format).block_side;
  const MipExtent texels = get_mip_extent(desc, mip);
  return {(texels.width + side - 1) / side, (texels.height + side - 1) / side, texels.depth};
}

uint32_t full_mip_count(const TextureDesc& desc) {
  uint32_t size = std::max(desc.Width, desc.Height);
  if (desc.Dimension == ResourceDimension::kTexture3D) {
    size = std::max<uint32_t>(size, desc.DepthOrArraySize);
  }
  uint32_t count = 0;
  for (; size > 0; size >>= 1) ++count;
  return count;
}

uint32_t array_size(const TextureDesc& desc) {
  return desc.Dimension == ResourceDimension::kTexture3D ? 1 : desc.DepthOrArraySize;
}

SubresourcePlace subresource_place(const TextureDesc& desc, uint32_t subresource) {
  const uint32_t elements = array_size(desc);
  const uint32_t layer = subresource / desc.MipLevels;
  return {subresource % desc.MipLevels, layer % elements, layer / elements};
}

uint32_t format_family(Format format) {
  const auto f = static_cast<uint32_t>(format);
  // First and last number of each DXGI format family, including its typeless member.
  static constexpr uint32_t kFamilies[][2] = {{1, 4},   {5, 8},   {9, 14},  {15, 18}, {19, 22},
                                              {23, 25}, {27, 32}, {33, 38}, {39, 43}, {44, 47},
                                              {48, 52}, {53, 59}, {60, 64}, {70, 72}, {73, 75},
                                              {76, 78}, {79, 81}, {82, 84}, {94, 96}, {97, 99}};
  for (const auto& family : kFamilies) {
    if (f >= family[0] && f <= family[1]) return family[0];
  }
  switch (format) {
    case Format::kB8G8R8A8Typeless:
    case Format::kB8G8R8A8Unorm:
    case Format::kB8G8R8A8UnormSrgb:
      return 90;
    case Format::kB8G8R8X8Typeless:
    case Format::kB8G8R8X8Unorm:
    case Format::kB8G8R8X8UnormSrgb:
      return 92;
    default:
      return f;
  }
}

bool castable(Format resource, Format view) {
  if (resource == view) return true;
  if (format_family(resource) != format_family(view)) return false;
  using C = FormatClass;
  const C from = GetFormatInfo(resource).type, to = GetFormatInfo(view).type;
  if (from == C::kTypeless) return true;
  if (IsDepthFormat(resource)) return false;  // [RAS-71]
  const auto among = [&](C a, C b) { return (from == a && to == b) || (from == b && to == a); };
  return (from == C::kFloat) == (to == C::kFloat) && !among(C::kUnorm, C::kSnorm);
}

BufferImpl::~BufferImpl() {
  if (memory) device->addresses.erase(memory->address());
}

Result<Buffer> make_buffer(const std::shared_ptr<DeviceImpl>& device, const BufferDesc& desc,
                           const runtime::HeapPlace* place) {
  if (Status s = device->removed(); !s.ok()) return s.error();
  if (Status s = check_buffer(*device, desc); !s.ok()) return s.error();
  auto memory = place != nullptr ? device->backend->create_placed_buffer(*place, desc)
                                 : device->backend->create_buffer(desc);
  if (!memory.ok()) return memory.error();
  auto buffer = std::make_shared<BufferImpl>();
  buffer->device = device;
  buffer->desc = desc;
  buffer->memory = std::move(*memory);
  device->addresses.insert({buffer->memory->address(), desc.SizeInBytes, desc.Heap, desc.Flags,
                            desc.InitialState == ResourceStates::kRaytracingAccelerationStructure,
                            desc.Name, buffer->memory->host(), buffer});
  return Buffer(std::move(buffer));
}

Result<TextureDesc> checked_texture(const DeviceImpl& device, const TextureDesc& desc) {
  if (Status s = check_texture(desc); !s.ok()) return s.error();
  if (Status s = check_target_support(device, desc); !s.ok()) return s.error();
  if (Status s = check_backend_samples(device, desc); !s.ok()) return s.error();
  TextureDesc resolved = desc;
  if (resolved.MipLevels == 0) {
    const bool one = desc.SampleDesc.Count > 1;
    resolved.MipLevels = static_cast<uint16_t>(one ? 1 : full_mip_count(desc));
  }
  return resolved;
}

Result<Texture> make_texture(const std::shared_ptr<DeviceImpl>& device, const TextureDesc& desc,
                             const runtime::HeapPlace* place) {
  if (Status s = device->removed(); !s.ok()) return s.error();
  auto resolved = checked_texture(*device, desc);
  if (!resolved.ok()) return resolved.error();
  auto memory = place != nullptr ? device->backend->create_placed_texture(*place, *resolved)
                                 : device->backend->create_texture(*resolved);
  if (!memory.ok()) return memory.error();
  auto texture = std::make_shared<TextureImpl>();
  texture->device = device;
  texture->desc = *std::move(resolved);
  texture->memory = std::move(*memory);
  if (device->checks) device->checks->textures().add(texture->memory, texture->desc);
  return Texture(std::move(texture));
}

}  // namespace detail

using namespace detail;

namespace {
const BufferDesc kEmptyBuffer;
const TextureDesc kEmptyTexture;
}  // namespace

const BufferDesc& Buffer::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyBuffer;
}
GpuVirtualAddress Buffer::GetGPUVirtualAddress() const {
  return impl_ ? impl_->memory->address() : 0;
}
void Buffer::SetName(std::string name) {
  if (!impl_) return;
  impl_->device->addresses.rename(impl_->memory->address(), name);
  impl_->desc.Name = std::move(name);
}

Result<std::span<std::byte>> Buffer::Map() const {
  if (!impl_) return make_error(Id::kNullHandle, "Map on an empty buffer handle");
  if (impl_->desc.Heap == HeapType::kDefault) {
    return make_error(Id::kMapDefaultHeap, named("buffer", impl_->desc.Name),
                      " is on the default heap; copy through an upload or readback buffer");
  }
  return mapped_bytes();
}

std::span<std::byte> Buffer::mapped_bytes() const {
  if (!impl_ || impl_->desc.Heap == HeapType::kDefault) return {};
  return {reinterpret_cast<std::byte*>(impl_->memory->host()), impl_->desc.SizeInBytes};
}

const TextureDesc& Texture::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyTexture;
}
uint32_t Texture::subresource_count() const {
  return impl_ ? impl_->desc.MipLevels * array_size(impl_->desc) *
                     runtime::plane_count(impl_->desc.Format)
               : 0;
}
void Texture::SetName(std::string name) {
  if (!impl_) return;
  if (impl_->device->checks) impl_->device->checks->textures().rename(impl_->memory.get(), name);
  impl_->desc.Name = std::move(name);
}

Result<Buffer> Device::CreateBuffer(const BufferDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateBuffer on an empty device handle");
  return make_buffer(impl_, desc, nullptr);
}

Result<Texture> Device::CreateTexture(const TextureDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateTexture on an empty device handle");
  return make_texture(impl_, desc, nullptr);
}

uint32_t Device::GetMultisampleQualityLevels(Format format, uint32_t count) const {
  if (!impl_) return 0;
  const bool typeless = GetFormatInfo(format).type == FormatClass::kTypeless;
  if (!typeless && !impl_->backend->supports_target(format, false)) return 0;
  return sample_levels(*impl_, format, count);
}

Result<uint64_t> Device::GetCopyableFootprints(const TextureDesc& desc, uint32_t first,
                                               uint32_t count, uint64_t base_offset,
                                               std::vector<PlacedSubresourceFootprint>* layouts,
                                               std::vector<uint32_t>* row_counts,
                                               std::vector<uint64_t>* row_bytes) const {
  if (Status s = check_texture(desc); !s.ok()) return s.error();
  if (desc.SampleDesc.Count > 1) {
    return make_error(Id::kSampleMismatch, named("texture", desc.Name), " has ",
                      desc.SampleDesc.Count,
                      " samples; only textures of one sample have a layout in buffers");
  }
  const uint32_t mips = desc.MipLevels ? desc.MipLevels : full_mip_count(desc);
  const uint32_t of_plane = mips * detail::array_size(desc);
  const uint64_t total = uint64_t{of_plane} * runtime::plane_count(desc.Format);
  if (uint64_t{first} + count > total) {
    return make_error(Id::kCopyRange, "subresources ", first, "..", uint64_t{first} + count,
                      " do not exist in ", named("texture", desc.Name), ", which has ", total);
  }
  uint64_t offset = 0;  // from base_offset
  uint64_t end = 0;
  for (uint32_t i = first; i < first + count; ++i) {
    const Format copied = runtime::plane_format(desc.Format, i / of_plane);
    const FormatInfo format = GetFormatInfo(copied);
    const MipExtent extent = get_mip_elements(desc, i % mips);
    const uint64_t row = uint64_t{extent.width} * format.bytes;
    const uint64_t pitch = align_up(row, kTextureDataPitchAlignment);
    offset = align_up(offset, kTextureDataPlacementAlignment);
    if (layouts) {
      layouts->push_back(
          {base_offset + offset,
           {copied, extent.width * format.block_side, extent.height * format.block_side,
            extent.depth, static_cast<uint32_t>(pitch)}});
    }
    if (row_counts) row_counts->push_back(extent.height);
    if (row_bytes) row_bytes->push_back(row);
    // The last row needs no padding, as in D3D12.
    end = offset + pitch * (uint64_t{extent.height} * extent.depth - 1) + row;
    offset += pitch * extent.height * extent.depth;
  }
  return end;
}

}  // namespace rtapi
