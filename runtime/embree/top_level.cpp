// SPDX-License-Identifier: MIT
#include "runtime/embree/top_level.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <system_error>
#include <thread>
#include <unordered_map>

#include "runtime/backend/errors.h"
#include "runtime/embree/parallel.h"

namespace kaamos::embree {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr RTCBounds kNoBounds = {kInfinity,  kInfinity,  kInfinity,  0,
                                 -kInfinity, -kInfinity, -kInfinity, 0};

void bounds_of_instance(const RTCBoundsFunctionArguments* arguments) {
  const BuilderCallback callback;
  const auto* bounds = static_cast<const RTCBounds*>(arguments->geometryUserPtr);
  *arguments->bounds_o = bounds[arguments->primID];
}

uint32_t flags_of(const InstanceNode& node) {
  uint32_t flags = node.flags | node.micromap_flags << kMicromapInstanceFlagsShift;
  if (node.opacity == OpacityOverride::kOpaque) flags |= kInstanceForceOpaque;
  if (node.opacity == OpacityOverride::kNonOpaque) flags |= kInstanceForceNonOpaque;
  return flags;
}

OpacityOverride opacity_of(uint32_t flags) {
  if ((flags & kInstanceForceOpaque) != 0) return OpacityOverride::kOpaque;
  if ((flags & kInstanceForceNonOpaque) != 0) return OpacityOverride::kNonOpaque;
  return OpacityOverride::kNone;
}

}  // namespace

RTCBounds bounds_of(const runtime::Instance& instance) {
  if (instance.bottom_level == nullptr) return kNoBounds;
  const runtime::Bounds& b = instance.bounds;
  return {b.lower[0], b.lower[1], b.lower[2], 0, b.upper[0], b.upper[1], b.upper[2], 0};
}

TopLevel::~TopLevel() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
}

void TopLevel::set_instance(uint32_t index, const runtime::Instance& instance) {
  const rtapi::RaytracingInstanceDesc& desc = instance.desc;
  InstanceNode& node = nodes_[index];
  WorldToObject& transform = world_to_object_[index];
  float* world_to_object = transform.rows;
  node = {};
  transform = {};
  std::memcpy(node.object_to_world, desc.Transform, sizeof(node.object_to_world));
  node.flags = desc.Flags & kFacingInstanceFlags;
  node.micromap_flags = (desc.Flags >> kMicromapInstanceFlagsShift) & 3;
  node.opacity = opacity_of(desc.Flags);
  node.contribution = desc.InstanceContributionToHitGroupIndex;
  transform.instance_id = instance.id;
  if (instance.bottom_level == nullptr) return;
  std::memcpy(world_to_object, instance.world_to_object, sizeof(transform.rows));
  transform.positions =
      shader::table_of(static_cast<const BottomLevel&>(*instance.bottom_level).positions());
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      node.world_to_object_columns[column][row] = world_to_object[4 * row + column];
    }
  }
  const BottomLevel& level = traced_level(instance);
  node.mask = desc.InstanceMask;
  node.procedural = level.procedural();
  node.scene = level.scene();
  node.exact = level.exact();
  node.clustered = static_cast<const BottomLevel&>(*instance.bottom_level).clustered();
  has_procedurals_ |= node.procedural;
  has_exact_ |= node.exact;
  has_robust_ |=
      !node.exact && !node.procedural && context_.exact == BuildContext::Exact::kNonOpaque;
  ++active_;
}

void TopLevel::set_exact_instance(uint32_t index, const runtime::Instance& instance) {
  if (!nodes_[index].exact) return;
  invert_in_double(&instance.desc.Transform[0][0], exact_instances_[index].world_to_object);
  exact_instances_[index].frame = &traced_level(instance).exact_frame();
}

void TopLevel::add_exact_instances(std::span<const runtime::Instance> instances) {
  exact_instances_.resize(instances.size());
  for (uint32_t i = 0; i < instances.size(); ++i) set_exact_instance(i, instances[i]);
}

// Those of exact instances are computed in double; the others are traced in float, and widened for
// it.
TopLevel::Box TopLevel::box_in_frame(const runtime::Instance& instance,
                                     const InstanceNode& node) const {
  Box box = {};
  const runtime::Bounds object =
      static_cast<const BottomLevel&>(*instance.bottom_level).object_bounds();
  const float* matrix = &instance.desc.Transform[0][0];
  for (int row = 0; row < 3; ++row) {
    double low = matrix[4 * row + 3];
    double high = low;
    for (int column = 0; column < 3; ++column) {
      const double a = static_cast<double>(matrix[4 * row + column]) * object.lower[column];
      const double b = static_cast<double>(matrix[4 * row + column]) * object.upper[column];
      low += std::min(a, b);
      high += std::max(a, b);
    }
    box.lower[row] = node.exact ? low : instance.bounds.lower[row];
    box.upper[row] = node.exact ? high : instance.bounds.upper[row];
  }
  return box;
}

// Makes bounds relative to a frame around all of them, which is larger by `slack` of their size on
// each side.
void TopLevel::move_to_frame(std::span<const runtime::Instance> instances,
                             std::vector<RTCBounds>& bounds, double slack) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box all = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  std::vector<Box> boxes(instances.size());
  for (size_t i = 0; i < instances.size(); ++i) {
    if (instances[i].bottom_level == nullptr) continue;
    boxes[i] = box_in_frame(instances[i], nodes_[i]);
    for (int row = 0; row < 3; ++row) {
      all.lower[row] = std::min(all.lower[row], boxes[i].lower[row]);
      all.upper[row] = std::max(all.upper[row], boxes[i].upper[row]);
    }
  }
  for (int row = 0; slack != 0 && row < 3; ++row) {
    const double room = slack * (all.upper[row] - all.lower[row]);
    all.lower[row] -= room;
    all.upper[row] += room;
  }
  frame_ = ExactFrame::of(all.lower, all.upper);
  for (size_t i = 0; i < instances.size(); ++i) {
    if (instances[i].bottom_level != nullptr) {
      bounds[i] = frame_.padded(boxes[i].lower, boxes[i].upper);
    }
  }
}

const BottomLevel& TopLevel::traced_level(const runtime::Instance& instance) const {
  const auto twin = twins_.find(instance.bottom_level.get());
  const bool opaque = twin == twins_.end() || twin->second == nullptr;
  return opaque ? static_cast<const BottomLevel&>(*instance.bottom_level) : *twin->second;
}

// Triangles that the instance, or else the ray, makes non-opaque are exact, as if they were
// non-opaque themselves.
void TopLevel::add_twins(std::span<const runtime::Instance> instances, bool all_non_opaque) {
  if (context_.exact != BuildContext::Exact::kNonOpaque) return;
  for (const runtime::Instance& instance : instances) {
    if (instance.bottom_level == nullptr) continue;
    const auto& level = static_cast<const BottomLevel&>(*instance.bottom_level);
    if (level.exact() || level.procedural()) continue;
    if (!all_non_opaque && opacity_of(instance.desc.Flags) != OpacityOverride::kNonOpaque) continue;
    auto [at, is_new] = twins_.try_emplace(&level);
    if (is_new) at->second = level.exact_twin(context_);
  }
}

// The instances that this was built from, without those of their flags that rays do not need.
std::vector<runtime::Instance> TopLevel::instances() const {
  std::unordered_map<RTCScene, std::shared_ptr<runtime::BottomLevelBase>> by_scene;
  for (const auto& kept : bottom_levels_) {
    if (kept == nullptr) continue;
    const auto level = std::const_pointer_cast<runtime::BottomLevelBase>(kept);
    by_scene[static_cast<const BottomLevel&>(*level).scene()] = level;
    const auto twin = twins_.find(level.get());
    if (twin != twins_.end() && twin->second != nullptr) by_scene[twin->second->scene()] = level;
  }
  std::vector<runtime::Instance> result(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const InstanceNode& node = nodes_[i];
    runtime::Instance& instance = result[i];
    std::memcpy(instance.desc.Transform, node.object_to_world, sizeof(node.object_to_world));
    instance.id = world_to_object_[i].instance_id;
    instance.desc.InstanceMask = node.mask;
    instance.desc.InstanceContributionToHitGroupIndex = node.contribution;
    instance.desc.Flags = flags_of(node);
    if (node.scene == nullptr) continue;
    instance.bottom_level = by_scene[node.scene];
    std::memcpy(instance.world_to_object, world_to_object_[i].rows,
                sizeof(world_to_object_[i].rows));
    runtime::world_bounds(node.object_to_world, instance.bottom_level->object_bounds(),
                          instance.bounds);
  }
  return result;
}

// On a thread of its own: the caller is deep in a tile, and while Embree builds it would take up
// other tiles, which wait for this.
[[gnu::noinline]] const TopLevel& TopLevel::make_non_opaque() const {
  const std::lock_guard lock(non_opaque_mutex_);
  if (const TopLevel* made = non_opaque_.load(std::memory_order_relaxed)) return *made;
  try {
    std::thread([this] {
      auto level = build(context_, instances(), true);
      if (level) non_opaque_owner_ = *level;
    }).join();
  } catch (const std::system_error&) {  // no thread can be had: Embree's triangles have to do
  }
  const TopLevel* made = non_opaque_owner_ != nullptr ? non_opaque_owner_.get() : this;
  non_opaque_.store(made, std::memory_order_release);
  return *made;
}

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build(
    const BuildContext& context, std::span<const runtime::Instance> instances) {
  return build(context, instances, false);
}

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build(
    const BuildContext& context, std::span<const runtime::Instance> instances,
    bool all_non_opaque) {
  std::shared_ptr<TopLevel> level(new TopLevel);
  level->context_ = context;
  level->add_twins(instances, all_non_opaque);
  level->nodes_.resize(instances.size());
  level->world_to_object_.resize(instances.size());
  std::vector<RTCBounds> bounds;
  bounds.reserve(instances.size());
  auto& kept = level->bottom_levels_;
  for (uint32_t i = 0; i < instances.size(); ++i) {
    level->set_instance(i, instances[i]);
    bounds.push_back(bounds_of(instances[i]));
    if (instances[i].bottom_level != nullptr) kept.push_back(instances[i].bottom_level);
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  if (level->empty()) return level;
  level->pack_filter_ = context.pack_filter;
  const bool exact = level->has_exact_;
  if (exact) level->add_exact_instances(instances);
  if (bounds.size() <= kMostInstanceBoxes) {
    level->boxes_.set(bounds);
    return level;
  }
  if (exact) level->move_to_frame(instances, bounds, 0);

  rtcGetDeviceError(context.device);  // clears an earlier build's error
  level->scene_ = rtcNewScene(context.device);
  RTCGeometry geometry = rtcNewGeometry(context.device, RTC_GEOMETRY_TYPE_USER);
  if (level->scene_ != nullptr && geometry != nullptr) {
    rtcSetSceneFlags(level->scene_,
                     context.robust && !exact ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(level->scene_, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<uint32_t>(bounds.size()));
    rtcSetGeometryUserData(geometry, bounds.data());  // only needed until the commit
    rtcSetGeometryBoundsFunction(geometry, bounds_of_instance, nullptr);
    rtcSetGeometryIntersectFunction(geometry,
                                    exact ? intersect_exact_instance : intersect_instance);
    rtcSetGeometryOccludedFunction(geometry, exact ? occlude_exact_instance : occlude_instance);
    rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(level->scene_, geometry, 0);
    {
      const BuilderRun run;
      rtcCommitScene(level->scene_);
    }
    rtcSetGeometryUserData(geometry, nullptr);
  }
  if (geometry != nullptr) rtcReleaseGeometry(geometry);
  if (rtcGetDeviceError(context.device) != RTC_ERROR_NONE || level->scene_ == nullptr) {
    return runtime::make_error(runtime::Id::kBuildFailed, rtapi::ErrorCode::kOutOfMemory,
                               "Embree has no memory for a top level of " +
                                   std::to_string(instances.size()) + " instances.");
  }
  return level;
}

}  // namespace kaamos::embree
