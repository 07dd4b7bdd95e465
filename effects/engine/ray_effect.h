// SPDX-License-Identifier: MIT
/// @file
/// An effect that is one ray tracing pass. It can do more than others: be recorded in bands of
/// rows, take its rays in another order, and take samples again over another frame.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "effects/engine/effect_pass.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// The pass of an effect, as its frame sees it.
class RayEffect : public EffectPass {
 public:
  /// Makes the pipeline, and with `is_sorted` the one that writes the keys of its rays, where the
  /// pass has one.
  /// @errors those of RayPass::create.
  static rtapi::Result<std::unique_ptr<RayEffect>> create(const EffectScope& scope,
                                                          const RayPassDesc& desc, bool is_sorted);

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override;
  std::uint64_t bytes() const override { return 0; }
  const RayEffect* rays() const override { return this; }

  /// Records `row_count` rows from constants.first_row on.
  void record_rows(rtapi::CommandList& list, const EffectSettings& settings,
                   const PassConstants& constants, std::uint32_t row_count) const;
  /// Returns whether record_keys records anything.
  bool has_keys() const { return keys_.has_value(); }
  /// Records what writes the keys of its rays, for a RaySorter.
  void record_keys(rtapi::CommandList& list, const EffectSettings& settings,
                   const PassConstants& constants) const;
  /// The pass.
  const RayPass& pass() const { return pass_; }

 private:
  RayEffect(const Frame& frame, const PassViews& views) : frame_(frame), views_(views) {}

  const Frame& frame_;
  const PassViews& views_;
  RayPass pass_;
  std::optional<RayPass> keys_;
};

}  // namespace kaamos::effects
