// SPDX-License-Identifier: MIT
#include "effects/reference/path_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaamos::effects {

namespace {

// Smith's Lambda for a direction with that cosine.
double smith_lambda(double alpha, double cosine) {
  const double tangent_squared = 1.0 / (cosine * cosine) - 1.0;
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent_squared) - 1.0);
}

}  // namespace

// Integrates over the facets that the view sees, whose density makes the integrand smooth:
// F G2 / G1, by the half disk that Heitz's sampling projects them to.
glm::dvec2 specular_parts(double roughness, double cosine, std::uint32_t steps) {
  const double alpha = roughness * roughness;
  const glm::dvec3 view(std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), 0.0, cosine);
  const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * view.x, 0.0, view.z));
  const glm::dvec3 t1(0, 1, 0);
  const glm::dvec3 t2 = glm::cross(stretched, t1);
  const double lambda_view = smith_lambda(alpha, cosine);
  glm::dvec2 sum(0.0);
  for (std::uint32_t i = 0; i < steps; ++i) {
    // Even steps of the facet's height over the disk: the integrand changes fastest at its rim.
    const double rise = (i + 0.5) / steps;
    const double r = std::sqrt(1.0 - rise * rise);
    // The lobe is symmetric about the plane of incidence: half of the disk is enough.
    for (std::uint32_t j = 0; j < steps; ++j) {
      const double phi = std::numbers::pi * ((j + 0.5) / steps - 0.5);
      const double p1 = r * std::cos(phi);
      const double s = 0.5 * (1.0 + stretched.z);
      const double p2 = (1.0 - s) * std::sqrt(std::max(0.0, 1.0 - p1 * p1)) + s * r * std::sin(phi);
      const double up = std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2));
      const glm::dvec3 n = p1 * t1 + p2 * t2 + up * stretched;
      const glm::dvec3 h =
          glm::normalize(glm::dvec3(alpha * n.x, alpha * n.y, std::max(n.z, 1e-12)));
      const double across = glm::dot(view, h);
      const double light = 2.0 * across * h.z - view.z;
      if (!(light > 0.0)) continue;
      const double weight = (1.0 + lambda_view) / (1.0 + lambda_view + smith_lambda(alpha, light));
      const double grazing = std::pow(std::clamp(1.0 - across, 0.0, 1.0), 5.0);
      sum += glm::dvec2(1.0 - grazing, grazing) * (2.0 * rise * weight);
    }
  }
  return sum / (static_cast<double>(steps) * steps);
}

std::vector<glm::vec2> specular_albedo_table() {
  std::vector<glm::vec2> table;
  table.reserve(kAlbedoCosines * kAlbedoRoughnesses);
  for (std::uint32_t y = 0; y < kAlbedoRoughnesses; ++y) {
    const double row = static_cast<double>(y) / (kAlbedoRoughnesses - 1);
    const double roughness = kPathMirrorRoughness + (1.0 - kPathMirrorRoughness) * row * row;
    for (std::uint32_t x = 0; x < kAlbedoCosines; ++x) {
      const double root = static_cast<double>(x) / (kAlbedoCosines - 1);
      table.emplace_back(specular_parts(roughness, std::max(root * root, 1e-5)));
    }
  }
  return table;
}

}  // namespace kaamos::effects
