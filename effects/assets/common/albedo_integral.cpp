// SPDX-License-Identifier: MIT
#include "effects/assets/common/albedo_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace kaamos::effects {

namespace {

constexpr int kPoints = 12;
constexpr int kAngles = 32;

// Points and weights of Gauss and Legendre's quadrature over 0 to 1. Newton's method finds the
// roots of the Legendre polynomial.
struct Gauss {
  std::array<double, kPoints> point, weight;

  Gauss() {
    for (int i = 0; i < kPoints; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (kPoints + 0.5));
      double slope = 1;
      for (int step = 0; step < 8; ++step) {
        double p = 1, previous = 0;
        for (int k = 1; k <= kPoints; ++k) {
          const double before = previous;
          previous = p;
          p = ((2 * k - 1) * x * previous - (k - 1) * before) / k;
        }
        slope = kPoints * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      const auto at = static_cast<std::size_t>(i);
      point[at] = 0.5 * (1 - x);
      weight[at] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

// The view, and how rough the surface is.
struct View {
  double alpha, cosine;
  glm::dvec3 direction;
  glm::dvec3 stretched;  // as seen by a hemisphere of facets [SampleGgxHalfVector]
  double shadowing;
};

// The cosine times (1 + Lambda) of Smith's shadowing.
double shadowing(double alpha, double cosine) {
  return 0.5 * (cosine + std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine));
}

// A facet of the spherical cap at `height` below its top, 0 to 1, and at an angle about its axis.
struct Facet {
  double facing;  // cosine between view and facet
  double light;   // cosine between the mirrored direction and the surface's normal

  Facet(const View& view, double height, const glm::dvec2& angle) {
    const double z = (1 - height) * (1 + view.stretched.z) - view.stretched.z;
    const glm::dvec2 across = std::sqrt(std::max(0.0, 1 - z * z)) * angle;
    const glm::dvec3 h = glm::dvec3(across, z) + view.stretched;
    const glm::dvec3 half = glm::normalize(glm::dvec3(view.alpha * h.x, view.alpha * h.y, h.z));
    facing = glm::dot(view.direction, half);
    light = 2 * facing * half.z - view.cosine;
  }
};

// Returns how far down the cap light is mirrored above the surface. At its top it is.
double lit_height(const View& view, const glm::dvec2& angle) {
  if (Facet(view, 1, angle).light > 0) return 1;
  double above = 0, below = 1;
  for (int step = 0; step < 16; ++step) {
    const double middle = 0.5 * (above + below);
    (Facet(view, middle, angle).light > 0 ? above : below) = middle;
  }
  return above;
}

}  // namespace

glm::dvec2 integrate_specular_albedo(double cosine, double roughness) {
  static const Gauss gauss;
  const double alpha = roughness * roughness;
  cosine = std::clamp(cosine, 1e-6, 1.0);
  View view = {.alpha = alpha, .cosine = cosine};
  view.direction = glm::dvec3(std::sqrt(1 - cosine * cosine), 0, cosine);
  view.stretched = glm::normalize(glm::dvec3(alpha * view.direction.x, 0, cosine));
  view.shadowing = shadowing(alpha, cosine);
  glm::dvec2 sum(0.0);
  // The facets that the view sees, as SampleGgxHalfVector draws them, down to those that mirror
  // light below the surface. Both halves of the circle are alike.
  for (int i = 0; i < kAngles; ++i) {
    const double phi = std::numbers::pi * (i + 0.5) / kAngles;
    const glm::dvec2 angle(std::cos(phi), std::sin(phi));
    const double range = lit_height(view, angle);
    for (std::size_t k = 0; k < kPoints; ++k) {
      // The integrand changes fastest where light grazes the surface, so points are dense there.
      const double t = gauss.point[k];
      const Facet facet(view, range * (1 - t * t * t), angle);
      // F G2 / G1, see GgxSampleWeight.
      const double seen =
          facet.light * view.shadowing /
          (facet.light * view.shadowing + cosine * (shadowing(alpha, facet.light) - facet.light));
      const double away = std::clamp(1 - facet.facing, 0.0, 1.0);
      const double fresnel = away * away * away * away * away;
      sum +=
          gauss.weight[k] * 3 * t * t * range / kAngles * seen * glm::dvec2(1 - fresnel, fresnel);
    }
  }
  return sum;
}

}  // namespace kaamos::effects
