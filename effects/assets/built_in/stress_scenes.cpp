// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/stress_scenes.h"

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

double target_triangles(const StressDesc& desc) {
  return desc.scale * static_cast<double>(original_triangles(desc.kind));
}

// A scene and its triangles without the small things that fill it up.
struct Built {
  Scene scene;
  double triangles = 0;
};

// Puts one of the scenes together.
struct Builder {
  Builder(const StressDesc& given, std::string name, double of_detail)
      : desc(given), detail(of_detail) {
    if (desc.scale == 1.0) name += "-full";
    if (desc.lights == 1) name += "-1";
    scene = start_scene(std::move(name));
  }

  // Returns the number of steps for a thing that has `full` of them at detail 1.
  int steps(double full, int least) const {
    return std::max(least, static_cast<int>(std::lround(full * detail)));
  }
  double random(std::uint32_t which, std::uint32_t use) const {
    return unit_float(hash_combine(desc.seed, which * 16u + use));
  }
  std::uint32_t paint(const char* name, const glm::vec3& color, float roughness = 0.7f) {
    return add_paint(scene, name, color, roughness);
  }
  void put(const char* name, std::uint32_t mesh, const glm::dmat4& transform) {
    add_instance(scene, name + (" " + std::to_string(scene.instances.size())), mesh, transform);
  }
  Shape rod(const glm::dvec3& from, const glm::dvec3& to, double radius, int sides) const {
    const glm::dvec3 path[] = {from, to};
    return tube(
        path, [=](double) { return radius; }, sides);
  }
  // A board with rounded edges, if there are triangles for them.
  Shape board(const glm::dvec3& half) const {
    const int rounding = steps(6, 0);
    const double radius = 0.7 * std::min({half.x, half.y, half.z});
    return rounding == 0 ? box(half) : rounded_box(half, radius, rounding);
  }
  // A seat, a back of bars, four legs.
  std::uint32_t chair(const char* name, std::uint32_t material, double full) {
    const int sides = steps(full, 3);
    Shape shape;
    append(shape, board({0.21, 0.02, 0.21}), translate({0, 0.45, 0}));
    for (const double x : {-0.18, 0.18}) {
      append(shape, rod({x, 0, 0.18}, {x, 0.44, 0.18}, 0.012, sides));
      append(shape, rod({x, 0, -0.18}, {x, 0.9, -0.2}, 0.012, sides));
    }
    for (int i = 0; i < 4; ++i) {
      const double x = -0.12 + 0.08 * i;
      append(shape, rod({x, 0.46, -0.185}, {x, 0.86, -0.2}, 0.007, sides));
    }
    append(shape, board({0.2, 0.03, 0.012}), translate({0, 0.88, -0.2}));
    return add_mesh(scene, name, std::move(shape), material);
  }
  // A top on one foot.
  std::uint32_t table(const char* name, std::uint32_t material, double radius, double full) {
    const glm::dvec2 profile[] = {{0.0, 0.0},     {0.5 * radius, 0.0},   {0.45 * radius, 0.03},
                                  {0.05, 0.05},   {0.04, 0.7},           {0.1, 0.71},
                                  {radius, 0.72}, {radius + 0.01, 0.73}, {radius - 0.005, 0.745},
                                  {0.0, 0.745}};
    return add_mesh(scene, name, revolve(profile, steps(full, 8)), material);
  }
  void room(const glm::dvec3& half, std::uint32_t floor, std::uint32_t wall) {
    add_floor(scene, "floor", {-half.x, -half.z}, {half.x, half.z}, 0, floor);
    const double h = 2.0 * half.y, t = 0.1;
    add_box(scene, "ceiling", {-half.x, h, -half.z}, {half.x, h + t, half.z}, wall);
    add_box(scene, "wall -x", {-half.x - t, -t, -half.z}, {-half.x, h + t, half.z}, wall);
    add_box(scene, "wall +x", {half.x, -t, -half.z}, {half.x + t, h + t, half.z}, wall);
    add_box(scene, "wall -z", {-half.x, -t, -half.z - t}, {half.x, h + t, -half.z}, wall);
    add_box(scene, "wall +z", {-half.x, -t, half.z}, {half.x, h + t, half.z + t}, wall);
  }
  void lamps(std::initializer_list<glm::dvec3> places, float intensity, float radius,
             std::size_t count) {
    for (const glm::dvec3& at : places) {
      if (count-- == 0) break;
      Light& lamp =
          add_lamp(scene, "lamp " + std::to_string(scene.lights.size()), at, intensity, radius);
      lamp.color = {1.0f, 0.86f, 0.66f};
    }
  }
  // Small round things where `place` says, until the count is right.
  template <class Place>
  void fill(const char* name, std::uint32_t material, double radius, const Place& place) {
    counted = instanced_triangle_count(scene);
    const double target = target_triangles(desc);
    double missing = target - static_cast<double>(counted);
    // Each has so few triangles that one thing more or less does not matter.
    int segments = 12, rings = 7;
    while (segments > 3 && segments * (2 * rings - 2) > 0.01 * target) {
      --segments;
      rings = std::max(3, rings - 1);
    }
    const std::uint32_t mesh = add_mesh(scene, name, ball(radius, segments, rings), material);
    const auto each = static_cast<double>(scene.meshes[mesh].triangle_count());
    for (std::uint32_t i = 0; missing > 0.5 * each; ++i, missing -= each) {
      put(name, mesh, translate(place(i)));
    }
  }

  StressDesc desc;
  Scene scene;
  double detail;
  std::uint64_t counted = 0;  // triangles before the small things
};

Built make_pub(const StressDesc& desc, double detail) {
  Builder b(desc, "pub", detail);
  b.scene.sky = {.zenith = glm::vec3(0.1f), .horizon = glm::vec3(0.1f), .ground = glm::vec3(0.05f)};
  b.scene.exposure = 0.7f;
  const std::uint32_t oak = b.paint("oak", {0.42f, 0.26f, 0.13f}, 0.5f);
  const std::uint32_t plaster = b.paint("plaster", {0.62f, 0.55f, 0.44f});
  const std::uint32_t dark = b.paint("dark wood", {0.2f, 0.1f, 0.05f}, 0.5f);
  const std::uint32_t glass = b.paint("bottles", {0.1f, 0.25f, 0.12f}, 0.2f);
  b.room({6, 1.6, 4}, oak, plaster);
  for (int i = -2; i <= 2; ++i) {
    add_box(b.scene, "beam " + std::to_string(i), {2.2 * i - 0.1, 2.95, -4},
            {2.2 * i + 0.1, 3.2, 4}, dark);
  }
  add_box(b.scene, "counter", {-5.2, 0, -2.6}, {1.5, 1.1, -2.0}, dark);
  for (int i = 0; i < 3; ++i) {
    add_box(b.scene, "shelf " + std::to_string(i), {-5.2, 1.2 + 0.4 * i, -3.95},
            {1.5, 1.23 + 0.4 * i, -3.7}, dark);
  }
  const std::uint32_t table = b.table("table", oak, 0.5, 110);
  const std::uint32_t chair = b.chair("chair", dark, 56);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 at(-4.2 + 2.7 * (i % 4), 0, i < 4 ? -0.4 : 2.3);
    b.put("table", table, translate(at));
    for (int k = 0; k < 4; ++k) {
      b.put("chair", chair,
            translate(at) * rotate_y(0.5 * kPi * k + 0.3 * b.random(8 * i + k, 0)) *
                translate({0, 0, -0.72}));
    }
  }
  b.lamps({{-2.9, 2.5, -0.4}, {2.6, 2.5, 2.3}, {-2.9, 2.5, 2.3}, {2.6, 2.5, -0.4}}, 14.0f, 0.25f,
          desc.lights);
  b.fill("bottle", glass, 0.045, [&](std::uint32_t i) {
    return glm::dvec3(-5.1 + 6.5 * b.random(i, 1), 1.275 + 0.4 * (i % 3),
                      -3.92 + 0.2 * b.random(i, 2));
  });
  add_view(b.scene, "pub", {5.3, 1.7, 3.3}, {-1.5, 0.7, -0.5}, 1.0);
  return {std::move(b.scene), static_cast<double>(b.counted)};
}

// A trunk that bends and a crown of leaves along arcs.
std::uint32_t palm(Builder& b, std::uint32_t bark, std::uint32_t green) {
  Mesh mesh;
  mesh.name = "palm";
  std::vector<glm::dvec3> path;
  const int joints = b.steps(24, 3);
  for (int i = 0; i <= joints; ++i) {
    const double t = static_cast<double>(i) / joints;
    path.emplace_back(0.6 * t * t, 5.0 * t, 0.0);
  }
  add_shape(mesh,
            tube(
                path, [](double t) { return 0.16 - 0.06 * t; }, b.steps(24, 4)),
            bark);
  Shape leaves;
  for (int i = 0; i < 14; ++i) {
    Shape leaf = patch({-0.5, 0, 1}, {1, 0, 0}, {0, 0, -1}, 2 * b.steps(3, 1), b.steps(24, 2));
    const double droop = 0.9 + 0.5 * b.random(static_cast<std::uint32_t>(i), 3);
    deform(leaf, [=](const glm::dvec3& p) {
      const double width = 0.45 * std::sin(kPi * (0.08 + 0.9 * p.z));
      return glm::dvec3(p.x * width, 0.5 * p.z - droop * p.z * p.z - 0.3 * std::abs(p.x) * width,
                        2.0 * p.z);
    });
    append(leaves, leaf, translate(path.back()) * rotate_y(2.0 * kPi * i / 14));
  }
  add_shape(mesh, std::move(leaves), green);
  b.scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(b.scene.meshes.size() - 1);
}

Built make_resort(const StressDesc& desc, double detail) {
  Builder b(desc, "resort", detail);
  b.scene.sky = default_sky();
  b.scene.sun = default_sun();
  b.scene.sun->direction_to_sun = glm::normalize(glm::vec3(0.5f, 0.8f, 0.35f));
  b.scene.exposure = 0.5f;
  const std::uint32_t sand = b.paint("sand", {0.62f, 0.54f, 0.4f});
  const std::uint32_t wall = b.paint("wall", {0.75f, 0.7f, 0.62f});
  const std::uint32_t roof = b.paint("roof", {0.5f, 0.2f, 0.12f});
  const std::uint32_t bark = b.paint("bark", {0.35f, 0.25f, 0.16f});
  const std::uint32_t green = b.paint("palm leaf", {0.16f, 0.34f, 0.1f});
  b.scene.materials[green].constants.flags |= kMaterialDoubleSided;
  const std::uint32_t cloth = b.paint("cloth", {0.75f, 0.72f, 0.6f});
  const std::uint32_t wood = b.paint("wood", {0.45f, 0.3f, 0.18f});
  const std::uint32_t water = b.paint("water", {0.08f, 0.3f, 0.4f}, 0.05f);
  const std::uint32_t gravel = b.paint("gravel", {0.5f, 0.48f, 0.45f});
  add_floor(b.scene, "ground", {-40, -40}, {40, 40}, 0.0, sand);
  add_floor(b.scene, "pool", {-5, -3}, {5, 3}, 0.01, water);
  for (int i = 0; i < 6; ++i) {
    const double x = -15.0 + 6.0 * i;
    const std::string number = std::to_string(i);
    add_box(b.scene, "house " + number, {x - 2, 0, -13}, {x + 2, 2.8, -9}, wall);
    const glm::dvec2 profile[] = {{3.4, 2.6}, {3.4, 2.75}, {0.0, 4.2}};
    add_thing(b.scene, "roof " + number, revolve(profile, 4, 0.0), roof,
              translate({x, 0, -11}) * rotate_y(0.25 * kPi));
  }
  const std::uint32_t tree = palm(b, bark, green);
  for (std::uint32_t i = 0; i < 24; ++i) {
    const double angle = 2.0 * kPi * i / 24, away = 8.5 + 9.0 * b.random(i, 4);
    glm::dvec3 at(away * std::cos(angle), 0, 0.75 * away * std::sin(angle));
    if (at.z < -6.0) at.z = -6.5;
    b.put("palm", tree,
          translate(at) * rotate_y(2.0 * kPi * b.random(i, 5)) *
              glm::dmat4(glm::dmat3(0.7 + 0.4 * b.random(i, 6))));
  }
  const glm::dvec2 shade[] = {{1.3, 2.05}, {1.31, 2.06}, {0.0, 2.5}};
  Shape shape = revolve(shade, b.steps(64, 6));
  append(shape, b.rod({0, 0, 0}, {0, 2.45, 0}, 0.03, b.steps(32, 4)));
  const std::uint32_t parasol = add_mesh(b.scene, "parasol", std::move(shape), cloth);
  b.scene.materials[cloth].constants.flags |= kMaterialDoubleSided;
  const std::uint32_t chair = b.chair("deck chair", wood, 52);
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 at(-9.0 + 1.9 * (i % 10), 0, i < 10 ? 4.6 : -4.4);
    b.put("parasol", parasol, translate(at));
    b.put("deck chair", chair, translate(at + glm::dvec3(0.6, 0, 0.5)) * rotate_y(0.3 * i));
    b.put("deck chair", chair, translate(at + glm::dvec3(-0.6, 0, 0.5)) * rotate_y(-0.2 * i));
  }
  b.lamps({{-6, 2.6, 5.5}, {6, 2.6, 5.5}, {0, 2.6, -6.5}}, 25.0f, 0.25f,
          desc.lights > 0 ? desc.lights - 1 : 0);
  b.fill("pebble", gravel, 0.06, [&](std::uint32_t i) {
    const double angle = 2.0 * kPi * b.random(i, 7), away = 6.2 + 5.0 * b.random(i, 8);
    return glm::dvec3(away * std::cos(angle), 0.02, 0.62 * away * std::sin(angle));
  });
  add_view(b.scene, "resort", {10.5, 3.2, 11.0}, {-1.5, 0.6, 0}, 0.9);
  return {std::move(b.scene), static_cast<double>(b.counted)};
}

Built make_breakfast(const StressDesc& desc, double detail) {
  Builder b(desc, "breakfast", detail);
  b.scene.sky = {.zenith = glm::vec3(0.2f), .horizon = glm::vec3(0.2f), .ground = glm::vec3(0.1f)};
  b.scene.exposure = 0.7f;
  const std::uint32_t tiles = b.paint("tiles", {0.5f, 0.46f, 0.4f}, 0.4f);
  const std::uint32_t wall = b.paint("wall", {0.7f, 0.68f, 0.6f});
  const std::uint32_t oak = b.paint("oak", {0.55f, 0.36f, 0.2f}, 0.5f);
  const std::uint32_t china = b.paint("china", {0.8f, 0.8f, 0.78f}, 0.2f);
  const std::uint32_t fruit = b.paint("fruit", {0.7f, 0.3f, 0.06f}, 0.5f);
  b.room({5, 1.4, 4}, tiles, wall);
  const std::uint32_t table = b.table("table", oak, 0.85, 220);
  const std::uint32_t chair = b.chair("chair", oak, 64);
  std::vector<glm::dvec2> bowl;
  const int arc = b.steps(22, 3);
  for (int i = 0; i <= arc; ++i) {
    const double angle = 0.5 * kPi * i / arc;
    bowl.emplace_back(i == 0 ? 0.0 : 0.05 * std::sin(angle), 0.05 - 0.05 * std::cos(angle));
  }
  for (int i = arc; i >= 0; --i) {
    const double angle = 0.5 * kPi * i / arc;
    bowl.emplace_back(i == 0 ? 0.0 : 0.046 * std::sin(angle), 0.051 - 0.046 * std::cos(angle));
  }
  const std::uint32_t cup = add_mesh(b.scene, "cup", revolve(bowl, b.steps(64, 6)), china);
  const glm::dvec2 rim[] = {{0.0, 0.0},     {0.08, 0.0},   {0.12, 0.014},
                            {0.119, 0.017}, {0.08, 0.004}, {0.0, 0.004}};
  const std::uint32_t plate = add_mesh(b.scene, "plate", revolve(rim, b.steps(96, 8)), china);
  for (int t = 0; t < 6; ++t) {
    const glm::dvec3 at(-3.1 + 3.1 * (t % 3), 0, t < 3 ? -1.7 : 1.7);
    b.put("table", table, translate(at));
    for (int k = 0; k < 5; ++k) {
      const glm::dmat4 seat = translate(at) * rotate_y(2.0 * kPi * (k + 0.1 * t) / 5);
      b.put("chair", chair, seat * translate({0, 0, -1.0}));
      b.put("plate", plate, seat * translate({0, 0.745, -0.6}));
      b.put("cup", cup, seat * translate({0.2, 0.745, -0.45}));
    }
  }
  b.lamps({{0, 2.3, 0}, {-3.1, 2.3, -1.7}, {3.1, 2.3, 1.7}, {-3.1, 2.3, 1.7}}, 16.0f, 0.3f,
          desc.lights);
  // In heaps on the tables.
  b.fill("fruit", fruit, 0.02, [&](std::uint32_t i) {
    const int t = static_cast<int>(i % 6);
    const double angle = 2.0 * kPi * b.random(i, 1), away = 0.3 * std::sqrt(b.random(i, 2));
    return glm::dvec3(-3.1 + 3.1 * (t % 3) + away * std::cos(angle),
                      0.765 + 0.25 * (0.3 - away) * b.random(i, 3),
                      (t < 3 ? -1.7 : 1.7) + away * std::sin(angle));
  });
  add_view(b.scene, "breakfast", {4.6, 1.5, 3.6}, {-1.0, 0.5, -0.6}, 1.0);
  return {std::move(b.scene), static_cast<double>(b.counted)};
}

}  // namespace

std::uint64_t original_triangles(StressKind kind) {
  return kind == StressKind::kPub ? 281000u : kind == StressKind::kResort ? 376000u : 1400000u;
}

Scene make_stress_scene(const StressDesc& given) {
  StressDesc desc = given;
  desc.scale = std::clamp(desc.scale, 1.0 / 32, 4.0);
  // As fine as leaves a tenth or so for the small things: coarser until it does.
  double detail = std::sqrt(desc.scale);
  const double target = target_triangles(desc);
  Built built;
  for (int attempt = 0; attempt < 8; ++attempt) {
    built = desc.kind == StressKind::kPub      ? make_pub(desc, detail)
            : desc.kind == StressKind::kResort ? make_resort(desc, detail)
                                               : make_breakfast(desc, detail);
    if (built.triangles <= target) break;
    detail *= std::min(0.9, std::sqrt(0.85 * target / built.triangles));
  }
  return std::move(built.scene);
}

std::optional<StressKind> stress_kind(const Scene& scene) {
  const std::string name = scene.name.substr(0, scene.name.find('-'));
  if (name == "pub") return StressKind::kPub;
  if (name == "resort") return StressKind::kResort;
  if (name == "breakfast") return StressKind::kBreakfast;
  return std::nullopt;
}

CameraPath stress_camera_path(StressKind kind) {
  CameraPath path;
  path.name = "own";
  switch (kind) {
    case StressKind::kPub:
      path.keys = {{.seconds = 0, .eye = {5.3, 1.7, 3.3}, .target = {-1.5, 0.7, -0.5}},
                   {.seconds = 5, .eye = {2.9, 1.5, 0.9}, .target = {-3.0, 0.8, -0.3}},
                   {.seconds = 10, .eye = {-1.3, 1.4, 0.95}, .target = {-5.0, 1.0, -1.5}},
                   {.seconds = 15, .eye = {-4.9, 1.6, 1.0}, .target = {0.0, 0.7, 0.5}},
                   {.seconds = 20, .eye = {-5.3, 1.8, 3.4}, .target = {1.5, 0.6, -0.5}}};
      break;
    case StressKind::kResort:
      path.keys = {{.seconds = 0, .eye = {10.5, 3.2, 11.0}, .target = {-1.5, 0.6, 0}},
                   {.seconds = 5, .eye = {5.5, 1.7, 6.4}, .target = {-3.0, 1.0, 1.5}},
                   {.seconds = 10, .eye = {-3.0, 1.7, 6.2}, .target = {-7.0, 1.2, -4.0}},
                   {.seconds = 15, .eye = {-8.5, 2.4, 2.0}, .target = {0.0, 1.0, -6.0}},
                   {.seconds = 20, .eye = {-11.0, 6.0, 8.0}, .target = {0.0, 0.5, -1.0}}};
      break;
    case StressKind::kBreakfast:
      path.keys = {{.seconds = 0, .eye = {4.6, 1.5, 3.6}, .target = {-1.0, 0.5, -0.6}},
                   {.seconds = 5, .eye = {4.4, 0.5, 0.1}, .target = {0.0, 0.5, -1.7}},
                   {.seconds = 10, .eye = {0.6, 0.35, 0.0}, .target = {-2.9, 0.6, -1.7}},
                   {.seconds = 15, .eye = {-3.0, 1.2, 0.1}, .target = {-3.1, 0.7, 1.9}},
                   {.seconds = 20, .eye = {-4.6, 1.7, 0.0}, .target = {1.0, 0.6, 0.3}}};
      break;
  }
  return path;
}

}  // namespace kaamos::effects
