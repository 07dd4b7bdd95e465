// SPDX-License-Identifier: MIT
#include "runtime/raster/testing/reference.h"

#include <cmath>

namespace kaamos::raster::testing {

ReferenceTriangle::ReferenceTriangle(const float corners[3][4], const rtapi::Viewport& viewport) {
  for (int i = 0; i < 3; ++i) {
    const float w = corners[i][3];
    const float half_width = viewport.Width / 2;
    const float half_height = viewport.Height / 2;
    const float x = corners[i][0] / w * half_width + (viewport.TopLeftX + half_width);
    const float y = corners[i][1] / w * -half_height + (viewport.TopLeftY + half_height);
    // The processor rounds to nearest even.
    x_[i] = std::llrint(static_cast<double>(x) * 256);
    y_[i] = std::llrint(static_cast<double>(y) * 256);
    z_[i] = corners[i][2] / w * (viewport.MaxDepth - viewport.MinDepth) + viewport.MinDepth;
    w_[i] = w;
  }
  area_ = edge(0, x_[2], y_[2]);
}

// Twice the area of corner `from`, the next one, and a point in subpixels.
int64_t ReferenceTriangle::edge(int from, int64_t x, int64_t y) const {
  const int to = (from + 1) % 3;
  return (x_[to] - x_[from]) * (y - y_[from]) - (y_[to] - y_[from]) * (x - x_[from]);
}

bool ReferenceTriangle::covers(int32_t x, int32_t y) const {
  if (area_ == 0) return false;
  const int64_t sign = area_ > 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    const int64_t value = sign * edge(i, x * 256 + 128, y * 256 + 128);
    if (value < 0) return false;
    if (value > 0) continue;
    // In the direction in which the inside is on the right, a left edge goes up and a top edge
    // goes right.
    const int64_t dx = sign * (x_[(i + 1) % 3] - x_[i]);
    const int64_t dy = sign * (y_[(i + 1) % 3] - y_[i]);
    const bool left = dy < 0;
    const bool top = dy == 0 && dx > 0;
    if (!left && !top) return false;
  }
  return true;
}

void ReferenceTriangle::weights(int32_t x, int32_t y, bool perspective, long double out[3]) const {
  long double sum = 0;
  for (int i = 0; i < 3; ++i) {
    out[i] = static_cast<long double>(edge((i + 1) % 3, x * 256 + 128, y * 256 + 128));
    if (perspective) out[i] /= static_cast<long double>(w_[i]);
    sum += out[i];
  }
  for (int i = 0; i < 3; ++i) out[i] /= sum;
}

long double ReferenceTriangle::depth(int32_t x, int32_t y) const {
  long double weight[3];
  weights(x, y, false, weight);
  long double z = 0;
  for (int i = 0; i < 3; ++i) z += weight[i] * static_cast<long double>(z_[i]);
  return z;
}

}  // namespace kaamos::raster::testing
