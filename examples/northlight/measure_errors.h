// SPDX-License-Identifier: MIT
// The errors of one setting over several runs with independent seeds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effects/image/image.h"

namespace northlight {

// A picture that is compared as people see it.
struct Target {
  kaamos::effects::FloatImage image;
  std::vector<std::uint8_t> mask;  // pixels that count
  float exposure = 0;              // of light, tone mapped; 0: visibility, shown as it is
  double own_rmse = 0;             // standard error of the image itself; 0: exact
};

// RGB of 0..1 as a screen shows it.
kaamos::effects::FloatImage as_seen(const kaamos::effects::FloatImage& image, float exposure);

class Errors {
 public:
  // The errors' text is empty on success. `target` must stay as it is between calls.
  std::string add(const kaamos::effects::FloatImage& image, const Target& target);

  // Means over the runs.
  struct Summary {
    double rmse = 0, relative_mse = 0, trimmed_relative_mse = 0, energy_ratio = 0;
    double psnr = 0, ssim = 0, flip = 0;    // of what is seen
    double bias_squared = 0, variance = 0;  // 2 runs or more, else nan
    std::uint64_t not_finite = 0;
  };
  Summary summary(const Target& target) const;

 private:
  std::vector<double> sum_, squares_;  // of each value
  double mse_ = 0, seen_mse_ = 0;
  Summary sums_;
  std::uint32_t runs_ = 0;
};

}  // namespace northlight
