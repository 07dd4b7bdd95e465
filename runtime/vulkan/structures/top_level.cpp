// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/top_level.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "runtime/vulkan/structures/sort.h"

namespace kaamos::vulkan {
namespace {

using shader::spirv::GeometryMicromaps;
using shader::spirv::InstanceEntry;

const BottomLevel& bottom_level_of(const runtime::Instance& instance) {
  return static_cast<const BottomLevel&>(*instance.bottom_level);
}

// The driver's record; `custom_index` is the instance's place in the instance table. An instance
// that cannot be hit gets no bottom level and a plain transform, because a NaN would hide its
// neighbours (B6). With `candidates` nothing of it is opaque.
VkAccelerationStructureInstanceKHR record_of(const runtime::Instance& instance,
                                             uint32_t custom_index, bool candidates) {
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
  if (candidates) {
    flags = (flags & ~runtime::kInstanceForceOpaque) | runtime::kInstanceForceNonOpaque;
  }
  record.flags = flags & 0xFu;
  record.accelerationStructureReference = bottom_level_of(instance).address();
  return record;
}

InstanceEntry entry_of(const runtime::Instance& instance, uint32_t index) {
  InstanceEntry entry;
  entry.instance_index = index;
  entry.instance_id = instance.id;
  if (instance.bottom_level != nullptr) {
    entry.primitive_remap = bottom_level_of(instance).primitive_remap();
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
  const uint64_t geometries = bottom_level_of(instance).shapes().size();
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

rtapi::Result<std::unique_ptr<VulkanStructure>> build_from(
    const std::shared_ptr<Gpu>& gpu, std::span<const VkAccelerationStructureInstanceKHR> records,
    runtime::BuildFlags flags) {
  auto inputs =
      gpu->create_buffer(records.size_bytes(), "instances of a top level", InitialContents::kAny);
  if (!inputs) return inputs.error();
  if (!records.empty()) std::memcpy((*inputs)->host(), records.data(), records.size_bytes());
  StructureGeometry geometry;
  geometry.range.primitiveCount = static_cast<uint32_t>(records.size());
  geometry.geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  auto& data = geometry.geometry.geometry.instances;
  data.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  data.data.deviceAddress = (*inputs)->address();
  return VulkanStructure::build(gpu, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, flags,
                                std::span(&geometry, 1), 0);
}

// An instance for the driver: of a classic bottom level, or of a part of one of clusters.
struct Expanded {
  std::vector<runtime::Instance> instances;
  std::vector<uint32_t> indices;  // InstanceIndex
};

// Instances of clusters become instances of the first part, and of the others at the end. Empty if
// there are no clusters.
Expanded expand_clusters(std::span<const runtime::Instance> instances) {
  Expanded result;
  const auto is_clustered = [](const runtime::Instance& instance) {
    return instance.bottom_level != nullptr && bottom_level_of(instance).clustered();
  };
  if (std::none_of(instances.begin(), instances.end(), is_clustered)) return result;
  result.instances.assign(instances.begin(), instances.end());
  for (uint32_t i = 0; i < instances.size(); ++i) result.indices.push_back(i);
  for (uint32_t i = 0; i < instances.size(); ++i) {
    if (!is_clustered(instances[i])) continue;
    const auto parts = bottom_level_of(instances[i]).parts();
    result.instances[i].bottom_level = parts[0];
    for (const auto& part : parts.subspan(1)) {
      result.instances.push_back(instances[i]);
      result.instances.back().bottom_level = part;
      result.indices.push_back(i);
    }
  }
  return result;
}

bool any_has_micromaps(std::span<const runtime::Instance> instances) {
  return std::any_of(instances.begin(), instances.end(), [](const runtime::Instance& instance) {
    return instance.bottom_level != nullptr && bottom_level_of(instance).has_micromaps();
  });
}

}  // namespace

shader::spirv::TopLevelEntry TopLevel::entry(uint64_t application_address) const {
  if (with_micromaps_ == nullptr) return {application_address, address(), 0, 0};
  return {application_address, address(), with_micromaps_->address(), all_candidates_->address()};
}

// Sets where the entries find the opacity of their geometries.
rtapi::Status TopLevel::add_micromaps(const std::shared_ptr<Gpu>& gpu,
                                      std::span<const runtime::Instance> instances,
                                      std::span<InstanceEntry> entries) {
  uint64_t count = 0;
  for (const auto& level : bottom_levels_) {
    count += static_cast<const BottomLevel&>(*level).shapes().size();
  }
  auto buffer = gpu->create_buffer(std::max<uint64_t>(count, 1) * sizeof(GeometryMicromaps),
                                   "opacity of geometries");
  if (!buffer) return buffer.error();
  micromaps_ = std::move(*buffer);
  auto* out = reinterpret_cast<GeometryMicromaps*>(micromaps_->host());
  std::map<const runtime::BottomLevelBase*, uint64_t> addresses;
  uint64_t address = micromaps_->address();
  for (const auto& base : bottom_levels_) {
    const auto& level = static_cast<const BottomLevel&>(*base);
    addresses[base.get()] = address;
    for (size_t g = 0; g < level.shapes().size(); ++g, ++out, address += sizeof(*out)) {
      *out = {level.micromap_indices(g), 0, level.shapes()[g].opaque ? 1u : 0u, 0};
    }
  }
  for (size_t i = 0; i < entries.size(); ++i) {
    if (instances[i].bottom_level == nullptr) continue;
    entries[i].micromaps = addresses[instances[i].bottom_level.get()];
    entries[i].flags = instances[i].desc.Flags;
  }
  return {};
}

rtapi::Status TopLevel::link_micromaps(MicromapBuffers& buffers) const {
  if (micromaps_ == nullptr) return {};
  auto* out = reinterpret_cast<GeometryMicromaps*>(micromaps_->host());
  for (const auto& base : bottom_levels_) {
    const auto& level = static_cast<const BottomLevel&>(*base);
    for (size_t g = 0; g < level.shapes().size(); ++g, ++out) {
      if (level.linkage(g) == nullptr || out->array != 0) continue;
      auto address = buffers.address_of(level.micromap_array(g));
      if (!address) return address.error();
      out->array = *address;
    }
  }
  return {};
}

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build(const std::shared_ptr<Gpu>& gpu,
                                                         InstanceTable& table,
                                                         std::span<const runtime::Instance> given,
                                                         runtime::BuildFlags flags) {
  std::shared_ptr<TopLevel> level(new TopLevel);
  const Expanded expanded = expand_clusters(given);
  const std::span<const runtime::Instance> instances =
      expanded.indices.empty() ? given : std::span<const runtime::Instance>(expanded.instances);
  auto& kept = level->bottom_levels_;
  const bool micromaps = any_has_micromaps(instances);
  for (const auto& instance : instances) {
    if (instance.bottom_level == nullptr) continue;
    level->largest_hit_record_ = std::max(level->largest_hit_record_, largest_record_of(instance));
    if (kept.empty() || kept.back() != instance.bottom_level) {
      kept.push_back(instance.bottom_level);
    }
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());

  std::vector<InstanceEntry> entries;
  entries.reserve(instances.size());
  for (const auto& instance : instances) {
    const auto i = static_cast<uint32_t>(entries.size());
    entries.push_back(entry_of(instance, expanded.indices.empty() ? i : expanded.indices[i]));
  }
  if (micromaps) {
    if (auto s = level->add_micromaps(gpu, instances, entries); !s) return s.error();
  }
  auto range = table.add(entries, position_tables_of(instances));
  if (!range) return range.error();
  level->entries_ = std::move(*range);

  const std::vector<uint32_t> order = driver_order(gpu->workarounds(), instances);
  std::vector<VkAccelerationStructureInstanceKHR> records(order.size());
  const auto build_with = [&](const auto& is_candidate) {
    for (size_t i = 0; i < order.size(); ++i) {
      const runtime::Instance& instance = instances[order[i]];
      const bool candidate = instance.bottom_level != nullptr && is_candidate(instance);
      records[i] = record_of(instance, level->entries_.first() + order[i], candidate);
    }
    auto structure = build_from(gpu, records, flags);
    if (structure) level->held_bytes_ += (*structure)->size_bytes();
    return structure;
  };
  auto structure = build_with([](const auto&) { return false; });
  if (!structure) return structure.error();
  level->structure_ = std::move(*structure);
  if (micromaps) {
    auto linked =
        build_with([](const auto& instance) { return bottom_level_of(instance).has_micromaps(); });
    if (!linked) return linked.error();
    level->with_micromaps_ = std::move(*linked);
    auto all = build_with([](const auto&) { return true; });
    if (!all) return all.error();
    level->all_candidates_ = std::move(*all);
  }
  level->held_bytes_ += entries.size() * sizeof(InstanceEntry);
  return level;
}

}  // namespace kaamos::vulkan
