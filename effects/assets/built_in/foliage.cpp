// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/foliage.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = glm::pi<double>();

double random(std::uint32_t seed, std::uint32_t which, std::uint32_t use) {
  return unit_float(hash_combine(seed, which * 16u + use));
}

TextureImage leaf_mask() {
  TextureImage image;
  image.name = "leaf";
  image.width = image.height = kLeafTexels;
  image.srgb = true;
  image.mips.emplace_back(std::size_t{kLeafTexels} * kLeafTexels * 4);
  for (std::uint32_t y = 0; y < kLeafTexels; ++y) {
    for (std::uint32_t x = 0; x < kLeafTexels; ++x) {
      std::uint8_t* out = &image.mips[0][(std::size_t{y} * kLeafTexels + x) * 4];
      const int vein = std::abs(2 * static_cast<int>(x) + 1 - static_cast<int>(kLeafTexels));
      const bool light = vein < 2 || (vein + 2 * static_cast<int>(y)) % 8 < 2;
      out[0] = light ? 120 : 70;
      out[1] = light ? 160 : 115;
      out[2] = light ? 70 : 45;
      out[3] = is_leaf(x, y) ? 255 : 0;
    }
  }
  generate_mips(image, 0.5f);
  return image;
}

// A unit square in x and z, z = 1 the tip, whose front faces +y.
Shape card() {
  return patch({-0.5, 0, 1}, {1, 0, 0}, {0, 0, -1}, 1, 1);
}

// The texels of the same square that are leaf: whole runs of a row as one rectangle. Along v the
// patch runs from the tip to the stem, as rows of an image do.
Shape leaf_squares() {
  Shape shape;
  constexpr double kStep = 1.0 / kLeafTexels;
  for (std::uint32_t y = 0; y < kLeafTexels; ++y) {
    for (std::uint32_t x = 0; x < kLeafTexels;) {
      std::uint32_t end = x;
      while (end < kLeafTexels && is_leaf(end, y)) ++end;
      if (end > x) {
        const double width = (end - x) * kStep;
        Shape part =
            patch({x * kStep - 0.5, 0, 1 - y * kStep}, {width, 0, 0}, {0, 0, -kStep}, 1, 1);
        for (Vertex& vertex : part.vertices) {
          vertex.uv = {static_cast<float>(vertex.position.x + 0.5),
                       static_cast<float>(1.0 - vertex.position.z)};
        }
        append(shape, part);
      }
      x = std::max(end, x + 1);
    }
  }
  return shape;
}

// Leaves around a stem that leans a little, each turned by the golden angle.
Shape twig_leaves(const Shape& leaf) {
  Shape shape;
  for (std::uint32_t i = 0; i < kLeavesOfTwig; ++i) {
    const double t = (i + 0.5) / kLeavesOfTwig, angle = i * 2.39996323;
    const double size = 0.16 * (1.1 - 0.5 * t), pitch = 0.9 - 1.5 * t;
    append(shape, leaf,
           translate({0, 0.08 + 0.75 * t, 0}) * rotate_y(angle) * rotate_x(pitch) *
               translate({0, 0, 0.02}) * glm::dmat4(glm::dmat3(size)));
  }
  return shape;
}

Shape twig_stem() {
  const glm::dvec3 path[] = {{0, 0, 0}, {0, 0.85, 0}};
  return tube(
      path, [](double t) { return 0.006 - 0.004 * t; }, 6);
}

Shape fence() {
  Shape shape;
  const auto wire = [&](const glm::dvec3& from, const glm::dvec3& to, double radius) {
    const glm::dvec3 path[] = {from, to};
    append(shape, tube(
                      path, [=](double) { return radius; }, 6));
  };
  for (int i = 0; i <= 24; ++i) {
    const double x = -1.8 + 0.15 * i;
    wire({x, 0, 0}, {x, 1.1, 0}, i % 12 == 0 ? 0.02 : kFenceWireRadius);
  }
  for (int i = 1; i <= 7; ++i) {
    wire({-1.8, 0.15 * i, 0.002}, {1.8, 0.15 * i, 0.002}, kFenceWireRadius);
  }
  return shape;
}

}  // namespace

bool is_leaf(std::uint32_t x, std::uint32_t y) {
  const double across = std::abs(2.0 * (x + 0.5) / kLeafTexels - 1.0);
  const double along = (y + 0.5) / kLeafTexels;
  const double half = 0.97 * std::pow(std::sin(kPi * std::pow(along, 0.8)), 0.6);
  if (across > half) return false;
  if (across < 0.08) return true;  // the rib
  // Holes between the side veins.
  const double vein = along * 5.0 + 1.2 * across;
  const double u = (vein - std::floor(vein) - 0.5) / 0.32, v = (across - 0.5 * half) / 0.24;
  return u * u + v * v > 1.0;
}

Scene make_foliage(const FoliageDesc& desc) {
  Scene scene = start_scene(desc.tessellated ? "foliage-tessellated" : "foliage");
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.exposure = 0.7f;
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(0.35f, 0.75f, 0.55f));
  const std::uint32_t ground = add_paint(scene, "ground", {0.5f, 0.46f, 0.38f});
  const std::uint32_t steel = add_paint(scene, "steel", {0.45f, 0.47f, 0.5f}, 0.4f);
  const std::uint32_t stem = add_paint(scene, "stem", {0.28f, 0.2f, 0.1f});
  const std::uint32_t leaf = add_paint(scene, "leaf", glm::vec3(1.0f), 0.6f);
  // Sampled at level 0 without filtering.
  scene.samplers.push_back({.wrap_u = Wrap::kClamp,
                            .wrap_v = Wrap::kClamp,
                            .min_filter = Filter::kNearest,
                            .mag_filter = Filter::kNearest,
                            .mipmapped = false});
  scene.images.push_back(leaf_mask());
  MaterialConstants& constants = scene.materials[leaf].constants;
  constants.flags = kMaterialDoubleSided;
  if (!desc.tessellated) constants.flags |= kMaterialMask | kMaterialAlphaTested;
  constants.image[kBaseColorTexture] = 0;
  constants.sampler[kBaseColorTexture] = 1;

  add_floor(scene, "ground", {-12, -12}, {12, 12}, 0.0, ground);
  add_thing(scene, "fence", fence(), steel, translate({0, 0, 0.8}));
  Mesh twig;
  twig.name = "twig";
  add_shape(twig, twig_leaves(desc.tessellated ? leaf_squares() : card()), leaf, !desc.tessellated);
  add_shape(twig, twig_stem(), stem);
  scene.meshes.push_back(std::move(twig));
  const auto mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  for (std::uint32_t i = 0; i < desc.twigs; ++i) {
    const double size = 0.8 + 0.7 * random(desc.seed, i, 0);
    const glm::dvec3 at(-1.9 + 3.8 * random(desc.seed, i, 1), 0.0,
                        -0.9 + 1.3 * random(desc.seed, i, 2));
    add_instance(scene, "twig " + std::to_string(i), mesh,
                 translate(at) * rotate_y(2.0 * kPi * random(desc.seed, i, 3)) *
                     rotate_x(0.5 * random(desc.seed, i, 4)) * glm::dmat4(glm::dmat3(size)));
  }
  add_view(scene, "hedge", {0.5, 1.15, 3.6}, {0, 0.5, 0}, 0.75);
  return scene;
}

}  // namespace kaamos::effects
