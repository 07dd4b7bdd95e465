// SPDX-License-Identifier: MIT
// A pot plant of alpha-tested leaf cards on stems, after monstera, whose leaves have cuts and
// holes.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/assets/built_in/lounge_parts.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects::lounge {
namespace {

constexpr double kPi = glm::pi<double>();

/// Uniform random numbers that differ from leaf to leaf and are the same at every call.
double random(std::uint32_t leaf, std::uint32_t use) {
  return unit_float(hash_combine(leaf * 16u + use, 77u));
}

/// A leaf along +z from the origin, 1 long, bent down towards its tip and folded up along its rib.
Shape leaf_blade(double droop, double fold) {
  Shape shape = patch({-0.5, 0.0, 1.0}, {1, 0, 0}, {0, 0, -1}, 8, 14);
  deform(shape, [=](const glm::dvec3& p) {
    const double bend = droop * p.z, x = p.x * 0.86;
    const double y = fold * std::abs(x) * (1.0 - 0.5 * p.z) + 0.03 * std::sin(9.0 * p.z) * x;
    // Bend along an arc, which preserves the length of the rib.
    const double s = std::abs(bend) < 1e-6 ? p.z : std::sin(bend) / droop;
    const double fall = std::abs(bend) < 1e-6 ? 0.0 : (1.0 - std::cos(bend)) / droop;
    return glm::dvec3(x, y * std::cos(bend) - fall, s + y * std::sin(bend));
  });
  return shape;
}

Shape pot() {
  const std::vector<glm::dvec2> profile = {
      {0.0, 0.0},    {0.15, 0.0},  {0.165, 0.012}, {0.19, 0.10},  {0.205, 0.22}, {0.21, 0.34},
      {0.207, 0.36}, {0.2, 0.364}, {0.193, 0.36},  {0.19, 0.345}, {0.19, 0.30},  {0.0, 0.30}};
  return revolve(profile, 64);
}

Shape soil() {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 8; ++i) {
    const double r = 0.191 * (1.0 - i / 8.0);
    profile.emplace_back(r, 0.325 + 0.012 * std::cos(r * 8.0));
  }
  return revolve(profile, 48);
}

}  // namespace

Mesh plant() {
  Mesh mesh;
  mesh.name = "plant";
  Shape stems, leaves;
  constexpr std::uint32_t kLeaves = 64;
  for (std::uint32_t i = 0; i < kLeaves; ++i) {
    // Each leaf is turned by the golden angle; inner leaves rise, outer ones hang.
    const double t = (i + 0.5) / kLeaves;
    const double azimuth = i * 2.39996323 + 0.5 * random(i, 0);
    const double reach = 0.12 + 0.5 * t + 0.1 * random(i, 1);
    const double height = 0.62 + 1.25 * std::pow(1.0 - t, 0.8) + 0.18 * random(i, 2);
    const glm::dvec3 out(std::sin(azimuth), 0.0, std::cos(azimuth));
    const glm::dvec3 root = out * (0.02 + 0.1 * random(i, 3)) + glm::dvec3(0, 0.32, 0);
    const glm::dvec3 tip = out * reach + glm::dvec3(0, height, 0);
    std::vector<glm::dvec3> path;
    for (int k = 0; k <= 14; ++k) {
      const double s = k / 14.0;
      // First up, then outwards: a quadratic curve whose control point is above the root.
      const glm::dvec3 middle = glm::mix(root, tip, 0.25) + glm::dvec3(0, 0.45 * height, 0);
      path.push_back(root * (1 - s) * (1 - s) + middle * 2.0 * s * (1 - s) + tip * s * s);
    }
    append(stems, tube(
                      path, [](double s) { return glm::mix(0.0085, 0.004, s); }, 8));
    const double size = 0.30 + 0.16 * random(i, 4);
    const double pitch = 0.25 + 0.6 * t + 0.35 * random(i, 5);
    const glm::dmat4 place = translate(tip) * rotate_y(azimuth + 0.5 * (random(i, 6) - 0.5)) *
                             rotate_x(pitch) * rotate_z(0.7 * (random(i, 7) - 0.5));
    append(leaves, leaf_blade(0.5 + 0.6 * random(i, 8), 0.25 + 0.2 * random(i, 9)),
           place * glm::dmat4(glm::dmat3(size)));
  }
  add_shape(mesh, pot(), kPorcelain);
  add_shape(mesh, soil(), kSoil);
  add_shape(mesh, stems, kStem);
  add_shape(mesh, leaves, kLeaf, true);
  return mesh;
}

TextureImage leaf_texture() {
  constexpr std::uint32_t kSize = 512;
  TextureImage image;
  image.name = "leaf";
  image.width = image.height = kSize;
  image.srgb = true;
  image.mips.emplace_back(std::size_t{kSize} * kSize * 4);
  for (std::uint32_t py = 0; py < kSize; ++py) {
    for (std::uint32_t px = 0; px < kSize; ++px) {
      // u runs across, v along the leaf: v = 1 is the bottom of the picture and the far edge of the
      // patch.
      const double x = 2.0 * (px + 0.5) / kSize - 1.0;
      const double along = (py + 0.5) / kSize;
      const double ax = std::abs(x);
      // A heart shape: wide near the stem, a point at the tip, a notch where the stem joins.
      const double half = 0.93 * std::pow(std::sin(kPi * std::pow(along, 0.62)), 0.75);
      double inside = half - ax;
      inside = std::min(inside, along - 0.02 - 0.10 * std::exp(-ax * 7.0));
      // Cuts between the side veins, open towards the rim.
      const double vein = along * 7.0 - 1.7 * ax;
      const double between = std::abs(vein - std::floor(vein) - 0.5);
      const double cut_depth = std::max(0.0, ax - 0.42 * half) * 0.20;
      if (along > 0.14) inside = std::min(inside, (between - cut_depth) * 0.35);
      // A row of holes beside the rib.
      const double hx = (ax - 0.2 * half) / 0.055, hy = (vein - std::floor(vein) - 0.5) / 0.16;
      if (along > 0.2 && along < 0.85)
        inside = std::min(inside, (std::sqrt(hx * hx + hy * hy) - 1.0) * 0.05);
      const double alpha = std::clamp(inside * kSize * 0.25 + 0.5, 0.0, 1.0);
      const double rib = std::exp(-ax * 45.0);
      const double side_vein = std::exp(-std::abs(between - 0.5) * 30.0) * 0.5;
      const double light = std::max(rib, side_vein);
      const glm::dvec3 color =
          glm::mix(glm::dvec3(0.16, 0.36, 0.11), glm::dvec3(0.42, 0.58, 0.26), light) *
          (0.9 + 0.1 * std::cos(ax * 5.0));
      std::uint8_t* out = &image.mips[0][(std::size_t{py} * kSize + px) * 4];
      for (int c = 0; c < 3; ++c)
        out[c] = static_cast<std::uint8_t>(std::lround(255.0 * std::min(color[c], 1.0)));
      out[3] = static_cast<std::uint8_t>(std::lround(255.0 * alpha));
    }
  }
  return image;
}

}  // namespace kaamos::effects::lounge
