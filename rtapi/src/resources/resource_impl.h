// SPDX-License-Identifier: MIT
//
// The objects behind the handles of resource.h and descriptor.h.
#pragma once

#include <memory>
#include <vector>

#include <rtapi/descriptor.h>
#include <rtapi/resource.h>

#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

struct BufferImpl {
  std::shared_ptr<DeviceImpl> device;
  BufferDesc desc;
  std::shared_ptr<runtime::BackendBuffer> memory;
  ~BufferImpl();
};

struct TextureImpl {
  std::shared_ptr<DeviceImpl> device;
  TextureDesc desc;
  std::shared_ptr<runtime::BackendTexture> memory;
};

struct DescriptorHeapImpl {
  std::shared_ptr<DeviceImpl> device;
  DescriptorHeapDesc desc;
  std::shared_ptr<runtime::BackendBuffer> memory;
  std::vector<TargetSlot> targets;  // of RTVs and DSVs; their memory only gives them addresses
  ~DescriptorHeapImpl();
};

// Device::CreateBuffer and CreateTexture. `place`: null, or where in a heap the resource lies.
Result<Buffer> make_buffer(const std::shared_ptr<DeviceImpl>& device, const BufferDesc& desc,
                           const runtime::HeapPlace* place);
Result<Texture> make_texture(const std::shared_ptr<DeviceImpl>& device, const TextureDesc& desc,
                             const runtime::HeapPlace* place);
// The desc with its mips counted, if it is one that the device can have.
Result<TextureDesc> checked_texture(const DeviceImpl& device, const TextureDesc& desc);

// Size of a mip level in texels.
struct MipExtent {
  uint32_t width, height, depth;
  bool operator==(const MipExtent&) const = default;
};
MipExtent get_mip_extent(const TextureDesc& desc, uint32_t mip);
// The same in elements of the format: in whole blocks, if it is block-compressed.
MipExtent get_mip_elements(const TextureDesc& desc, uint32_t mip);
uint32_t full_mip_count(const TextureDesc& desc);
// KA0573 unless the quality is one that there is. `name` says of what, for messages.
Status check_sample_desc(const SampleDesc& desc, const std::string& name);
// KA0573 unless the backend has targets of the format with as many samples.
Status check_sample_support(const DeviceImpl& device, Format format, uint32_t count,
                            const std::string& name);
// Quality levels of such targets: 0 or 1. kUnknown: of any format.
uint32_t sample_levels(const DeviceImpl& device, Format format, uint32_t count);
uint32_t array_size(const TextureDesc& desc);  // 1 for 3-D textures

// A subresource by what its number says. [D3D12: subresources]
struct SubresourcePlace {
  uint32_t mip, array_element, plane;
};
// MipLevels must be resolved.
SubresourcePlace subresource_place(const TextureDesc& desc, uint32_t subresource);

// Formats of one family share their texel layout; 0 for formats that belong to none.
uint32_t format_family(Format format);
// Returns whether views of a resource may have another format than it. [D3D12: Relaxed Format
// Casting Rules]
bool castable(Format resource, Format view);

}  // namespace rtapi::detail
