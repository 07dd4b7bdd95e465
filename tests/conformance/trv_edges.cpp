// SPDX-License-Identifier: MIT
//
// Shared edges and vertices: rays that meet them hit one triangle of a surface, and never slip
// through.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/conformance/walker.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kOnce = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;

using Point = std::array<float, 3>;
using Triangle = std::array<Point, 3>;

// A closed surface around the origin, star-shaped as seen from near it: a ray from there leaves it
// through one point. Its poles and equator lie on the axes, so many edges are parallel to an axis.
std::vector<Triangle> lumpy_sphere(Random& random, uint32_t rings, uint32_t segments) {
  std::vector<std::vector<Point>> grid(rings + 1);
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t k = 0; k < segments; ++k) {
      const float polar = 3.14159265f * static_cast<float>(i) / static_cast<float>(rings);
      const float around = 6.28318531f * static_cast<float>(k) / static_cast<float>(segments);
      const float radius = random.between(0.9f, 1.1f);
      grid[i].push_back({radius * std::sin(polar) * std::cos(around),
                         radius * std::sin(polar) * std::sin(around), radius * std::cos(polar)});
      if (i == 0 || i == rings) grid[i][k] = grid[i][0];
    }
  }
  std::vector<Triangle> out;
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t k = 0; k < segments; ++k) {
      const uint32_t next = (k + 1) % segments;
      const Point a = grid[i][k], b = grid[i][next], c = grid[i + 1][k], d = grid[i + 1][next];
      if (i + 1 < rings) out.push_back({a, c, d});
      if (i > 0) out.push_back({a, d, b});
    }
  }
  return out;
}

std::vector<Triangle> cube(float size) {
  std::vector<Triangle> out;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-size, size}) {
      const auto corner = [&](float u, float v) {
        Point p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return p;
      };
      out.push_back({corner(-size, -size), corner(size, -size), corner(size, size)});
      out.push_back({corner(-size, -size), corner(size, size), corner(-size, size)});
    }
  }
  return out;
}

// One geometry with all triangles, or several that share them out.
std::vector<Geometry> geometries_of(const std::vector<Triangle>& triangles, size_t count = 1) {
  std::vector<Geometry> out(count);
  for (Geometry& each : out) each.flags = kOnce;
  for (size_t i = 0; i < triangles.size(); ++i) {
    for (const Point& corner : triangles[i]) {
      auto& vertices = out[i % count].vertices;
      vertices.insert(vertices.end(), corner.begin(), corner.end());
    }
  }
  return out;
}

enum class Aim { kEdges, kVertices };

// From a point within `spread` of the origin, through an edge or a vertex of a triangle.
Ray aimed(Random& random, const std::vector<Triangle>& triangles, Aim aim, float spread) {
  const Triangle& triangle = triangles[random.below(static_cast<uint32_t>(triangles.size()))];
  const uint32_t corner = random.below(3);
  const Point& a = triangle[corner];
  const Point& b = triangle[(corner + 1) % 3];
  // Half of the edges are hit at simple fractions, which floats often meet exactly.
  const float along = aim == Aim::kVertices ? 0
                      : random.chance(0.5)  ? 0.25f * static_cast<float>(1 + random.below(3))
                                            : random.between(0, 1);
  const bool from_centre = random.chance(0.3);
  Ray ray;
  for (size_t i = 0; i < 3; ++i) {
    ray.origin[i] = from_centre ? 0 : random.between(-spread, spread);
    ray.direction[i] = a[i] + along * (b[i] - a[i]) - ray.origin[i];
  }
  ray.t_max = 1e30f;
  return ray;
}

struct Wrong {
  uint32_t none = 0, several = 0, rays = 0;
};

Wrong count_wrong(Walker& walker, const std::vector<Ray>& rays) {
  Wrong out;
  for (const uint32_t each : walker.count(rays)) {
    out.none += each == 0 ? 1 : 0;
    out.several += each > 1 ? 1 : 0;
    ++out.rays;
  }
  return out;
}

void expect_none_wrong(Context& t, const std::string& what, const Wrong& wrong) {
  if (wrong.none + wrong.several == 0) return;
  t.fail(what + ": " + std::to_string(wrong.none) + " of " + std::to_string(wrong.rays) +
         " rays hit nothing, " + std::to_string(wrong.several) + " hit several triangles");
}

// Moves the surface's origin, and the rays with it.
RaytracingInstanceDesc moved(const Buffer& bottom_level, const std::vector<float>& transform) {
  RaytracingInstanceDesc out = instance(bottom_level);
  if (!transform.empty()) std::copy(transform.begin(), transform.end(), &out.Transform[0][0]);
  return out;
}

Ray moved(const Ray& ray, const std::vector<float>& m) {
  if (m.empty()) return ray;
  Ray out = ray;
  for (size_t row = 0; row < 3; ++row) {
    out.origin[row] = m[4 * row + 3];
    out.direction[row] = 0;
    for (size_t i = 0; i < 3; ++i) {
      out.origin[row] += m[4 * row + i] * ray.origin[i];
      out.direction[row] += m[4 * row + i] * ray.direction[i];
    }
  }
  return out;
}

void one_triangle_of_a_manifold(Context& t) {
  Walker walker(t);
  walker.record("Ignored");
  Random random(11);
  const auto sphere = lumpy_sphere(random, 12, 16);
  const std::vector<float> transforms[] = {{},
                                           {-0.6f, 0.8f, 0, 5, 0.8f, 0.6f, 0, -3, 0, 0, 1.5f, 2}};
  Wrong edges, vertices;
  for (const auto& transform : transforms) {
    for (const size_t parts : {1, 3}) {
      const Buffer bottom = t.bottom_level(geometries_of(sphere, parts));
      walker.scene = t.top_level({moved(bottom, transform)});
      for (const Aim aim : {Aim::kEdges, Aim::kVertices}) {
        std::vector<Ray> rays;
        for (int i = 0; i < 2500; ++i) {
          rays.push_back(moved(aimed(random, sphere, aim, 0.3f), transform));
        }
        const Wrong wrong = count_wrong(walker, rays);
        Wrong& sum = aim == Aim::kEdges ? edges : vertices;
        sum.none += wrong.none;
        sum.several += wrong.several;
        sum.rays += wrong.rays;
      }
    }
  }
  expect_none_wrong(t, "aimed at edges", edges);
  expect_none_wrong(t, "aimed at vertices", vertices);
}

// Rays from outside, some past the silhouette: they cross a closed surface an even number of times.
void parity_from_outside(Context& t) {
  Walker walker(t);
  walker.record("Ignored");
  Random random(12);
  const auto sphere = lumpy_sphere(random, 12, 16);
  walker.scene = t.scene(geometries_of(sphere));
  std::vector<Ray> rays;
  for (int i = 0; i < 4000; ++i) {
    rays.push_back(aimed(random, sphere, i % 2 == 0 ? Aim::kEdges : Aim::kVertices, 0));
    for (size_t k = 0; k < 3; ++k) {
      const float target = rays.back().origin[k] + rays.back().direction[k];
      rays.back().origin[k] = random.between(-1, 1) + (k == 0 ? 4.0f : 0.0f);
      rays.back().direction[k] = target - rays.back().origin[k];
    }
  }
  uint32_t odd = 0, hit = 0;
  for (const uint32_t each : walker.count(rays)) {
    odd += each % 2;
    hit += each > 0 ? 1 : 0;
  }
  t.equal("rays of 4000 that cross the surface an odd number of times", odd, 0u);
  t.holds("most rays cross it", hit > 3000);
}

void manifolds(Context& t) {
  one_triangle_of_a_manifold(t);
  parity_from_outside(t);
}

// A fan of triangles around the edge from (0, -1, 0) to (0, 1, 0), one for each corner.
std::vector<Geometry> fan(const std::vector<Point>& corners) {
  std::vector<Triangle> out;
  for (const Point& each : corners) out.push_back({Point{0, -1, 0}, Point{0, 1, 0}, each});
  return geometries_of(out);
}

struct FanCase {
  const char* what;
  std::vector<Geometry> geometries;
  std::vector<uint32_t> allowed;
};

void non_manifold_edges_and_vertices(Context& t) {
  // Two open cones with a common apex at the origin and their rims behind it.
  std::vector<Triangle> cones;
  for (const float depth : {1.0f, 2.0f}) {
    for (int i = 0; i < 6; ++i) {
      const auto rim = [&](int k) {
        const float around = 1.04719755f * static_cast<float>(k % 6) + 0.3f;
        return Point{std::cos(around), std::sin(around), depth};
      };
      cones.push_back({Point{0, 0, 0}, rim(i), rim(i + 1)});
    }
  }
  const FanCase cases[] = {
      {"one side 1, other 2", fan({{-1, 0.1f, 0}, {1, 0.2f, 0.5f}, {1, -0.3f, -0.5f}}), {1, 2}},
      {"one side 2, other 2",
       fan({{-1, 0, 0.3f}, {-1, 0.5f, -1}, {1, 0.2f, 0.5f}, {1, -0.3f, -0.5f}}),
       {2}},
      {"one side 0, other 3", fan({{1, 0, 0}, {1, 0.2f, 0.5f}, {1, -0.3f, -0.5f}}), {0, 3}},
      {"one side 4, other 4",
       fan({{-1, 0, 0.3f},
            {-1, 0.5f, -0.5f},
            {-1, 0, -0.2f},
            {-1, 0.4f, 0.7f},
            {1, 0.2f, 0.5f},
            {1, -0.3f, -0.5f},
            {1, 0, 0.1f},
            {1, 0.6f, -0.9f}}),
       {4}},
      {"two cones at their apex", geometries_of(cones), {2}}};
  Walker walker(t);
  walker.record("Ignored");
  for (const FanCase& each : cases) {
    const bool at_vertex = std::string(each.what).find("apex") != std::string::npos;
    Random random(13);
    std::vector<Ray> rays;
    for (int i = 0; i < 300; ++i) {
      // Close enough to the z axis that the ray sees the same sides.
      Ray ray = ray_at(random.between(-0.4f, 0.4f), random.between(-0.3f, 0.3f));
      ray.origin[2] = -3;
      const float y = at_vertex ? 0 : 0.125f * static_cast<float>(random.below(13)) - 0.75f;
      ray.direction[0] = -ray.origin[0];
      ray.direction[1] = y - ray.origin[1];
      ray.direction[2] = 3;
      rays.push_back(ray);
    }
    walker.scene = t.scene(each.geometries);
    uint32_t wrong = 0, last = 0;
    for (const uint32_t count : walker.count(rays)) {
      if (std::find(each.allowed.begin(), each.allowed.end(), count) != each.allowed.end())
        continue;
      ++wrong;
      last = count;
    }
    if (wrong > 0) {
      t.fail(std::string(each.what) + ": " + std::to_string(wrong) +
             " of 300 rays hit a wrong number of triangles, one " + std::to_string(last));
    }
  }
}

// Counts rays from inside that escape; there must be none. The size is 2^exponent.
uint32_t escapes(Context& t, Walker& walker, Random& random, int exponent) {
  const float scale = std::ldexp(1.0f, exponent);
  auto triangles = lumpy_sphere(random, 8, 10);
  for (const Triangle& each : cube(1)) triangles.push_back(each);
  for (Triangle& each : triangles) {
    for (Point& corner : each) {
      for (float& value : corner) value *= scale;
    }
  }
  walker.scene = t.scene(geometries_of(triangles, 2));
  std::vector<Ray> rays;
  for (int i = 0; i < 600; ++i) {
    rays.push_back(
        aimed(random, triangles, i % 2 == 0 ? Aim::kEdges : Aim::kVertices, 0.3f * scale));
    // Also with t of about `scale` instead of 1.
    if (i % 3 == 0) {
      for (float& each : rays.back().direction) each /= scale;
    }
    rays.back().t_max = std::numeric_limits<float>::infinity();
  }
  uint32_t out = 0;
  // The sphere and the cube are two surfaces, and the ray must hit both.
  for (const uint32_t each : walker.count(rays)) out += each < 2 ? 1 : 0;
  return out;
}

void no_gaps_at_any_scale(Context& t) {
  Walker walker(t);
  walker.record("Ignored");
  Random random(14);
  for (int exponent = -30; exponent <= 30; exponent += 6) {
    const uint32_t gaps = escapes(t, walker, random, exponent);
    if (gaps > 0) {
      t.fail("scale 2^" + std::to_string(exponent) + ": " + std::to_string(gaps) +
             " of 600 rays escape");
    }
  }
}

void coincident_triangles(Context& t) {
  Standard program(t);
  program.record("Counted");
  std::vector<Ray> rays;
  std::vector<RaytracingInstanceDesc> instances;
  Random random(15);
  // At x = 20 i: the same tilted triangle three times, in one geometry, in three, and in instances.
  for (uint32_t i = 0; i < 60; ++i) {
    Geometry one = triangle(random.between(2, 50), 0, kOnce);
    for (float& each : one.vertices) each += random.between(-0.4f, 0.4f);
    const float x = 20 * static_cast<float>(i);
    if (i % 3 == 0) {
      Geometry three = one;
      for (int k = 0; k < 2; ++k) {
        three.vertices.insert(three.vertices.end(), one.vertices.begin(), one.vertices.end());
      }
      instances.push_back(instance(t.bottom_level({three}), x));
    } else if (i % 3 == 1) {
      instances.push_back(instance(t.bottom_level({one, one, one}), x));
    } else {
      const Buffer bottom = t.bottom_level({one});
      for (int k = 0; k < 3; ++k) instances.push_back(instance(bottom, x));
    }
    for (int k = 0; k < 5; ++k) {
      rays.push_back(ray_at(x + random.between(-0.5f, 0.5f), random.between(-0.5f, 0.5f)));
    }
  }
  program.scene = t.top_level(instances);
  uint32_t wrong = 0;
  const auto seen = program.trace(rays);
  for (const Seen& each : seen) {
    t.equal("end", each.end, kClosestHitRan);
    wrong += each.any_hits == 1 && each.any_t == each.t ? 0 : 1;
  }
  t.equal("rays of 300 with more than one any-hit shader at equal t", wrong, 0u);
}

}  // namespace

std::vector<RuleTest> trv_edge_tests() {
  return {{"TRV-06", coincident_triangles},
          {"TRV-70", manifolds},
          {"TRV-71", non_manifold_edges_and_vertices},
          {"TRV-72", no_gaps_at_any_scale}};
}

}  // namespace kaamos::conformance
