// SPDX-License-Identifier: MIT
//
// A top level: a list of boxes if there are few instances, otherwise one Embree user geometry whose
// primitives are the instances. Compared with Embree's own instances, the user geometry costs the
// same to trace and less to build, does not abort on singular matrices, has bounds with room for
// rounding, and lets each instance have its own flags; the list of boxes costs less to trace.
// Numbers: README.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/embree/bottom_level.h"
#include "runtime/embree/instance_boxes.h"
#include "runtime/embree/instance_node.h"
#include "runtime/embree/partition_groups.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::embree {

// The world bounds of an instance; inverted if it cannot be hit.
RTCBounds bounds_of(const runtime::Instance& instance);

// What only shaders need from an instance.
using WorldToObject = shader::InstanceTransform;

class TopLevel final : public runtime::TopLevelBase {
 public:
  // `instances` are in input order: the index is InstanceIndex. Errors: KA0792 out of memory.
  static rtapi::Result<std::shared_ptr<TopLevel>> build(
      const BuildContext& context, std::span<const runtime::Instance> instances);
  // EXPERIMENTAL: the same of partitions, so that update() can follow.
  static rtapi::Result<std::shared_ptr<TopLevel>> build_partitioned(
      const BuildContext& context, const runtime::PartitionedInstances& partitioned);
  // Takes over the changed instances, in time that depends on them and their partitions. False: a
  // new level has to be built. Errors as above.
  rtapi::Result<bool> update(const runtime::PartitionedInstances& partitioned);
  ~TopLevel() override;
  TopLevel(const TopLevel&) = delete;
  TopLevel& operator=(const TopLevel&) = delete;

  // True if nothing can be hit. Otherwise there is either a list of boxes or a scene.
  bool empty() const { return active_ == 0; }
  const InstanceBoxes& boxes() const { return boxes_; }
  RTCScene scene() const { return scene_; }
  bool has_procedurals() const { return has_procedurals_; }
  uint32_t size() const { return static_cast<uint32_t>(nodes_.size()); }
  const InstanceNode* nodes() const { return nodes_.data(); }
  const float* world_to_object(uint32_t index) const { return world_to_object_[index].rows; }
  // The triangle of a clustered instance that Embree knows by these numbers.
  const shader::ClusterTriangle& cluster_triangle(uint32_t index, uint32_t slot,
                                                  uint32_t primitive) const {
    const auto* positions =
        reinterpret_cast<const shader::GeometryPositions*>(world_to_object_[index].positions);
    return positions[slot].clustered[primitive];
  }
  uint32_t instance_id(uint32_t index) const { return world_to_object_[index].instance_id; }
  bool has_exact() const { return has_exact_; }
  // The level for rays that make all geometry non-opaque, and so may meet any-hit shaders
  // everywhere: the same instances with all triangles exact. Made when it is first asked for, in
  // robust precision.
  const TopLevel& for_non_opaque() const {
    if (!has_robust_) return *this;
    const TopLevel* made = non_opaque_.load(std::memory_order_acquire);
    return made != nullptr ? *made : make_non_opaque();
  }
  // The origin of Embree's coordinates in a tree with exact bottom levels.
  const ExactFrame& frame() const { return frame_; }
  PackFilter pack_filter() const { return pack_filter_; }
  const ExactInstance& exact_instance(uint32_t index) const { return exact_instances_[index]; }

 private:
  TopLevel() = default;
  static rtapi::Result<std::shared_ptr<TopLevel>> build(
      const BuildContext& context, std::span<const runtime::Instance> instances,
      bool all_non_opaque);
  const TopLevel& make_non_opaque() const;
  std::vector<runtime::Instance> instances() const;
  const BottomLevel& traced_level(const runtime::Instance& instance) const;
  void add_twins(std::span<const runtime::Instance> instances, bool all_non_opaque);
  void add_exact_instances(std::span<const runtime::Instance> instances);
  struct Box {
    double lower[3];
    double upper[3];
  };
  Box box_in_frame(const runtime::Instance& instance, const InstanceNode& node) const;
  void move_to_frame(std::span<const runtime::Instance> instances, std::vector<RTCBounds>& bounds,
                     double slack);
  void set_instance(uint32_t index, const runtime::Instance& instance);
  void set_exact_instance(uint32_t index, const runtime::Instance& instance);
  rtapi::Status commit_groups();

  RTCScene scene_ = nullptr;
  InstanceBoxes boxes_;
  bool has_procedurals_ = false;
  bool has_exact_ = false;
  bool has_robust_ = false;  // bottom levels that could be exact, and are not
  uint32_t active_ = 0;      // instances that can be hit
  BuildContext context_;
  ExactFrame frame_;
  PackFilter pack_filter_ = nullptr;
  std::vector<ExactInstance> exact_instances_;
  std::vector<InstanceNode> nodes_;
  std::vector<WorldToObject> world_to_object_;
  std::vector<std::shared_ptr<const runtime::BottomLevelBase>>
      bottom_levels_;       // kept alive; each appears once, but of partitions: by instance
  PartitionGroups groups_;  // only of partitions, and then scene_ is theirs
  // Exact ones that take the place of others.
  std::map<const runtime::BottomLevelBase*, std::shared_ptr<const BottomLevel>> twins_;

  mutable std::mutex non_opaque_mutex_;
  mutable std::shared_ptr<const TopLevel> non_opaque_owner_;
  mutable std::atomic<const TopLevel*> non_opaque_ = nullptr;
};

struct LaneSearches;
struct RayState;

// Traverse the ray's top level, which must not be empty, like rtcIntersect1 and rtcOccluded1.
// [traverse.cpp]
void intersect(RayState& state, RTCRayHit& ray_hit);
void occlude(RayState& state, RTCRay& ray);
// The same for a list of boxes without exact bottom levels, when it is known which boxes the ray
// enters.
void intersect(RayState& state, RTCRayHit& ray_hit, const LaneSearches& lanes, int lane);
void occlude(RayState& state, RTCRay& ray, const LaneSearches& lanes, int lane);

// Callbacks for the traversal of a scene.
void intersect_instance(const RTCIntersectFunctionNArguments* arguments);
void occlude_instance(const RTCOccludedFunctionNArguments* arguments);
void intersect_member(const RTCIntersectFunctionNArguments* arguments);
void occlude_member(const RTCOccludedFunctionNArguments* arguments);

}  // namespace kaamos::embree
