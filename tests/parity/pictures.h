// SPDX-License-Identifier: MIT
//
// Compares pictures that the same program renders on two backends.
#pragma once

#include <cstdint>
#include <string>

#include "effects/assets/image/image.h"

namespace kaamos::parity {

struct PictureLimits {
  double psnr = 50;            // decibels, without the silhouettes
  double silhouettes = 5e-3;   // of pixels
  double close = 3.0 / 255.0;  // values this close show the same thing
};

struct PictureDifference {
  uint64_t pixels = 0;
  uint64_t unequal = 0;      // pixels that differ at all
  uint64_t silhouettes = 0;  // pixels that show what a neighbour shows on the other backend
  double psnr = 0;           // of all other pixels
  double psnr_of_all = 0;
  uint32_t worst_x = 0, worst_y = 0;  // among the other pixels
  double worst = 0;
};

// Values are 0 to 1. Both pictures must have the same size; otherwise the result is all zero.
PictureDifference compare_pictures(const effects::FloatImage& a, const effects::FloatImage& b,
                                   const PictureLimits& limits = {});
std::string judge(const PictureDifference& difference, const PictureLimits& limits = {});
std::string describe(const PictureDifference& difference);

// Compares whole-number sums of visible samples per pixel. Pixels whose `ids` differ see different
// points and are left out.
struct SumDifference {
  uint64_t pixels = 0;   // with the same ids
  uint64_t changed = 0;  // with different ids
  double rays = 0;
  double different = 0;  // how far pixels are apart in rays, summed up
  uint32_t worst_x = 0, worst_y = 0;
  double worst = 0;
};
SumDifference compare_sums(const effects::FloatImage& a, const effects::FloatImage& b,
                           const effects::FloatImage& ids_a, const effects::FloatImage& ids_b,
                           uint32_t samples);
// Visibility may differ in at most 1e-4 of the rays.
std::string judge(const SumDifference& difference, double allowed = 1e-4);
std::string describe(const SumDifference& difference);

// Values of all pixels whose `ids` are the same: the largest difference, relative to the larger of
// the two values and 1.
struct LayerDifference {
  double worst = 0;
  uint32_t worst_x = 0, worst_y = 0;
  uint64_t above = 0;  // pixels further apart than `allowed`
};
LayerDifference compare_layers(const effects::FloatImage& a, const effects::FloatImage& b,
                               const effects::FloatImage& ids_a, const effects::FloatImage& ids_b,
                               double allowed);

// A PNG's bytes as values from 0 to 1.
effects::FloatImage floats(const effects::ByteImage& image);

}  // namespace kaamos::parity
