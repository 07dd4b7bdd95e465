// SPDX-License-Identifier: MIT
#include "runtime/embree/top_level.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace kaamos::embree {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr RTCBounds kNoBounds = {kInfinity,  kInfinity,  kInfinity,  0,
                                 -kInfinity, -kInfinity, -kInfinity, 0};

void bounds_of_instance(const RTCBoundsFunctionArguments* arguments) {
  const auto* bounds = static_cast<const RTCBounds*>(arguments->geometryUserPtr);
  *arguments->bounds_o = bounds[arguments->primID];
}

OpacityOverride opacity_of(uint32_t flags) {
  if ((flags & kInstanceForceOpaque) != 0) return OpacityOverride::kOpaque;
  if ((flags & kInstanceForceNonOpaque) != 0) return OpacityOverride::kNonOpaque;
  return OpacityOverride::kNone;
}

}  // namespace

TopLevel::~TopLevel() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
}

void TopLevel::add_instance(const runtime::Instance& instance, std::vector<RTCBounds>& bounds) {
  const rtapi::RaytracingInstanceDesc& desc = instance.desc;
  InstanceNode& node = nodes_.emplace_back();
  InstanceDetail& detail = details_.emplace_back();
  RTCBounds& box = bounds.emplace_back(kNoBounds);
  node = {};
  std::memcpy(node.object_to_world, desc.Transform, sizeof(node.object_to_world));
  node.flags = static_cast<uint8_t>(desc.Flags);
  node.opacity = opacity_of(desc.Flags);
  node.contribution = desc.InstanceContributionToHitGroupIndex;
  detail = {};
  detail.id = desc.InstanceID;
  if (instance.bottom_level == nullptr) return;
  const runtime::Bounds& b = instance.bounds;
  box = {b.lower[0], b.lower[1], b.lower[2], 0, b.upper[0], b.upper[1], b.upper[2], 0};
  std::memcpy(detail.world_to_object, instance.world_to_object, sizeof(detail.world_to_object));
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      node.world_to_object_columns[column][row] = detail.world_to_object[4 * row + column];
    }
  }
  const auto& level = static_cast<const BottomLevel&>(*instance.bottom_level);
  node.mask = desc.InstanceMask;
  node.procedural = level.procedural();
  node.scene = level.scene();
  has_procedurals_ |= node.procedural;
  bottom_levels_.push_back(instance.bottom_level);
}

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build(
    const BuildContext& context, std::span<const runtime::Instance> instances) {
  std::shared_ptr<TopLevel> level(new TopLevel);
  level->nodes_.reserve(instances.size());
  level->details_.reserve(instances.size());
  std::vector<RTCBounds> bounds;
  bounds.reserve(instances.size());
  for (const auto& instance : instances) {
    level->add_instance(instance, bounds);
  }
  auto& kept = level->bottom_levels_;
  const bool any_active = !kept.empty();
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  if (!any_active) return level;

  rtcGetDeviceError(context.device);  // forgets what an earlier build left
  level->scene_ = rtcNewScene(context.device);
  RTCGeometry geometry = rtcNewGeometry(context.device, RTC_GEOMETRY_TYPE_USER);
  if (level->scene_ != nullptr && geometry != nullptr) {
    rtcSetSceneFlags(level->scene_, context.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(level->scene_, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<uint32_t>(bounds.size()));
    rtcSetGeometryUserData(geometry, bounds.data());  // needed until the commit only
    rtcSetGeometryBoundsFunction(geometry, bounds_of_instance, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_instance);
    rtcSetGeometryOccludedFunction(geometry, occlude_instance);
    rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(level->scene_, geometry, 0);
    rtcCommitScene(level->scene_);
    rtcSetGeometryUserData(geometry, nullptr);
  }
  if (geometry != nullptr) rtcReleaseGeometry(geometry);
  if (rtcGetDeviceError(context.device) != RTC_ERROR_NONE || level->scene_ == nullptr) {
    return rtapi::Error{"KA0792", rtapi::ErrorCode::kOutOfMemory,
                        "KA0792 top level could not be built: Embree has no memory for " +
                            std::to_string(instances.size()) + " instances."};
  }
  return level;
}

}  // namespace kaamos::embree
