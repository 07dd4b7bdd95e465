// SPDX-License-Identifier: MIT
#include "exactness.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <random>

namespace kaamos::test {
namespace {

using Real = long double;
using Vec = glm::vec<3, Real>;

constexpr int kSteps = 12;

// A bumpy sphere, star-shaped seen from its centre: eight faces of kSteps^2 triangles each, welded.
// The axes pass through vertices.
ProbeMesh closed_mesh(float scale) {
  ProbeMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [at, is_new] = known.try_emplace(p, static_cast<std::uint32_t>(known.size()));
    if (is_new) {
      const glm::dvec3 d = glm::normalize(glm::dvec3(p[0], p[1], p[2]));
      const double bump = 1 + 0.1 * std::sin(9 * d.x + 5 * d.y);
      mesh.positions.push_back(glm::vec3(d / bump * double{scale}));
    }
    return at->second;
  };
  for (int face = 0; face < 8; ++face) {
    const auto at = [&](int i, int j) {
      const int k = kSteps - i - j;
      return vertex({face & 1 ? -i : i, face & 2 ? -j : j, face & 4 ? -k : k});
    };
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; i + j < kSteps; ++j) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < kSteps) {
          mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
      }
    }
  }
  return mesh;
}

glm::vec3 target_of(const ProbeMesh& mesh, Aim aim, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  const auto& triangle = mesh.triangles[random() % mesh.triangles.size()];
  const float u = aim == Aim::kVertex ? 0 : unit(random);
  const float v = aim == Aim::kRandom ? (1 - u) * unit(random) : 0;
  const glm::vec3& a = mesh.positions[triangle[0]];
  return a + u * (mesh.positions[triangle[1]] - a) + v * (mesh.positions[triangle[2]] - a);
}

ProbeRay ray_of(const ProbeMesh& mesh, const Placement& place, Aim aim, std::mt19937& random) {
  std::uniform_real_distribution<float> around(-0.2f, 0.2f);
  const glm::vec3 moved(place.scene, place.scene, 0);
  glm::vec3 origin = place.scale * glm::vec3(around(random), around(random), 0);
  if (place.camera != 0) origin.z = place.camera * place.scale;
  ProbeRay ray;
  ray.origin = origin + moved;
  ray.direction = target_of(mesh, aim, random) + moved - ray.origin;
  ray.t_max = std::numeric_limits<float>::infinity();
  return ray;
}

Real ulp_of(Real value) {
  const float nearest = std::fabs(static_cast<float>(value));
  return Real{std::nextafterf(nearest, std::numeric_limits<float>::infinity())} - nearest;
}

// Computes the errors of t and of the worse barycentric; false if the ray grazes.
bool errors_of(const ProbeMesh& mesh, const ProbeRay& ray, const ProbeHit& hit, double& t,
               double& barycentrics) {
  const auto& triangle = mesh.triangles[hit.primitive];
  const Vec a(mesh.positions[triangle[0]]);
  const Vec e = Vec(mesh.positions[triangle[1]]) - a;
  const Vec f = Vec(mesh.positions[triangle[2]]) - a;
  const Vec moved(mesh.transform[0].w, mesh.transform[1].w, mesh.transform[2].w);
  const Vec d(ray.direction);
  const Vec s = Vec(ray.origin) - moved - a;
  const Vec h = glm::cross(d, f);
  const Vec q = glm::cross(s, e);
  const Real determinant = glm::dot(e, h);
  if (std::fabs(determinant) < 0.05L * std::sqrt(glm::dot(e, e) * glm::dot(f, f) * glm::dot(d, d)))
    return false;
  const Real truth = glm::dot(f, q) / determinant;
  t = static_cast<double>(std::fabs(hit.t - truth) / ulp_of(truth));
  const Real u = std::fabs(hit.barycentrics.x - glm::dot(s, h) / determinant);
  const Real v = std::fabs(hit.barycentrics.y - glm::dot(d, q) / determinant);
  barycentrics = static_cast<double>(std::max(u, v) * 0x1p24L);
  return true;
}

void take_largest(std::vector<double>& values, double& largest, double& of_99) {
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  largest = values.back();
  of_99 = values[values.size() * 99 / 100];
}

}  // namespace

std::vector<Placement> all_placements() {
  std::vector<Placement> places;
  for (float scale : {1e-9f, 1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f, 1e9f, 1e12f}) {
    places.push_back({scale, 0, 0});
  }
  for (float scene : {1e2f, 1e4f, 1e6f}) places.push_back({1, scene, 0});
  for (float camera : {1e2f, 1e4f, 1e6f}) places.push_back({1, 0, camera});
  for (const Placement& mixed : {Placement{1e-9f, 0, 1e6f}, Placement{1e12f, 0, 1e3f},
                                 Placement{100, 1e6f, 1e3f}, Placement{1, 1e6f, 1e6f}}) {
    places.push_back(mixed);
  }
  return places;
}

std::string name_of(const Placement& placement) {
  char text[64];
  std::snprintf(text, sizeof(text), "%-7.0e %-7.0e %-7.0e", placement.scale, placement.scene,
                placement.camera);
  return text;
}

ProbeMesh mesh_of(const Placement& placement) {
  ProbeMesh mesh = closed_mesh(placement.scale);
  mesh.transform[0].w = placement.scene;
  mesh.transform[1].w = placement.scene;
  return mesh;
}

std::vector<ProbeRay> mixed_rays(const Placement& placement, std::uint32_t rays) {
  const ProbeMesh mesh = mesh_of(placement);
  std::mt19937 random(17);
  std::vector<ProbeRay> out;
  for (std::uint32_t i = 0; i < rays; ++i) {
    out.push_back(ray_of(mesh, placement, kAims[i % 3], random));
  }
  return out;
}

WrongHits count_wrong_hits(RayProbe& probe, const Placement& placement, Aim aim,
                           std::uint32_t rays) {
  const ProbeMesh mesh = mesh_of(placement);
  probe.set_mesh(mesh);
  std::mt19937 random(static_cast<std::uint32_t>(aim) + 5);
  std::vector<ProbeRay> shot;
  for (std::uint32_t i = 0; i < rays; ++i) shot.push_back(ray_of(mesh, placement, aim, random));
  WrongHits result;
  for (const std::uint32_t count : probe.triangle_counts(shot)) {
    const bool inside = placement.camera == 0;
    result.wrong += (inside ? count != 1 : count % 2 != 0) ? 1 : 0;
    result.gaps += inside && count == 0 ? 1 : 0;
  }
  return result;
}

HitErrors measure_hit_errors(RayProbe& probe, const Placement& placement, std::uint32_t rays) {
  const ProbeMesh mesh = mesh_of(placement);
  probe.set_mesh(mesh);
  std::mt19937 random(3);
  std::vector<ProbeRay> shot;
  for (std::uint32_t i = 0; i < rays; ++i) {
    shot.push_back(ray_of(mesh, placement, Aim::kRandom, random));
  }
  const std::vector<ProbeHit> hits = probe.hits(shot);
  std::vector<double> of_t, of_barycentrics;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    double t = 0, barycentrics = 0;
    if (hits[i].t < 0 || !errors_of(mesh, shot[i], hits[i], t, barycentrics)) continue;
    of_t.push_back(t);
    of_barycentrics.push_back(barycentrics);
  }
  HitErrors errors;
  take_largest(of_t, errors.t, errors.t_99);
  take_largest(of_barycentrics, errors.barycentrics, errors.barycentrics_99);
  return errors;
}

}  // namespace kaamos::test
