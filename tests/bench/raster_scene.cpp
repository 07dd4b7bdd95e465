// SPDX-License-Identifier: MIT
#include "raster_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>
#include <string>

namespace kaamos::bench {
namespace {

constexpr float kSide = 10;  // of the height field, from its middle
constexpr uint32_t kSpheres = 50;
constexpr float kHalfTurn = 3.14159265f;

float height_at(float x, float z) {
  return 0.6f * std::sin(0.9f * x) * std::cos(0.7f * z) + 0.15f * std::sin(3.1f * x + 2.3f * z);
}

void add_quad(std::vector<uint32_t>& indices, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  indices.insert(indices.end(), {a, c, b, b, c, d});
}

void add_height_field(RasterScene& scene, uint32_t cells) {
  for (uint32_t row = 0; row <= cells; ++row) {
    for (uint32_t column = 0; column <= cells; ++column) {
      const auto at = [cells](uint32_t i) {
        return kSide * (2 * static_cast<float>(i) / static_cast<float>(cells) - 1);
      };
      const float x = at(column);
      const float z = at(row);
      scene.positions.insert(scene.positions.end(), {x, height_at(x, z), z});
    }
  }
  for (uint32_t row = 0; row < cells; ++row) {
    for (uint32_t column = 0; column < cells; ++column) {
      const uint32_t a = row * (cells + 1) + column;
      add_quad(scene.indices, a, a + 1, a + cells + 1, a + cells + 2);
    }
  }
}

// The first and last ring are points, and have a triangle where others have two.
void add_sphere(RasterScene& scene, uint32_t number, uint32_t segments, uint32_t rings) {
  const auto i = static_cast<float>(number);
  const float radius = 0.35f + 0.25f * std::sin(1.7f * i);
  const float distance = 9.0f * std::sqrt((i + 0.5f) / kSpheres);
  const float turn = 2.39996323f * i;
  const glm::vec3 middle(distance * std::cos(turn), 1.6f + 0.4f * std::cos(2.3f * i),
                         distance * std::sin(turn));
  const auto first = static_cast<uint32_t>(scene.positions.size() / 3);
  for (uint32_t ring = 0; ring <= rings; ++ring) {
    for (uint32_t segment = 0; segment <= segments; ++segment) {
      const float down = kHalfTurn * static_cast<float>(ring) / static_cast<float>(rings);
      const float around =
          2 * kHalfTurn * static_cast<float>(segment) / static_cast<float>(segments);
      const glm::vec3 out(std::sin(down) * std::cos(around), std::cos(down),
                          std::sin(down) * std::sin(around));
      const glm::vec3 at = middle + radius * out;
      scene.positions.insert(scene.positions.end(), {at.x, at.y, at.z});
    }
  }
  for (uint32_t ring = 0; ring < rings; ++ring) {
    for (uint32_t segment = 0; segment < segments; ++segment) {
      const uint32_t a = first + ring * (segments + 1) + segment;
      const uint32_t c = a + segments + 1;
      if (ring != 0) scene.indices.insert(scene.indices.end(), {a, c, a + 1});
      if (ring != rings - 1) scene.indices.insert(scene.indices.end(), {a + 1, c, c + 1});
    }
  }
}

// Rows of `matrix`.
template <size_t kRows>
void set_rows(float (&out)[kRows][4], const glm::mat4& matrix, const int (&rows)[kRows]) {
  for (size_t r = 0; r < kRows; ++r) {
    for (int c = 0; c < 4; ++c) out[r][c] = matrix[c][rows[r]];
  }
}

glm::mat4 light() {
  const glm::mat4 view = glm::lookAt(glm::vec3(6, 15, 4), glm::vec3(0), glm::vec3(0, 0, 1));
  return glm::orthoRH_ZO(-12.0f, 12.0f, -12.0f, 12.0f, 1.0f, 40.0f) * view;
}

// Depth is 1 at the near plane and 0 at infinity.
glm::mat4 perspective(float vertical_fov, float width, float height) {
  const float scale = 1 / std::tan(0.5f * vertical_fov);
  glm::mat4 projection(0);
  projection[0][0] = scale * height / width;
  projection[1][1] = scale;
  projection[2][3] = -1;
  projection[3][2] = kRasterNear;
  return projection;
}

glm::mat4 camera(float width, float height, float moved) {
  return perspective(glm::radians(50.0f), width, height) *
         glm::lookAt(glm::vec3(0.3f + moved, 8, 11), glm::vec3(0, 0, 1.2f), glm::vec3(0, 1, 0));
}

float half_to_float(uint16_t half) {
  const int exponent = half >> 10 & 0x1F;
  const int fraction = half & 0x3FF;
  const float magnitude = exponent == 0
                              ? std::ldexp(static_cast<float>(fraction), -24)
                              : std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

template <class T>
T read(const std::vector<std::byte>& texels, size_t number) {
  T value;
  std::memcpy(&value, texels.data() + number * sizeof(T), sizeof(T));
  return value;
}

// Tells whether all colours of the pixel are the same but for rounding.
bool same_colors(const RasterPictures& a, const RasterPictures& b, size_t pixel) {
  for (const uint32_t target : {0u, 2u}) {
    for (size_t i = 4 * pixel; i < 4 * pixel + 4; ++i) {
      const int difference =
          read<uint8_t>(a.colors[target], i) - read<uint8_t>(b.colors[target], i);
      if (std::abs(difference) > 2) return false;
    }
  }
  const auto same_halves = [&](uint32_t target, size_t count) {
    for (size_t i = count * pixel; i < count * pixel + count; ++i) {
      const float x = half_to_float(read<uint16_t>(a.colors[target], i));
      const float y = half_to_float(read<uint16_t>(b.colors[target], i));
      if (!(std::fabs(x - y) <= 0.01f * std::max(1.0f, std::fabs(y)))) return false;
    }
    return true;
  };
  return same_halves(1, 4) && same_halves(3, 2);
}

void check_few(const char* what, size_t different, size_t pixels, size_t one_in) {
  const size_t allowed = std::max<size_t>(pixels / one_in, 2);
  if (different <= allowed) return;
  throw std::runtime_error(std::string(what) + " differs from the baseline's in " +
                           std::to_string(different) + " of " + std::to_string(pixels) +
                           " pixels, allowed are " + std::to_string(allowed));
}

}  // namespace

RasterScene make_raster_scene(RasterPass pass, uint32_t width, uint32_t height, double detail) {
  RasterScene scene;
  scene.pass = pass;
  scene.width = width;
  scene.height = height;
  // Twice the triangles on sqrt(2) times the edges.
  const auto scaled = [detail](double edges) {
    return static_cast<uint32_t>(std::max(4.0, std::round(edges * std::sqrt(detail))));
  };
  add_height_field(scene, scaled(320));
  for (uint32_t i = 0; i < kSpheres; ++i) add_sphere(scene, i, scaled(44), scaled(22) + 1);
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  const bool shadow = pass == RasterPass::kShadow;
  const glm::mat4 clip = shadow ? light() : camera(w, h, 0);
  set_rows(scene.constants.clip, clip, {0, 1, 2, 3});
  set_rows(scene.constants.before, shadow ? clip : camera(w, h, 0.05f), {0, 1, 3});
  return scene;
}

RasterScene make_raster_scene(const SceneData& data, uint32_t width, uint32_t height) {
  RasterScene scene;
  scene.pass = RasterPass::kIds;
  scene.width = width;
  scene.height = height;
  for (const InstanceData& instance : data.instances) {
    const MeshData& mesh = data.meshes[instance.mesh];
    const auto first = static_cast<uint32_t>(scene.positions.size() / 3);
    for (const effects::Vertex& vertex : *mesh.vertices) {
      for (size_t row = 0; row < 3; ++row) {
        const float* t = instance.transform.data() + 4 * row;
        scene.positions.push_back(t[0] * vertex.position.x + t[1] * vertex.position.y +
                                  t[2] * vertex.position.z + t[3]);
      }
    }
    for (const GeometryData& geometry : mesh.geometries) {
      for (uint32_t i = 0; i < 3 * geometry.triangle_count; ++i) {
        scene.indices.push_back(first + geometry.first_vertex +
                                mesh.indices[geometry.first_index + i]);
      }
    }
  }
  const effects::Camera& from = data.scene.cameras.front();
  const glm::mat4 clip = perspective(static_cast<float>(from.vertical_fov),
                                     static_cast<float>(width), static_cast<float>(height)) *
                         glm::mat4(glm::inverse(glm::dmat4(from.camera_to_world)));
  set_rows(scene.constants.clip, clip, {0, 1, 2, 3});
  return scene;
}

void check_same_pictures(const RasterScene& scene, const RasterPictures& ours,
                         const RasterPictures& baseline) {
  const size_t pixels = size_t{scene.width} * scene.height;
  size_t covered = 0, coverage = 0, ids = 0, depths = 0, colors = 0;
  for (size_t i = 0; i < pixels; ++i) {
    const bool a = ours.depth[i] != scene.cleared_depth();
    const bool b = baseline.depth[i] != scene.cleared_depth();
    covered += a;
    coverage += a != b;
    if (!a || !b) continue;
    if (!ours.colors.empty()) {
      const bool same_id =
          read<uint32_t>(ours.colors[4], i) == read<uint32_t>(baseline.colors[4], i);
      ids += !same_id;
      if (same_id) colors += !same_colors(ours, baseline, i);
    }
    depths += !(std::fabs(ours.depth[i] - baseline.depth[i]) <= 1e-4f);
  }
  if (covered < pixels / 4) throw std::runtime_error("the scene covers next to nothing");
  check_few("coverage", coverage, pixels, 100'000);
  check_few("the triangle", ids, pixels, 10'000);
  check_few("depth", depths, pixels, 1000);
  check_few("colour", colors, pixels, 1000);
}

}  // namespace kaamos::bench
