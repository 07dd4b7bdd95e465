// SPDX-License-Identifier: MIT
/// @file
/// Turns a sum over samples into the signal that a denoiser reads: their mean, at every pixel.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"

namespace kaamos::effects {

struct DenoiseLibraries;

/// The pass that makes a signal of a sum.
class SumLoad {
 public:
  /// No pass.
  SumLoad() = default;
  /// Makes the pass. `sum`: a picture of one float or of four; `into`: R32G32B32A32_FLOAT, three
  /// equal channels of one float. `step` 2: only one pixel of each 2 x 2 of `sum` was written
  /// (PassConstants::pixel_step), the others are worked out from them by joint bilateral upscaling.
  /// Both must outlive it. [Kopf et al. 2007]
  /// @errors those of the device; KA0537 a library without a kernel.
  static rtapi::Result<SumLoad> create(const rtapi::Device& device, const Frame& frame,
                                       const DenoiseLibraries& libraries, const rtapi::Texture& sum,
                                       const rtapi::Texture& into, std::uint32_t step = 1);
  /// Records it: `into` = `scale` * sum. `pixel_offset`: which pixel of each 2 x 2 was written.
  /// [PassConstants::pixel_offset]
  void record(rtapi::CommandList& list, const Frame& frame, float scale,
              std::uint32_t pixel_offset = 0) const;

  /// Null: no pass.
  const rtapi::Texture& sum() const { return sum_; }

 private:
  rtapi::Texture sum_;
  std::shared_ptr<ComputePass> pass_;
  PassViews views_;
};

}  // namespace kaamos::effects
