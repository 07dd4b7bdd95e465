// SPDX-License-Identifier: MIT
/// @file
/// A-SVGF: samples of the frame before, taken again to tell what has changed from noise.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "effects/denoise/temporal_gradients.h"
#include "effects/northlight/active_effect.h"
#include "effects/northlight/frame_context.h"

namespace kaamos::effects {

/// The temporal gradients of a frame's effects. Without that denoiser, and in frames that do not
/// move, it does nothing.
class GradientStage {
 public:
  /// The context must stay.
  explicit GradientStage(FrameContext& context) : context_(context) {}
  GradientStage(const GradientStage&) = delete;
  GradientStage& operator=(const GradientStage&) = delete;

  /// Takes those of the effects whose samples can be taken again, up to kMostGradients.
  /// @errors those of TemporalGradients.
  rtapi::Status create(const std::vector<std::unique_ptr<ActiveEffect>>& effects);
  /// Executes what chooses the samples, behind the G-buffer.
  /// @errors those of the device.
  rtapi::Status begin();
  /// Executes an effect's samples of the frame before, behind those of this one.
  /// @errors those of the device.
  rtapi::Status repeat(const ActiveEffect& effect);
  /// Executes what makes gradients of them, behind the effects and before their signals are
  /// denoised.
  /// @errors those of the device.
  rtapi::Status finish();
  /// There is no frame before any more.
  void forget() {
    if (gradients_) gradients_->forget();
  }
  /// The channel of an effect's first signal among the changes; none: it has no gradient.
  std::optional<std::uint32_t> channel(const ActiveEffect& effect) const;
  /// Null: the denoiser needs none.
  const TemporalGradients* gradients() const { return gradients_ ? &*gradients_ : nullptr; }

 private:
  struct Repeated {
    const ActiveEffect* effect = nullptr;
    SignalPictures pictures;  // which the views name
    PassViews views;
    std::uint32_t channel = 0;
  };

  rtapi::Status add(const ActiveEffect& effect);
  const Repeated* find(const ActiveEffect& effect) const;

  FrameContext& context_;
  std::optional<TemporalGradients> gradients_;
  std::vector<Repeated> effects_;
  std::uint32_t past_index_ = 0;  // of the frame that they keep
};

}  // namespace kaamos::effects
