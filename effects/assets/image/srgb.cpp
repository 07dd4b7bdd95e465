// SPDX-License-Identifier: MIT
#include "effects/assets/image/srgb.h"

#include <cmath>

namespace kaamos::effects {
namespace {

template <class T>
T decode(T encoded) {
  return encoded <= T(0.04045) ? encoded / T(12.92)
                               : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

}  // namespace

float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb(float encoded) {
  return decode(encoded);
}

double linear_from_srgb(double encoded) {
  return decode(encoded);
}

}  // namespace kaamos::effects
