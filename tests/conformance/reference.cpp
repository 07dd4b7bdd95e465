// SPDX-License-Identifier: MIT
#include "tests/conformance/reference.h"

#include <algorithm>
#include <cmath>

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// Rounding may decide about a candidate that is closer to a decision than this: in barycentrics, in
// t relative to its size, and in the cosine between ray and plane.
constexpr double kEdgeMargin = 2e-4;
constexpr double kIntervalMargin = 1e-4;
constexpr double kGrazing = 0.02;

struct Vec {
  double x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y, s * a.z};
}
double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec vec(const float* from) {
  return {from[0], from[1], from[2]};
}

// Columns and translation of a row-major 3x4 matrix.
struct Affine {
  Vec x, y, z, translation;
};
Affine affine(const float* rows) {
  const auto column = [&](int i) { return Vec{rows[i], rows[4 + i], rows[8 + i]}; };
  return {column(0), column(1), column(2), column(3)};
}
Vec point(const Affine& m, Vec p) {
  return p.x * m.x + p.y * m.y + p.z * m.z + m.translation;
}
// Solves m's linear part * result = v, by Cramer's rule.
Vec solve(const Affine& m, Vec v) {
  const double det = dot(m.x, cross(m.y, m.z));
  return (1 / det) * Vec{dot(v, cross(m.y, m.z)), dot(m.x, cross(v, m.z)), dot(m.x, cross(m.y, v))};
}

struct Line {
  Vec origin, direction;
};

// The flags that apply to one geometry of one instance.
struct Rules {
  bool skipped = false;
  bool opaque = false;
  bool front_counterclockwise = false;
  bool cull_front = false, cull_back = false;
};
Rules rules_of(const Geometry& geometry, uint32_t instance_flags, uint32_t ray_flags) {
  Rules out;
  out.opaque = (static_cast<uint32_t>(geometry.flags) &
                static_cast<uint32_t>(RaytracingGeometryFlags::kOpaque)) != 0;
  // FORCE_NON_OPAQUE and FORCE_OPAQUE must not be combined; our policy lets the latter win.
  if ((instance_flags & 8) != 0) out.opaque = false;
  if ((instance_flags & 4) != 0) out.opaque = true;
  const bool triangles = geometry.boxes.empty();
  out.skipped = (out.opaque && (ray_flags & 0x40) != 0) ||
                (!out.opaque && (ray_flags & 0x80) != 0) ||
                (triangles && (ray_flags & 0x100) != 0) || (!triangles && (ray_flags & 0x200) != 0);
  if ((ray_flags & 0x2) != 0) out.opaque = false;
  if ((ray_flags & 0x1) != 0) out.opaque = true;
  out.front_counterclockwise = (instance_flags & 2) != 0;
  const bool culls = (instance_flags & 1) == 0;
  out.cull_back = culls && (ray_flags & 0x10) != 0;
  out.cull_front = culls && (ray_flags & 0x20) != 0;
  return out;
}

bool near(double a, double b) {
  return std::abs(a - b) <= kIntervalMargin * std::max({1.0, std::abs(a), std::abs(b)});
}

// Adds the candidate if t lies in the interval, or so close to its ends that rounding decides.
void add(std::vector<Candidate>& out, Candidate candidate, const Ray& ray, bool ends_included) {
  const double t = candidate.t;
  const bool inside =
      ends_included ? t >= ray.t_min && t <= ray.t_max : t > ray.t_min && t < ray.t_max;
  const bool at_end = near(t, ray.t_min) || near(t, ray.t_max);
  if (!inside && !at_end) return;
  candidate.certain = candidate.certain && !at_end;
  out.push_back(candidate);
}

void meet_triangles(std::vector<Candidate>& out, Candidate candidate, const Geometry& geometry,
                    const Rules& rules, const Line& line, const Ray& ray) {
  for (size_t i = 0; i + 9 <= geometry.vertices.size(); i += 9) {
    Vec corners[3];
    for (size_t k = 0; k < 3; ++k) {
      corners[k] = vec(&geometry.vertices[i + 3 * k]);
      if (!geometry.transform.empty()) {
        corners[k] = point(affine(geometry.transform.data()), corners[k]);
      }
    }
    const Vec e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
    const Vec normal = cross(e1, e2);
    const double facing = dot(normal, line.direction);
    if (facing == 0) continue;
    const Vec from = line.origin - corners[0];
    candidate.t = -dot(normal, from) / facing;
    const Vec moved = cross(from, line.direction);
    candidate.u = -dot(e2, moved) / facing;
    candidate.v = dot(e1, moved) / facing;
    const double least = std::min({candidate.u, candidate.v, 1 - candidate.u - candidate.v});
    if (least < -kEdgeMargin) continue;
    const bool front = (facing < 0) != rules.front_counterclockwise;
    if (front ? rules.cull_front : rules.cull_back) continue;
    candidate.primitive = static_cast<uint32_t>(i / 9);
    candidate.kind = front ? 254 : 255;
    const double slope =
        std::abs(facing) / std::sqrt(dot(normal, normal) * dot(line.direction, line.direction));
    candidate.certain = least > kEdgeMargin && slope > kGrazing;
    add(out, candidate, ray, false);
  }
}

void meet_spheres(std::vector<Candidate>& out, Candidate candidate, const Geometry& geometry,
                  const Line& line, const Ray& ray) {
  for (size_t i = 0; i < geometry.boxes.size(); ++i) {
    const RaytracingAabb& box = geometry.boxes[i];
    const Vec lower = {box.MinX, box.MinY, box.MinZ}, upper = {box.MaxX, box.MaxY, box.MaxZ};
    const Vec extent = 0.5 * (upper - lower);
    const double radius = std::min({extent.x, extent.y, extent.z});
    const Vec to_centre = 0.5 * (lower + upper) - line.origin;
    const double squared = dot(line.direction, line.direction);
    const double along = dot(to_centre, line.direction) / squared;
    const Vec aside = to_centre - along * line.direction;
    const double rest = radius * radius - dot(aside, aside);
    const double margin = 1e-3 * radius * radius;
    if (rest < -margin) continue;
    const double reach = std::sqrt(std::max(rest, 0.0) / squared);
    candidate.primitive = static_cast<uint32_t>(i);
    candidate.certain = rest > margin;
    candidate.t = along - reach;
    candidate.kind = 1;
    add(out, candidate, ray, true);
    candidate.t = along + reach;
    candidate.kind = 2;
    add(out, candidate, ray, true);
  }
}

}  // namespace

std::vector<Candidate> candidates(const Scene& scene, const Ray& ray) {
  std::vector<Candidate> out;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const RaytracingInstanceDesc& instance = scene.instances[i];
    if ((instance.InstanceMask & ray.mask & 0xFF) == 0) continue;
    const Affine to_world = affine(&instance.Transform[0][0]);
    const Line line = {solve(to_world, vec(ray.origin) - to_world.translation),
                       solve(to_world, vec(ray.direction))};
    const auto& geometries = scene.bottom_levels[instance.AccelerationStructure];
    for (uint32_t g = 0; g < geometries.size(); ++g) {
      const Rules rules = rules_of(geometries[g], instance.Flags, ray.flags);
      if (rules.skipped) continue;
      Candidate candidate;
      candidate.instance = i;
      candidate.geometry = g;
      candidate.record = instance.InstanceContributionToHitGroupIndex + g;
      const GroupKind group = scene.records[candidate.record];
      candidate.commits = rules.opaque || group != GroupKind::kAnyHit;
      if (geometries[g].boxes.empty()) {
        meet_triangles(out, candidate, geometries[g], rules, line, ray);
      } else if (group != GroupKind::kNull) {
        meet_spheres(out, candidate, geometries[g], line, ray);
      }
    }
  }
  std::sort(out.begin(), out.end(),
            [](const Candidate& a, const Candidate& b) { return a.t < b.t; });
  return out;
}

Decision decide(uint32_t mode, uint32_t seed, uint32_t packed) {
  uint32_t h = seed ^ (packed * 0x9E3779B1u);
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  h ^= h >> 15;
  if (mode == kIgnoreAll) return kIgnore;
  if (mode == kAcceptAll) return kAccept;
  return static_cast<Decision>(h % (mode == kAcceptSome ? 2 : 3));
}

}  // namespace kaamos::conformance
