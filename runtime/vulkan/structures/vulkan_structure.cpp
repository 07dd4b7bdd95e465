// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/vulkan_structure.h"

#include <utility>
#include <vector>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/structures/box_padding.h"

namespace kaamos::vulkan {
namespace {

using rtapi::HasAny;
using runtime::BuildFlags;

// Updates are builds here, and a compacted copy shares the original's memory, so neither needs a
// flag.
VkBuildAccelerationStructureFlagsKHR build_flags(BuildFlags flags) {
  VkBuildAccelerationStructureFlagsKHR result = 0;
  if (HasAny(flags, BuildFlags::kPreferFastTrace)) {
    result |= VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  } else if (HasAny(flags, BuildFlags::kPreferFastBuild)) {
    result |= VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR;
  }
  if (HasAny(flags, BuildFlags::kMinimizeMemory)) {
    result |= VK_BUILD_ACCELERATION_STRUCTURE_LOW_MEMORY_BIT_KHR;
  }
  return result;
}

rtapi::Status check_limit(const Gpu& gpu, const char* what, uint64_t count, uint64_t limit) {
  if (count <= limit) return {};
  return runtime::make_error(runtime::Id::kTooManyElements,
                             std::to_string(count) + " " + what + ", but " + gpu.info().Name +
                                 " takes at most " + std::to_string(limit) +
                                 ". Split it into several acceleration structures.");
}

rtapi::Status check_limits(const Gpu& gpu, VkAccelerationStructureTypeKHR type,
                           std::span<const StructureGeometry> geometries) {
  const auto& limits = gpu.properties().acceleration_structure;
  uint64_t primitives = 0;
  for (const auto& geometry : geometries) primitives += geometry.range.primitiveCount;
  if (type == VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR) {
    return check_limit(gpu, "instances in a top level", primitives, limits.maxInstanceCount);
  }
  if (auto s = check_limit(gpu, "geometries in a bottom level", geometries.size(),
                           limits.maxGeometryCount);
      !s) {
    return s;
  }
  return check_limit(gpu, "primitives in a bottom level", primitives, limits.maxPrimitiveCount);
}

uint64_t round_up(uint64_t value, uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

}  // namespace

VulkanStructure::~VulkanStructure() {
  gpu_->vk().vkDestroyAccelerationStructureKHR(gpu_->device(), handle_, nullptr);
}

rtapi::Result<std::unique_ptr<VulkanStructure>> VulkanStructure::build(
    std::shared_ptr<Gpu> gpu_pointer, VkAccelerationStructureTypeKHR type, BuildFlags flags,
    std::span<const StructureGeometry> geometries, uint64_t extra_bytes) {
  std::unique_ptr<VulkanStructure> result(new VulkanStructure(std::move(gpu_pointer)));
  Gpu& gpu = *result->gpu_;
  if (auto s = check_limits(gpu, type, geometries); !s) return s.error();
  const bool top = type == VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
  const std::string what = top ? "top level" : "bottom level";
  std::vector<VkAccelerationStructureGeometryKHR> descs;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
  std::vector<uint32_t> counts;
  for (const StructureGeometry& geometry : geometries) {
    descs.push_back(geometry.geometry);
    ranges.push_back(geometry.range);
    counts.push_back(geometry.range.primitiveCount);
  }
  VkAccelerationStructureBuildGeometryInfoKHR info = {
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  info.type = type;
  info.flags = build_flags(flags);
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<uint32_t>(descs.size());
  info.pGeometries = descs.data();
  VkAccelerationStructureBuildSizesInfoKHR sizes = {
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  gpu.vk().vkGetAccelerationStructureBuildSizesKHR(
      gpu.device(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, counts.data(), &sizes);

  result->size_bytes_ = round_up(sizes.accelerationStructureSize, 256);
  auto storage = gpu.create_buffer(result->size_bytes_ + extra_bytes, what, InitialContents::kAny);
  if (!storage) return storage.error();
  result->storage_ = std::move(*storage);
  const uint64_t alignment =
      gpu.properties().acceleration_structure.minAccelerationStructureScratchOffsetAlignment;
  auto scratch = gpu.create_buffer(sizes.buildScratchSize + alignment,
                                   "scratch memory of a " + what, InitialContents::kAny);
  if (!scratch) return scratch.error();

  VkAccelerationStructureCreateInfoKHR create = {
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
  create.buffer = result->storage_->handle();
  create.offset = result->storage_->offset();
  create.size = sizes.accelerationStructureSize;
  create.type = type;
  const VkResult r =
      gpu.vk().vkCreateAccelerationStructureKHR(gpu.device(), &create, nullptr, &result->handle_);
  if (r != VK_SUCCESS) return gpu.error(r, what);
  info.dstAccelerationStructure = result->handle_;
  info.scratchData.deviceAddress = round_up((*scratch)->address(), alignment);
  const VkAccelerationStructureBuildRangeInfoKHR* range_pointer = ranges.data();
  const auto status = gpu.run(
      [&](VkCommandBuffer commands) {
        gpu.vk().vkCmdBuildAccelerationStructuresKHR(commands, 1, &info, &range_pointer);
      },
      "build of a " + what);
  if (!status) return status.error();
  if (gpu.workarounds().has(Workaround::kPadBoxes)) {
    uint64_t leaves = 0;
    for (const uint32_t count : counts) leaves += count;
    pad_boxes({result->storage_->host(), result->size_bytes_}, leaves);
  }
  VkAccelerationStructureDeviceAddressInfoKHR address = {
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
  address.accelerationStructure = result->handle_;
  result->address_ = gpu.vk().vkGetAccelerationStructureDeviceAddressKHR(gpu.device(), &address);
  return result;
}

}  // namespace kaamos::vulkan
