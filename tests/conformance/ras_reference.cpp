// SPDX-License-Identifier: MIT
#include "tests/conformance/ras_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaamos::conformance {

namespace {

// Pixels to the nearest 1/256, ties to even.
int64_t subpixels_of(double pixels) {
  return static_cast<int64_t>(std::nearbyint(pixels * 256));
}

}  // namespace

ExactTriangle::ExactTriangle(const Screen& screen, const Corner* corners) : size_(screen.size()) {
  const double half = size_ / 2.0;
  for (int i = 0; i < 3; ++i) {
    const auto& p = corners[i].position;
    const double w = static_cast<double>(p[3]);
    x_[i] = subpixels_of((static_cast<double>(p[0]) / w + 1) * half);
    y_[i] = subpixels_of((1 - static_cast<double>(p[1]) / w) * half);
    z_[i] = static_cast<long double>(p[2] / p[3]);
    w_[i] = static_cast<long double>(p[3]);
    value_[i] = static_cast<long double>(corners[i].value[0]);
  }
  area_ = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (x_[2] - x_[0]) * (y_[1] - y_[0]);
}

// Twice the area of corners `from`, from + 1 and a point; positive as the triangle's own.
int64_t ExactTriangle::edge(int from, int64_t x, int64_t y) const {
  const int to = (from + 1) % 3;
  const int64_t value = (x_[to] - x_[from]) * (y - y_[from]) - (x - x_[from]) * (y_[to] - y_[from]);
  return area_ < 0 ? -value : value;
}

bool ExactTriangle::covers(uint32_t px, uint32_t py) const {
  if (area_ == 0) return false;
  const int64_t x = int64_t{px} * 256 + 128;
  const int64_t y = int64_t{py} * 256 + 128;
  for (int from = 0; from < 3; ++from) {
    const int64_t value = edge(from, x, y);
    if (value > 0) continue;
    if (value < 0) return false;
    // The clockwise direction of the edge: right is a top edge, up is a left one.
    const int to = (from + 1) % 3;
    const int64_t sign = area_ < 0 ? -1 : 1;
    const int64_t dx = (x_[to] - x_[from]) * sign;
    const int64_t dy = (y_[to] - y_[from]) * sign;
    if (!(dy < 0 || (dy == 0 && dx > 0))) return false;
  }
  return true;
}

bool ExactTriangle::is_in_target() const {
  const auto inside = [&](int64_t subpixels) {
    return subpixels >= 0 && subpixels <= int64_t{size_} * 256;
  };
  return std::all_of(x_, x_ + 3, inside) && std::all_of(y_, y_ + 3, inside);
}

long double ExactTriangle::distance_to_edges(uint32_t px, uint32_t py) const {
  long double nearest = std::numeric_limits<long double>::infinity();
  for (int from = 0; from < 3; ++from) {
    const int to = (from + 1) % 3;
    const long double length = std::hypot(static_cast<long double>(x_[to] - x_[from]),
                                          static_cast<long double>(y_[to] - y_[from]));
    const int64_t value = edge(from, int64_t{px} * 256 + 128, int64_t{py} * 256 + 128);
    nearest = std::min(nearest, static_cast<long double>(std::abs(value)) / length / 256);
  }
  return nearest;
}

std::string ExactTriangle::text() const {
  std::string out;
  for (int i = 0; i < 3; ++i) {
    out += (i == 0 ? "(" : ", (") + std::to_string(static_cast<double>(x_[i]) / 256) + " " +
           std::to_string(static_cast<double>(y_[i]) / 256) + " z " + std::to_string(z_[i]) +
           " w " + std::to_string(w_[i]) + " value " + std::to_string(value_[i]) + ")";
  }
  return out;
}

void ExactTriangle::each_pixel(const std::function<void(uint32_t x, uint32_t y)>& visit) const {
  const auto pixel = [&](int64_t subpixels) {
    return static_cast<uint32_t>(std::clamp<int64_t>(subpixels / 256, 0, size_));
  };
  const uint32_t left = pixel(*std::min_element(x_, x_ + 3));
  const uint32_t right = pixel(*std::max_element(x_, x_ + 3) + 256);
  const uint32_t top = pixel(*std::min_element(y_, y_ + 3));
  const uint32_t bottom = pixel(*std::max_element(y_, y_ + 3) + 256);
  for (uint32_t y = top; y < bottom; ++y) {
    for (uint32_t x = left; x < right; ++x) {
      if (covers(x, y)) visit(x, y);
    }
  }
}

void ExactTriangle::weights(uint32_t px, uint32_t py, long double out[3]) const {
  const int64_t x = int64_t{px} * 256 + 128;
  const int64_t y = int64_t{py} * 256 + 128;
  const auto area = static_cast<long double>(std::abs(area_));
  for (int i = 0; i < 3; ++i) {
    out[i] = static_cast<long double>(edge((i + 1) % 3, x, y)) / area;
  }
}

long double ExactTriangle::depth(uint32_t x, uint32_t y) const {
  long double b[3];
  weights(x, y, b);
  return b[0] * z_[0] + b[1] * z_[1] + b[2] * z_[2];
}

long double ExactTriangle::value(uint32_t x, uint32_t y, bool perspective) const {
  long double b[3];
  weights(x, y, b);
  long double sum = 0, weight = 0;
  for (int i = 0; i < 3; ++i) {
    if (perspective) b[i] /= w_[i];
    sum += b[i] * value_[i];
    weight += b[i];
  }
  return sum / weight;
}

long double ExactTriangle::slope_of(const long double values[3]) const {
  const auto area = static_cast<long double>(area_);
  const long double d1 = values[1] - values[0], d2 = values[2] - values[0];
  const auto dx1 = static_cast<long double>(x_[1] - x_[0]);
  const auto dx2 = static_cast<long double>(x_[2] - x_[0]);
  const auto dy1 = static_cast<long double>(y_[1] - y_[0]);
  const auto dy2 = static_cast<long double>(y_[2] - y_[0]);
  const long double x = (d1 * dy2 - d2 * dy1) / area;
  const long double y = (d2 * dx1 - d1 * dx2) / area;
  return (std::abs(x) + std::abs(y)) * 256;
}

ExactTriangle::Bounds ExactTriangle::bounds(uint32_t x, uint32_t y, bool vulkan) const {
  if (!vulkan) return {std::abs(depth(x, y)) * 0x1p-24L + 0x1p-25L, 0x1p-20L, 0x1p-20L};
  // Planes are through corners that were not rounded, so they are moved by up to 1/256 pixel.
  long double over_w[3], inv_w[3], b[3];
  weights(x, y, b);
  long double one_over_w = 0;
  for (int i = 0; i < 3; ++i) {
    over_w[i] = value_[i] / w_[i];
    inv_w[i] = 1 / w_[i];
    one_over_w += b[i] * inv_w[i];
  }
  constexpr long double kMoved = 1.0L / 256;
  const long double moved =
      (slope_of(over_w) + value(x, y, true) * slope_of(inv_w)) / one_over_w * kMoved;
  return {slope_of(z_) * kMoved + 0x1p-20L, moved + 0x1p-12L, slope_of(value_) * kMoved + 0x1p-12L};
}

std::vector<Corner> grid_triangles(const Screen& screen, GridKind kind, uint32_t count,
                                   std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double size = screen.size();
  const auto on_grid = [](double pixels) {
    return static_cast<float>(std::nearbyint(pixels * 2048) / 2048);
  };
  std::vector<Corner> out;
  out.reserve(size_t{count} * 3);
  for (uint32_t i = 0; i < count; ++i) {
    const double x = between(-20, size + 20), y = between(-20, size + 20);
    const double along_x = between(-150, 150), along_y = between(-150, 150);
    for (int corner = 0; corner < 3; ++corner) {
      double px = x, py = y;
      switch (kind) {
        case GridKind::kSmall:
          px += between(-4, 4);
          py += between(-4, 4);
          break;
        case GridKind::kMedium:
          px += between(-size / 4, size / 4);
          py += between(-size / 4, size / 4);
          break;
        case GridKind::kHuge:
          px = std::nearbyint(px + between(-4000, 4000));
          py = std::nearbyint(py + between(-4000, 4000));
          break;
        case GridKind::kSliver:
          px += along_x * corner / 2 + between(-0.6, 0.6);
          py += along_y * corner / 2 + between(-0.6, 0.6);
          break;
        case GridKind::kCenters:
          px = std::floor(px + between(-20, 20)) + 0.5;
          py = std::floor(py + between(-20, 20)) + 0.5;
          break;
      }
      const auto w = static_cast<float>(std::ldexp(1.0, static_cast<int>(random() % 6) - 1));
      const auto z = static_cast<float>(random() % 65537) / 65536;
      const auto value = static_cast<float>(random() % 65537) / 65536;
      out.push_back(screen.at(on_grid(px), on_grid(py), z, w, {value, 0, 0, 1}));
    }
  }
  return out;
}

double ProjectedTriangle::Plane::slope() const {
  return std::sqrt(a * a + b * b);
}

ProjectedTriangle::Plane ProjectedTriangle::combine(const double factors[3]) const {
  Plane out = {};
  for (int i = 0; i < 3; ++i) {
    out.a += weights_[i].a * factors[i];
    out.b += weights_[i].b * factors[i];
    out.c += weights_[i].c * factors[i];
  }
  return out;
}

// A point of the triangle, sum of b[i] * corner[i], is seen at (x / w, y / w). So b[i] / w are the
// solution of sum of b[i] / w * (x, y, w)[i] = (X, Y, 1), which is linear in X and Y.
ProjectedTriangle::ProjectedTriangle(uint32_t size, const Corner* corners) {
  double p[3][3], z[3], value[3];
  for (int i = 0; i < 3; ++i) {
    const auto& position = corners[i].position;
    p[i][0] = static_cast<double>(position[0]);
    p[i][1] = static_cast<double>(position[1]);
    p[i][2] = static_cast<double>(position[3]);
    z[i] = static_cast<double>(position[2]);
    value[i] = static_cast<double>(corners[i].value[0]);
  }
  const auto cross = [&](int i, int k) {
    return std::array<double, 3>{p[i][1] * p[k][2] - p[i][2] * p[k][1],
                                 p[i][2] * p[k][0] - p[i][0] * p[k][2],
                                 p[i][0] * p[k][1] - p[i][1] * p[k][0]};
  };
  const auto first = cross(1, 2);
  const double det = p[0][0] * first[0] + p[0][1] * first[1] + p[0][2] * first[2];
  has_area_ = det != 0;
  if (!has_area_) return;
  // X = (x + 0.5) / half - 1, Y = 1 - (y + 0.5) / half.
  const double half = size / 2.0;
  for (int i = 0; i < 3; ++i) {
    const auto normal = cross((i + 1) % 3, (i + 2) % 3);
    weights_[i] = {normal[0] / det / half, -normal[1] / det / half,
                   (normal[0] * (0.5 / half - 1) + normal[1] * (1 - 0.5 / half) + normal[2]) / det};
  }
  constexpr double kOnes[3] = {1, 1, 1};
  inv_w_ = combine(kOnes);
  depth_ = combine(z);
  value_over_w_ = combine(value);
}

ProjectedTriangle::Pixel ProjectedTriangle::at(uint32_t px, uint32_t py) const {
  Pixel out;
  if (!has_area_) return out;
  const double x = px, y = py;
  out.inside = true;
  // Borders: the edges, near, far. Rounding moves them by 1/256 pixel and a little.
  constexpr double kNear = 1.0 / 64;
  bool outside = false;
  const auto border = [&](double distance, double slope) {
    out.inside = out.inside && distance > 0;
    outside = outside || distance < -slope * kNear;
    out.near_border = out.near_border || std::abs(distance) <= slope * kNear;
  };
  for (const Plane& weight : weights_) border(weight.at(x, y), weight.slope());
  out.depth = depth_.at(x, y);
  border(out.depth, depth_.slope());
  border(1 - out.depth, depth_.slope());
  out.near_border = out.near_border && !outside;
  const double w = 1 / inv_w_.at(x, y);
  out.value = value_over_w_.at(x, y) * w;
  out.depth_bound = depth_.slope() / 256 + 0x1p-20;
  out.value_bound =
      std::abs(w) * (value_over_w_.slope() + std::abs(out.value) * inv_w_.slope()) / 256 + 0x1p-14;
  return out;
}

std::vector<Corner> eye_triangles(uint32_t count, std::mt19937& random) {
  const auto number = [&] {
    return static_cast<float>(static_cast<int>(random() % 4097) - 2048) / 256;
  };
  std::vector<Corner> out;
  while (out.size() < size_t{count} * 3) {
    Corner corners[3];
    bool before = false;
    for (Corner& corner : corners) {
      corner.position = {number(), number(), number(), number()};
      corner.value[0] = static_cast<float>(random() % 257) / 256;
      before = before || corner.position[3] > 0;
    }
    if (before) out.insert(out.end(), corners, corners + 3);
  }
  return out;
}

}  // namespace kaamos::conformance
