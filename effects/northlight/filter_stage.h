// SPDX-License-Identifier: MIT
/// @file
/// The denoising of a frame: its effects' signals, and the filters that they share.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <string>

#include "effects/northlight/effect_stage.h"
#include "effects/northlight/frame_context.h"
#include "effects/northlight/light_stage.h"
#include "effects/northlight/signal_filters.h"

namespace kaamos::effects {

/// The denoisers of a whole frame; other frames have no filters.
class FilterStage {
 public:
  /// All must stay.
  FilterStage(FrameContext& context, const LightStage& lights, const EffectStage& effects)
      : context_(context), lights_(lights), effects_(effects) {}
  FilterStage(const FilterStage&) = delete;
  FilterStage& operator=(const FilterStage&) = delete;

  /// Makes filters for the signals of all effects.
  /// @errors those of SignalFilters.
  rtapi::Status create();
  /// The host's work of a frame: histories begin anew at a cut.
  void begin_frame();
  /// Executes the filters of signals that are late, or of all others. [SignalFilters::Filter]
  /// @errors those of the device.
  rtapi::Status run(bool late);
  /// Records those that late effects wait for, once. False: they are recorded already.
  bool record_early(rtapi::CommandList& list);
  /// Records all that are not recorded yet.
  void record_rest(rtapi::CommandList& list);
  /// Adds a signal of this frame to denoisers that someone makes for themselves.
  /// @errors KA3046 no such signal; those of SignalFilters::add.
  rtapi::Status add_signal(SignalFilters& to, const std::string& signal) const;

  /// The picture that the composition takes for a signal: denoised, as its pass wrote it, or main
  /// lighting.
  const rtapi::Texture& composed(const ActiveEffect& effect, std::size_t signal) const;
  /// The signals and their denoisers; none before prepare.
  const SignalFilters& signals() const { return filters_; }

 private:
  void see_samples();
  rtapi::Status add_signal(SignalFilters& to, const ActiveEffect& effect, std::size_t index) const;

  FrameContext& context_;
  const LightStage& lights_;
  const EffectStage& effects_;
  SignalFilters filters_;
  bool is_early_done_ = false;  // what late parts read is recorded
};

}  // namespace kaamos::effects
