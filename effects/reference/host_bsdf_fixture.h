// SPDX-License-Identifier: MIT
// For tests: the equations of README.md in doubles, and integrals of them by quadrature.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "effects/reference/path_albedo.h"

namespace kaamos::effects {

// A surface about +z, seen from `view`.
struct HostBsdf {
  glm::dvec3 view;
  double base = 0.5;  // of one colour
  double metallic = 0;
  double roughness = 0.5;
  double albedo = 0;  // of the specular lobe

  HostBsdf(double degrees, double base_color, double metal, double rough)
      : base(base_color), metallic(metal), roughness(rough) {
    const double angle = degrees * std::numbers::pi / 180;
    view = {std::sin(angle), 0, std::cos(angle)};
    const glm::dvec2 parts = specular_parts(rough, view.z, 128);
    albedo = f0() * parts.x + parts.y;
  }
  double f0() const { return 0.04 + (base - 0.04) * metallic; }
  double diffuse() const { return (1 - metallic) * base * (1 - albedo); }
  // Returns the part of even light that it reflects.
  double total_albedo() const { return albedo + diffuse(); }

  static double lambda(double alpha, const glm::dvec3& v) {
    const double t = (v.x * v.x + v.y * v.y) / (v.z * v.z);
    return 0.5 * (std::sqrt(1 + alpha * alpha * t) - 1);
  }
  double specular_times_cosine(const glm::dvec3& light) const {
    if (light.z <= 0) return 0;
    const double alpha = roughness * roughness;
    const glm::dvec3 h = glm::normalize(view + light);
    const double q = h.z * h.z * (alpha * alpha - 1) + 1;
    const double d = alpha * alpha / (std::numbers::pi * q * q);
    const double f = f0() + (1 - f0()) * std::pow(1 - glm::dot(view, h), 5);
    return f * d / (4 * view.z * (1 + lambda(alpha, view) + lambda(alpha, light)));
  }
  double times_cosine(const glm::dvec3& light) const {
    if (light.z <= 0) return 0;
    return diffuse() / std::numbers::pi * light.z + specular_times_cosine(light);
  }
};

// Integral over the directions in a cone about `axis` of that half angle.
inline double over_cone(const glm::dvec3& axis, double half_angle,
                        const std::function<double(const glm::dvec3&)>& value, int steps = 400) {
  const glm::dvec3 other = std::abs(axis.x) > 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 t = glm::normalize(glm::cross(axis, other));
  const glm::dvec3 b = glm::cross(axis, t);
  const double height = 1 - std::cos(half_angle);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = 1 - height * (i + 0.5) / steps;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < steps; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / steps;
      sum += value(r * std::cos(phi) * t + r * std::sin(phi) * b + z * axis);
    }
  }
  return sum * 2 * std::numbers::pi * height / (static_cast<double>(steps) * steps);
}

inline double over_hemisphere(const std::function<double(const glm::dvec3&)>& value,
                              int steps = 600) {
  return over_cone({0, 0, 1}, 0.5 * std::numbers::pi, value, steps);
}

}  // namespace kaamos::effects
