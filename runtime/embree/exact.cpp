// SPDX-License-Identifier: MIT
#include "runtime/embree/exact.h"

#include <algorithm>

#include "runtime/structures/instances.h"

namespace kaamos::embree {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Embree's rays start within four radii.
constexpr float kLargestExactCoordinate = runtime::kLargestCoordinate / 8;

float round_down(double value) {
  const auto rounded = static_cast<float>(value);
  return std::nextafterf(rounded, -kInfinity);
}
float round_up(double value) {
  const auto rounded = static_cast<float>(value);
  return std::nextafterf(rounded, kInfinity);
}

double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

ExactFrame ExactFrame::of(const double lower[3], const double upper[3]) {
  ExactFrame frame;
  if (!(lower[0] <= upper[0])) return frame;
  for (int i = 0; i < 3; ++i) {
    frame.center[i] = 0.5 * (lower[i] + upper[i]);
    // Slightly larger, because the center is rounded.
    frame.radius = std::max(frame.radius, 0.5 * (upper[i] - lower[i]) * (1 + 0x1p-40));
  }
  return frame;
}

bool ExactFrame::holds(const double lower[3], const double upper[3]) const {
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    inside &= lower[i] >= center[i] - radius && upper[i] <= center[i] + radius;
  }
  return inside;
}

RTCBounds ExactFrame::padded(const double lower[3], const double upper[3]) const {
  float low[3];
  float high[3];
  for (int i = 0; i < 3; ++i) {
    low[i] = round_down(lower[i] - center[i] - pad());
    high[i] = round_up(upper[i] - center[i] + pad());
  }
  return {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
}

bool ExactTriangles::bounds(uint32_t primitive, float lower[3], float upper[3]) const {
  const float* a = corner(primitive, 0);
  const float* b = corner(primitive, 1);
  const float* c = corner(primitive, 2);
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    for (const float value : {a[i], b[i], c[i]}) {
      inside &= std::fabs(value) < kLargestExactCoordinate;
    }
    lower[i] = std::min({a[i], b[i], c[i]});
    upper[i] = std::max({a[i], b[i], c[i]});
  }
  return inside && !is_degenerate(a, b, c);
}

void ExactTriangles::pack(RTCDevice device, RTCBuildQuality quality, float lower[3],
                          float upper[3]) {
  std::vector<PackInput> inputs;
  inputs.reserve(indices.size() / 3);
  for (uint32_t i = 0; i < indices.size() / 3; ++i) {
    PackInput in;
    in.primitive = i;
    if (!bounds(i, in.lower, in.upper)) continue;
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], in.lower[k]);
      upper[k] = std::max(upper[k], in.upper[k]);
    }
    inputs.push_back(in);
  }
  packs = build_packs(device, inputs, quality, vertices.data(), indices.data());
}

RayInDouble to_object_space(const ExactInstance& instance, const RayInDouble& world) {
  RayInDouble object;
  for (int row = 0; row < 3; ++row) {
    const double* m = instance.world_to_object + 4 * row;
    object.origin[row] = dot(m, world.origin) + m[3];
    object.direction[row] = dot(m, world.direction);
  }
  return object;
}

void invert_in_double(const float matrix[12], double inverse[12]) {
  double m[12];
  std::copy(matrix, matrix + 12, m);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const int r1 = (column + 1) % 3, r2 = (column + 2) % 3;
      const int c1 = (row + 1) % 3, c2 = (row + 2) % 3;
      inverse[4 * row + column] =
          difference_of_products(m[4 * r1 + c1], m[4 * r2 + c2], m[4 * r1 + c2], m[4 * r2 + c1]);
    }
  }
  const double determinant = m[0] * inverse[0] + m[1] * inverse[4] + m[2] * inverse[8];
  for (int row = 0; row < 3; ++row) {
    double translation = 0;
    for (int column = 0; column < 3; ++column) {
      inverse[4 * row + column] /= determinant;
      translation -= inverse[4 * row + column] * m[4 * column + 3];
    }
    inverse[4 * row + 3] = translation;
  }
}

bool EmbreeRay::set(const RayInDouble& ray, const ExactFrame& frame) {
  const double* d = ray.direction;
  const double longest = std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
  if (!(longest > 0)) return false;
  double o[3];
  for (int i = 0; i < 3; ++i) o[i] = ray.origin[i] - frame.center[i];
  start_t = 0;
  const double sphere = 1.75 * frame.radius;  // a little more than sqrt(3)
  if (dot(o, o) > 4 * sphere * sphere) {
    const double square = dot(d, d);
    const double closest_t = -dot(o, d) / square;
    const double reach = 1.1 * sphere / std::sqrt(square);
    if (closest_t + reach < 0) return false;
    double closest[3];
    for (int i = 0; i < 3; ++i) closest[i] = o[i] + closest_t * d[i];
    if (dot(closest, closest) > 1.1 * sphere * sphere) return false;
    start_t = std::max(closest_t - reach, 0.0);
  }
  per_unit = longest;
  const double scale = 1 / longest;
  bool finite = true;
  for (int i = 0; i < 3; ++i) {
    origin[i] = static_cast<float>(o[i] + start_t * d[i]);
    direction[i] = static_cast<float>(d[i] * scale);
    finite &= std::fabs(origin[i]) < runtime::kLargestCoordinate && std::fabs(direction[i]) <= 1;
  }
  return finite;
}

float EmbreeRay::near_of(float t) const {
  const double local = (static_cast<double>(t) - start_t) * per_unit;
  return local > 0 ? std::max(round_down(local * (1 - 0x1p-20)), 0.0f) : 0.0f;
}

float EmbreeRay::far_of(float t) const {
  const double local = (static_cast<double>(t) - start_t) * per_unit;
  return local > 0 ? round_up(local * (1 + 0x1p-20)) : std::numeric_limits<float>::min();
}

}  // namespace kaamos::embree
