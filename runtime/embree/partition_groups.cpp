// SPDX-License-Identifier: MIT
#include "runtime/embree/partition_groups.h"

#include <algorithm>

#include "runtime/embree/exact.h"
#include "runtime/embree/parallel.h"
#include "runtime/embree/top_level.h"

namespace kaamos::embree {
namespace {

// A geometry takes a kilobyte of its own.
constexpr uint32_t kFewestPerGroup = 256;

void bounds_of_member(const RTCBoundsFunctionArguments* arguments) {
  const BuilderCallback callback;
  const auto& group = *static_cast<const PartitionGroup*>(arguments->geometryUserPtr);
  *arguments->bounds_o = group.bounds[arguments->primID];
}

}  // namespace

void PartitionGroups::begin(uint32_t instances, uint32_t partitions) {
  partitions_ = partitions;
  const uint64_t wanted = uint64_t{kFewestPerGroup} * partitions;
  partitions_per_group_ =
      static_cast<uint32_t>(std::max<uint64_t>(1, wanted / std::max(instances, 1u)));
  const uint32_t groups = (partitions - 1 + partitions_per_group_ - 1) / partitions_per_group_;
  groups_ = std::vector<PartitionGroup>(size_t{groups} + 1);
  places_.assign(instances, Place{});
}

uint32_t PartitionGroups::group_of(uint32_t partition) const {
  if (partition + 1 == partitions_) return static_cast<uint32_t>(groups_.size() - 1);
  return partition / partitions_per_group_;
}

void PartitionGroups::set(uint32_t instance, uint32_t partition, const RTCBounds& bounds) {
  const uint32_t wanted = group_of(partition);
  if (places_[instance].group != wanted) {
    remove(instance);
    places_[instance] = {wanted, static_cast<uint32_t>(groups_[wanted].members.size())};
    groups_[wanted].members.push_back(instance);
    groups_[wanted].bounds.emplace_back();
  }
  PartitionGroup& group = groups_[wanted];
  group.bounds[places_[instance].position] = bounds;
  group.changed = true;
}

void PartitionGroups::remove(uint32_t instance) {
  const Place place = places_[instance];
  if (place.group == kNone) return;
  PartitionGroup& group = groups_[place.group];
  const uint32_t last = group.members.back();
  group.members[place.position] = last;
  group.bounds[place.position] = group.bounds.back();
  places_[last].position = place.position;
  group.members.pop_back();
  group.bounds.pop_back();
  group.changed = true;
  places_[instance] = {};
}

void PartitionGroups::commit(RTCDevice device, RTCScene scene, bool exact) {
  std::vector<uint32_t> changed;
  for (uint32_t g = 0; g < groups_.size(); ++g) {
    PartitionGroup& group = groups_[g];
    if (!group.changed) continue;
    group.changed = false;
    const bool is_new = group.geometry == nullptr;
    if (is_new) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
      if (geometry == nullptr) return;
      rtcSetGeometryBoundsFunction(geometry, bounds_of_member, nullptr);
      rtcSetGeometryIntersectFunction(geometry, exact ? intersect_exact_member : intersect_member);
      rtcSetGeometryOccludedFunction(geometry, exact ? occlude_exact_member : occlude_member);
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
      rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
      group.geometry = geometry;
    }
    rtcSetGeometryUserData(group.geometry, &group);
    changed.push_back(g);
    rtcSetGeometryUserPrimitiveCount(group.geometry, static_cast<uint32_t>(group.members.size()));
    rtcCommitGeometry(group.geometry);
    if (!is_new) continue;
    rtcAttachGeometryByID(scene, group.geometry, g);
    rtcReleaseGeometry(group.geometry);  // the scene keeps it
  }
  {
    const BuilderRun run;
    rtcCommitScene(scene);
  }
  for (const uint32_t g : changed) {
    rtcSetGeometryUserData(groups_[g].geometry, groups_[g].members.data());
  }
}

}  // namespace kaamos::embree
