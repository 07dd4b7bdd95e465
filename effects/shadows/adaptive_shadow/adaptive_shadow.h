// SPDX-License-Identifier: MIT
/// @file
/// Adaptive ray traced shadows: as many rays as the visibility of a light has varied lately, none
/// where it has not. [Boksansky, Wimmer & Bittner 2019]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/effect_pass.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// Bits of AdaptiveShadowConstants::flags. The first three are what the released code does where it
/// differs from the text. [Boksansky, Wimmer & Bittner 2019; effects/SOURCES.md: E3]
enum AdaptiveShadowFlags : std::uint32_t {
  /// Variation is that of this frame and the three before it, these not carried along with the
  /// surfaces, and three equal counts are calm. Else, as the text says, that of the four frames
  /// before, carried along, and four equal counts.
  kAdaptiveReleasedHistory = 1u << 0,
  /// The newest of the former variations takes the place of all older ones.
  kAdaptiveReleasedShift = 1u << 1,
  /// A box of 9 pixels in place of the tent of 13.
  kAdaptiveReleasedLowPass = 1u << 2,
  kAdaptiveUniform = 1u << 3,     ///< all pixels take the most rays: to compare with
  kAdaptiveUnfiltered = 1u << 4,  ///< neighbours are not averaged, frames still are
};

/// AdaptiveShadowConstants::light: the sun.
inline constexpr std::uint32_t kAdaptiveSun = 0xFFFFFFFFu;
/// EffectSettings::samples, the most rays of a pixel: standard and high quality.
///@{
inline constexpr std::uint32_t kAdaptiveStandardSamples = 5;
inline constexpr std::uint32_t kAdaptiveHighSamples = 8;
///@}

/// Constants b0, space3: mirrors AdaptiveShadowConstants of adaptive_shadow.hlsl.
struct AdaptiveShadowConstants {
  float target = 0.1f;            ///< variation from which on a pixel gets one more ray
  float facing_depth = 0.003f;    ///< relative change of depth within a surface seen from its front
  float grazing_depth = 0.02f;    ///< and along it
  float filter_variation = 0.4f;  ///< from which on 9 x 9 pixels are averaged; less, fewer
  /// Mean variation of the picture, 0 to 1, from which on counts go down to 1. 0: there is no
  /// limit. 0.3 is that of the released code.
  float budget = 0.0f;
  std::uint32_t flags = 0;             ///< AdaptiveShadowFlags
  std::uint32_t light = kAdaptiveSun;  ///< or a place in light_constants: a local light
  std::uint32_t frame_count = 0;       ///< set by AdaptiveShadowPass
};
static_assert(sizeof(AdaptiveShadowConstants) == 32);

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> adaptive_shadow_library();

/// The passes of one light, with its histories. Each record() is a frame of them.
class AdaptiveShadowPass : public EffectPass {
 public:
  /// Makes the passes and their pictures. Registers u0 and u1 are the signals of the row.
  /// @errors those of the device, among them KA0990 no memory.
  static rtapi::Result<std::unique_ptr<EffectPass>> create(const EffectScope& scope);
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override;
  std::uint64_t bytes() const override { return bytes_; }

 private:
  explicit AdaptiveShadowPass(const EffectScope& scope)
      : frame_(scope.frame), views_(scope.views) {}
  rtapi::Status create_pictures(const EffectScope& scope);

  const Frame& frame_;
  PassViews& views_;
  RayPass rays_;
  std::vector<ComputePass> before_rays_, after_rays_;
  ComputePass sum_tiles_, sum_all_;
  std::vector<rtapi::Texture> pictures_;
  rtapi::Buffer sums_;
  std::uint64_t bytes_ = 0;
  std::uint32_t frame_count_ = 0;
};

}  // namespace kaamos::effects
