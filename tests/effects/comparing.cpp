// SPDX-License-Identifier: MIT
#include "comparing.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace kaamos::test {

using effects::FloatImage;

namespace {

double largest(const FloatImage& image) {
  double out = 1e-30;
  for (const float value : image.values) {
    if (std::isfinite(value)) out = std::max(out, std::abs(static_cast<double>(value)));
  }
  return out;
}

double difference(float a, float b, double largest_value) {
  const bool finite = std::isfinite(a) && std::isfinite(b);
  if (finite) return std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isfinite(a) == std::isfinite(b) ? 0 : largest_value;
}

}  // namespace

std::string differing(const Pictures& a, const Pictures& b, const std::vector<std::string>& but) {
  std::string out;
  for (const auto& [name, image] : a) {
    if (std::find(but.begin(), but.end(), name) != but.end()) continue;
    const auto& other = b.at(name).values;
    if (other.size() != image.values.size() ||
        std::memcmp(other.data(), image.values.data(), other.size() * sizeof(float)) != 0) {
      out += (out.empty() ? "" : ", ") + name;
    }
  }
  return out;
}

double decibels(const FloatImage& a, const FloatImage& reference) {
  const double peak = largest(reference);
  double sum = 0;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    const double d = difference(a.values[i], reference.values[i], peak);
    sum += d * d;
  }
  if (sum == 0) return 200;
  return 20 * std::log10(peak / std::sqrt(sum / static_cast<double>(reference.values.size())));
}

std::uint32_t pixels_off(const FloatImage& a, const FloatImage& reference, double relative) {
  const double peak = largest(reference);
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < reference.values.size(); i += reference.channels) {
    bool off = false;
    for (std::uint32_t c = 0; c < reference.channels; ++c) {
      off |= difference(a.values[i + c], reference.values[i + c], peak) > relative * peak;
    }
    out += off ? 1 : 0;
  }
  return out;
}

FloatImage reversed(const FloatImage& image) {
  FloatImage out = image;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      for (std::uint32_t c = 0; c < image.channels; ++c) {
        out.at(x, y, c) = image.at(image.width - 1 - x, y, c);
      }
    }
  }
  return out;
}

std::uint32_t not_finite(const FloatImage& image) {
  return static_cast<std::uint32_t>(std::count_if(image.values.begin(), image.values.end(),
                                                  [](float v) { return !std::isfinite(v); }));
}

std::string not_finite(const Pictures& pictures) {
  std::string out;
  for (const auto& [name, image] : pictures) {
    if (const std::uint32_t count = not_finite(image); count > 0) {
      out += (out.empty() ? "" : ", ") + name + " " + std::to_string(count);
    }
  }
  return out;
}

}  // namespace kaamos::test
