// SPDX-License-Identifier: MIT
//
// A Vulkan acceleration structure, with its memory.
#pragma once

#include <volk.h>

#include <memory>
#include <span>
#include <string>

#include <rtapi/result.h>

#include "runtime/structures/structure_map.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

struct StructureGeometry {
  VkAccelerationStructureGeometryKHR geometry = {};
  VkAccelerationStructureBuildRangeInfoKHR range = {};
};

class VulkanStructure {
 public:
  // Builds on the queue and waits. `extra_bytes` of memory, a multiple of 4, come with it. Errors:
  // KA0794 more geometries, primitives or instances than the device supports, KA0990 out of memory.
  static rtapi::Result<std::unique_ptr<VulkanStructure>> build(
      std::shared_ptr<Gpu> gpu, VkAccelerationStructureTypeKHR type, runtime::BuildFlags flags,
      std::span<const StructureGeometry> geometries, uint64_t extra_bytes);
  ~VulkanStructure();
  VulkanStructure(const VulkanStructure&) = delete;
  VulkanStructure& operator=(const VulkanStructure&) = delete;

  uint64_t address() const { return address_; }  // for instances and accelerationStructureEXT()
  uint64_t size_bytes() const { return size_bytes_; }  // without the extra memory
  uint8_t* host() const { return storage_->host(); }
  uint8_t* extra_host() const { return storage_->host() + size_bytes_; }
  uint64_t extra_address() const { return storage_->address() + size_bytes_; }

 private:
  explicit VulkanStructure(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}

  std::shared_ptr<Gpu> gpu_;
  std::unique_ptr<GpuBuffer> storage_;
  VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
  uint64_t address_ = 0;
  uint64_t size_bytes_ = 0;
};

}  // namespace kaamos::vulkan
