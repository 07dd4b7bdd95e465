// SPDX-License-Identifier: MIT
/// @file
/// The finished radiance of a frame, kept for the next one. Reflections that are found in the
/// picture may take it from there: it has reflections itself, and glass. [survey 6.2]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/compute_pass.h"

namespace kaamos::effects {

/// A copy of kRadiance with the view depth of each pixel.
class KeptRadiance {
 public:
  /// Makes the picture and the passes that write it. Record record_nothing first.
  /// @errors KA0537 a library without the passes; those of Frame::create_pass_views and of
  /// rtapi::Device::CreateTexture.
  static rtapi::Result<KeptRadiance> create(const rtapi::Device& device, const Frame& frame,
                                            const rtapi::ShaderLibrary& library);
  /// Records the copy of a finished frame.
  void record(rtapi::CommandList& list, const Frame& frame) const;
  /// Records that there is no frame before, as at the start and after a cut.
  void record_nothing(rtapi::CommandList& list, const Frame& frame) const;
  /// R32G32B32A32_FLOAT: radiance, and view depth in metres; 0: sky; negative: there is no frame
  /// before.
  const rtapi::Texture& picture() const { return picture_; }

 private:
  ComputePass keep_, forget_;
  PassViews views_;
  rtapi::Texture picture_;
};

}  // namespace kaamos::effects
