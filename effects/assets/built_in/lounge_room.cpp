// SPDX-License-Identifier: MIT
// The static parts: walls, ceiling, dome, rug. All are closed solids, so that nothing leaks where
// they meet.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/assets/built_in/lounge_parts.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects::lounge {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kWallThickness = 0.3;

void add_box(Shape& shape, const glm::dvec3& low, const glm::dvec3& high) {
  append(shape, box(0.5 * (high - low)), translate(0.5 * (low + high)));
}

/// The window in the +x wall: its z range, sill and head.
constexpr double kWindowZ0 = -3.9, kWindowZ1 = 2.1, kSill = 0.35, kHead = 3.35;

Shape walls() {
  Shape shape;
  const double x = kRoomX, z = kRoomZ, t = kWallThickness, h = kRoomHeight + t;
  add_box(shape, {-x - t, -t, -z - t}, {x + t, h, -z});
  add_box(shape, {-x - t, -t, z}, {x + t, h, z + t});
  add_box(shape, {-x - t, -t, -z - t}, {-x, h, z + t});
  // The window's wall consists of four overlapping parts, so no edges have to match.
  add_box(shape, {x, -t, -z - t}, {x + t, h, kWindowZ0});
  add_box(shape, {x, -t, kWindowZ1}, {x + t, h, z + t});
  add_box(shape, {x, -t, kWindowZ0 - 0.1}, {x + t, kSill, kWindowZ1 + 0.1});
  add_box(shape, {x, kHead, kWindowZ0 - 0.1}, {x + t, h, kWindowZ1 + 0.1});
  return shape;
}

Shape window_frame() {
  Shape shape;
  const double x0 = kRoomX + 0.1, x1 = kRoomX + 0.17, w = 0.035;
  for (int i = 0; i <= 6; ++i) {
    const double z = kWindowZ0 + (kWindowZ1 - kWindowZ0) * i / 6;
    add_box(shape, {x0, kSill - 0.01, z - w}, {x1, kHead + 0.01, z + w});
  }
  for (const double y : {kSill, 2.45, kHead})
    add_box(shape, {x0 + 0.005, y - w, kWindowZ0 - 0.01}, {x1 - 0.005, y + w, kWindowZ1 + 0.01});
  return shape;
}

Shape woodwork() {
  Shape shape;
  const double x = kRoomX, z = kRoomZ;
  // Skirting boards along all walls.
  add_box(shape, {-x, 0.0, -z - 0.01}, {x, 0.11, -z + 0.02});
  add_box(shape, {-x, 0.0, z - 0.02}, {x, 0.11, z + 0.01});
  add_box(shape, {-x - 0.01, 0.0, -z}, {-x + 0.02, 0.11, z});
  add_box(shape, {x - 0.02, 0.0, -z}, {x + 0.01, 0.11, z});
  // A wide window sill.
  append(shape, rounded_box({0.19, 0.02, 0.5 * (kWindowZ1 - kWindowZ0) + 0.06}, 0.012, 4),
         translate({x + 0.06, kSill + 0.015, 0.5 * (kWindowZ0 + kWindowZ1)}));
  // Slats in front of the far wall: rows of small gaps that only occlusion reveals.
  for (int i = 0; i < 96; ++i) {
    const double at = -x + 0.1 + (2.0 * x - 0.2) * (i + 0.5) / 96;
    append(shape, rounded_box({0.032, 1.4, 0.022}, 0.006, 2), translate({at, 1.62, -z + 0.03}));
  }
  return shape;
}

/// A rectangle with a round hole at height y, meshed from the circle to the room's edge. `up`
/// selects the side that is visible.
Shape ceiling_plane(double y, double half_x, double half_z, bool up) {
  constexpr int kSegments = 256, kRings = 12;
  Shape shape;
  for (int r = 0; r <= kRings; ++r) {
    for (int s = 0; s <= kSegments; ++s) {
      const double angle = s == kSegments ? 0.0 : 2.0 * kPi * s / kSegments;
      const glm::dvec2 d(std::sin(angle), std::cos(angle));
      const double edge =
          std::min(half_x / std::max(std::abs(d.x), 1e-9), half_z / std::max(std::abs(d.y), 1e-9));
      const glm::dvec2 p = d * glm::mix(kDomeRadius, edge, static_cast<double>(r) / kRings);
      Vertex vertex;
      vertex.position = glm::vec3(p.x, y, p.y);
      vertex.normal = glm::vec3(0, up ? 1 : -1, 0);
      vertex.uv = glm::vec2(p);
      shape.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t r = 0; r < kRings; ++r)
    for (std::uint32_t s = 0; s < kSegments; ++s) {
      const std::uint32_t a = r * (kSegments + 1) + s, b = a + 1, c = a + kSegments + 1, d = c + 1;
      if (up)
        shape.indices.insert(shape.indices.end(), {a, c, d, a, d, b});
      else
        shape.indices.insert(shape.indices.end(), {a, d, c, a, b, d});
    }
  return shape;
}

Shape ceiling() {
  const double y0 = kRoomHeight, y1 = kRoomHeight + 0.3;
  Shape shape = ceiling_plane(y0, kRoomX + 0.15, kRoomZ + 0.15, false);
  append(shape, ceiling_plane(y1, kRoomX + 0.15, kRoomZ + 0.15, true));
  // The inside of the hole, from top to bottom, facing the axis.
  const std::vector<glm::dvec2> side = {{kDomeRadius, y1}, {kDomeRadius, y0}};
  append(shape, revolve(side, 256));
  return shape;
}

/// A point of the dome, which is a flattened sphere, above its rim.
glm::dvec3 dome_point(double polar, double azimuth, double inset = 0.0) {
  const double r = kDomeRadius - 0.03 - inset, rise = 1.45 - inset;
  return {std::sin(polar) * r * std::sin(azimuth), kRoomHeight + 0.3 + std::cos(polar) * rise,
          std::sin(polar) * r * std::cos(azimuth)};
}

glm::dvec3 dome_normal(const glm::dvec3& p) {
  return glm::normalize(glm::dvec3(p.x, (p.y - kRoomHeight - 0.3) * 1.5, p.z));
}

/// Bars in both diagonal directions: a net of thin geometry.
Shape dome_lattice() {
  constexpr int kBars = 24, kSteps = 40;
  Shape shape;
  for (const double turn : {-1.0, 1.0}) {
    for (int b = 0; b < kBars; ++b) {
      std::vector<glm::dvec3> path;
      for (int i = 0; i <= kSteps; ++i) {
        const double t = static_cast<double>(i) / kSteps;
        const double polar = glm::mix(0.5 * kPi, 0.2, t);
        const double azimuth = 2.0 * kPi * b / kBars + turn * 1.1 * t;
        // The two nets lie on top of each other rather than cross.
        path.push_back(dome_point(polar, azimuth, turn > 0.0 ? 0.0 : 0.018));
      }
      append(shape, bar(path, 0.014, 0.016, [&](std::size_t i) { return dome_normal(path[i]); }));
    }
  }
  return shape;
}

Shape dome_ring(double polar, double radius, double inset) {
  std::vector<glm::dvec3> path;
  for (int i = 0; i <= 128; ++i)
    path.push_back(dome_point(polar, 2.0 * kPi * (i % 128) / 128, inset));
  return tube(
      path, [=](double) { return radius; }, 10);
}

/// A thin closed band at the foot of the dome, 4 mm of sheet metal. It reaches into the ceiling, so
/// that no light enters beside it.
Shape dome_band() {
  std::vector<glm::dvec2> profile;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i <= 10; ++i) {
      const double t = side == 0 ? i / 10.0 : 1.0 - i / 10.0;
      const glm::dvec3 p =
          dome_point(glm::mix(0.5 * kPi + 0.05, 1.33, t), 0.0, side == 0 ? -0.034 : -0.030);
      profile.emplace_back(p.z, p.y);
    }
  profile.push_back(profile.front());
  return revolve(profile, 192);
}

}  // namespace

Mesh room() {
  Mesh mesh;
  mesh.name = "room";
  const double x = kRoomX, z = kRoomZ;
  Shape floor = patch({-x - 0.1, 0.0, z + 0.1}, {2 * x + 0.2, 0, 0}, {0, 0, -2 * z - 0.2}, 48, 40);
  for (Vertex& vertex : floor.vertices)
    vertex.uv = glm::vec2(vertex.position.x, vertex.position.z) / 1.2f;
  // A slab under the floor keeps out light from below.
  Shape slab;
  add_box(slab, {-x - 0.3, -0.3, -z - 0.3}, {x + 0.3, -0.02, z + 0.3});
  Shape terrace;
  add_box(terrace, {x + 0.3, -0.35, -14.0}, {x + 16.0, -0.05, 14.0});
  add_shape(mesh, floor, kFloor);
  Shape plaster = walls();
  append(plaster, slab);
  add_shape(mesh, plaster, kWall);
  add_shape(mesh, ceiling(), kCeiling);
  add_shape(mesh, woodwork(), kDarkWood);
  add_shape(mesh, window_frame(), kBlackMetal);
  add_shape(mesh, terrace, kTerrace);
  return mesh;
}

Mesh dome() {
  Mesh mesh;
  mesh.name = "dome";
  Shape shell = dome_band();
  append(shell, dome_lattice());
  append(shell, dome_ring(0.2, 0.02, 0.0));
  append(shell, dome_ring(0.75, 0.012, 0.03));
  Shape lines;
  for (const double polar : {1.36, 1.05, 0.45}) append(lines, dome_ring(polar, 0.008, 0.045));
  add_shape(mesh, shell, kDomeShell);
  add_shape(mesh, lines, kDomeLine);
  return mesh;
}

Mesh rug() {
  Mesh mesh;
  mesh.name = "rug";
  const std::vector<glm::dvec2> profile = {{0.0, 0.002},   {2.55, 0.002},  {2.56, 0.006},
                                           {2.556, 0.011}, {2.545, 0.014}, {0.0, 0.014}};
  Shape shape = revolve(profile, 128);
  for (Vertex& vertex : shape.vertices) vertex.uv = glm::vec2(vertex.position.x, vertex.position.z);
  add_shape(mesh, shape, kRug);
  return mesh;
}

}  // namespace kaamos::effects::lounge
