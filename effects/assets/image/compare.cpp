// SPDX-License-Identifier: MIT
#include "effects/assets/image/compare.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace kaamos::effects {
namespace {

std::string size_text(const FloatImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " +
         std::to_string(image.channels);
}

bool same(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

Result<ImageDifference> compare(const FloatImage& a, const FloatImage& b, double peak) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels ||
      a.values.size() != b.values.size())
    return make_error(ErrorId::kPictures, "cannot compare a picture of " + size_text(a) +
                                              " with one of " + size_text(b));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ImageDifference out;
  double squares = 0.0, sum = 0.0;
  std::uint64_t counted = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const bool equal = same(a.values[i], b.values[i]);
    const bool both = std::isfinite(a.values[i]) && std::isfinite(b.values[i]);
    double difference = 0.0;
    if (both) {
      difference = static_cast<double>(a.values[i]) - b.values[i];
      squares += difference * difference;
      sum += difference;
      ++counted;
    } else if (!equal) {
      difference = kInfinity;
    }
    if (!equal) ++out.unequal;
    if (std::abs(difference) > out.max_abs) {
      out.max_abs = std::abs(difference);
      const std::size_t pixel = i / a.channels;
      out.worst_x = static_cast<std::uint32_t>(pixel % a.width);
      out.worst_y = static_cast<std::uint32_t>(pixel / a.width);
      out.worst_channel = static_cast<std::uint32_t>(i % a.channels);
    }
  }
  if (counted > 0) {
    out.mse = squares / static_cast<double>(counted);
    out.bias = sum / static_cast<double>(counted);
  }
  out.psnr = out.mse > 0.0 ? 10.0 * std::log10(peak * peak / out.mse) : kInfinity;
  return out;
}

std::string describe(const ImageDifference& d) {
  char text[256];
  std::snprintf(text, sizeof text,
                "mse %.3g, psnr %.2f dB, bias %.3g, %llu values differ, worst %.6g at pixel "
                "(%u,%u) channel %u",
                d.mse, d.psnr, d.bias, static_cast<unsigned long long>(d.unequal), d.max_abs,
                d.worst_x, d.worst_y, d.worst_channel);
  return text;
}

}  // namespace kaamos::effects
