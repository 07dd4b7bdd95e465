// SPDX-License-Identifier: MIT
#include "effects/measure/errors/measure_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "effects/assets/image/flip.h"
#include "effects/assets/image/metrics.h"
#include "effects/assets/image/tonemap.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

float srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace

FloatImage as_seen(const FloatImage& image, float exposure) {
  FloatImage out(image.width, image.height, 3);
  for (std::size_t pixel = 0; pixel < out.values.size() / 3; ++pixel) {
    const float* in = &image.values[pixel * image.channels];
    for (std::uint32_t c = 0; c < 3; ++c) {
      // Two visibilities have no colors; show their mean.
      const float value = image.channels == 3   ? in[c]
                          : image.channels == 2 ? 0.5f * (in[0] + in[1])
                                                : in[0];
      out.values[pixel * 3 + c] =
          exposure > 0 ? srgb(filmic(value * exposure)) : std::clamp(value, 0.0f, 1.0f);
    }
  }
  return out;
}

std::string Errors::add(const FloatImage& image, const Target& target) {
  const auto linear = effects::measure(image, target.image, target.mask);
  if (!linear.ok()) return linear.error().message;
  const FloatImage seen = as_seen(image, target.exposure);
  const FloatImage wanted = as_seen(target.image, target.exposure);
  const auto shown = effects::measure(seen, wanted, target.mask);
  if (!shown.ok()) return shown.error().message;
  const auto structure = ssim(seen, wanted);
  if (!structure.ok()) return structure.error().message;
  const auto perceived = flip(seen, wanted);
  if (!perceived.ok()) return perceived.error().message;

  const Metrics& m = linear.value();
  mse_ += m.rmse * m.rmse;
  seen_mse_ += shown.value().rmse * shown.value().rmse;
  sums_.relative_mse += m.relative_mse;
  sums_.trimmed_relative_mse += m.trimmed_relative_mse;
  sums_.energy_ratio += m.energy_ratio;
  sums_.ssim += structure.value();
  sums_.flip += perceived.value().mean;
  sums_.not_finite += m.not_finite;
  sum_.resize(image.values.size());
  squares_.resize(image.values.size());
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    // Summing differences loses no digits where a picture hardly varies.
    const double d = static_cast<double>(image.values[i]) - target.image.values[i];
    sum_[i] += d;
    squares_[i] += d * d;
  }
  ++runs_;
  return {};
}

Errors::Summary Errors::summary(const Target& target) const {
  Summary out = sums_;
  const double n = runs_;
  out.rmse = std::sqrt(mse_ / n);
  out.relative_mse /= n;
  out.trimmed_relative_mse /= n;
  out.energy_ratio /= n;
  out.ssim /= n;
  out.flip /= n;
  out.psnr =
      seen_mse_ > 0 ? -10 * std::log10(seen_mse_ / n) : std::numeric_limits<double>::infinity();
  if (runs_ < 2) {
    out.bias_squared = out.variance = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  double bias_squared = 0, variance = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    if (target.mask[i / target.image.channels] == 0 || !std::isfinite(squares_[i])) continue;
    const double mean = sum_[i] / n;
    const double v = std::max(0.0, (squares_[i] - n * mean * mean) / (n - 1));
    variance += v;
    bias_squared += mean * mean - v / n;  // the mean of a few runs has variance of its own
    ++count;
  }
  out.bias_squared = count > 0 ? bias_squared / static_cast<double>(count) : 0;
  out.variance = count > 0 ? variance / static_cast<double>(count) : 0;
  return out;
}

}  // namespace kaamos::measure
