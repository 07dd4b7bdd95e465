// SPDX-License-Identifier: MIT
#include "effects/assets/image/flip.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "effects/assets/image/srgb.h"

namespace kaamos::effects {
namespace {

using glm::dmat3;
using glm::dvec3;

// A picture of vectors; beyond the border, the border pixels repeat.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<dvec3> values;

  const dvec3& at(int x, int y) const {
    return values[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width +
                  std::clamp(x, 0, width - 1)];
  }
};

// Linear sRGB to XYZ, by rows. [IEC 61966-2-1, with the white that its own sums give]
const dmat3 kXyzFromRgb =
    glm::transpose(dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,
                         2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,
                         1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const dvec3 kWhite = kXyzFromRgb * dvec3(1.0);

// CIELAB without the cube roots: luminance and two opponent colours, so that linear filters apply.
dvec3 opponent_from_rgb(const dvec3& rgb) {
  const dvec3 n = (kXyzFromRgb * rgb) / kWhite;
  return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}

dvec3 rgb_from_opponent(const dvec3& c) {
  const double y = (c.x + 16) / 116;
  return glm::inverse(kXyzFromRgb) * (dvec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

// CIELAB with the Hunt effect: colours matter less in the dark.
dvec3 hunt_lab_from_rgb(const dvec3& rgb) {
  const dvec3 n = (kXyzFromRgb * rgb) / kWhite;
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double lightness = 116 * f(n.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(n.x) - f(n.y)),
          0.01 * lightness * 200 * (f(n.y) - f(n.z))};
}

// A colour distance that also holds for large differences. [Abasi et al. 2020]
double hyab(const dvec3& a, const dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// The eye's contrast sensitivity: a sum of two Gaussians per opponent channel, in degrees of the
// visual field.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivities[3] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

using Kernel = std::vector<dvec3>;  // (2 radius + 1)^2 entries

Kernel sensitivity_kernel(double pixels_per_degree, int radius) {
  constexpr double kPi = 3.14159265358979323846;
  Kernel kernel;
  dvec3 sum(0);
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const double squared = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
      dvec3 weight;
      for (int c = 0; c < 3; ++c) {
        const Sensitivity& s = kSensitivities[c];
        weight[c] = s.a1 * std::sqrt(kPi / s.b1) * std::exp(-kPi * kPi * squared / s.b1) +
                    s.a2 * std::sqrt(kPi / s.b2) * std::exp(-kPi * kPi * squared / s.b2);
      }
      kernel.push_back(weight);
      sum += weight;
    }
  }
  for (dvec3& weight : kernel) weight /= sum;
  return kernel;
}

dvec3 filtered(const Plane& plane, const Kernel& kernel, int radius, int x, int y) {
  dvec3 sum(0);
  std::size_t i = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) sum += kernel[i++] * plane.at(x + dx, y + dy);
  }
  return sum;
}

// Filters in x for edges (first derivative of a Gaussian) and points (second derivative). The
// positive weights sum to one, and so do the negative ones. The third component is the Gaussian in
// y.
Kernel feature_weights(double deviation, int radius) {
  Kernel weights;
  dvec3 positive(0), negative(0);
  for (int x = -radius; x <= radius; ++x) {
    const double gaussian = std::exp(-x * x / (2 * deviation * deviation));
    const dvec3 weight(-x * gaussian, (x * x / (deviation * deviation) - 1) * gaussian, gaussian);
    positive += glm::max(weight, dvec3(0));
    negative += glm::max(-weight, dvec3(0));
    weights.push_back(weight);
  }
  for (dvec3& weight : weights) {
    for (int c = 0; c < 3; ++c)
      weight[c] /= weight[c] > 0 ? positive[c] : std::max(negative[c], 1e-300);
  }
  return weights;
}

// Strength of edges and points at a pixel, in luminance.
glm::dvec2 features(const Plane& plane, const Kernel& weights, int radius, int x, int y) {
  double edge_x = 0, edge_y = 0, point_x = 0, point_y = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const double luminance = (plane.at(x + dx, y + dy).x + 16) / 116;
      const dvec3& in_x = weights[dx + radius];
      const dvec3& in_y = weights[dy + radius];
      edge_x += in_x.x * in_y.z * luminance;
      edge_y += in_y.x * in_x.z * luminance;
      point_x += in_x.y * in_y.z * luminance;
      point_y += in_y.y * in_x.z * luminance;
    }
  }
  return {std::hypot(edge_x, edge_y), std::hypot(point_x, point_y)};
}

// Compresses large colour differences into the last twentieth of the range.
double redistributed(double difference, double largest) {
  constexpr double kKnee = 0.4, kAtKnee = 0.95;
  const double knee = kKnee * largest;
  if (difference < knee) return kAtKnee / knee * difference;
  return kAtKnee + (difference - knee) / (largest - knee) * (1 - kAtKnee);
}

Plane opponent_plane(const FloatImage& image) {
  Plane plane{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    dvec3 rgb;
    for (int c = 0; c < 3; ++c) {
      const double value = image.values[i + c];
      rgb[c] = linear_from_srgb(value > 0 ? std::min(value, 1.0) : 0.0);
    }
    plane.values.push_back(opponent_from_rgb(rgb));
  }
  return plane;
}

}  // namespace

Result<Flip> flip(const FloatImage& picture, const FloatImage& reference,
                  double pixels_per_degree) {
  if (picture.channels != 3 || reference.channels != 3 || picture.width != reference.width ||
      picture.height != reference.height) {
    const auto text = [](const FloatImage& image) {
      return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " +
             std::to_string(image.channels);
    };
    return make_error(ErrorId::kPictures,
                      "FLIP needs two pictures of one size with 3 channels, these have " +
                          text(picture) + " and " + text(reference));
  }
  constexpr double kColorExponent = 0.7, kFeatureExponent = 0.5, kFeatureWidthDegrees = 0.082;
  constexpr double kPi = 3.14159265358979323846;
  const Plane planes[2] = {opponent_plane(picture), opponent_plane(reference)};
  const int color_radius =
      static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixels_per_degree));
  const Kernel color_kernel = sensitivity_kernel(pixels_per_degree, color_radius);
  const double deviation = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
  const int feature_radius = static_cast<int>(std::ceil(3 * deviation));
  const Kernel weights = feature_weights(deviation, feature_radius);
  const double largest = std::pow(
      hyab(hunt_lab_from_rgb(dvec3(0, 1, 0)), hunt_lab_from_rgb(dvec3(0, 0, 1))), kColorExponent);

  Flip out;
  out.map = FloatImage(picture.width, picture.height, 1);
  for (int y = 0; y < planes[0].height; ++y) {
    for (int x = 0; x < planes[0].width; ++x) {
      dvec3 colors[2];
      glm::dvec2 found[2];
      for (int i = 0; i < 2; ++i) {
        const dvec3 seen = filtered(planes[i], color_kernel, color_radius, x, y);
        colors[i] = hunt_lab_from_rgb(glm::clamp(rgb_from_opponent(seen), 0.0, 1.0));
        found[i] = features(planes[i], weights, feature_radius, x, y);
      }
      const double color =
          redistributed(std::pow(hyab(colors[0], colors[1]), kColorExponent), largest);
      const glm::dvec2 change = glm::abs(found[0] - found[1]);
      const double feature =
          std::pow(std::max(change.x, change.y) / std::sqrt(2.0), kFeatureExponent);
      const double difference = std::pow(color, 1 - feature);
      out.map.at(x, y) = static_cast<float>(difference);
      out.mean += difference;
    }
  }
  out.mean /= std::max<double>(1, static_cast<double>(out.map.values.size()));
  return out;
}

}  // namespace kaamos::effects
