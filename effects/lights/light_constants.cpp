// SPDX-License-Identifier: MIT
#include "effects/lights/light_constants.h"

#include <algorithm>
#include <cmath>

namespace kaamos::effects {

namespace {

// [KHR_lights_punctual: Inner and Outer Cone Angles]
void set_cone(LightConstants& out, const Light& light) {
  const float inner = std::cos(light.inner_cone_angle);
  const float outer = std::cos(light.outer_cone_angle);
  out.spot_scale = 1.0f / std::max(1e-3f, inner - outer);
  out.spot_offset = -outer * out.spot_scale;
  out.is_spot = 1;
  out.cos_outer = std::max(outer, 0.05f);  // flat maps do not reach a half space
}

}  // namespace

std::vector<LightConstants> light_constants(const Scene& scene, const glm::dvec3& origin) {
  std::vector<LightConstants> lights;
  for (const Light& light : scene.lights) {
    if (light.type == LightType::kDirectional) continue;
    LightConstants out = {};
    out.position = glm::vec3(light.position - origin);
    out.intensity = light.color * light.intensity;
    out.direction = light.direction;
    out.radius = light.radius;
    const float strongest =
        std::max({out.intensity.x, out.intensity.y, out.intensity.z, kCutOffIlluminance});
    out.range = light.range > 0 ? light.range : std::sqrt(strongest / kCutOffIlluminance);
    out.spot_offset = 1.0f;
    if (light.type == LightType::kSpot) set_cone(out, light);
    lights.push_back(out);
  }
  return lights;
}

}  // namespace kaamos::effects
