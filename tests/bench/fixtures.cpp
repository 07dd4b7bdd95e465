// SPDX-License-Identifier: MIT
#include "fixtures.h"

#if KAAMOS_HAS_VULKAN
#include "hand_vulkan.h"
#else
namespace kaamos::bench {
class HandVulkan {};
}  // namespace kaamos::bench
#endif

namespace kaamos::bench {

Fixtures::Fixtures(const Options& options)
    : options_(options), arena_(static_cast<int>(options.threads)) {}

const SceneData& Fixtures::scene() {
  if (!scene_) scene_ = make_scene_data();
  return *scene_;
}

const RayGrid& Fixtures::rays(RaySet set) {
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
  if (!made) made = std::make_unique<DxrScene>(scene(), threads(), alpha_tested);
  return *made;
}

Fixtures::~Fixtures() = default;

DxrScene& Fixtures::exact_scene() {
  if (!exact_) {
    exact_ = std::make_unique<DxrScene>(scene(), threads(), false, "embree",
                                        rtapi::TraversalPrecision::kExact);
  }
  return *exact_;
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
  if (!own_) own_ = std::make_unique<OwnTopLevel>(dxr_scene(false));
  return *own_;
}

}  // namespace kaamos::bench
