// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Top levels of partitions: built once, and then changed where an operation changed
// instances. [DXR 2.0: Partitioned TLAS]
#include <string>
#include <utility>

#include "runtime/backend/errors.h"
#include "runtime/embree/top_level.h"

namespace kaamos::embree {
namespace {

// Instances may move as far as this, in sizes of the level, before exact traversals need a new
// frame.
constexpr double kFrameSlack = 0.25;

}  // namespace

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build_partitioned(
    const BuildContext& context, const runtime::PartitionedInstances& partitioned) {
  const auto instances = partitioned.instances;
  const bool is_whole = partitioned.prefers_trace || instances.size() <= kMostInstanceBoxes;
  if (is_whole) return build(context, instances);
  std::shared_ptr<TopLevel> level(new TopLevel);
  level->context_ = context;
  level->pack_filter_ = context.pack_filter;
  level->add_twins(instances, false);
  level->nodes_.resize(instances.size());
  level->world_to_object_.resize(instances.size());
  level->bottom_levels_.resize(instances.size());
  std::vector<RTCBounds> bounds(instances.size());
  for (uint32_t i = 0; i < instances.size(); ++i) {
    level->set_instance(i, instances[i]);
    level->bottom_levels_[i] = instances[i].bottom_level;
    bounds[i] = bounds_of(instances[i]);
  }
  const bool exact = level->has_exact_;
  if (exact) {
    level->add_exact_instances(instances);
    level->move_to_frame(instances, bounds, kFrameSlack);
  }
  level->groups_.begin(static_cast<uint32_t>(instances.size()), partitioned.partition_count);
  for (uint32_t i = 0; i < instances.size(); ++i) {
    if (instances[i].bottom_level == nullptr) continue;
    level->groups_.set(i, partitioned.partition_of(i), bounds[i]);
  }
  level->scene_ = rtcNewScene(context.device);
  if (level->scene_ != nullptr) {
    // Only LOW has a tree for each geometry; those are built in the geometries' quality.
    rtcSetSceneBuildQuality(level->scene_, RTC_BUILD_QUALITY_LOW);
    const int robust = context.robust && !exact ? RTC_SCENE_FLAG_ROBUST : 0;
    rtcSetSceneFlags(level->scene_, static_cast<RTCSceneFlags>(robust | RTC_SCENE_FLAG_DYNAMIC));
  }
  if (auto s = level->commit_groups(); !s) return s.error();
  return level;
}

rtapi::Status TopLevel::commit_groups() {
  rtcGetDeviceError(context_.device);  // clears an earlier build's error
  if (scene_ != nullptr) groups_.commit(context_.device, scene_, has_exact_);
  if (scene_ != nullptr && rtcGetDeviceError(context_.device) == RTC_ERROR_NONE) return {};
  return runtime::make_error(runtime::Id::kBuildFailed, rtapi::ErrorCode::kOutOfMemory,
                             "Embree has no memory for a partitioned top level of " +
                                 std::to_string(nodes_.size()) + " instances.");
}

rtapi::Result<bool> TopLevel::update(const runtime::PartitionedInstances& partitioned) {
  const auto instances = partitioned.instances;
  if (partitioned.prefers_trace || groups_.partitions() != partitioned.partition_count ||
      nodes_.size() != instances.size()) {
    return false;
  }
  non_opaque_.store(nullptr);
  non_opaque_owner_ = nullptr;
  const bool exact = has_exact_;
  for (const uint32_t i : partitioned.changed) {
    const runtime::Instance& instance = instances[i];
    add_twins(std::span(&instance, 1), false);
    // Twins are found by the addresses of levels that this would not keep alive.
    if (!twins_.empty()) return false;
    if (std::exchange(bottom_levels_[i], instance.bottom_level) != nullptr) --active_;
    set_instance(i, instance);
    if (has_exact_ != exact) return false;
    if (instance.bottom_level == nullptr) {
      groups_.remove(i);
      continue;
    }
    RTCBounds bounds = bounds_of(instance);
    if (exact) {
      set_exact_instance(i, instance);
      const Box box = box_in_frame(instance, nodes_[i]);
      if (!frame_.holds(box.lower, box.upper)) return false;
      bounds = frame_.padded(box.lower, box.upper);
    }
    groups_.set(i, partitioned.partition_of(i), bounds);
  }
  if (auto s = commit_groups(); !s) return s.error();
  return true;
}

}  // namespace kaamos::embree
