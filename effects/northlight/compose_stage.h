// SPDX-License-Identifier: MIT
/// @file
/// Puts a frame together: the radiance of all effects, antialiasing over frames, enlarging.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "effects/composition/composite/composite.h"
#include "effects/composition/enlarge/enlarge.h"
#include "effects/composition/taa/taa.h"
#include "effects/northlight/effect_stage.h"
#include "effects/northlight/filter_stage.h"
#include "effects/northlight/frame_context.h"
#include "effects/northlight/light_stage.h"

namespace kaamos::effects {

/// The composition of a frame.
class ComposeStage {
 public:
  /// All must stay.
  ComposeStage(FrameContext& context, LightStage& lights, const EffectStage& effects,
               const FilterStage& filters)
      : context_(context), lights_(lights), effects_(effects), filters_(filters) {}
  ComposeStage(const ComposeStage&) = delete;
  ComposeStage& operator=(const ComposeStage&) = delete;

  /// Makes the passes, of a whole frame or of the sums as they are.
  /// @errors those of ComposePass, CompositePass, TemporalAntialiasing and Enlarger.
  rtapi::Status create();
  /// Histories begin anew at a cut.
  void begin_frame();
  /// Records what puts the frame together.
  void record(rtapi::CommandList& list) const;
  /// Executes that, antialiasing and enlarging.
  /// @errors those of the device.
  rtapi::Status run();
  /// Records the radiance without reflections, which late effects look at.
  void record_unreflected(rtapi::CommandList& list) const;
  /// Executes that.
  /// @errors those of the device.
  rtapi::Status run_unreflected();
  /// Executes the frame's radiance by these signals alone, as the composition adds them to what
  /// surfaces emit; without glass. It is written over the frame's "radiance".
  /// @errors those of the device; KA3046 a name that is no part of the composition.
  rtapi::Status run_some(const std::vector<std::string>& signals);

  /// The strongest lights have this effect's visibility from now on, unless it is none of theirs.
  /// @errors those of the device.
  rtapi::Status take_strongest(const ActiveEffect& effect);

  /// Null without antialiasing over frames.
  const TemporalAntialiasing* taa() const { return taa_ ? &*taa_ : nullptr; }
  /// The finished picture, enlarged where FrameSettings::enlarge says so.
  const rtapi::Texture& result() const { return enlarger_ ? enlarger_->result() : resolved(); }

 private:
  rtapi::Status create_whole();
  rtapi::Status create_plain();
  rtapi::Result<ComposePass> create_pass(const FrameParts& parts) const;
  rtapi::Result<FrameParts> parts_of(const std::vector<std::string>& signals) const;
  std::uint64_t bytes() const;
  // The picture of the frame's own size.
  const rtapi::Texture& resolved() const {
    return taa_ ? taa_->result() : context_.frame.texture(kRadiance);
  }

  FrameContext& context_;
  LightStage& lights_;
  const EffectStage& effects_;
  const FilterStage& filters_;
  std::optional<CompositePass> composite_;                        // of the sums as they are, or
  std::optional<ComposePass> compose_;                            // of a whole frame
  std::optional<ComposePass> compose_unreflected_;                // for late effects
  std::map<std::vector<std::string>, ComposePass> compose_some_;  // by their signals
  rtapi::Texture black_;  // stands for indirect light that is left out
  std::optional<TemporalAntialiasing> taa_;
  std::optional<Enlarger> enlarger_;
};

}  // namespace kaamos::effects
