// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/top_level.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "runtime/vulkan/structures/sort.h"

namespace kaamos::vulkan {
namespace {

using shader::spirv::InstanceEntry;

// The driver's record; `custom_index` is the instance's place in the instance table. An instance
// that cannot be hit gets no bottom level and a plain transform, because a NaN would hide its
// neighbours (B6).
VkAccelerationStructureInstanceKHR record_of(const runtime::Instance& instance,
                                             uint32_t custom_index) {
  VkAccelerationStructureInstanceKHR record = {};
  record.instanceCustomIndex = custom_index & 0xFFFFFFu;
  for (int i = 0; i < 3; ++i) record.transform.matrix[i][i] = 1;
  if (instance.bottom_level == nullptr) return record;
  const rtapi::RaytracingInstanceDesc& desc = instance.desc;
  std::memcpy(&record.transform, desc.Transform, sizeof(record.transform));
  record.mask = desc.InstanceMask;
  record.instanceShaderBindingTableRecordOffset = desc.InstanceContributionToHitGroupIndex;
  // The bits have the same values as D3D12's. Both opacities at once are not allowed; opaque wins,
  // as on Embree.
  uint32_t flags = desc.Flags & 0xFu;
  if ((flags & runtime::kInstanceForceOpaque) != 0) flags &= ~runtime::kInstanceForceNonOpaque;
  record.flags = flags & 0xFu;
  record.accelerationStructureReference =
      static_cast<const BottomLevel&>(*instance.bottom_level).address();
  return record;
}

InstanceEntry entry_of(const runtime::Instance& instance, uint32_t index) {
  InstanceEntry entry;
  entry.instance_index = index;
  entry.instance_id = instance.desc.InstanceID;
  if (instance.bottom_level != nullptr) {
    entry.primitive_remap =
        static_cast<const BottomLevel&>(*instance.bottom_level).primitive_remap();
  }
  return entry;
}

std::vector<uint64_t> position_tables_of(std::span<const runtime::Instance> instances) {
  std::vector<uint64_t> tables(instances.size());
  for (size_t i = 0; i < instances.size(); ++i) {
    if (instances[i].bottom_level == nullptr) continue;
    tables[i] = static_cast<const BottomLevel&>(*instances[i].bottom_level).position_table();
  }
  return tables;
}

uint64_t largest_record_of(const runtime::Instance& instance) {
  const auto& level = static_cast<const BottomLevel&>(*instance.bottom_level);
  const uint64_t geometries = level.shapes().size();
  return instance.desc.InstanceContributionToHitGroupIndex + 15 + 15 * (geometries - 1);
}

// The instances for the driver, as positions in the input. Lavapipe halves their list as it does
// for primitives; for it, instances that cannot be hit are left out.
std::vector<uint32_t> driver_order(const Workarounds& workarounds,
                                   std::span<const runtime::Instance> instances) {
  std::vector<uint32_t> order;
  order.reserve(instances.size());
  if (!workarounds.has(Workaround::kSortPrimitives)) {
    for (uint32_t i = 0; i < instances.size(); ++i) order.push_back(i);
    return order;
  }
  std::vector<SortItem> items;
  items.reserve(instances.size());
  for (uint32_t i = 0; i < instances.size(); ++i) {
    if (instances[i].bottom_level == nullptr) continue;
    SortItem& item = items.emplace_back();
    item.primitive = i;
    const runtime::Bounds& bounds = instances[i].bounds;
    for (int axis = 0; axis < 3; ++axis) {
      item.centre[axis] = 0.5f * bounds.lower[axis] + 0.5f * bounds.upper[axis];
    }
  }
  constexpr uint32_t kOneList[] = {0};
  sort_for_halving(items, kOneList);
  for (const SortItem& item : items) order.push_back(item.primitive);
  return order;
}

}  // namespace

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build(
    const std::shared_ptr<Gpu>& gpu, InstanceTable& table,
    std::span<const runtime::Instance> instances, runtime::BuildFlags flags) {
  std::shared_ptr<TopLevel> level(new TopLevel);
  std::vector<InstanceEntry> entries;
  entries.reserve(instances.size());
  for (const auto& instance : instances) {
    entries.push_back(entry_of(instance, static_cast<uint32_t>(entries.size())));
  }
  auto range = table.add(entries, position_tables_of(instances));
  if (!range) return range.error();
  level->entries_ = std::move(*range);

  const std::vector<uint32_t> order = driver_order(gpu->workarounds(), instances);
  const uint64_t bytes = order.size() * sizeof(VkAccelerationStructureInstanceKHR);
  auto inputs = gpu->create_buffer(bytes, "instances of a top level", InitialContents::kAny);
  if (!inputs) return inputs.error();
  auto* records = reinterpret_cast<VkAccelerationStructureInstanceKHR*>((*inputs)->host());
  auto& kept = level->bottom_levels_;
  for (uint32_t i = 0; i < order.size(); ++i) {
    const runtime::Instance& instance = instances[order[i]];
    records[i] = record_of(instance, level->entries_.first() + order[i]);
    if (instance.bottom_level == nullptr) continue;
    level->largest_hit_record_ = std::max(level->largest_hit_record_, largest_record_of(instance));
    if (kept.empty() || kept.back() != instance.bottom_level) {
      kept.push_back(instance.bottom_level);
    }
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());

  StructureGeometry geometry;
  geometry.range.primitiveCount = static_cast<uint32_t>(order.size());
  geometry.geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  auto& data = geometry.geometry.geometry.instances;
  data.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  data.data.deviceAddress = (*inputs)->address();
  auto structure = VulkanStructure::build(gpu, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, flags,
                                          std::span(&geometry, 1), 0);
  if (!structure) return structure.error();
  level->structure_ = std::move(*structure);
  level->held_bytes_ = level->structure_->size_bytes() + entries.size() * sizeof(InstanceEntry);
  return level;
}

}  // namespace kaamos::vulkan
