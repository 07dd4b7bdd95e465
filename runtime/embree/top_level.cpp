// SPDX-License-Identifier: MIT
#include "runtime/embree/top_level.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace kaamos::embree {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr RTCBounds kNoBounds = {kInfinity,  kInfinity,  kInfinity,  0,
                                 -kInfinity, -kInfinity, -kInfinity, 0};

void bounds_of_instance(const RTCBoundsFunctionArguments* arguments) {
  const auto* bounds = static_cast<const RTCBounds*>(arguments->geometryUserPtr);
  *arguments->bounds_o = bounds[arguments->primID];
}

// World bounds of an object-space box. Widened by the rounding of the ray transform: a ray that
// touches the geometry in object space must not miss the box in world space. False if the box
// leaves Embree's range.
bool world_bounds(const float matrix[12], const RTCBounds& object, RTCBounds& world) {
  const double lower[3] = {object.lower_x, object.lower_y, object.lower_z};
  const double upper[3] = {object.upper_x, object.upper_y, object.upper_z};
  float out_lower[3];
  float out_upper[3];
  for (int row = 0; row < 3; ++row) {
    double low = matrix[4 * row + 3];
    double high = low;
    double magnitude = std::fabs(low);
    for (int column = 0; column < 3; ++column) {
      const double a = matrix[4 * row + column] * lower[column];
      const double b = matrix[4 * row + column] * upper[column];
      low += std::min(a, b);
      high += std::max(a, b);
      magnitude += std::max(std::fabs(a), std::fabs(b));
    }
    // 8 ulp of the largest term: six roundings of the transform, and two of the box test.
    const double pad = 8 * FLT_EPSILON * magnitude + 16 * FLT_MIN;
    out_lower[row] = static_cast<float>(low - pad);
    out_upper[row] = static_cast<float>(high + pad);
    if (!(std::fabs(out_lower[row]) < shim::kLargestCoordinate) ||
        !(std::fabs(out_upper[row]) < shim::kLargestCoordinate)) {
      return false;
    }
  }
  world = {out_lower[0], out_lower[1], out_lower[2], 0,
           out_upper[0], out_upper[1], out_upper[2], 0};
  return true;
}

OpacityOverride opacity_of(uint32_t flags) {
  if ((flags & kInstanceForceOpaque) != 0) return OpacityOverride::kOpaque;
  if ((flags & kInstanceForceNonOpaque) != 0) return OpacityOverride::kNonOpaque;
  return OpacityOverride::kNone;
}

}  // namespace

bool invert_transform(const float matrix[12], float inverse[12]) {
  double m[12];
  for (int i = 0; i < 12; ++i) {
    if (!std::isfinite(matrix[i])) return false;
    m[i] = matrix[i];
  }
  const double cofactors[9] = {
      m[5] * m[10] - m[6] * m[9], m[2] * m[9] - m[1] * m[10], m[1] * m[6] - m[2] * m[5],
      m[6] * m[8] - m[4] * m[10], m[0] * m[10] - m[2] * m[8], m[2] * m[4] - m[0] * m[6],
      m[4] * m[9] - m[5] * m[8],  m[1] * m[8] - m[0] * m[9],  m[0] * m[5] - m[1] * m[4]};
  const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
  if (determinant == 0 || !std::isfinite(determinant)) return false;
  for (int row = 0; row < 3; ++row) {
    double translation = 0;
    for (int column = 0; column < 3; ++column) {
      const double value = cofactors[3 * row + column] / determinant;
      inverse[4 * row + column] = static_cast<float>(value);
      translation -= value * m[4 * column + 3];
    }
    inverse[4 * row + 3] = static_cast<float>(translation);
  }
  return std::all_of(inverse, inverse + 12, [](float v) { return std::isfinite(v); });
}

TopLevel::~TopLevel() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
}

void TopLevel::add_instance(const rtapi::RaytracingInstanceDesc& desc, FindBottomLevel find,
                            const void* find_self, std::vector<RTCBounds>& bounds,
                            std::vector<std::string>& notes) {
  const uint32_t index = static_cast<uint32_t>(nodes_.size());
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
  if (desc.AccelerationStructure == 0) return;

  std::shared_ptr<const BottomLevel> level = find(find_self, desc.AccelerationStructure);
  const auto note = [&](const char* what) {
    notes.push_back("instance " + std::to_string(index) + ": " + what);
  };
  if (level == nullptr) {
    return note(
        "no bottom level stands at its address; it is inactive. Was it built, and not "
        "overwritten or freed since?");
  }
  if (level->empty()) return;
  if (!invert_transform(node.object_to_world, detail.world_to_object)) {
    return note("its transform is singular or not finite; it is inactive");
  }
  if (!world_bounds(node.object_to_world, level->bounds(), box)) {
    box = kNoBounds;
    return note("its bounds reach past 1.8e18; it is inactive");
  }
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      node.world_to_object_columns[column][row] = detail.world_to_object[4 * row + column];
    }
  }
  node.mask = desc.InstanceMask;
  node.procedural = level->procedural();
  node.scene = level->scene();
  has_procedurals_ |= node.procedural;
  bottom_levels_.push_back(std::move(level));
}

rtapi::Result<std::shared_ptr<TopLevel>> TopLevel::build(
    const BuildContext& context, std::span<const rtapi::RaytracingInstanceDesc> instances,
    FindBottomLevel find, const void* find_self, std::vector<std::string>& notes) {
  std::shared_ptr<TopLevel> level(new TopLevel);
  level->nodes_.reserve(instances.size());
  level->details_.reserve(instances.size());
  std::vector<RTCBounds> bounds;
  bounds.reserve(instances.size());
  for (const auto& instance : instances) {
    level->add_instance(instance, find, find_self, bounds, notes);
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
