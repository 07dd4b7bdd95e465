// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/destruction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr int kColumns = 25, kRows = 20;
static_assert(kColumns * kRows == kDebrisPieces);
constexpr double kWidth = 4.0, kHeight = 2.5, kThickness = 0.2;  // of the wall
constexpr int kFrames = 60, kStepsPerFrame = 8;
constexpr double kStep = kDestructionSeconds / (kFrames * kStepsPerFrame);
constexpr int kBurstFrame = 20;
constexpr double kGravity = 9.81;
const glm::dvec3 kBlast(0.3, 0.9, -0.9);  // behind the wall

// The places and turns of a thing, one for each frame.
struct Track {
  std::vector<glm::dvec3> at;
  std::vector<glm::dquat> turned;
};

double random(std::uint32_t seed, std::uint32_t which, std::uint32_t use) {
  return unit_float(hash_combine(seed, which * 16u + use));
}

// A corner of the pieces; those of the wall's outline stay on it.
glm::dvec2 corner(std::uint32_t seed, int column, int row) {
  const auto id = static_cast<std::uint32_t>(row * (kColumns + 1) + column);
  const bool inside_x = column > 0 && column<kColumns, inside_y = row> 0 && row < kRows;
  const double dx = inside_x ? 0.7 * (random(seed, id, 0) - 0.5) : 0.0;
  const double dy = inside_y ? 0.7 * (random(seed, id, 1) - 0.5) : 0.0;
  return {kWidth * ((column + dx) / kColumns - 0.5), kHeight * (row + dy) / kRows};
}

// A prism with flat faces about its middle. `middle` is an output.
Shape piece(std::uint32_t seed, int column, int row, glm::dvec3& middle) {
  const glm::dvec2 c[4] = {corner(seed, column, row), corner(seed, column + 1, row),
                           corner(seed, column + 1, row + 1), corner(seed, column, row + 1)};
  middle = glm::dvec3(0.25 * (c[0] + c[1] + c[2] + c[3]), 0.0);
  Shape shape;
  const auto quad = [&](const std::array<glm::dvec3, 4>& p) {
    const auto first = static_cast<std::uint32_t>(shape.vertices.size());
    const glm::vec3 normal(glm::normalize(glm::cross(p[1] - p[0], p[3] - p[0])));
    for (std::size_t i = 0; i < 4; ++i) {
      Vertex vertex;
      vertex.position = glm::vec3(p[i] - middle);
      vertex.normal = normal;
      vertex.uv = {i == 1 || i == 2 ? 1.0f : 0.0f, i >= 2 ? 0.0f : 1.0f};
      shape.vertices.push_back(vertex);
    }
    shape.indices.insert(shape.indices.end(),
                         {first, first + 1, first + 2, first, first + 2, first + 3});
  };
  const auto front = [&](int i) { return glm::dvec3(c[i], 0.5 * kThickness); };
  const auto back = [&](int i) { return glm::dvec3(c[i], -0.5 * kThickness); };
  quad({front(0), front(1), front(2), front(3)});
  quad({back(1), back(0), back(3), back(2)});
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    quad({back(i), back(next), front(next), front(i)});
  }
  return shape;
}

// Thrown by the blast, falls, bounces, comes to rest. Pieces do not meet each other.
Track fly(std::uint32_t seed, std::uint32_t id, const glm::dvec3& start) {
  Track track;
  const glm::dvec3 away = start - kBlast;
  const double distance = glm::length(away);
  glm::dvec3 velocity =
      away / distance * (5.5 / (0.3 + distance * distance)) * (0.7 + 0.6 * random(seed, id, 2));
  velocity.y += 0.8 * random(seed, id, 3);
  const glm::dvec3 axis = glm::normalize(
      glm::dvec3(random(seed, id, 4) - 0.5, random(seed, id, 5) - 0.5, random(seed, id, 6) - 0.51));
  double spin = glm::length(velocity) * (0.5 + 2.0 * random(seed, id, 7)), angle = 0.0;
  glm::dvec3 at = start;
  const double rest = 0.06;  // metres over the floor, of the middle
  for (int frame = 0; frame <= kFrames; ++frame) {
    track.at.push_back(at);
    track.turned.push_back(glm::angleAxis(angle, axis));
    if (frame < kBurstFrame) continue;
    for (int i = 0; i < kStepsPerFrame; ++i) {
      velocity.y -= kGravity * kStep;
      at += velocity * kStep;
      angle += spin * kStep;
      if (at.y < std::min(rest, start.y)) {
        at.y = std::min(rest, start.y);
        velocity *= glm::dvec3(0.7, -0.3, 0.7);
        spin *= 0.5;
        if (std::abs(velocity.y) < 0.2) velocity.y = 0.0;
      }
    }
  }
  return track;
}

// The upper half of a soft piece swings about its lower one.
Track swing(const Track& of, std::uint32_t seed, std::uint32_t id) {
  Track track = of;
  for (int frame = kBurstFrame; frame <= kFrames; ++frame) {
    const double seconds = (frame - kBurstFrame) * kStep * kStepsPerFrame;
    const double angle = 1.2 * std::exp(-1.5 * seconds) *
                         std::sin(14.0 * seconds * (0.8 + 0.4 * random(seed, id, 8)));
    track.turned[static_cast<std::size_t>(frame)] *= glm::angleAxis(angle, glm::dvec3(1, 0, 0));
  }
  return track;
}

// The curtain's joints, row by row from the top, and its vertices, `kFine` per joint.
constexpr int kClothColumns = 12, kClothRows = 12, kFine = 2;
constexpr double kClothWidth = 2.2, kClothHeight = 2.2, kClothZ = 0.9;

glm::dvec3 cloth_rest(double column, double row) {
  return {kClothWidth * (column / kClothColumns - 0.5), 2.4 - kClothHeight * row / kClothRows,
          kClothZ + 0.06 * std::sin(column * 2.0) * (0.4 + 0.6 * row / kClothRows)};
}

// Points joined by bars that keep their length, its top row fixed. [Jakobsen 2001]
std::vector<Track> simulate_cloth() {
  constexpr int kStride = kClothColumns + 1, kCount = kStride * (kClothRows + 1);
  const auto at = [](int column, int row) {
    return static_cast<std::size_t>(row * kStride + column);
  };
  std::vector<glm::dvec3> rest, now, before;
  for (int row = 0; row <= kClothRows; ++row) {
    for (int column = 0; column <= kClothColumns; ++column) rest.push_back(cloth_rest(column, row));
  }
  now = before = rest;
  std::vector<Track> tracks(kCount);
  // Axes of the cloth at a point: along a row, down a column, across.
  const auto axes = [&](const std::vector<glm::dvec3>& p, int column, int row) {
    const glm::dvec3 u =
        p[at(std::min(column + 1, kClothColumns), row)] - p[at(std::max(column - 1, 0), row)];
    const glm::dvec3 v =
        p[at(column, std::max(row - 1, 0))] - p[at(column, std::min(row + 1, kClothRows))];
    const glm::dvec3 n = glm::normalize(glm::cross(u, v)), right = glm::normalize(u);
    return glm::dmat3(right, glm::cross(n, right), n);
  };
  const auto pull = [&](std::size_t a, std::size_t b, bool a_fixed, bool b_fixed) {
    const glm::dvec3 d = now[b] - now[a];
    const double length = glm::length(d), wanted = glm::distance(rest[a], rest[b]);
    if (length < 1e-9) return;
    const glm::dvec3 move = d * ((length - wanted) / length);
    if (!a_fixed) now[a] += move * (b_fixed ? 1.0 : 0.5);
    if (!b_fixed) now[b] -= move * (a_fixed ? 1.0 : 0.5);
  };
  for (int frame = 0; frame <= kFrames; ++frame) {
    for (int row = 0; row <= kClothRows; ++row) {
      for (int column = 0; column <= kClothColumns; ++column) {
        const std::size_t i = at(column, row);
        tracks[i].at.push_back(now[i]);
        tracks[i].turned.push_back(
            glm::quat_cast(axes(now, column, row) * glm::transpose(axes(rest, column, row))));
      }
    }
    if (frame < kBurstFrame) continue;
    for (int step = 0; step < kStepsPerFrame; ++step) {
      const double seconds = (frame - kBurstFrame + step / double{kStepsPerFrame}) / 30.0;
      for (std::size_t i = kStride; i < kCount; ++i) {
        const glm::dvec3 away = now[i] - kBlast;
        const double push = seconds < 0.25 ? 90.0 / (0.5 + glm::dot(away, away)) : 0.0;
        const glm::dvec3 force = push * glm::normalize(away) - glm::dvec3(0, kGravity, 0);
        const glm::dvec3 next = now[i] + 0.995 * (now[i] - before[i]) + force * (kStep * kStep);
        before[i] = now[i];
        now[i] = next;
      }
      for (int pass = 0; pass < 12; ++pass) {
        for (int row = 0; row <= kClothRows; ++row) {
          for (int column = 0; column <= kClothColumns; ++column) {
            if (column < kClothColumns && row > 0) {
              pull(at(column, row), at(column + 1, row), false, false);
            }
            if (row < kClothRows) pull(at(column, row), at(column, row + 1), row == 0, false);
            if (column < kClothColumns && row < kClothRows) {
              pull(at(column, row), at(column + 1, row + 1), row == 0, false);
            }
          }
        }
      }
    }
  }
  return tracks;
}

// Collects the joints of a skin with their tracks.
struct SkinMaker {
  Scene& scene;
  Skin skin{};
  std::uint16_t add(const glm::dvec3& bind, const Track& track) {
    Node node;
    node.name = skin.name + " " + std::to_string(skin.joints.size());
    const auto id = static_cast<std::uint32_t>(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
    Channel place{.node = id, .path = ChannelPath::kTranslation, .times = {}, .values = {}};
    Channel turn{.node = id, .path = ChannelPath::kRotation, .times = {}, .values = {}};
    for (std::size_t frame = 0; frame < track.at.size(); ++frame) {
      // One key stands for all frames before the burst.
      if (frame > 0 && frame < kBurstFrame) continue;
      const auto seconds = static_cast<float>(frame * kDestructionSeconds / kFrames);
      const glm::dquat& q = track.turned[frame];
      place.times.push_back(seconds);
      place.values.push_back(glm::vec4(glm::dvec4(track.at[frame], 0.0)));
      turn.times.push_back(seconds);
      turn.values.push_back(glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w)));
    }
    scene.animations.back().channels.push_back(std::move(place));
    scene.animations.back().channels.push_back(std::move(turn));
    skin.joints.push_back(id);
    skin.inverse_binds.push_back(translate(-bind));
    return static_cast<std::uint16_t>(skin.joints.size() - 1);
  }
};

SkinVertex bound_to(std::uint16_t a, std::uint16_t b, double share_of_b) {
  return {glm::u16vec4(a, b, 0, 0),
          glm::vec4(1.0f - static_cast<float>(share_of_b), static_cast<float>(share_of_b), 0, 0)};
}

Mesh wall_mesh(SkinMaker& maker, std::uint32_t material, std::uint32_t seed) {
  Mesh mesh;
  mesh.name = "wall";
  Shape all;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const auto id = static_cast<std::uint32_t>(row * kColumns + column);
      glm::dvec3 middle;
      const Shape part = piece(seed, column, row, middle);
      const Track track = fly(seed, 1000 + id, middle);
      const std::uint16_t joint = maker.add(middle, track);
      const bool soft = id % 10 == 7;
      const std::uint16_t upper = soft ? maker.add(middle, swing(track, seed, id)) : joint;
      for (const Vertex& vertex : part.vertices) {
        mesh.skin.push_back(bound_to(joint, upper, soft && vertex.position.y > 0 ? 1.0 : 0.0));
      }
      append(all, part, translate(middle));
    }
  }
  add_shape(mesh, std::move(all), material);
  return mesh;
}

Mesh cloth_mesh(SkinMaker& maker, std::uint32_t material) {
  const std::vector<Track> tracks = simulate_cloth();
  for (const Track& track : tracks) maker.add(track.at.front(), track);
  Mesh mesh;
  mesh.name = "curtain";
  // Over the unit square, with row 0 at its top.
  Shape shape = patch({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kFine * kClothColumns, kFine * kClothRows);
  for (Vertex& vertex : shape.vertices) {
    const double column = kClothColumns * static_cast<double>(vertex.position.x);
    const double row = kClothRows * (1.0 - static_cast<double>(vertex.position.y));
    const int c = std::min(static_cast<int>(column), kClothColumns - 1);
    const int r = std::min(static_cast<int>(row), kClothRows - 1);
    const double u = column - c, v = row - r;
    const auto joint = [&](int dc, int dr) {
      return static_cast<std::uint16_t>((r + dr) * (kClothColumns + 1) + c + dc);
    };
    mesh.skin.push_back(
        {glm::u16vec4(joint(0, 0), joint(1, 0), joint(0, 1), joint(1, 1)),
         glm::vec4(glm::dvec4((1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v))});
    vertex.position = glm::vec3(cloth_rest(column, row));
    const double step = 0.01;
    const glm::dvec3 across = cloth_rest(column + step, row) - cloth_rest(column - step, row);
    const glm::dvec3 up = cloth_rest(column, row - step) - cloth_rest(column, row + step);
    vertex.normal = glm::vec3(glm::normalize(glm::cross(across, up)));
  }
  add_shape(mesh, std::move(shape), material);
  return mesh;
}

}  // namespace

Scene make_destruction(BuildClass build_class, std::uint32_t seed) {
  Scene scene =
      start_scene(build_class == BuildClass::kEveryFrame ? "destruction" : "destruction-updated");
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.exposure = 0.5f;
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(0.55f, 0.75f, 0.6f));
  const std::uint32_t ground = add_paint(scene, "ground", {0.5f, 0.48f, 0.45f});
  const std::uint32_t brick = add_paint(scene, "brick", {0.55f, 0.28f, 0.2f});
  const std::uint32_t cloth = add_paint(scene, "cloth", {0.25f, 0.33f, 0.5f});
  scene.materials[cloth].constants.flags = kMaterialDoubleSided;
  add_floor(scene, "floor", {-15, -15}, {15, 15}, 0.0, ground);
  scene.animations.push_back({.name = "burst", .channels = {}, .duration = kDestructionSeconds});
  for (const bool is_wall : {true, false}) {
    SkinMaker maker{scene};
    maker.skin.name = is_wall ? "wall" : "curtain";
    scene.meshes.push_back(is_wall ? wall_mesh(maker, brick, seed) : cloth_mesh(maker, cloth));
    Instance& instance =
        add_instance(scene, maker.skin.name, static_cast<std::uint32_t>(scene.meshes.size() - 1));
    instance.motion = {.skin = static_cast<std::int32_t>(scene.skins.size()), .animation = 0};
    instance.build_class = build_class;
    scene.skins.push_back(std::move(maker.skin));
  }
  add_view(scene, "side", {3.6, 2.0, 5.0}, {-0.1, 0.9, 0.5}, 0.8);
  return scene;
}

}  // namespace kaamos::effects
