// SPDX-License-Identifier: MIT
#include "tests/parity/rays.h"

#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <stdexcept>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/gltf/gltf_load.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::parity {
namespace {

using effects::hash_combine;
using effects::unit_float;

ProbeRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float t_max) {
  ProbeRay ray;
  for (int i = 0; i < 3; ++i) {
    ray.origin[i] = origin[i];
    ray.direction[i] = direction[i];
  }
  ray.t_max = t_max;
  return ray;
}

glm::vec2 random_pair(uint32_t seed, uint32_t index) {
  const uint32_t a = effects::pcg_hash(hash_combine(seed, index));
  return {unit_float(a), unit_float(effects::pcg_hash(a + 0x9E3779B9u))};
}

// The rays of a camera at the origin that looks along -Z of the given axes.
std::vector<ProbeRay> picture_rays(const RaySet& set, const glm::mat3& axes, float tan_half_fov,
                                   const glm::vec3& eye) {
  std::vector<ProbeRay> rays;
  for (uint32_t y = 0; y < set.height; ++y) {
    for (uint32_t x = 0; x < set.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(set.width) * 2 - 1;
      const float v = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(set.height) * 2;
      const float aspect = static_cast<float>(set.width) / static_cast<float>(set.height);
      const glm::vec3 local(u * tan_half_fov * aspect, v * tan_half_fov, -1);
      rays.push_back(make_ray(eye, glm::normalize(axes * local), 1e30f));
    }
  }
  return rays;
}

// Random flags, but none that contradict each other or skip the closest-hit shader. [DXR: Ray
// flags]
void add_flags(const RaySet& set, std::vector<ProbeRay>& rays) {
  static constexpr uint32_t kOpacity[] = {0, 0, 1, 2, 0x40, 0x80};
  static constexpr uint32_t kCulling[] = {0, 0, 0x10, 0x20};
  static constexpr uint32_t kSkipping[] = {0, 0, 0x100, 0x200};
  // Neighbours share their flags, so that the picture shows what is next to an edge.
  constexpr uint32_t kTile = 30;
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto x = static_cast<uint32_t>(i % set.width) / kTile;
    const auto y = static_cast<uint32_t>(i / set.width) / kTile;
    const uint32_t h = effects::pcg_hash(hash_combine(set.seed, y * 1000 + x));
    const uint32_t skipping = kSkipping[h >> 4 & 3];
    uint32_t culling = kCulling[h >> 2 & 3];
    if (skipping == 0x100) culling = 0;  // [DXR: SKIP_TRIANGLES excludes culling]
    rays[i].flags = kOpacity[h % 6] | culling | skipping;
    rays[i].mask = (h >> 8 & 3) == 0 ? 0xFF : h >> 16 & 0xFF;
  }
}

// Rays from the hits of `primary` on the first backend.
std::vector<ProbeRay> secondary_rays(const RaySet& set, const std::vector<ProbeRay>& primary,
                                     const std::vector<HitRecord>& hits,
                                     const effects::Scene& scene) {
  std::vector<ProbeRay> rays;
  for (size_t i = 0; i < primary.size(); ++i) {
    if (hits[i].hit == 0) continue;
    const ProbeRay& p = primary[i];
    const glm::vec3 direction(p.direction[0], p.direction[1], p.direction[2]);
    const glm::vec3 eye(p.origin[0], p.origin[1], p.origin[2]);
    // A little in front of the surface, towards the eye: this needs no normal, and the record has
    // none.
    const glm::vec3 origin = eye + direction * (hits[i].t * 0.9995f);
    const glm::vec2 u = random_pair(set.seed, static_cast<uint32_t>(i));
    if (set.kind == "sun") {
      ProbeRay ray =
          make_ray(origin, effects::sample_sun(u, scene.sun->direction_to_sun, 0.00465f), 1e30f);
      ray.flags = 0xC;
      rays.push_back(ray);
      continue;
    }
    const glm::vec3 towards = effects::to_world(effects::sample_cosine_hemisphere(u), -direction);
    ProbeRay ray = make_ray(origin, glm::normalize(towards), set.kind == "ao" ? 4.0f : 1e30f);
    ray.flags = set.kind == "ao" ? 0xC : 0;
    rays.push_back(ray);
  }
  rays.resize(rays.size() / set.width * set.width);
  return rays;
}

}  // namespace

std::optional<effects::Scene> load_scene(const std::string& name) {
  if (name == "lounge") return effects::make_lounge();
  auto loaded = effects::load_gltf(name);
  if (!loaded.ok()) return std::nullopt;
  effects::Scene scene = std::move(loaded.value().scene);
  if (effects::needs_ground(scene)) effects::add_ground(scene);
  return scene;
}

RayRun trace_on_both(const RaySet& set, const std::string (&backends)[2]) {
  RayRun run;
  std::unique_ptr<Probe> probes[2];
  std::optional<effects::Scene> scene;
  glm::mat3 axes(1.0f);
  float tan_half_fov = 0.6f;
  glm::vec3 eye(0, 0, 16);
  if (set.scene != "mixed") {
    scene = load_scene(set.scene);
    if (!scene) throw std::invalid_argument("no scene \"" + set.scene + "\"");
    const effects::Camera& camera = scene->cameras.front();
    axes = glm::mat3(camera.camera_to_world);
    tan_half_fov = static_cast<float>(std::tan(camera.vertical_fov / 2));
    eye = glm::vec3(0);  // probes put the scene's origin there
  }
  for (int i = 0; i < 2; ++i) {
    probes[i] =
        scene ? std::make_unique<Probe>(backends[i], *scene) : std::make_unique<Probe>(backends[i]);
  }
  run.rays = picture_rays(set, axes, tan_half_fov, eye);
  run.picture_width = set.width;
  if (set.kind == "given") {
    run.rays = set.given;
  } else if (set.kind == "flags") {
    add_flags(set, run.rays);
  } else if (set.kind == "ao" || set.kind == "diffuse" ||
             (set.kind == "sun" && scene && scene->sun)) {
    const auto seen = probes[0]->trace(run.rays, set.width);
    run.rays = secondary_rays(set, run.rays, seen, scene ? *scene : effects::Scene());
    run.picture_width = 0;
  } else if (set.kind != "primary") {
    throw std::invalid_argument("no rays \"" + set.kind +
                                "\": there are primary, flags, sun, ao and diffuse");
  }
  for (int i = 0; i < 2; ++i) run.hits[i] = probes[i]->trace(run.rays, set.width);
  return run;
}

std::string retrace_command(const RaySet& set, uint64_t ray) {
  return "kaamos-parity --scene " + set.scene + " --rays " + set.kind + " --size " +
         std::to_string(set.width) + "x" + std::to_string(set.height) + " --seed " +
         std::to_string(set.seed) + " --ray " + std::to_string(ray);
}

}  // namespace kaamos::parity
