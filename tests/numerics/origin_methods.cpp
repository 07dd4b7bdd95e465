// SPDX-License-Identifier: MIT
#include "origin_methods.h"

#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "effects/assets/common/ray_origin.h"

namespace kaamos::test {

using effects::make_spawn_point;
using effects::SpawnPoint;

namespace {

constexpr double kSheet = 0.02;  // height of the sheet over a triangle, relative to the scale

// A triangle (0) and a much larger one (1) above its front side, both in object space.
struct Pair {
  ProbeMesh mesh;
  glm::mat3x4 to_object{0.0f};
  double sheet = 0;  // metres to the sheet, in the world
};

glm::mat3x4 rows_of(const glm::dmat4& m) {
  glm::mat3x4 rows(0.0f);
  for (int r = 0; r < 3; ++r) {
    rows[r] = glm::vec4(glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]));
  }
  return rows;
}

// The matrix as the rounded rows define it, so that the inverse belongs to those rows, as in a
// runtime.
glm::dmat4 matrix_of(const glm::mat3x4& rows) {
  glm::dmat4 m(1.0);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) m[c][r] = static_cast<double>(rows[r][c]);
  }
  return m;
}

Pair make_pair(const OriginPlace& place, std::mt19937& random) {
  std::uniform_real_distribution<double> even(-1, 1);
  const auto vector = [&] { return glm::dvec3(even(random), even(random), even(random)); };
  Pair out;
  for (int i = 0; i < 3; ++i) out.mesh.positions.push_back(glm::vec3(vector()));
  const glm::dvec3 a(out.mesh.positions[0]), b(out.mesh.positions[1]), c(out.mesh.positions[2]);
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const glm::dvec3 middle = (a + b + c) / 3.0;
  // With sides of equal length, however thin the triangle is.
  const glm::dvec3 x = 40.0 * glm::normalize(b - a), y = glm::cross(normal, x);
  for (const glm::dvec3& p : {2.0 * x, 2.0 * y - x, -2.0 * y - x}) {
    out.mesh.positions.push_back(glm::vec3(middle + p + kSheet * normal));
  }
  out.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const glm::dmat4 turn =
      glm::rotate(glm::dmat4(1.0), 3.14 * even(random), glm::normalize(vector()));
  const glm::dmat4 move =
      glm::translate(glm::dmat4(1.0), glm::normalize(vector()) * place.distance);
  const glm::dvec3 scale(place.scale, place.scale * place.stretch, place.scale);
  out.mesh.transform = rows_of(move * turn * glm::scale(glm::dmat4(1.0), scale));
  out.to_object = rows_of(glm::inverse(matrix_of(out.mesh.transform)));
  out.sheet = kSheet * place.scale;
  return out;
}

glm::vec3 integer_offset(const glm::vec3& p, const glm::vec3& n) {
  glm::vec3 out;
  for (int i = 0; i < 3; ++i) {
    const auto steps = static_cast<std::int32_t>(256.0f * n[i]);
    const auto bits = std::bit_cast<std::int32_t>(p[i]);
    out[i] = std::abs(p[i]) < 1.0f / 32 ? p[i] + n[i] / 65536
                                        : std::bit_cast<float>(bits + (p[i] < 0 ? -steps : steps));
  }
  return out;
}

ProbeRay start(OriginMethod method, const SpawnPoint& point, const glm::vec3& direction) {
  ProbeRay ray;
  ray.origin = point.position;
  ray.direction = direction;
  ray.t_max = std::numeric_limits<float>::infinity();
  if (method == kFixedTMin) ray.t_min = 1e-3f;
  if (method == kFixedOffset) ray.origin += 1e-3f * point.normal;
  if (method == kIntegerOffset) ray.origin = integer_offset(point.position, point.normal);
  if (method == kErrorBound) ray.origin = effects::spawn_origin(point, direction);
  return ray;
}

}  // namespace

std::array<OriginRates, kOriginMethodCount> measure_origins(RayProbe& probe,
                                                            const OriginPlace& place,
                                                            std::uint32_t triangles,
                                                            std::uint32_t rays) {
  std::array<OriginRates, kOriginMethodCount> out{};
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  const double each = 1.0 / (static_cast<double>(triangles) * rays);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Pair pair = make_pair(place, random);
    probe.set_mesh(pair.mesh);
    std::vector<ProbeRay> shot;
    std::vector<double> expected;  // t at the sheet
    for (std::uint32_t k = 0; k < rays; ++k) {
      glm::vec2 bary(unit(random), unit(random));
      if (bary.x + bary.y > 1) bary = 1.0f - bary;
      const auto& p = pair.mesh.positions;
      const SpawnPoint point =
          make_spawn_point(p[0], p[1], p[2], bary, pair.mesh.transform, pair.to_object);
      glm::vec3 direction;
      do {
        direction = 2.0f * glm::vec3(unit(random), unit(random), unit(random)) - 1.0f;
      } while (!(glm::dot(direction, direction) > 0.01f));
      direction = glm::normalize(direction);
      if (glm::dot(direction, point.normal) < 0) direction = -direction;
      for (std::uint32_t m = 0; m < kOriginMethodCount; ++m) {
        shot.push_back(start(static_cast<OriginMethod>(m), point, direction));
        const glm::dvec3 moved(shot.back().origin - point.position);
        out[m].offset += each * (glm::length(moved) + static_cast<double>(shot.back().t_min));
      }
      expected.push_back(pair.sheet / static_cast<double>(glm::dot(direction, point.normal)));
    }
    const std::vector<ProbeHit> hits = probe.hits(shot);
    for (std::size_t h = 0; h < hits.size(); ++h) {
      OriginRates& rates = out[h % kOriginMethodCount];
      const bool hit = hits[h].t >= 0;
      if (hit && hits[h].primitive == 0) rates.self_hits += each;
      // A ray along the surface does not reach the sheet.
      if (!hit && expected[h / kOriginMethodCount] < 5 * place.scale) rates.leaks += each;
    }
  }
  return out;
}

}  // namespace kaamos::test
