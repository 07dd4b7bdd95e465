// SPDX-License-Identifier: MIT
/// @file
/// The numbers of the denoiser for visibility. [visibility_denoiser.h]
#pragma once

#include <cstdint>

namespace kaamos::effects {

/// Constants b0, space3, of every kernel: mirrors VisibilityConstants of visibility_filter.hlsl.
struct VisibilityConstants {
  float alpha = 0.05f;              ///< least weight of the new frame, 0 to 1
  std::uint32_t max_history = 32;   ///< frames, at least 1
  std::uint32_t history_valid = 0;  ///< set by VisibilityDenoiser
  /// Deviation of the filter, in radii of the penumbra; 0: nothing is filtered in space.
  float reach = 0.35f;
  /// History is let go that differs from new samples by more deviations of their mean; 0: never.
  float clip = 3.0f;
  std::int32_t channels = 1;         ///< set by VisibilityDenoiser
  std::int32_t channel = 0;          ///< set by VisibilityDenoiser
  std::int32_t lights_channel = -1;  ///< set by VisibilityDenoiser
  std::int32_t step = 1;             ///< set by VisibilityDenoiser
  std::uint32_t vertical = 0;        ///< set by VisibilityDenoiser
  std::uint32_t changes = 0;         ///< set by VisibilityDenoiser
};
static_assert(sizeof(VisibilityConstants) == 44);

}  // namespace kaamos::effects
