// SPDX-License-Identifier: MIT
/// @file
/// The effects of a frame, in the order of their rows.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/composition/composite/kept_radiance.h"
#include "effects/northlight/active_effect.h"
#include "effects/northlight/frame_context.h"
#include "effects/northlight/gradient_stage.h"
#include "effects/northlight/light_stage.h"
#include "effects/surfaces/ray_order/ray_order.h"

namespace kaamos::effects {

/// Options for recording a part of a frame.
struct PartOptions {
  std::uint32_t first_sample = 0;  ///< of each pixel's sequence
  std::uint32_t samples = 0;       ///< 0: as settings() have them
  bool is_sorted = false;          ///< in the order that record_sort made
};

/// The effects that a frame renders.
class EffectStage {
 public:
  /// Both must stay.
  EffectStage(FrameContext& context, const LightStage& lights)
      : context_(context), inputs_{lights, {}, false}, gradients_(context) {}
  EffectStage(const EffectStage&) = delete;
  EffectStage& operator=(const EffectStage&) = delete;

  /// Finds them; they are not made yet.
  void choose();
  /// Makes them. Lights are there by then, in a whole frame.
  /// @errors those of ActiveEffect::create, RaySorter and TemporalGradients.
  rtapi::Status create();
  /// Executes those that read the volume of indirect light, with a few samples, so that it is known
  /// which cells they read; their pictures are of no use.
  /// @errors those of the device.
  rtapi::Result<Outcome> read_volume(const Progress& progress);
  /// Makes those again that read the volume when they are made, and what effects share.
  /// @errors those of ActiveEffect::create.
  rtapi::Status remake_readers();
  /// The host's work of a frame.
  /// @errors those of the device.
  rtapi::Status begin_frame();
  /// Executes what comes behind the G-buffer, before the effects.
  /// @errors those of the device.
  rtapi::Status begin();
  /// Executes those that read the radiance which others make, or all others.
  /// @errors those of the device.
  rtapi::Result<Outcome> run(bool late, const Progress& progress);
  /// Records one over the whole picture, as the frame has it; its sums begin anew.
  void record(rtapi::CommandList& list, ActiveEffect& effect, const PartOptions& options);
  /// Records the sorting of an effect's rays by FrameSettings::order.
  void record_sort(rtapi::CommandList& list, const std::string& effect) const;
  /// Records that the finished radiance is kept, for late effects of the next frame.
  void record_keep(rtapi::CommandList& list) const;
  /// Forgets the radiance of the frame before.
  /// @errors those of the device.
  rtapi::Status forget_radiance();

  /// In order.
  const std::vector<std::unique_ptr<ActiveEffect>>& active() const { return active_; }
  /// Null: the frame does not render it.
  ActiveEffect* find(const std::string& effect) const;
  /// Returns whether an effect is rendered: chosen, and of use in this scene.
  bool renders(const std::string& effect) const;
  /// Returns whether there are late effects.
  bool has_late() const;
  /// Returns what the effects need of main lighting.
  LightStage::Needs light_needs() const;
  /// The picture that an effect adds its samples to. Null: no such signal.
  rtapi::Texture sum(const std::string& signal) const;
  /// Samples of the frame before that are taken again.
  ///@{
  const GradientStage& gradients() const { return gradients_; }
  GradientStage& gradients() { return gradients_; }
  ///@}

 private:
  rtapi::Status create_radiance();

  FrameContext& context_;
  EffectInputs inputs_;
  std::optional<RaySorter> sorter_;
  std::optional<KeptRadiance> kept_;  // for late effects
  std::vector<std::unique_ptr<ActiveEffect>> active_;
  GradientStage gradients_;
};

}  // namespace kaamos::effects
