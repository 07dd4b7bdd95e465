// SPDX-License-Identifier: MIT
#include "effects/assets/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace kaamos::effects {
namespace {

std::string size_text(const FloatImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " +
         std::to_string(image.channels);
}

Status same_size(const FloatImage& a, const FloatImage& b) {
  if (a.width == b.width && a.height == b.height && a.channels == b.channels &&
      a.values.size() == b.values.size()) {
    return {};
  }
  return make_error(ErrorId::kPictures, "cannot measure a picture of " + size_text(a) +
                                            " against one of " + size_text(b));
}

// The mean without the largest thousandth of the values.
double trimmed_mean(std::vector<double>& values) {
  if (values.empty()) return 0;
  const std::size_t kept = values.size() - values.size() / 1000;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept - 1),
                   values.end());
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += values[i];
  return sum / static_cast<double>(kept);
}

constexpr int kWindow = 5;  // pixels to each side

std::vector<double> gaussian_window() {
  std::vector<double> weights;
  double sum = 0;
  for (int i = -kWindow; i <= kWindow; ++i) {
    weights.push_back(std::exp(-i * i / (2 * 1.5 * 1.5)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// One channel, blurred along both axes.
std::vector<double> blurred(const std::vector<double>& plane, int width, int height) {
  const std::vector<double> weights = gaussian_window();
  std::vector<double> rows(plane.size()), out(plane.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int i = -kWindow; i <= kWindow; ++i) {
        sum += weights[i + kWindow] * plane[y * width + std::clamp(x + i, 0, width - 1)];
      }
      rows[y * width + x] = sum;
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int i = -kWindow; i <= kWindow; ++i) {
        sum += weights[i + kWindow] * rows[std::clamp(y + i, 0, height - 1) * width + x];
      }
      out[y * width + x] = sum;
    }
  }
  return out;
}

double ssim_of_planes(const std::vector<double>& a, const std::vector<double>& b, int width,
                      int height) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  std::vector<double> aa(a.size()), bb(a.size()), ab(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa[i] = a[i] * a[i];
    bb[i] = b[i] * b[i];
    ab[i] = a[i] * b[i];
  }
  const auto mean_a = blurred(a, width, height), mean_b = blurred(b, width, height);
  aa = blurred(aa, width, height);
  bb = blurred(bb, width, height);
  ab = blurred(ab, width, height);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double m = mean_a[i], n = mean_b[i];
    const double covariance = ab[i] - m * n;
    const double variances = aa[i] - m * m + bb[i] - n * n;
    sum += (2 * m * n + kC1) * (2 * covariance + kC2) / ((m * m + n * n + kC1) * (variances + kC2));
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace

Result<Metrics> measure(const FloatImage& picture, const FloatImage& reference,
                        std::span<const std::uint8_t> mask) {
  if (const Status s = same_size(picture, reference); !s.ok()) return s.error();
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  if (!mask.empty() && mask.size() != pixels) {
    return make_error(ErrorId::kPictures, "the mask has " + std::to_string(mask.size()) +
                                              " pixels and the picture " + std::to_string(pixels));
  }
  Metrics out;
  double squares = 0, differences = 0, energy = 0, reference_energy = 0;
  std::vector<double> relative;
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    if (!mask.empty() && mask[i / picture.channels] == 0) continue;
    const double x = picture.values[i], r = reference.values[i];
    if (!std::isfinite(x) || !std::isfinite(r)) {
      ++out.not_finite;
      continue;
    }
    squares += (x - r) * (x - r);
    differences += x - r;
    energy += x;
    reference_energy += r;
    relative.push_back((x - r) * (x - r) / (r * r + 0.01));
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (relative.empty()) return out;
  const auto count = static_cast<double>(relative.size());
  out.rmse = std::sqrt(squares / count);
  out.bias = differences / count;
  for (const double value : relative) out.relative_mse += value / count;
  out.trimmed_relative_mse = trimmed_mean(relative);
  out.psnr = squares > 0 ? -10 * std::log10(squares / count) : kInfinity;
  out.energy_ratio = reference_energy != 0 ? energy / reference_energy
                     : energy != 0         ? kInfinity
                                           : 1;
  return out;
}

Result<double> ssim(const FloatImage& picture, const FloatImage& reference) {
  if (const Status s = same_size(picture, reference); !s.ok()) return s.error();
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  if (picture.values.empty()) return 1.0;
  double sum = 0;
  for (std::uint32_t c = 0; c < picture.channels; ++c) {
    std::vector<double> a, b;
    for (std::size_t i = c; i < picture.values.size(); i += picture.channels) {
      a.push_back(picture.values[i]);
      b.push_back(reference.values[i]);
    }
    sum += ssim_of_planes(a, b, width, height);
  }
  return sum / picture.channels;
}

Result<ErrorParts> split_error(std::span<const FloatImage> pictures, const FloatImage& reference) {
  if (pictures.size() < 2) {
    return make_error(ErrorId::kPictures, "bias and variance need 2 pictures or more, there are " +
                                              std::to_string(pictures.size()));
  }
  for (const FloatImage& picture : pictures) {
    if (const Status s = same_size(picture, reference); !s.ok()) return s.error();
  }
  const auto n = static_cast<double>(pictures.size());
  ErrorParts out;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    double sum = 0, squares = 0;
    for (const FloatImage& picture : pictures) sum += picture.values[i];
    const double mean = sum / n;
    for (const FloatImage& picture : pictures) {
      squares += (picture.values[i] - mean) * (picture.values[i] - mean);
    }
    const double variance = squares / (n - 1);
    const double bias = mean - reference.values[i];
    out.variance += variance;
    out.bias_squared += bias * bias - variance / n;
  }
  out.variance /= static_cast<double>(reference.values.size());
  out.bias_squared /= static_cast<double>(reference.values.size());
  return out;
}

Result<double> flicker(const FloatImage& previous, const FloatImage& current,
                       const FloatImage& previous_reference, const FloatImage& reference) {
  for (const FloatImage* image : {&previous, &previous_reference, &reference}) {
    if (const Status s = same_size(*image, current); !s.ok()) return s.error();
  }
  double sum = 0;
  for (std::size_t i = 0; i < current.values.size(); ++i) {
    sum += std::abs(double{current.values[i]} - previous.values[i]) -
           std::abs(double{reference.values[i]} - previous_reference.values[i]);
  }
  return sum / static_cast<double>(std::max<std::size_t>(current.values.size(), 1));
}

}  // namespace kaamos::effects
