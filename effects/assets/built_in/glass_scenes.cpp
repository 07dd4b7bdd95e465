// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/glass_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <utility>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kGlassThickness = 0.006;  // metres

std::uint32_t add_tint(Scene& scene, std::string name, const glm::vec4& base_color,
                       float roughness) {
  MaterialConstants constants;
  constants.base_color = base_color;
  constants.roughness = roughness;
  if (base_color.a < 1.0f) constants.flags |= kMaterialBlend;
  return add_material(scene, std::move(name), constants);
}

void add(Scene& scene, std::string name, Shape shape, std::uint32_t material,
         const glm::dmat4& transform) {
  Instance& thing = add_thing(scene, std::move(name), std::move(shape), material, transform);
  if (scene.materials[material].constants.flags & kMaterialBlend) thing.mask = kMaskTransparent;
}

// Centred at the origin; the front faces +z at z = 0.
Shape pane_shape(double half_width, double half_height, double thickness) {
  if (thickness > 0.0) {
    Shape shape;
    append(shape, box({half_width, half_height, 0.5 * thickness}),
           translate({0, 0, -0.5 * thickness}));
    return shape;
  }
  return patch({-half_width, -half_height, 0}, {2.0 * half_width, 0, 0}, {0, 2.0 * half_height, 0},
               1, 1);
}

glm::vec3 hue(double h) {
  const auto channel = [&](double shift) {
    return static_cast<float>(0.5 + 0.45 * std::cos(2.0 * glm::pi<double>() * (h + shift)));
  };
  return {channel(0.0), channel(-1.0 / 3), channel(1.0 / 3)};
}

// Six walls and two shelves of glass, with balls on the shelves.
void add_cabinet(Scene& scene, const glm::dvec3& at) {
  const std::uint32_t glass = add_tint(scene, "cabinet glass", {0.7f, 0.8f, 0.75f, 0.12f}, 0);
  scene.materials[glass].constants.flags |= kMaterialDoubleSided;
  const std::uint32_t wood = add_tint(scene, "cabinet wood", {0.35f, 0.2f, 0.1f, 1.0f}, 0.5f);
  const double half = 0.4, height = 1.5, t = 0.5 * kGlassThickness;
  add(scene, "cabinet foot", box({half, 0.1, half}), wood, translate(at + glm::dvec3(0, 0.1, 0)));
  const double middle = 0.2 + 0.5 * height;
  Shape walls;
  append(walls, box({half, 0.5 * height, t}), translate({0, middle, half - t}));
  append(walls, box({half, 0.5 * height, t}), translate({0, middle, -half + t}));
  append(walls, box({t, 0.5 * height, half - 3 * t}), translate({half - t, middle, 0}));
  append(walls, box({t, 0.5 * height, half - 3 * t}), translate({-half + t, middle, 0}));
  add(scene, "cabinet walls", std::move(walls), glass, translate(at));
  for (int shelf = 0; shelf < 2; ++shelf) {
    const double y = 0.2 + height * (shelf + 1) / 3.0;
    add(scene, "shelf " + std::to_string(shelf), box({half - 4 * t, t, half - 4 * t}), glass,
        translate(at + glm::dvec3(0, y, 0)));
    for (int i = 0; i < 2; ++i) {
      const std::uint32_t paint = add_tint(scene, "ball " + std::to_string(2 * shelf + i),
                                           glm::vec4(hue(0.3 * shelf + 0.5 * i), 1.0f), 0.3f);
      add(scene, "ball", ball(0.1, 32, 16), paint,
          translate(at + glm::dvec3(i == 0 ? -0.16 : 0.17, y + t + 0.1, i == 0 ? 0.1 : -0.12)));
    }
  }
}

void add_lamp(Scene& scene, const glm::dvec3& at, float candela) {
  Light light;
  light.name = "lamp " + std::to_string(scene.lights.size());
  light.color = glm::vec3(1.0f, 0.9f, 0.75f);
  light.intensity = candela;
  light.position = at;
  light.range = 12.0f;
  scene.lights.push_back(light);
}

void add_stack(Scene& scene, const GlassStackDesc& desc) {
  const std::uint32_t count = std::clamp(desc.panes, 1u, 8u);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double part = count == 1 ? 0.0 : static_cast<double>(i) / (count - 1);
    const std::uint32_t glass =
        add_tint(scene, "pane " + std::to_string(i),
                 glm::vec4(hue(part * 0.8), static_cast<float>(0.1 + 0.8 * part)), 0.0f);
    if (desc.thick) scene.materials[glass].constants.flags |= kMaterialDoubleSided;
    // Either in a row, each pane higher than the one before, or crossed about one vertical axis.
    glm::dmat4 place = translate({-1.2 + 0.12 * i, 0.5 + 0.06 * i, 1.0 - 0.28 * i});
    if (desc.crossed) {
      place = translate({-0.8, 0.7, 0.0}) *
              rotate_y(glm::pi<double>() * (0.25 + i * (0.5 + 0.5 / count)));
    }
    add(scene, "pane " + std::to_string(i),
        pane_shape(0.5, 0.5 + 0.06 * i, desc.thick ? kGlassThickness : 0.0), glass, place);
  }
}

}  // namespace

Scene make_pane_oracle(std::span<const Pane> panes, const glm::vec3& background) {
  Scene scene;
  scene.name = "pane-oracle";
  scene.samplers.push_back(Sampler{});
  const std::uint32_t wall = add_tint(scene, "wall", {0, 0, 0, 1}, 1.0f);
  scene.materials[wall].constants.emissive = background;
  add(scene, "wall", pane_shape(60.0, 60.0, 0.0), wall, translate({0, 0, -50}));
  for (std::size_t i = 0; i < panes.size(); ++i) {
    const Pane& pane = panes[i];
    const std::string name = "pane " + std::to_string(i);
    const std::uint32_t id = add_tint(scene, name, glm::vec4(pane.base_color, pane.alpha), 0.0f);
    MaterialConstants& glass = scene.materials[id].constants;
    glass.emissive = pane.emissive;
    glass.flags = kMaterialBlend | (pane.double_sided ? kMaterialDoubleSided : 0u);
    // At any distance wider than the view.
    const double half = 2.0 * pane.distance;
    add(scene, name, pane_shape(half, half, pane.thickness), id,
        translate({0, 0, -pane.distance}) * rotate_y(pane.turned));
  }
  add_view(scene, scene.name, glm::dvec3(0.0), {0, 0, -1}, 0.9);
  return scene;
}

Scene make_glass_stack(const GlassStackDesc& desc) {
  Scene scene;
  scene.name = "glass-stack";
  scene.samplers.push_back(Sampler{});
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.exposure = 0.4f;
  const std::uint32_t ground = add_tint(scene, "ground", {0.45f, 0.43f, 0.4f, 1.0f}, 0.6f);
  const std::uint32_t wall = add_tint(scene, "wall", {0.3f, 0.32f, 0.36f, 1.0f}, 0.9f);
  add(scene, "ground", patch({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, 1, 1), ground, glm::dmat4(1.0));
  add(scene, "wall", box({4.0, 1.5, 0.1}), wall, translate({0, 1.5, -3.0}));
  for (int i = 0; i < 5; ++i) {
    const std::uint32_t paint =
        add_tint(scene, "prop " + std::to_string(i), glm::vec4(hue(0.17 * i + 0.4), 1.0f), 0.4f);
    add(scene, "prop " + std::to_string(i), box({0.15, 0.2 + 0.12 * i, 0.15}), paint,
        translate({-1.9 + 0.55 * i, 0.2 + 0.12 * i, -2.2}) * rotate_y(0.4 * i));
  }
  // Behind the camera, so that only the glass shows it.
  const std::uint32_t lit = add_tint(scene, "sign", {0.1f, 0.1f, 0.1f, 1.0f}, 0.9f);
  scene.materials[lit].constants.emissive = glm::vec3(12.0f, 4.0f, 1.0f);
  add(scene, "sign", box({0.6, 0.25, 0.05}), lit, translate({-1.8, 0.8, 6.0}));
  add_stack(scene, desc);
  if (desc.cabinet) add_cabinet(scene, {1.3, 0, -0.4});
  add_lamp(scene, {-1.5, 2.4, 1.5}, 5.0f);
  add_lamp(scene, {1.5, 2.6, 0.8}, 5.0f);
  add_view(scene, scene.name, {0.1, 1.15, 4.2}, {0, 0.75, -0.5}, 0.75);
  return scene;
}

}  // namespace kaamos::effects
