// SPDX-License-Identifier: MIT
#include "tests/verify/expected.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace kaamos::verify {

namespace {

using glm::dvec3;

constexpr double kUnsure = 1e-3;
constexpr double kErrorOfT = 1e-4, kErrorOfAttributes = 1e-3;

struct Ray {
  dvec3 origin, direction;
};

struct Hit {
  double t = 0;
  double attributes[2] = {};
  double code = 0;
  // How far inside the outline, as a part of the shape's size; negative outside.
  double inside = -1;
};

dvec3 vector_of(const Point& point) {
  return {point[0], point[1], point[2]};
}

glm::dmat3 linear_of(const Transform& transform) {
  glm::dmat3 out;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out[column][row] = transform[row][column];
  }
  return out;
}

dvec3 offset_of(const Transform& transform) {
  return {transform[0][3], transform[1][3], transform[2][3]};
}

// Where the ray meets the triangle's plane, and the areas of the parts around that point.
Hit meet_triangle(const Ray& ray, const Triangle& triangle, const Transform& to_world,
                  double code) {
  const auto world = [&](const Point& point) {
    return linear_of(to_world) * vector_of(point) + offset_of(to_world);
  };
  const dvec3 first = world(triangle[0]);
  const dvec3 e1 = world(triangle[1]) - first, e2 = world(triangle[2]) - first;
  const dvec3 normal = glm::cross(e1, e2);
  Hit hit;
  hit.t = glm::dot(normal, first - ray.origin) / glm::dot(normal, ray.direction);
  const dvec3 at = ray.origin + hit.t * ray.direction - first;
  hit.attributes[0] = glm::dot(glm::cross(at, e2), normal) / glm::dot(normal, normal);
  hit.attributes[1] = glm::dot(glm::cross(e1, at), normal) / glm::dot(normal, normal);
  hit.inside =
      std::min({hit.attributes[0], hit.attributes[1], 1 - hit.attributes[0] - hit.attributes[1]});
  hit.code = code;
  return hit;
}

// The ray's line comes closest to the sphere's centre at t = middle.
Hit meet_sphere(const Ray& ray) {
  const glm::dmat3 to_object = glm::inverse(linear_of(kSphereToWorld));
  const dvec3 origin = to_object * (ray.origin - offset_of(kSphereToWorld));
  const dvec3 direction = to_object * ray.direction;
  const double length = glm::length(direction);
  const double middle = -glm::dot(origin, direction) / (length * length);
  const double distance = glm::length(origin + middle * direction);
  Hit hit;
  hit.inside = 1 - distance / double{kRadius};
  if (hit.inside < 0) return hit;
  hit.t = middle - std::sqrt(double{kRadius} * kRadius - distance * distance) / length;
  const dvec3 normal = (origin + hit.t * direction) / double{kRadius};
  hit.attributes[0] = normal.x;
  hit.attributes[1] = normal.y;
  hit.code = kSphereId;
  return hit;
}

std::vector<Hit> meet_occluders(const Ray& ray) {
  return {meet_triangle(ray, kTilted, kTiltedToWorld, kTriangleId), meet_sphere(ray)};
}

// Whether the light is seen; none where that is unsure.
std::optional<bool> is_lit(const dvec3& position) {
  const Ray ray = {position, vector_of(kLight) - position};
  bool lit = true;
  for (const Hit& hit : meet_occluders(ray)) {
    if (std::abs(hit.inside) < kUnsure) return std::nullopt;
    if (hit.inside > 0 && hit.t > 0 && hit.t < 1) lit = false;
  }
  return lit;
}

}  // namespace

std::optional<Texel> expected_texel(uint32_t x, uint32_t y) {
  const Ray ray = {vector_of(kEye),
                   {1.6 * ((x + 0.5) / kWidth * 2 - 1), -1.2 * ((y + 0.5) / kHeight * 2 - 1), 2}};
  std::vector<Hit> hits = meet_occluders(ray);
  for (uint32_t i = 0; i < kFloor.size(); ++i) {
    hits.push_back(meet_triangle(ray, kFloor[i], kFloorToWorld, kFloorId + 16.0 * i));
  }
  const Hit* closest = nullptr;
  for (const Hit& hit : hits) {
    if (std::abs(hit.inside) < kUnsure) return std::nullopt;
    if (hit.inside < 0 || hit.t <= 0) continue;
    if (closest != nullptr && std::abs(hit.t - closest->t) < kUnsure) return std::nullopt;
    if (closest == nullptr || hit.t < closest->t) closest = &hit;
  }
  if (closest == nullptr) return Texel{.t = -1};
  Texel out;
  out.t = static_cast<float>(closest->t);
  out.attributes[0] = static_cast<float>(closest->attributes[0]);
  out.attributes[1] = static_cast<float>(closest->attributes[1]);
  out.code = static_cast<float>(closest->code);
  if (static_cast<uint32_t>(closest->code) % 16 == kFloorId) {
    const auto lit = is_lit(ray.origin + closest->t * ray.direction);
    if (!lit) return std::nullopt;
    if (*lit) out.code += 64;
  }
  return out;
}

Comparison compare(const std::vector<Texel>& texels) {
  Comparison out;
  if (texels.size() != kTexels) {
    out.failure = std::to_string(texels.size()) + " texels instead of " + std::to_string(kTexels);
    return out;
  }
  for (uint32_t i = 0; i < kTexels; ++i) {
    const auto wanted = expected_texel(i % kWidth, i / kWidth);
    if (!wanted) continue;
    ++out.compared;
    const Texel& found = texels[i];
    const double of_t = std::abs(found.t - wanted->t) / std::abs(wanted->t);
    const double of_attributes = std::max(std::abs(found.attributes[0] - wanted->attributes[0]),
                                          std::abs(found.attributes[1] - wanted->attributes[1]));
    // Comparisons with NaN are false.
    if (found.code == wanted->code && of_t <= kErrorOfT && of_attributes <= kErrorOfAttributes) {
      out.largest_error = std::max({out.largest_error, of_t, of_attributes});
      continue;
    }
    char text[256];
    std::snprintf(text, sizeof text,
                  "pixel (%u, %u) is t %.6g, attributes (%.6g, %.6g), code %g; expected t %.6g, "
                  "attributes (%.6g, %.6g), code %g",
                  i % kWidth, i / kWidth, found.t, found.attributes[0], found.attributes[1],
                  found.code, wanted->t, wanted->attributes[0], wanted->attributes[1],
                  wanted->code);
    out.failure = text;
    return out;
  }
  return out;
}

}  // namespace kaamos::verify
