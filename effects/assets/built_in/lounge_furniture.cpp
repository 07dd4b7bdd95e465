// SPDX-License-Identifier: MIT
// Chairs, sofas, table, magazine, lamp. Each stands on y = 0 and faces +z.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/assets/built_in/lounge_parts.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects::lounge {
namespace {

constexpr double kPi = glm::pi<double>();

double square(double x) {
  return x * x;
}

/// A cushion centred at the origin: rounded, and thicker in the middle than at its edges.
Shape cushion(const glm::dvec3& half, double radius, double bulge) {
  Shape shape = rounded_box(half, radius, 5, {10, 1, 6});
  deform(shape, [=](const glm::dvec3& p) {
    const double x = std::min(1.0, square(p.x / half.x)), z = std::min(1.0, square(p.z / half.z));
    return glm::dvec3(p.x, p.y + bulge * (1.0 - x) * (1.0 - z) * p.y / half.y, p.z);
  });
  return shape;
}

/// An upright cushion, thick along z.
Shape standing_cushion(const glm::dvec3& half, double radius, double bulge) {
  Shape shape;
  append(shape, cushion({half.x, half.z, half.y}, radius, bulge), rotate_x(0.5 * kPi));
  return shape;
}

Shape leg(const glm::dvec3& top, const glm::dvec3& bottom, double top_radius, double bottom_radius,
          int sides = 16) {
  std::vector<glm::dvec3> path;
  for (int i = 0; i <= 8; ++i) path.push_back(glm::mix(top, bottom, i / 8.0));
  return tube(
      path, [=](double t) { return glm::mix(top_radius, bottom_radius, t); }, sides);
}

/// Upper edge of the chair's shell by the angle from the back (0) to the arms: a high back and low
/// arms.
double shell_top(double angle) {
  const double t = 0.5 + 0.5 * std::cos(std::min(std::abs(angle) / 1.95, 1.0) * kPi);
  return 0.56 + 0.24 * t;
}

glm::dvec3 shell_point(double angle, double radius, double height) {
  // Leans back with height; angle 0 points to -z.
  const double lean = 1.0 + 0.22 * std::max(0.0, height - 0.38);
  return {std::sin(angle) * radius * lean, height, -std::cos(angle) * radius * lean};
}

/// The chair's back: a flat plate bent around the seat.
Shape chair_shell() {
  constexpr double kReach = 1.95, kThickness = 0.022;
  Shape shape =
      rounded_box({kReach, 0.5, 0.5 * kThickness}, 0.5 * kThickness - 1e-5, 3, {40, 16, 1});
  deform(shape, [=](const glm::dvec3& p) {
    const double v = p.y + 0.5;
    const double height = glm::mix(0.36, shell_top(p.x), v);
    return shell_point(p.x, 0.285 - p.z, height);
  });
  // The floor of the tub, under the cushion.
  const std::vector<glm::dvec2> floor = {{0.0, 0.345},   {0.27, 0.345}, {0.285, 0.352},
                                         {0.285, 0.366}, {0.27, 0.373}, {0.0, 0.373}};
  append(shape, revolve(floor, 64));
  return shape;
}

Shape chair_piping() {
  std::vector<glm::dvec3> edge;
  for (int i = 0; i <= 96; ++i) {
    const double angle = -1.95 + 3.9 * i / 96;
    edge.push_back(shell_point(angle, 0.285, shell_top(angle) + 0.002));
  }
  Shape shape = tube(
      edge, [](double) { return 0.0135; }, 10);
  std::vector<glm::dvec3> ring;
  for (int i = 0; i <= 96; ++i) {
    const double angle = 2.0 * kPi * (i % 96) / 96;
    ring.emplace_back(0.262 * std::cos(angle), 0.424, 0.262 * std::sin(angle));
  }
  append(shape, tube(
                    ring, [](double) { return 0.006; }, 8));
  return shape;
}

Shape chair_cushion() {
  std::vector<glm::dvec2> profile = {{0.0, 0.374}, {0.23, 0.374}};
  for (int i = 1; i <= 12; ++i) {
    const double a = -0.5 * kPi + kPi * i / 12;
    profile.emplace_back(0.23 + 0.03 * std::cos(a), 0.424 + 0.05 * std::sin(a));
  }
  for (int i = 1; i <= 16; ++i) {
    const double r = 0.23 * (1.0 - i / 16.0);
    profile.emplace_back(r, 0.474 + 0.022 * (1.0 - square(r / 0.23)));
  }
  return revolve(profile, 72);
}

/// Bends a shape into a ring sector: x becomes the angle, z is added to the radius.
void bend_round(Shape& shape, double radius) {
  deform(shape, [=](const glm::dvec3& p) {
    const double r = radius + p.z, angle = p.x / radius;
    return glm::dvec3(std::sin(angle) * r, p.y, std::cos(angle) * r);
  });
}

}  // namespace

Mesh chair() {
  Mesh mesh;
  mesh.name = "chair";
  Shape legs, feet;
  for (const double x : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      const glm::dvec3 top(0.17 * x, 0.35, 0.17 * z), foot(0.235 * x, 0.012, 0.235 * z);
      append(legs, leg(top, foot, 0.013, 0.009));
      append(feet, leg(glm::mix(foot, top, 0.02), foot * glm::dvec3(1, 0.15, 1), 0.014, 0.015, 20));
    }
  }
  // A ring under the seat connects the legs.
  std::vector<glm::dvec3> ring;
  for (int i = 0; i <= 64; ++i) {
    const double angle = 2.0 * kPi * (i % 64) / 64;
    ring.emplace_back(0.262 * std::cos(angle), 0.25, 0.262 * std::sin(angle));
  }
  append(legs, tube(
                   ring, [](double) { return 0.007; }, 10));
  add_shape(mesh, chair_cushion(), kRedFabric);
  add_shape(mesh, chair_shell(), kWood);
  add_shape(mesh, legs, kBrass);
  add_shape(mesh, chair_piping(), kPiping);
  add_shape(mesh, feet, kRubber);
  return mesh;
}

Mesh small_sofa() {
  Mesh mesh;
  mesh.name = "small sofa";
  Shape fabric, frame, legs, pillows;
  append(frame, rounded_box({0.86, 0.07, 0.40}, 0.03, 4), translate({0, 0.23, 0}));
  for (const double side : {-1.0, 1.0}) {
    append(fabric, cushion({0.345, 0.085, 0.34}, 0.05, 0.03),
           translate({0.35 * side, 0.385, 0.05}));
    append(fabric, standing_cushion({0.345, 0.24, 0.09}, 0.06, 0.035),
           translate({0.35 * side, 0.67, -0.27}) * rotate_x(-0.2));
    append(fabric, cushion({0.085, 0.20, 0.40}, 0.07, 0.012), translate({0.785 * side, 0.46, 0.0}));
    append(pillows, standing_cushion({0.19, 0.19, 0.055}, 0.03, 0.05),
           translate({0.5 * side, 0.64, -0.1}) * rotate_y(-0.35 * side) * rotate_x(-0.35));
    for (const double z : {-1.0, 1.0})
      append(legs, leg({0.72 * side, 0.18, 0.3 * z}, {0.76 * side, 0.003, 0.33 * z}, 0.016, 0.011));
  }
  // The back plate that the upright cushions lean on.
  append(frame, rounded_box({0.86, 0.28, 0.03}, 0.025, 4),
         translate({0, 0.55, -0.38}) * rotate_x(-0.16));
  add_shape(mesh, fabric, kSandFabric);
  add_shape(mesh, frame, kDarkWood);
  add_shape(mesh, legs, kBrass);
  add_shape(mesh, pillows, kTealFabric);
  return mesh;
}

Mesh round_sofa() {
  Mesh mesh;
  mesh.name = "round sofa";
  constexpr double kRadius = 1.75, kSector = 0.44;
  constexpr int kSeats = 5;
  Shape fabric, plinth, base;
  for (int i = 0; i < kSeats; ++i) {
    const double angle = (i - 0.5 * (kSeats - 1)) * kSector;
    const double half_width = 0.5 * kSector * kRadius - 0.006;
    Shape seat = cushion({half_width, 0.11, 0.36}, 0.06, 0.03);
    bend_round(seat, kRadius);
    append(fabric, seat, translate({0, 0.335, 0}) * rotate_y(angle));
    Shape back = standing_cushion({half_width * 1.16, 0.25, 0.10}, 0.075, 0.035);
    bend_round(back, kRadius + 0.27);
    append(fabric, back, translate({0, 0.64, 0.0}) * rotate_y(angle));
  }
  constexpr double kHalfArc = 0.5 * kSeats * kSector * kRadius;
  base = rounded_box({kHalfArc + 0.02, 0.06, 0.42}, 0.025, 4, {40, 1, 2});
  bend_round(base, kRadius + 0.03);
  Shape back_plate = rounded_box({kHalfArc + 0.02, 0.32, 0.025}, 0.02, 4, {40, 4, 1});
  bend_round(back_plate, kRadius + 0.445);
  Shape all_base;
  append(all_base, base, translate({0, 0.165, 0}));
  append(all_base, back_plate, translate({0, 0.425, 0}));
  plinth = rounded_box({kHalfArc - 0.06, 0.0525, 0.33}, 0.01, 2, {40, 1, 1});
  bend_round(plinth, kRadius + 0.03);
  Shape feet;
  append(feet, plinth, translate({0, 0.0525, 0}));
  add_shape(mesh, fabric, kTealFabric);
  add_shape(mesh, all_base, kDarkWood);
  add_shape(mesh, feet, kBlackMetal);
  return mesh;
}

Mesh table() {
  Mesh mesh;
  mesh.name = "table";
  std::vector<glm::dvec2> top = {{0.0, 0.405}, {0.50, 0.405}};
  for (int i = 0; i <= 16; ++i) {
    const double a = -0.5 * kPi + kPi * i / 16;
    top.emplace_back(0.535 + 0.015 * std::cos(a), 0.42 + 0.015 * std::sin(a));
  }
  top.emplace_back(0.0, 0.435);
  std::vector<glm::dvec2> foot = {{0.0, 0.0}, {0.30, 0.0}, {0.31, 0.006}, {0.31, 0.014}};
  for (int i = 0; i <= 24; ++i) {
    const double t = i / 24.0;
    foot.emplace_back(0.31 * std::pow(1.0 - t, 3.0) + 0.045 + 0.05 * t * t * t * t,
                      0.016 + 0.385 * t);
  }
  foot.emplace_back(0.0, 0.404);
  Shape cup, saucer;
  std::vector<glm::dvec2> bowl = {{0.0, 0.0}, {0.022, 0.0}, {0.024, 0.004}};
  for (int i = 1; i <= 12; ++i) {
    const double t = i / 12.0;
    bowl.emplace_back(0.024 + 0.016 * std::sqrt(t), 0.004 + 0.056 * t);
  }
  for (int i = 12; i >= 0; --i) {
    const double t = i / 12.0;
    bowl.emplace_back(std::max(0.0, 0.024 + 0.016 * std::sqrt(t) - 0.0025 - (i == 0 ? 0.03 : 0.0)),
                      0.007 + 0.053 * t);
  }
  const std::vector<glm::dvec2> plate = {{0.0, 0.0},     {0.035, 0.0},   {0.07, 0.010},
                                         {0.071, 0.012}, {0.069, 0.012}, {0.036, 0.004},
                                         {0.0, 0.004}};
  std::vector<glm::dvec3> handle;
  for (int i = 0; i <= 20; ++i) {
    const double a = -0.45 * kPi + 0.9 * kPi * i / 20;
    handle.emplace_back(0.034 + 0.021 * std::cos(a), 0.034 + 0.018 * std::sin(a), 0.0);
  }
  append(cup, revolve(bowl, 40), translate({0, 0.004, 0}));
  append(cup,
         tube(
             handle, [](double) { return 0.0028; }, 8),
         translate({0, 0.004, 0}));
  append(saucer, revolve(plate, 48));
  Shape porcelain;
  const glm::dmat4 place = translate({0.24, 0.4351, -0.16}) * rotate_y(0.7);
  append(porcelain, cup, place);
  append(porcelain, saucer, place);
  add_shape(mesh, revolve(top, 96), kDarkWood);
  add_shape(mesh, revolve(foot, 64), kBrass);
  add_shape(mesh, porcelain, kPorcelain);
  return mesh;
}

Mesh magazine() {
  Mesh mesh;
  mesh.name = "magazine";
  // 12 sheets of 0.1 mm bend up from the spine at x = 0, with the covers outermost; each sheet is a
  // little higher than the one below. Lengths along a sheet are preserved, so the far edges fan
  // out.
  Shape pages, cover;
  constexpr double kWidth = 0.21, kDepth = 0.29, kSheet = 0.0006;
  for (int i = 0; i < 12; ++i) {
    const double lift = 0.008 + 0.0045 * i;
    Shape sheet = rounded_box({0.5 * kWidth, 0.00005, 0.5 * kDepth}, 0.00004, 1, {20, 1, 8});
    deform(sheet, [=](const glm::dvec3& p) {
      const double t = (p.x + 0.5 * kWidth) / kWidth;
      const double curl = 0.006 * std::sin(p.z * 9.0 + 0.6 * i) * t * t;
      return glm::dvec3(t * kWidth * (1.0 - 0.12 * lift * i * t),
                        p.y + 0.0004 + kSheet * i + lift * t * t * (1.0 - 0.45 * t) * 0.12 * i +
                            std::abs(curl) * 0.1 * i,
                        p.z);
    });
    append(i == 0 || i == 11 ? cover : pages, sheet);
  }
  for (Vertex& vertex : cover.vertices)
    vertex.uv = glm::vec2(vertex.position.x / kWidth, vertex.position.z / kDepth + 0.5);
  add_shape(mesh, pages, kPaper);
  add_shape(mesh, cover, kCover);
  return mesh;
}

Mesh floor_lamp() {
  Mesh mesh;
  mesh.name = "floor lamp";
  const std::vector<glm::dvec2> foot = {{0.0, 0.0},     {0.15, 0.0},  {0.155, 0.005},
                                        {0.155, 0.015}, {0.15, 0.02}, {0.02, 0.028},
                                        {0.011, 0.04},  {0.011, 1.3}, {0.0, 1.3}};
  const std::vector<glm::dvec2> shade = {{0.2, 1.28},   {0.2, 1.283},  {0.15, 1.62},
                                         {0.147, 1.62}, {0.197, 1.28}, {0.2, 1.28}};
  add_shape(mesh, revolve(foot, 40), kBrass);
  add_shape(mesh, revolve(shade, 64), kSandFabric);
  return mesh;
}

Mesh bulb() {
  Mesh mesh;
  mesh.name = "bulb";
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 16; ++i) {
    const double a = -0.5 * kPi + kPi * i / 16;
    profile.emplace_back(std::max(0.0, kBulbRadius * std::cos(a)),
                         kBulbHeight + kBulbRadius * std::sin(a));
  }
  profile.front().x = profile.back().x = 0.0;
  add_shape(mesh, revolve(profile, 32), kLampBulb);
  return mesh;
}

}  // namespace kaamos::effects::lounge
