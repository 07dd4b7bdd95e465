// SPDX-License-Identifier: MIT
//
// Shader resource, unordered access and constant buffer views: checks, then 32 bytes in a heap
// slot. What concerns textures is in texture_view.cpp.
#include <algorithm>
#include <cstring>

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/device/device_level.h"
#include "rtapi/src/resources/resource_impl.h"
#include "rtapi/src/resources/texture_view.h"

namespace rtapi {

using namespace detail;

namespace {

using shader::Descriptor;
using shader::DescriptorAccess;
using shader::DescriptorKind;

// The part that the SRVs and UAVs of buffers have in common.
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

Status write_slot(const DeviceImpl& device, CpuDescriptorHandle dest, const Descriptor& value) {
  const auto slot = device.find_slot(dest);
  if (!slot || slot->type != DescriptorHeapType::kCbvSrvUav) {
    return make_error(Id::kDescriptorHandle, "view: ", hex(dest.ptr), describe_heap(slot),
                      "; it must be in one of kCbvSrvUav");
  }
  std::memcpy(slot->slot, &value, sizeof value);
  return {};
}

// Determines element size and kind by the rules of format and stride. [D3D12: D3D12_BUFFER_SRV]
Result<uint32_t> check_element(const DeviceImpl& device, const BufferView& view,
                               const std::string& name, Descriptor& out) {
  const bool uav = view.access == DescriptorAccess::kUnorderedAccess;
  if (view.raw) {
    if (view.format != Format::kR32Typeless || view.stride != 0) {
      return make_error(Id::kViewFormat, "raw view of ", name, " has format ",
                        static_cast<uint32_t>(view.format), " and stride ", view.stride,
                        "; it must have format kR32Typeless and no stride");
    }
    if (view.first * 4 % kRawUavSrvByteAlignment != 0) {
      return make_error(Id::kViewStride, "raw view of ", name, " starts at byte ", view.first * 4,
                        "; it must be a multiple of 16");
    }
    out.kind = DescriptorKind::kRawBuffer;
    return 4u;
  }
  if (view.stride != 0) {
    if (view.format != Format::kUnknown) {
      return make_error(Id::kViewFormat, "structured view of ", name, " has format ",
                        static_cast<uint32_t>(view.format), "; it must be kUnknown");
    }
    // Elements of 16-bit types have strides such as 2, 6 and 10.
    if (view.stride % 2 != 0 || view.stride > 2048) {
      return make_error(Id::kViewStride, "structured view of ", name, " has a stride of ",
                        view.stride, " bytes; it must be a multiple of 2, at most 2048");
    }
    out.kind = DescriptorKind::kStructuredBuffer;
    out.stride_bytes = view.stride;
    return view.stride;
  }
  const FormatInfo info = GetFormatInfo(view.format);
  // Formats of textures with depth, or depth and stencil, are none of buffers.
  const uint32_t family = format_family(view.format);
  const bool of_depth = IsDepthFormat(view.format) ||
                        family == static_cast<uint32_t>(Format::kR32G8X24Typeless) ||
                        family == static_cast<uint32_t>(Format::kR24G8Typeless);
  const bool typed = info.type != FormatClass::kUnsupported &&
                     info.type != FormatClass::kTypeless && info.block_side == 1 && !of_depth;
  if (!typed || !device.backend->supports_format(view.format, uav)) {
    return make_error(Id::kViewFormat, "typed view of ", name, " has format ",
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

Status write_counter(const std::shared_ptr<DeviceImpl>& device, const BufferView& view,
                     Descriptor& descriptor) {
  const uint64_t offset = view.counter_offset;
  if (view.counter == nullptr) {
    if (offset == 0) return {};
    return make_error(Id::kViewCounter, "CounterOffsetInBytes is ", offset,
                      ", but no buffer for a counter is given; it must be 0 then");
  }
  const Buffer& counter = *view.counter;
  if (Status s = CheckHandle(device, counter, "the counter's buffer"); !s.ok()) return s;
  const std::string name = named("buffer", counter.name());
  if (descriptor.kind != DescriptorKind::kStructuredBuffer) {
    return make_error(Id::kViewCounter, "a counter in ", name,
                      " is given for a view that is not structured");
  }
  if (!HasAny(counter.GetDesc().Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(Id::kViewCounter, name,
                      ", which holds the counter, was created without kAllowUnorderedAccess");
  }
  if (offset % kCounterAlignment != 0 || counter.size() < 4 || offset > counter.size() - 4) {
    return make_error(Id::kViewCounter, "CounterOffsetInBytes is ", offset,
                      "; it must be a multiple of 4096, with 4 bytes from there on in ", name,
                      ", which has ", counter.size(), " bytes");
  }
  set_counter(descriptor, counter.GetGPUVirtualAddress() + offset);
  return {};
}

Status write_buffer_view(const std::shared_ptr<DeviceImpl>& device, const Buffer& buffer,
                         const BufferView& view, CpuDescriptorHandle dest) {
  if (Status s = CheckHandle(device, buffer, "the viewed buffer"); !s.ok()) return s;
  const std::string name = named("buffer", buffer.name());
  const bool uav = view.access == DescriptorAccess::kUnorderedAccess;
  if (uav && !HasAny(buffer.GetDesc().Flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(Id::kViewAccess, name,
                      " was created without kAllowUnorderedAccess; add the flag to its BufferDesc");
  }
  Descriptor descriptor;
  const auto element = check_element(*device, view, name, descriptor);
  if (!element.ok()) return element.error();
  // Compare counts first, so that the products below cannot overflow.
  const uint64_t total = buffer.size() / *element;
  const uint64_t count = view.count ? view.count : (view.first < total ? total - view.first : 0);
  if (view.first > total || count > total - view.first) {
    return make_error(Id::kViewRange, "elements ", view.first, "..", view.first + count,
                      " are outside ", name, ", which has ", total, " elements of ", *element,
                      " bytes");
  }
  descriptor.access = view.access;
  descriptor.address = buffer.GetGPUVirtualAddress() + view.first * *element;
  descriptor.size_bytes = count * *element;
  if (Status s = write_counter(device, view, descriptor); !s.ok()) return s;
  return write_slot(*device, dest, descriptor);
}

Status write_texture_view(const std::shared_ptr<DeviceImpl>& device, const Texture& texture,
                          const TextureView& view, uint32_t mapping, CpuDescriptorHandle dest) {
  auto descriptor = make_texture_descriptor(device, texture, view, mapping);
  if (!descriptor.ok()) return descriptor.error();
  return write_slot(*device, dest, *descriptor);
}

const char* kind_name(const Resource& resource) {
  return std::holds_alternative<Buffer>(resource) ? "a buffer" : "a texture";
}

Status write_acceleration_structure_view(const DeviceImpl& device, const Resource& resource,
                                         GpuVirtualAddress location, CpuDescriptorHandle dest) {
  if (Status s = check_has_raytracing(device, "a view of an acceleration structure"); !s.ok()) {
    return s;
  }
  if (!std::holds_alternative<std::monostate>(resource)) {
    device.report(
        MessageSeverity::kWarning,
        make_error(Id::kViewAdjusted, "acceleration structure view: ", kind_name(resource),
                   " is given beside Location, which names the structure; it is ignored"));
  }
  if (location % kRaytracingAccelerationStructureByteAlignment != 0) {
    return make_error(Id::kAccelerationStructureView, "Location is ",
                      device.describe_address(location), "; it must be a multiple of 256");
  }
  Descriptor descriptor;
  if (location != 0) {
    if (!device.addresses.find(location)) {
      return make_error(Id::kAccelerationStructureView, "Location is ",
                        device.describe_address(location));
    }
    descriptor.kind = DescriptorKind::kAccelerationStructure;
    descriptor.address = location;
  }
  return write_slot(device, dest, descriptor);
}

}  // namespace

Status Device::CreateShaderResourceView(const Resource& resource,
                                        const ShaderResourceViewDesc& desc,
                                        CpuDescriptorHandle dest) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateShaderResourceView on an empty device");
  if (desc.ViewDimension == SrvDimension::kRaytracingAccelerationStructure) {
    return write_acceleration_structure_view(*impl_, resource,
                                             desc.RaytracingAccelerationStructure.Location, dest);
  }
  if (std::holds_alternative<std::monostate>(resource)) return write_slot(*impl_, dest, {});
  const bool wants_buffer = desc.ViewDimension == SrvDimension::kBuffer;
  if (wants_buffer != std::holds_alternative<Buffer>(resource)) {
    return make_error(Id::kViewResource, "view dimension ",
                      static_cast<uint32_t>(desc.ViewDimension), " does not fit ",
                      kind_name(resource));
  }
  if (wants_buffer) {
    const BufferSrv& b = desc.Buffer;
    return write_buffer_view(
        impl_, std::get<Buffer>(resource),
        {desc.Format, b.FirstElement, b.NumElements, b.StructureByteStride,
         HasAny(b.Flags, BufferSrvFlags::kRaw), DescriptorAccess::kShaderResource},
        dest);
  }
  return write_texture_view(impl_, std::get<Texture>(resource), from_srv(desc),
                            desc.Shader4ComponentMapping, dest);
}

Status Device::CreateShaderResourceView(const Texture& texture, CpuDescriptorHandle dest) const {
  ShaderResourceViewDesc desc;
  desc.ViewDimension = whole_dimension(texture.GetDesc());
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
  if (!impl_) return make_error(Id::kNullHandle, "CreateUnorderedAccessView on an empty device");
  if (std::holds_alternative<std::monostate>(resource)) return write_slot(*impl_, dest, {});
  const bool wants_buffer = desc.ViewDimension == UavDimension::kBuffer;
  if (wants_buffer != std::holds_alternative<Buffer>(resource)) {
    return make_error(Id::kViewResource, "view dimension ",
                      static_cast<uint32_t>(desc.ViewDimension), " does not fit ",
                      kind_name(resource));
  }
  if (wants_buffer) {
    const BufferUav& b = desc.Buffer;
    return write_buffer_view(
        impl_, std::get<Buffer>(resource),
        {desc.Format, b.FirstElement, b.NumElements, b.StructureByteStride,
         HasAny(b.Flags, BufferUavFlags::kRaw), DescriptorAccess::kUnorderedAccess,
         counter ? &counter : nullptr, b.CounterOffsetInBytes},
        dest);
  }
  if (counter) {
    return make_error(Id::kViewCounter, "a counter in ", named("buffer", counter.name()),
                      " is given for a view of a texture");
  }
  return write_texture_view(impl_, std::get<Texture>(resource), from_uav(desc),
                            kDefaultShader4ComponentMapping, dest);
}

Status Device::CreateUnorderedAccessView(const Texture& texture, CpuDescriptorHandle dest) const {
  UnorderedAccessViewDesc desc;
  desc.ViewDimension = static_cast<UavDimension>(whole_dimension(texture.GetDesc()));
  return CreateUnorderedAccessView(Resource(texture), desc, dest);
}

Status Device::CreateConstantBufferView(const ConstantBufferViewDesc& desc,
                                        CpuDescriptorHandle dest) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateConstantBufferView on an empty device");
  Descriptor descriptor;
  descriptor.access = DescriptorAccess::kOther;
  if (desc.BufferLocation != 0) {
    if (desc.BufferLocation % 256 != 0 || desc.SizeInBytes % 256 != 0 || desc.SizeInBytes == 0 ||
        desc.SizeInBytes > 65536) {
      return make_error(Id::kConstantBufferView, desc.SizeInBytes, " bytes at ",
                        impl_->describe_address(desc.BufferLocation),
                        "; address and size must be multiples of 256, the size at most 65536");
    }
    const uint64_t there = impl_->addresses.bytes_from(desc.BufferLocation);
    if (there == 0) {
      return make_error(Id::kConstantBufferView, desc.SizeInBytes, " bytes at ",
                        impl_->describe_address(desc.BufferLocation), " are in no live buffer");
    }
    // Buffers lie in heaps, which have the bytes up to the next 64 KiB; here they read as zero.
    if (there < desc.SizeInBytes) {
      impl_->report(MessageSeverity::kWarning,
                    make_error(Id::kViewAdjusted, "constant buffer view: ", desc.SizeInBytes,
                               " bytes at ", impl_->describe_address(desc.BufferLocation),
                               ", which has ", there, " from there on; what is past them reads 0"));
    }
    descriptor.kind = DescriptorKind::kConstantBuffer;
    descriptor.address = desc.BufferLocation;
    descriptor.size_bytes = std::min<uint64_t>(desc.SizeInBytes, there);
  }
  return write_slot(*impl_, dest, descriptor);
}

}  // namespace rtapi
