// SPDX-License-Identifier: MIT
#include "effects/shadows/shadow_map/map_rays.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace kaamos::effects {

namespace {

std::uint32_t map_count(const ShadowMapConstants& constants) {
  return std::max(constants.cascades, 1u);
}

}  // namespace

MapRays::MapRays(const EffectScope& scope)
    : frame_(scope.frame),
      scene_(scope.scene),
      views_(scope.views),
      made_(scope.settings.get_constants<ShadowMapConstants>()) {}

rtapi::Status MapRays::create(const EffectScope& scope, const RayPassDesc& rays) {
  if (const auto s = check_shadow_map(made_); !s) return s;
  const auto& draws = scope.library("shadows/shadow_map/shadow_draws");
  if (const auto s = draws_.create(scope, draws, made_.size, map_count(made_)); !s) return s;
  auto disk = bind_disk(scope);
  if (!disk) return disk.error();
  disk_ = std::move(*disk);
  auto pass = RayPass::create(scope.device, frame_, scope.gpu, rays);
  if (!pass) return pass.error();
  rays_ = std::move(*pass);
  return {};
}

rtapi::Status MapRays::begin_frame(const Camera& camera) {
  draws_.see_instances(camera.position());
  draws_.set_maps(sun_maps(describe_sun_maps(made_, scene_, draws_.bounds(), frame_), camera));
  return {};
}

void MapRays::record(rtapi::CommandList& list, const EffectSettings& settings,
                     const PassConstants& constants) {
  auto map = settings.get_constants<ShadowMapConstants>();
  map.size = made_.size;
  map.cascades = map_count(made_);
  draws_.record(list, map);
  auto own = settings.constants;
  std::memcpy(own.data(), &map, sizeof map);
  rays_.dispatch(list, frame_, constants, frame_.height(), PassArguments(views_, own));
}

RayPassDesc occluder_pass(const char* name, rtapi::ShaderLibrary library,
                          const char* ray_generation) {
  RayPassDesc desc;
  desc.name = name;
  desc.library = std::move(library);
  desc.ray_generation = ray_generation;
  desc.miss[kRayTypeVisibility] = "OccluderMiss";
  desc.hit[kRayTypeVisibility].any_hit = "OccluderAnyHit";
  desc.hit[kRayTypeVisibility].closest_hit = "OccluderClosestHit";
  desc.payload_bytes = 8;  // OccluderPayload
  return desc;
}

}  // namespace kaamos::effects
