// SPDX-License-Identifier: MIT
#include "runtime/structures/partitioned_instances.h"

#include <cmath>
#include <cstring>

namespace kaamos::runtime {

namespace {

constexpr uint32_t kInstanceFlagsMask = 0x3F;  // those of every top level

}  // namespace

const Translation& PartitionedTopLevel::translation_of(uint32_t partition) const {
  static constexpr Translation kNone = {};
  if (!translates()) return kNone;
  return partition == rtapi::kRtasPartitionIndexGlobalPartition ? global_translation
                                                                : translations[partition];
}

bool is_degenerate(const float (&transform)[3][4]) {
  bool empty = true;
  for (const auto& row : transform) {
    for (int i = 0; i < 4; ++i) {
      if (std::isnan(row[i])) return true;
      if (i < 3 && row[i] != 0) empty = false;
    }
  }
  return empty;
}

const char* activate(const StructureMap& structures, PartitionedTopLevel& level, uint32_t index) {
  const PartitionedInstance& slot = level.slots[index];
  Instance& instance = level.instances[index];
  instance = {};
  instance.desc.InstanceMask = 0;
  if (!slot.written) return nullptr;
  const auto& args = slot.args;
  rtapi::RaytracingInstanceDesc& desc = instance.desc;
  std::memcpy(desc.Transform, args.Transform, sizeof(desc.Transform));
  const Translation& translation = level.translation_of(args.PartitionIndex);
  for (int row = 0; row < 3; ++row) desc.Transform[row][3] += translation[row];
  instance.id = args.InstanceID;
  desc.InstanceID = args.InstanceID & 0xFFFFFF;
  desc.InstanceMask = args.InstanceMask & 0xFF;
  desc.InstanceContributionToHitGroupIndex = args.InstanceContributionToHitGroupIndex;
  desc.Flags = static_cast<uint32_t>(args.InstanceFlags) & kInstanceFlagsMask;
  desc.AccelerationStructure = args.AccelerationStructure;
  return is_degenerate(desc.Transform) ? nullptr : activate_instance(structures, instance);
}

rtapi::Status build_partitioned_level(const RebuildLevel& rebuild, const PartitionedTopLevel& level,
                                      std::span<const uint32_t> changed,
                                      AccelerationStructure& result) {
  if (!rebuild.partitioned_level) return rebuild.top_level(level.instances, result);
  const auto partition_of = [&level](uint32_t instance) {
    return level.place_of(level.slots[instance].args.PartitionIndex);
  };
  const bool prefers_trace =
      rtapi::HasAny(level.inputs.Flags, rtapi::RtasPartitionedTlasFlags::kFastTrace);
  return rebuild.partitioned_level(
      {level.instances, changed, level.inputs.PartitionCount + 1, prefers_trace, partition_of},
      result);
}

}  // namespace kaamos::runtime
