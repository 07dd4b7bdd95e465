// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/peter_panning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <string>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kRadii[3] = {0.0025, 0.005, 0.015};
constexpr double kStoolZ[3] = {-0.7, 0.0, 0.7};
constexpr double kLegOffset = 0.16, kSeatHalf = 0.2, kSeatTop = 0.45, kSeatThickness = 0.02;
constexpr double kLegHeight = kSeatTop - kSeatThickness;
constexpr double kSheetThickness = 0.002, kSheetDepth = 0.5, kSheetPart = 0.6;

// A box that casts a shadow: its own axes are `to_world`'s.
struct Slab {
  const char* name;
  glm::dvec3 half;
  glm::dmat4 to_world;
};

// A sheet of parts `first` to `last`, whose shadow ends at kSheetShadowX: its nearer upper edge is
// what the last blocked ray touches.
Slab sheet(const PeterPanningDesc& desc, int which, int first, int last) {
  const double edge = kSheetShadowX + kSheetHeights[which] / std::tan(desc.sun_elevation);
  const double near_z = kSheetPartZ[first] + 0.5 * kSheetPart;
  const double far_z = kSheetPartZ[last] - 0.5 * kSheetPart;
  return {which == 0 ? "low sheet" : "high sheet",
          {0.5 * kSheetDepth, 0.5 * kSheetThickness, 0.5 * (near_z - far_z)},
          translate({edge + 0.5 * kSheetDepth, kSheetHeights[which] - 0.5 * kSheetThickness,
                     0.5 * (near_z + far_z)})};
}

std::vector<Slab> slabs(const PeterPanningDesc& desc) {
  std::vector<Slab> out;
  for (const double z : kStoolZ) {
    out.push_back({"seat",
                   {kSeatHalf, 0.5 * kSeatThickness, kSeatHalf},
                   translate({0, kSeatTop - 0.5 * kSeatThickness, z})});
  }
  // Its lower edge towards the sun lies on the floor, the other one is lifted by 14 degrees.
  const glm::dvec3 half(0.15, 0.006, 0.05);
  out.push_back({"sole", half,
                 translate({0.3, 0, 1.35}) * rotate_z(-0.25) * translate({-half.x, half.y, 0})});
  out.push_back(sheet(desc, 0, 0, 1));
  out.push_back(sheet(desc, 1, 1, 2));
  return out;
}

std::array<StoolLeg, 12> make_legs() {
  std::array<StoolLeg, 12> legs{};
  for (std::size_t i = 0; i < legs.size(); ++i) {
    legs[i] = {kRadii[i / 4],
               {i % 2 == 0 ? kLegOffset : -kLegOffset,
                kStoolZ[i / 4] + (i % 4 < 2 ? kLegOffset : -kLegOffset)}};
  }
  return legs;
}

glm::dvec3 direction_to_sun(const PeterPanningDesc& desc) {
  return {std::cos(desc.sun_elevation), std::sin(desc.sun_elevation), 0.0};
}

bool hits(const Slab& slab, const glm::dvec3& from, const glm::dvec3& way) {
  const glm::dmat4 to_own = glm::inverse(slab.to_world);
  const glm::dvec3 p(to_own * glm::dvec4(from, 1)), d(to_own * glm::dvec4(way, 0));
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) {
      if (std::abs(p[axis]) > slab.half[axis]) return false;
      continue;
    }
    const double a = (-slab.half[axis] - p[axis]) / d[axis];
    const double b = (slab.half[axis] - p[axis]) / d[axis];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  return low < high;
}

// From the floor upwards: over the disk that the leg stands on, the ray enters below its top.
bool hits(const StoolLeg& leg, const glm::dvec3& from, const glm::dvec3& way) {
  const glm::dvec2 p = glm::dvec2(from.x, from.z) - leg.at, d(way.x, way.z);
  const double a = glm::dot(d, d), b = glm::dot(p, d);
  const double root = b * b - a * (glm::dot(p, p) - leg.radius * leg.radius);
  if (root <= 0.0) return false;
  const double out = (-b + std::sqrt(root)) / a, in = std::max(0.0, (-b - std::sqrt(root)) / a);
  return out > 0.0 && from.y + in * way.y < kLegHeight;
}

bool sees_sun(const std::vector<Slab>& all, const glm::dvec3& way, const glm::dvec2& point) {
  const glm::dvec3 from(point.x, 0, point.y);
  const auto hit = [&](const auto& thing) { return hits(thing, from, way); };
  return std::none_of(all.begin(), all.end(), hit) &&
         std::none_of(stool_legs().begin(), stool_legs().end(), hit);
}

}  // namespace

std::span<const StoolLeg> stool_legs() {
  static const std::array<StoolLeg, 12> legs = make_legs();
  return legs;
}

bool sees_sun(const PeterPanningDesc& desc, const glm::dvec2& point) {
  return sees_sun(slabs(desc), direction_to_sun(desc), point);
}

FloorLight floor_light(const PeterPanningDesc& desc, const glm::dvec2& point, double margin) {
  const std::vector<Slab> all = slabs(desc);
  const glm::dvec3 way = direction_to_sun(desc);
  for (const StoolLeg& leg : stool_legs()) {
    if (glm::distance(leg.at, point) < leg.radius + margin) return FloorLight::kEdge;
  }
  const bool middle = sees_sun(all, way, point);
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * kPi * i;
    const glm::dvec2 beside = point + margin * glm::dvec2(std::cos(angle), std::sin(angle));
    if (sees_sun(all, way, beside) != middle) return FloorLight::kEdge;
  }
  return middle ? FloorLight::kLit : FloorLight::kShadow;
}

glm::dvec2 shadow_middle(const StoolLeg& leg, double distance) {
  return leg.at - glm::dvec2(leg.radius + distance, 0.0);
}

double sheet_visibility(const PeterPanningDesc& desc, int part, double x) {
  double visible = 1.0;
  for (int which = 0; which < 2; ++which) {
    if (part == 2 * (1 - which)) continue;  // the other sheet alone
    const double edge = kSheetShadowX + kSheetHeights[which] / std::tan(desc.sun_elevation);
    const double above = desc.sun_elevation - std::atan2(kSheetHeights[which], edge - x);
    if (desc.angular_radius <= 0.0) {
      if (above < 0.0) visible = 0.0;
      continue;
    }
    const double s = std::clamp(std::tan(above) / std::tan(desc.angular_radius), -1.0, 1.0);
    visible = std::min(visible, (std::acos(-s) + s * std::sqrt(1.0 - s * s)) / kPi);
  }
  return visible;
}

Scene make_peter_panning(const PeterPanningDesc& desc) {
  Scene scene = start_scene("peter-panning");
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.exposure = 0.5f;
  scene.sun->direction_to_sun = glm::vec3(direction_to_sun(desc));
  scene.sun->angular_radius = static_cast<float>(desc.angular_radius);
  const std::uint32_t ground = add_paint(scene, "ground", glm::vec3(0.55f, 0.53f, 0.5f));
  const std::uint32_t wood = add_paint(scene, "wood", {0.5f, 0.3f, 0.16f}, 0.6f);
  const std::uint32_t steel = add_paint(scene, "steel", {0.35f, 0.38f, 0.42f}, 0.4f);
  const std::uint32_t paper = add_paint(scene, "paper", {0.7f, 0.6f, 0.35f});
  const std::uint32_t leather = add_paint(scene, "leather", {0.25f, 0.09f, 0.06f}, 0.5f);
  add_floor(scene, "floor", {-30, -30}, {30, 30}, 0.0, ground);
  for (const Slab& slab : slabs(desc)) {
    const std::string name = slab.name;
    const std::uint32_t paint = name == "seat" ? wood : name == "sole" ? leather : paper;
    add_thing(scene, name, box(slab.half), paint, slab.to_world);
  }
  for (std::size_t i = 0; i < stool_legs().size(); ++i) {
    const StoolLeg& leg = stool_legs()[i];
    // The mesh has 24 sides and is at most 0.13 mm thinner than the cylinder.
    if (i % 4 == 0) add_mesh(scene, "leg", post(leg.radius, kLegHeight, 24), steel);
    add_instance(scene, "leg " + std::to_string(i),
                 static_cast<std::uint32_t>(scene.meshes.size() - 1),
                 translate({leg.at.x, 0, leg.at.y}));
  }
  add_view(scene, "all", {-2.5, 1.25, 2.3}, {-0.2, 0.15, -0.35}, 0.8);
  add_view(scene, "foot", {-0.42, 0.22, 1.05}, {0.12, 0.02, 0.84}, 0.5);
  return scene;
}

}  // namespace kaamos::effects
