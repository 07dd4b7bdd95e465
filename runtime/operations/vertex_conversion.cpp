// SPDX-License-Identifier: MIT
#include "runtime/operations/vertex_conversion.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace kaamos::runtime {

using rtapi::RtasVertexFormat;

namespace {

// Toward zero.
float as_half(float x) {
  constexpr float kLargest = 65504;
  if (!std::isfinite(x)) return x;
  if (std::fabs(x) >= kLargest) return std::copysign(kLargest, x);
  // Below the smallest normal number steps are 2^-24.
  if (std::fabs(x) < 0x1p-14f) return std::trunc(x * 0x1p24f) * 0x1p-24f;
  return std::bit_cast<float>(std::bit_cast<uint32_t>(x) & ~0x1FFFu);
}

// To the nearest, ties away from zero. NaN becomes 0.
float as_norm(float x, float least, float most) {
  if (std::isnan(x)) return 0;
  const double scaled = double{std::clamp(x, least, 1.0f)} * most;
  return static_cast<float>(std::round(scaled)) / most;
}

float as_stored(RtasVertexFormat format, float x) {
  switch (format) {
    case RtasVertexFormat::kFloat16x2:
    case RtasVertexFormat::kFloat16x3:
      return as_half(x);
    case RtasVertexFormat::kUnorm16x2:
    case RtasVertexFormat::kUnorm16x3:
      return as_norm(x, 0, 65535);
    case RtasVertexFormat::kSnorm16x2:
    case RtasVertexFormat::kSnorm16x3:
      return as_norm(x, -1, 32767);
    case RtasVertexFormat::kUnorm8x2:
    case RtasVertexFormat::kUnorm8x3:
      return as_norm(x, 0, 255);
    case RtasVertexFormat::kSnorm8x2:
    case RtasVertexFormat::kSnorm8x3:
      return as_norm(x, -1, 127);
    case RtasVertexFormat::k10_10_10_2_Unorm:
      return as_norm(x, 0, 1023);
    default:
      return x;
  }
}

bool has_two_components(RtasVertexFormat format) {
  switch (format) {
    case RtasVertexFormat::kFloat32x2:
    case RtasVertexFormat::kFloat16x2:
    case RtasVertexFormat::kUnorm16x2:
    case RtasVertexFormat::kSnorm16x2:
    case RtasVertexFormat::kUnorm8x2:
    case RtasVertexFormat::kSnorm8x2:
      return true;
    default:
      return false;
  }
}

uint32_t bits_of(uint32_t header, int axis) {
  return (header >> (8 + 4 * axis) & 15) + 1;
}

// In double, since x / scale + 0.5 is rounded in float.
bool compress_axis(std::vector<float>& xyz, int axis, double scale, uint32_t bits) {
  constexpr double kLeastAnchor = -8388608;
  constexpr double kMostAnchor = 8388607;
  bool fits = true;
  const auto quantized = [&](float x) {
    if (std::isfinite(x)) return std::floor(x / scale + 0.5);
    fits = false;
    return 0.0;
  };
  double anchor = kMostAnchor + 1;
  const auto first = static_cast<size_t>(axis);
  for (size_t i = first; i < xyz.size(); i += 3) anchor = std::min(anchor, quantized(xyz[i]));
  if (anchor < kLeastAnchor || anchor > kMostAnchor) {
    anchor = std::clamp(anchor, kLeastAnchor, kMostAnchor);
    fits = false;
  }
  const double most = static_cast<double>((1u << bits) - 1);
  for (size_t i = first; i < xyz.size(); i += 3) {
    const double offset = quantized(xyz[i]) - anchor;
    if (offset < 0 || offset > most) fits = false;
    xyz[i] = static_cast<float>((anchor + std::clamp(offset, 0.0, most)) * scale);
  }
  return fits;
}

}  // namespace

bool convert_vertices(RtasVertexFormat format, uint32_t header, std::vector<float>& xyz) {
  if (format == RtasVertexFormat::kCompressed1) {
    const double scale = std::ldexp(1.0, static_cast<int>(header & 0xFF) - 127);
    bool fits = true;
    for (int axis = 0; axis < 3; ++axis) {
      fits &= compress_axis(xyz, axis, scale, bits_of(header, axis));
    }
    return fits;
  }
  for (float& x : xyz) x = as_stored(format, x);
  if (!has_two_components(format)) return true;
  for (size_t i = 2; i < xyz.size(); i += 3) xyz[i] = 0;
  return true;
}

bool fits_template(const CompressedHeader& block, uint32_t header) {
  for (int axis = 0; axis < 3; ++axis) {
    if (block.bits[axis] > bits_of(header, axis)) return false;
  }
  return true;
}

}  // namespace kaamos::runtime
