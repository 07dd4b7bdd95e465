// SPDX-License-Identifier: MIT
//
// A top level: a Vulkan acceleration structure, its part of the instance table, and the bottom
// levels that it keeps alive.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <rtapi/result.h>

#include "runtime/structures/instances.h"
#include "runtime/vulkan/structures/bottom_level.h"
#include "runtime/vulkan/structures/instance_table.h"
#include "runtime/vulkan/structures/micromap_buffers.h"

namespace kaamos::vulkan {

class TopLevel final : public runtime::TopLevelBase {
 public:
  // `instances` are in input order: the index is InstanceIndex. Errors: KA0794 too many instances,
  // KA0990 out of memory.
  static rtapi::Result<std::shared_ptr<TopLevel>> build(
      const std::shared_ptr<Gpu>& gpu, InstanceTable& table,
      std::span<const runtime::Instance> instances, runtime::BuildFlags flags);

  uint64_t address() const { return structure_->address(); }  // what accelerationStructureEXT takes
  // As shaders find it under the application's address.
  shader::spirv::TopLevelEntry entry(uint64_t application_address) const;
  // Tells shaders where the micromap arrays are that linkages have found. Must not be called while
  // a dispatch runs. Errors: those of MicromapBuffers::address_of.
  rtapi::Status link_micromaps(MicromapBuffers& buffers) const;
  uint64_t held_bytes() const { return held_bytes_; }
  // The largest index of a hit record that a ray can ask for: the ray contributes at most 15, and
  // the geometries at most 15 each. [DXR: Hit group table indexing]
  uint64_t largest_hit_record() const { return largest_hit_record_; }

 private:
  TopLevel() = default;
  rtapi::Status add_micromaps(const std::shared_ptr<Gpu>& gpu,
                              std::span<const runtime::Instance> instances,
                              std::span<shader::spirv::InstanceEntry> entries);

  std::unique_ptr<VulkanStructure> structure_;
  // Only where a bottom level has opacity micromaps: what spirv::TopLevelEntry has for rays that
  // use them, and spirv::GeometryMicromaps of all geometries.
  std::unique_ptr<VulkanStructure> with_micromaps_;
  std::unique_ptr<VulkanStructure> all_candidates_;
  std::unique_ptr<GpuBuffer> micromaps_;
  InstanceTable::Range entries_;
  uint64_t held_bytes_ = 0;
  uint64_t largest_hit_record_ = 0;
  std::vector<std::shared_ptr<const runtime::BottomLevelBase>> bottom_levels_;  // each appears once
};

}  // namespace kaamos::vulkan
