// SPDX-License-Identifier: MIT
#include "fixtures.h"

#include "frame_run.h"

#if KAAMOS_HAS_VULKAN
#include "hand_vulkan.h"
#else
namespace kaamos::bench {
class HandVulkan {};
}  // namespace kaamos::bench
#endif

namespace kaamos::bench {
namespace {

constexpr uint32_t kFrameWidth = 1280, kFrameHeight = 720;
constexpr uint32_t kQuickFrameWidth = 96, kQuickFrameHeight = 54;

}  // namespace

Fixtures::Fixtures(const Options& options)
    : options_(options), arena_(static_cast<int>(options.threads)) {}

const SceneData& Fixtures::scene() {
  if (!scene_) scene_ = make_scene_data();
  return *scene_;
}

const RayGrid& Fixtures::rays(RaySet set, float distance) {
  if (distance != 0) {
    RayGrid& moved = distant_rays_[{static_cast<int>(set), distance}];
    if (!moved.rays.empty()) return moved;
    moved = rays(set);
    for (Ray& ray : moved.rays) {
      ray.origin[0] += distance;
      ray.origin[2] += distance;
    }
    return moved;
  }
  RayGrid& grid = rays_[static_cast<int>(set)];
  if (!grid.rays.empty()) return grid;
  grid.width = options_.width;
  grid.height = options_.height;
  if (set == RaySet::kPrimary) {
    grid.rays = primary_rays(scene().scene, grid.width, grid.height);
    return grid;
  }
  if (points_.empty()) points_ = embree_scene(false).surface_points(rays(RaySet::kPrimary));
  grid.rays = secondary_rays(scene().scene, points_, set);
  return grid;
}

const EmbreeScene& Fixtures::embree_scene(bool alpha_tested) {
  auto& made = embree_[alpha_tested ? 1 : 0];
  if (!made) made = std::make_unique<EmbreeScene>(scene(), alpha_tested);
  return *made;
}

DxrScene& Fixtures::dxr_scene(bool alpha_tested) {
  auto& made = dxr_[alpha_tested ? 1 : 0];
  if (!made) {
    made =
        std::make_unique<DxrScene>(scene(), threads(), alpha_tested, "embree", options_.precision);
  }
  return *made;
}

Fixtures::~Fixtures() = default;

DxrScene& Fixtures::scene_of(rtapi::TraversalPrecision precision, float distance) {
  const auto index = static_cast<uint32_t>(precision);
  Distant& distant = distant_[index];
  auto& made = distance == 0 ? of_precision_[index] : distant.scene;
  if (distance != 0 && std::exchange(distant.distance, distance) != distance) made.reset();
  if (!made) {
    made = std::make_unique<DxrScene>(scene(), threads(), false, "embree", precision, distance);
  }
  return *made;
}

DxrScene& Fixtures::checked_scene() {
  if (!checked_) {
    checked_ = std::make_unique<DxrScene>(scene(), threads(), false, "embree",
                                          rtapi::TraversalPrecision::kRobust, 0.0f, true);
  }
  return *checked_;
}

FrameRun& Fixtures::frame_run() {
  if (!frame_) {
    frame_ =
        std::make_unique<FrameRun>(options_.quick ? kQuickFrameWidth : kFrameWidth,
                                   options_.quick ? kQuickFrameHeight : kFrameHeight, threads());
  }
  return *frame_;
}

DxrScene& Fixtures::vulkan_scene() {
  if (!vulkan_) vulkan_ = std::make_unique<DxrScene>(scene(), threads(), false, "vulkan");
  return *vulkan_;
}

#if KAAMOS_HAS_VULKAN
HandVulkan& Fixtures::hand_vulkan() {
  if (!hand_) hand_ = std::make_unique<HandVulkan>(hand_meshes(scene(), true), scene().instances);
  return *hand_;
}
#endif

const OwnTopLevel& Fixtures::own_top_level() {
  if (!own_) own_ = std::make_unique<OwnTopLevel>(scene_of(rtapi::TraversalPrecision::kRobust));
  return *own_;
}

}  // namespace kaamos::bench
