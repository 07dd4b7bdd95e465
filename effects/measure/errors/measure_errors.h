// SPDX-License-Identifier: MIT
// The errors of one setting over several runs with independent seeds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effects/assets/image/image.h"

namespace kaamos::measure {

// A reference picture, also in the form in which people see it.
struct Target {
  effects::FloatImage image;
  std::vector<std::uint8_t> mask;  // pixels to compare
  float exposure = 0;              // for light, to tone map it; 0: visibility, shown as it is
  double own_rmse = 0;             // standard error of the reference itself; 0: exact
};

// RGB from 0 to 1, as a screen shows it.
effects::FloatImage as_seen(const effects::FloatImage& image, float exposure);

class Errors {
 public:
  // Returns an error text, empty on success. `target` must not change between calls.
  std::string add(const effects::FloatImage& image, const Target& target);

  // Means over the runs.
  struct Summary {
    double rmse = 0, relative_mse = 0, trimmed_relative_mse = 0, energy_ratio = 0;
    double psnr = 0, ssim = 0, flip = 0;    // of what people see
    double bias_squared = 0, variance = 0;  // NaN for fewer than 2 runs
    std::uint64_t not_finite = 0;
  };
  Summary summary(const Target& target) const;

 private:
  std::vector<double> sum_, squares_;  // one for each value
  double mse_ = 0, seen_mse_ = 0;
  Summary sums_;
  std::uint32_t runs_ = 0;
};

}  // namespace kaamos::measure
