// SPDX-License-Identifier: MIT
#include "compare_renderers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace kaamos {

using effects::FloatImage;

namespace {

/// Sums over the pixels of a tile or of a picture, for one channel.
struct Sums {
  double first = 0.0, second = 0.0;
  double variance = 0.0;  // of the difference of the renderers' means, pixel by pixel
  double squares = 0.0;   // of that difference
  std::uint64_t count = 0;

  void add(const TwoHalves& a, const TwoHalves& b, std::uint32_t x, std::uint32_t y,
           std::uint32_t c) {
    const double a0 = a[0].at(x, y, c), a1 = a[1].at(x, y, c);
    const double b0 = b[0].at(x, y, c), b1 = b[1].at(x, y, c);
    const double apart = 0.5 * (a0 + a1) - 0.5 * (b0 + b1);
    first += 0.5 * (a0 + a1);
    second += 0.5 * (b0 + b1);
    // The mean of two halves has a quarter of their squared difference as its variance.
    variance += 0.25 * ((a0 - a1) * (a0 - a1) + (b0 - b1) * (b0 - b1));
    squares += apart * apart;
    ++count;
  }
  void add(const Sums& other) {
    first += other.first;
    second += other.second;
    variance += other.variance;
    squares += other.squares;
    count += other.count;
  }
  double bias() const { return (first - second) / static_cast<double>(count); }
  double bias_error() const { return std::sqrt(variance) / static_cast<double>(count); }
};

bool is_usable(const FloatImage& image, const FloatImage& like) {
  if (image.width != like.width || image.height != like.height || image.channels < 3) return false;
  return std::all_of(image.values.begin(), image.values.end(),
                     [](float value) { return std::isfinite(value); });
}

}  // namespace

effects::Result<FloatImage> smooth_pixels(const FloatImage& ids, const FloatImage& normal) {
  if (ids.width != normal.width || ids.height != normal.height || normal.channels < 2)
    return effects::make_error(effects::ErrorId::kPictures, "ids and normals of different sizes");
  FloatImage out(ids.width, ids.height, 1);
  const auto is_like = [&](std::uint32_t x, std::uint32_t y, std::uint32_t u, std::uint32_t v) {
    return ids.at(x, y) == ids.at(u, v) &&
           std::abs(normal.at(x, y, 0) - normal.at(u, v, 0)) < 1e-3f &&
           std::abs(normal.at(x, y, 1) - normal.at(u, v, 1)) < 1e-3f;
  };
  for (std::uint32_t y = 1; y + 1 < ids.height; ++y) {
    for (std::uint32_t x = 1; x + 1 < ids.width; ++x) {
      bool is_smooth = true;
      for (std::uint32_t i = 0; i < 9; ++i)
        is_smooth = is_smooth && is_like(x, y, x + i % 3 - 1, y + i / 3 - 1);
      out.at(x, y) = is_smooth ? 1.0f : 0.0f;
    }
  }
  return out;
}

effects::Result<RendererDifference> compare_renderers(const TwoHalves& first,
                                                      const TwoHalves& second,
                                                      const FloatImage& smooth,
                                                      const Allowance& allowance) {
  for (const TwoHalves* halves : {&first, &second}) {
    for (const FloatImage& image : *halves) {
      if (!is_usable(image, smooth))
        return effects::make_error(effects::ErrorId::kPictures,
                                   "pictures of different sizes, or not finite");
    }
  }
  RendererDifference out;
  Sums all;
  for (std::uint32_t y = 0; y < smooth.height; y += allowance.tile) {
    for (std::uint32_t x = 0; x < smooth.width; x += allowance.tile) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        Sums tile;
        for (std::uint32_t v = y; v < std::min(y + allowance.tile, smooth.height); ++v)
          for (std::uint32_t u = x; u < std::min(x + allowance.tile, smooth.width); ++u)
            if (smooth.at(u, v) != 0.0f) tile.add(first, second, u, v, c);
        if (tile.count == 0) continue;
        all.add(tile);
        const double mean = tile.second / static_cast<double>(tile.count);
        const double allowed =
            allowance.errors * tile.bias_error() + allowance.relative * mean + 1e-7;
        if (std::abs(tile.bias()) / allowed <= out.worst_tile) continue;
        out.worst_tile = std::abs(tile.bias()) / allowed;
        out.tile_x = x + allowance.tile / 2;
        out.tile_y = y + allowance.tile / 2;
        out.tile_difference = mean > 0.0 ? tile.bias() / mean : 0.0;
      }
    }
  }
  if (all.count == 0)
    return effects::make_error(effects::ErrorId::kPictures, "there is no smooth pixel");
  const double count = static_cast<double>(all.count);
  out.pixels = all.count / 3;
  out.mean = all.second / count;
  out.bias = all.bias();
  out.bias_error = all.bias_error();
  out.rms = std::sqrt(all.squares / count);
  out.expected_rms = std::sqrt(all.variance / count);
  return out;
}

bool agrees(const RendererDifference& difference, const Allowance& allowance) {
  return difference.worst_tile <= 1.0 &&
         std::abs(difference.bias) <=
             allowance.errors * difference.bias_error + allowance.relative * difference.mean;
}

std::string describe(const RendererDifference& d) {
  char text[200];
  std::snprintf(text, sizeof(text),
                "mean %.5f, apart %+.3f %% +- %.3f %%, rms %.5f of expected %.5f, worst tile %.2f "
                "of its allowance at %u,%u (%+.2f %%)",
                d.mean, 100.0 * d.bias / d.mean, 100.0 * d.bias_error / d.mean, d.rms,
                d.expected_rms, d.worst_tile, d.tile_x, d.tile_y, 100.0 * d.tile_difference);
  return text;
}

}  // namespace kaamos
