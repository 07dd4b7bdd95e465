// SPDX-License-Identifier: MIT
//
// Tests how exact a hit is, for objects from a nanometre to a billion kilometres in size and up to
// 1,000 km from the origin. A jittered relief of 2 x 32 x 32 triangles is seen from above. Each ray
// goes to a known point inside a known triangle; the truth is the same intersection computed in
// long double from the same float vertices and float ray. The bounds are measured values with a
// margin of two to four: they record what float costs here instead of hiding it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "ray_probe.h"
#include "size.h"

namespace kaamos::test {
namespace {

using Real = long double;
using Vec = glm::vec<3, Real>;

constexpr int kSteps = 32;

// A relief over [-1, 1]^2 with z within 0.01, times `scale`, then moved and rounded to float once.
ProbeMesh relief(double scale, const glm::dvec3& offset) {
  ProbeMesh mesh;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3), height(-0.01, 0.01);
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      const glm::dvec3 p(-1 + 2 * (x + jitter(random)) / kSteps,
                         -1 + 2 * (y + jitter(random)) / kSteps, height(random));
      mesh.positions.push_back(glm::vec3(p * scale + offset));
    }
  }
  for (std::uint32_t y = 0; y < kSteps; ++y) {
    for (std::uint32_t x = 0; x < kSteps; ++x) {
      const std::uint32_t a = y * (kSteps + 1) + x;
      const std::uint32_t c = a + kSteps + 1;
      mesh.triangles.push_back({a, a + 1, c + 1});
      mesh.triangles.push_back({a, c + 1, c});
    }
  }
  return mesh;
}

Vec corner(const ProbeMesh& mesh, std::uint32_t triangle, int i) {
  const Vec p(mesh.positions[mesh.triangles[triangle][static_cast<std::size_t>(i)]]);
  Vec out;
  for (int r = 0; r < 3; ++r) {
    const auto& row = mesh.transform[r];
    out[r] = Real(row.x) * p.x + Real(row.y) * p.y + Real(row.z) * p.z + Real(row.w);
  }
  return out;
}

struct Truth {
  Real t;
  Real u;
  Real v;
};

Truth intersect(const ProbeMesh& mesh, std::uint32_t triangle, const ProbeRay& ray) {
  const Vec v0 = corner(mesh, triangle, 0);
  const Vec e1 = corner(mesh, triangle, 1) - v0;
  const Vec e2 = corner(mesh, triangle, 2) - v0;
  const Vec origin(ray.origin), direction(ray.direction);
  const Vec p = glm::cross(direction, e2);
  const Real determinant = glm::dot(e1, p);
  const Vec s = origin - v0;
  const Vec q = glm::cross(s, e1);
  return {glm::dot(e2, q) / determinant, glm::dot(s, p) / determinant,
          glm::dot(direction, q) / determinant};
}

// A ray from above to a point well inside a triangle, with barycentrics of at least 0.1.
struct Aim {
  ProbeRay ray;
  std::uint32_t triangle;
};

std::vector<Aim> aims(const ProbeMesh& mesh, double scale, double distance, std::uint32_t count) {
  std::vector<Aim> out;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1), slant(-0.5, 0.5);
  while (out.size() < count) {
    Aim aim;
    aim.triangle = static_cast<std::uint32_t>(random() % mesh.triangles.size());
    double u = 0.1 + 0.7 * unit(random), v = 0.1 + 0.7 * unit(random);
    if (u + v > 0.9) continue;
    const glm::dvec3 v0(corner(mesh, aim.triangle, 0));
    const glm::dvec3 target = v0 + (glm::dvec3(corner(mesh, aim.triangle, 1)) - v0) * u +
                              (glm::dvec3(corner(mesh, aim.triangle, 2)) - v0) * v;
    const glm::dvec3 back = glm::normalize(glm::dvec3(slant(random), slant(random), 1));
    aim.ray.origin = glm::vec3(target + back * (distance * scale));
    aim.ray.direction = glm::vec3(glm::normalize(target - glm::dvec3(aim.ray.origin)));
    aim.ray.t_max = std::numeric_limits<float>::infinity();
    out.push_back(aim);
  }
  return out;
}

// One line of a table.
struct Row {
  std::uint32_t rays = 0;
  std::uint32_t lost = 0;   // rays that hit nothing
  std::uint32_t other = 0;  // rays that hit another triangle than the one aimed at
  double t_median = 0;      // median error of the distance, relative to `unit`
  double t_largest = 0;
  double uv_largest = 0;
  std::uint32_t uv_zero = 0;  // both barycentrics exactly 0, which no aimed ray should give
};

// Measures errors of t in units of `unit` (a length). Does not count rays whose float form misses
// the inside of their triangle.
Row measure(const ProbeMesh& mesh, const std::vector<Aim>& aimed, double unit) {
  std::vector<ProbeRay> rays;
  for (const Aim& aim : aimed) rays.push_back(aim.ray);
  const std::vector<ProbeHit> hits = probe(mesh, rays);
  Row row;
  std::vector<double> errors;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Truth truth = intersect(mesh, aimed[i].triangle, rays[i]);
    if (!(truth.u > 0.01L && truth.v > 0.01L && truth.u + truth.v < 0.99L)) continue;
    ++row.rays;
    if (hits[i].t < 0) {
      ++row.lost;
    } else if (hits[i].primitive != aimed[i].triangle) {
      ++row.other;
    } else {
      errors.push_back(static_cast<double>(std::abs(Real(hits[i].t) - truth.t)) / unit);
      const glm::vec2 uv = hits[i].barycentrics;
      if (uv == glm::vec2(0.0f)) {
        ++row.uv_zero;
      } else {
        row.uv_largest =
            std::max({row.uv_largest, static_cast<double>(std::abs(Real(uv.x) - truth.u)),
                      static_cast<double>(std::abs(Real(uv.y) - truth.v))});
      }
    }
  }
  if (!errors.empty()) {
    std::sort(errors.begin(), errors.end());
    row.t_median = errors[errors.size() / 2];
    row.t_largest = errors.back();
  }
  return row;
}

void print_head(const char* value) {
  std::printf("%10s %9s %6s %6s %10s %10s %10s %8s\n", value, "rays", "lost", "other", "t median",
              "t largest", "uv largest", "uv zero");
}

void print(double value, const Row& row) {
  std::printf("%10.0e %9u %6u %6u %10.1e %10.1e %10.1e %8u\n", value, row.rays, row.lost, row.other,
              row.t_median, row.t_largest, row.uv_largest, row.uv_zero);
}

std::uint32_t ray_count() {
  return by_size(2000, 20000, 1000000);
}

// Upper bounds for one row; `lost` and `other` are shares of the rays.
struct Bound {
  double value;
  double t;
  double uv;
  double lost = 0;
  double other = 0;
};

void expect_within(const Row& row, const Bound& bound) {
  print(bound.value, row);
  EXPECT_GE(row.rays, ray_count() * 3 / 4) << bound.value;
  EXPECT_LE(row.lost, bound.lost * row.rays) << bound.value;
  EXPECT_LE(row.other, bound.other * row.rays) << bound.value;
  EXPECT_LE(row.t_largest, bound.t) << bound.value;
  EXPECT_LE(row.uv_largest, bound.uv) << bound.value;
}

TEST(PrecisionSweep, Scale) {
  std::printf("objects of 2 x scale metres, seen from 5 x scale; errors of t relative to t\n");
  print_head("scale");
  for (int exponent = -9; exponent <= 12; exponent += 3) {
    const double scale = std::pow(10.0, exponent);
    const ProbeMesh mesh = relief(scale, glm::dvec3(0));
    const Row row = measure(mesh, aims(mesh, scale, 5, ray_count()), 5 * scale);
    expect_within(row, {scale, 2e-6, 1e-3});
    // Embree gives up on barycentrics where edge times distance falls below 1e-18.
    EXPECT_EQ(row.uv_zero, exponent == -9 ? row.rays : 0u) << scale;
  }
}

TEST(PrecisionSweep, DistanceOfTheCamera) {
  std::printf("an object of 2 metres seen from far; errors of t relative to t\n");
  print_head("distance");
  // From 1e5 on, rounding the direction leads to neighbours, or past the border.
  const Bound bounds[] = {{1e0, 2e-6, 1e-4},        {1e1, 2e-6, 1e-3}, {1e2, 2e-6, 1e-2},
                          {1e3, 2e-6, 1e-1},        {1e4, 2e-6, 0.5},  {1e5, 5e-6, 1, 5e-4, 0.02},
                          {1e6, 2e-6, 1, 0.03, 0.7}};
  const ProbeMesh mesh = relief(1, glm::dvec3(0));
  for (const Bound& bound : bounds) {
    expect_within(measure(mesh, aims(mesh, 1, bound.value, ray_count()), bound.value), bound);
  }
}

TEST(PrecisionSweep, DistanceFromTheOriginInTheVertices) {
  std::printf(
      "an object of 2 metres whose vertices lie far out, seen from 5 metres; errors of t\n"
      "relative to t\n");
  print_head("distance");
  for (const double distance : {0.0, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    const ProbeMesh mesh = relief(1, glm::dvec3(0.6, -0.48, 0.64) * distance);
    expect_within(measure(mesh, aims(mesh, 1, 5, ray_count()), 5), {distance, 2e-6, 1e-3});
  }
}

TEST(PrecisionSweep, DistanceFromTheOriginInTheInstance) {
  std::printf(
      "an object of 2 metres whose instance stands far out, seen from 5 metres; errors of t\n"
      "in steps of a float at the distance\n");
  print_head("distance");
  // The ray is transformed to object space, where its origin is rounded at that distance: 8 mm at
  // 1e5, 60 mm at 1e6, which is the size of a triangle here. Effects avoid this by putting the
  // camera at the origin.
  const Bound bounds[] = {
      {0, 20, 1e-3},   {1e0, 20, 1e-3}, {1e1, 20, 1e-3},          {1e2, 20, 1e-2},
      {1e3, 20, 1e-1}, {1e4, 20, 0.5},  {1e5, 20, 1, 3e-3, 0.15}, {1e6, 20, 1, 0.05, 0.9}};
  for (const Bound& bound : bounds) {
    ProbeMesh mesh = relief(1, glm::dvec3(0));
    // Rotated by an angle that no float represents exactly.
    const float c = std::cos(0.7f), s = std::sin(0.7f);
    const glm::vec3 offset = glm::vec3(0.6f, -0.48f, 0.64f) * static_cast<float>(bound.value);
    mesh.transform = glm::mat3x4({c, -s, 0, offset.x}, {s, c, 0, offset.y}, {0, 0, 1, offset.z});
    const double unit = std::max(bound.value, 5.0) * std::pow(2.0, -24);
    expect_within(measure(mesh, aims(mesh, 1, 5, ray_count()), unit), bound);
  }
}

}  // namespace
}  // namespace kaamos::test
