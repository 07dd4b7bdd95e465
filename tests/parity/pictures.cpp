// SPDX-License-Identifier: MIT
#include "tests/parity/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

namespace kaamos::parity {

using effects::FloatImage;

namespace {

std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string line(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

bool same_size(const FloatImage& a, const FloatImage& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

// Infinite if only one of them is a number.
double apart(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double difference = std::fabs(double{a} - b);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double apart(const FloatImage& a, uint32_t ax, uint32_t ay, const FloatImage& b, uint32_t bx,
             uint32_t by) {
  double most = 0;
  for (uint32_t c = 0; c < a.channels; ++c) {
    most = std::max(most, apart(a.at(ax, ay, c), b.at(bx, by, c)));
  }
  return most;
}

// Tells whether a neighbour of (x, y) in `picture` shows what `other` shows at (x, y).
bool is_next_to(const FloatImage& picture, const FloatImage& other, uint32_t x, uint32_t y,
                double close) {
  for (uint32_t ny = y - (y > 0); ny <= std::min(y + 1, picture.height - 1); ++ny) {
    for (uint32_t nx = x - (x > 0); nx <= std::min(x + 1, picture.width - 1); ++nx) {
      if ((nx != x || ny != y) && apart(picture, nx, ny, other, x, y) <= close) return true;
    }
  }
  return false;
}

double psnr(double squares, double values) {
  if (squares == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(values / squares);
}

bool same_ids(const FloatImage& a, const FloatImage& b, uint32_t x, uint32_t y) {
  return apart(a, x, y, b, x, y) == 0;
}

}  // namespace

PictureDifference compare_pictures(const FloatImage& a, const FloatImage& b,
                                   const PictureLimits& limits) {
  PictureDifference out;
  if (!same_size(a, b)) return out;
  out.pixels = uint64_t{a.width} * a.height;
  double squares = 0;
  double squares_of_all = 0;
  for (uint32_t y = 0; y < a.height; ++y) {
    for (uint32_t x = 0; x < a.width; ++x) {
      const double difference = apart(a, x, y, b, x, y);
      if (difference == 0) continue;
      ++out.unequal;
      double sum = 0;
      for (uint32_t c = 0; c < a.channels; ++c) {
        const double d = apart(a.at(x, y, c), b.at(x, y, c));
        sum += d * d;
      }
      squares_of_all += sum;
      if (difference > limits.close && is_next_to(a, b, x, y, limits.close)) {
        ++out.silhouettes;
        continue;
      }
      squares += sum;
      if (difference > out.worst) {
        out.worst = difference;
        out.worst_x = x;
        out.worst_y = y;
      }
    }
  }
  const double values = static_cast<double>(out.pixels) * a.channels;
  out.psnr = psnr(squares, values);
  out.psnr_of_all = psnr(squares_of_all, values);
  return out;
}

std::string judge(const PictureDifference& difference, const PictureLimits& limits) {
  if (difference.pixels == 0) return "the pictures have different sizes";
  std::string text;
  if (!(difference.psnr >= limits.psnr)) {
    text += line("%.1f dB, wanted %.0f; ", difference.psnr, limits.psnr);
  }
  const double allowed = limits.silhouettes * static_cast<double>(difference.pixels);
  if (static_cast<double>(difference.silhouettes) > allowed) {
    text += line("%llu silhouette pixels differ, allowed %.0f; ",
                 static_cast<unsigned long long>(difference.silhouettes), allowed);
  }
  return text;
}

std::string describe(const PictureDifference& d) {
  return line(
      "%.1f dB (%.1f with silhouettes), %llu of %llu pixels differ, %llu of them at "
      "silhouettes, worst (%u, %u) by %.3g",
      d.psnr, d.psnr_of_all, static_cast<unsigned long long>(d.unequal),
      static_cast<unsigned long long>(d.pixels), static_cast<unsigned long long>(d.silhouettes),
      d.worst_x, d.worst_y, d.worst);
}

SumDifference compare_sums(const FloatImage& a, const FloatImage& b, const FloatImage& ids_a,
                           const FloatImage& ids_b, uint32_t samples) {
  SumDifference out;
  if (!same_size(a, b) || !same_size(ids_a, ids_b)) return out;
  for (uint32_t y = 0; y < a.height; ++y) {
    for (uint32_t x = 0; x < a.width; ++x) {
      if (!same_ids(ids_a, ids_b, x, y)) {
        ++out.changed;
        continue;
      }
      ++out.pixels;
      const double difference = apart(a, x, y, b, x, y);
      out.different += difference;
      if (difference > out.worst) {
        out.worst = difference;
        out.worst_x = x;
        out.worst_y = y;
      }
    }
  }
  out.rays = static_cast<double>(out.pixels) * samples;
  return out;
}

std::string judge(const SumDifference& difference, double allowed) {
  if (difference.pixels == 0) return "the pictures have different sizes, or nothing in common";
  if (difference.different <= std::max(allowed * difference.rays, 1.0)) return {};
  return line("visibility differs in %.0f of %.0f rays, allowed %.0f; ", difference.different,
              difference.rays, allowed * difference.rays);
}

std::string describe(const SumDifference& d) {
  return line(
      "%.0f of %.0f rays differ (%.2g), %llu pixels see another triangle, worst (%u, %u) "
      "by %.0f rays",
      d.different, d.rays, d.different / d.rays, static_cast<unsigned long long>(d.changed),
      d.worst_x, d.worst_y, d.worst);
}

LayerDifference compare_layers(const FloatImage& a, const FloatImage& b, const FloatImage& ids_a,
                               const FloatImage& ids_b, double allowed) {
  LayerDifference out;
  out.worst = std::numeric_limits<double>::infinity();
  if (!same_size(a, b) || !same_size(ids_a, ids_b)) return out;
  out.worst = 0;
  for (uint32_t y = 0; y < a.height; ++y) {
    for (uint32_t x = 0; x < a.width; ++x) {
      if (!same_ids(ids_a, ids_b, x, y)) continue;
      double size = 1;
      for (uint32_t c = 0; c < a.channels; ++c) {
        const double value = std::fabs(double{a.at(x, y, c)});
        if (std::isfinite(value)) size = std::max(size, value);
      }
      const double difference = apart(a, x, y, b, x, y) / size;
      out.above += difference > allowed;
      if (difference > out.worst) {
        out.worst = difference;
        out.worst_x = x;
        out.worst_y = y;
      }
    }
  }
  return out;
}

FloatImage floats(const effects::ByteImage& image) {
  FloatImage out(image.width, image.height, image.channels);
  for (size_t i = 0; i < image.values.size(); ++i) {
    out.values[i] = static_cast<float>(image.values[i]) / 255.0f;
  }
  return out;
}

}  // namespace kaamos::parity
