// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. The instances of a partitioned top level in groups of whole partitions. Each group
// is an Embree geometry in a scene that keeps a tree for each, so that a change costs the trees of
// the groups that it touches, and a small tree over all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/embree/embree_shim.h"

namespace kaamos::embree {

// Primitive i is the instance members[i]. Rays' callbacks get members, those of builds the group.
struct PartitionGroup {
  std::vector<uint32_t> members;
  std::vector<RTCBounds> bounds;  // of the members
  RTCGeometry geometry = nullptr;
  bool changed = false;
};

class PartitionGroups {
 public:
  PartitionGroups() = default;
  PartitionGroups(const PartitionGroups&) = delete;
  PartitionGroups& operator=(const PartitionGroups&) = delete;

  // Without members. Small partitions share a group. The last of `partitions` is the global one.
  void begin(uint32_t instances, uint32_t partitions);
  uint32_t partitions() const { return partitions_; }
  // Adds an instance, or moves it.
  void set(uint32_t instance, uint32_t partition, const RTCBounds& bounds);
  // Nothing, if it is no member.
  void remove(uint32_t instance);
  // Brings the scene up to date. `exact`: as in TopLevel. Errors are the device's.
  void commit(RTCDevice device, RTCScene scene, bool exact);

 private:
  struct Place {
    uint32_t group = kNone;
    uint32_t position = 0;  // in members
  };
  static constexpr uint32_t kNone = 0xFFFFFFFF;

  uint32_t group_of(uint32_t partition) const;

  uint32_t partitions_ = 0;
  uint32_t partitions_per_group_ = 1;
  std::vector<PartitionGroup> groups_;
  std::vector<Place> places_;  // by instance
};

}  // namespace kaamos::embree
