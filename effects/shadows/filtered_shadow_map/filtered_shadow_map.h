// SPDX-License-Identifier: MIT
/// @file
/// Shadows of the sun by maps that are filtered before they are looked up. One pass; its method is
/// a constant. [survey 5.1.3, 5.1.4]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

/// The contents of a filtered map.
enum FilteredShadowMapMethod : std::uint32_t {
  kFilteredVariance,             ///< two moments [Donnelly & Lauritzen 2006]
  kFilteredExponential,          ///< an exponential [Annen et al. 2008]
  kFilteredExponentialVariance,  ///< moments of two of them [Lauritzen & McCool 2008]
  kFilteredConvolution,          ///< a Fourier series [Annen et al. 2007]
  kFilteredPcssVariance,         ///< moments at all widths, for PCSS [Yang et al. 2010]
  kFilteredPcssConvolution,      ///< a Fourier series at all widths, for PCSS [Annen et al. 2008b]
  kFilteredShadowMapMethodCount
};

/// Constants b0, space3: mirrors ShadowMapConstants and FilterConstants of
/// filtered_shadow_map.hlsl. A share is one of the depths that the map reaches over, 0 to 1.
struct FilteredShadowMapConstants {
  /// `method` is a FilteredShadowMapMethod; `radius` half the width of the square that is filtered
  /// over, up to 128 texels, or the widest disk of PCSS. `taps` and `blocker_taps` do not count.
  /// For PCSS `size` is a power of two.
  ShadowMapConstants map;
  /// The exponent of the exponential, over a share, above 0 to 87; that of the front moments, over
  /// half a share, to 42: what is beyond is no 32-bit float.
  float exponent = 80.0f;
  float back_exponent = 5.0f;    ///< of the back moments, likewise
  std::uint32_t terms = 16;      ///< of the series, 1 to 16
  float damping = 0.0f;          ///< of its last term, 0 to 20: times exp(-damping)
  float reduce_bleeding = 0.0f;  ///< visibility that counts as none, 0 to 0.99
  float least_variance = 1e-6f;  ///< of shares, 0 to 1
  float offset = 1.0f;           ///< of surfaces against the series, 0 to 1 of half its step
  std::uint32_t level = 0;       ///< set by the pass
};
static_assert(sizeof(FilteredShadowMapConstants) == 96);

/// The shaders, as they are built into the program. Maps are drawn by those of
/// shadow_draws_library().
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> filtered_shadow_map_library();

/// The passes that FilteredShadowMapConstants of `scope.settings` ask for. What they say about
/// maps, their number and size, the method, and `terms` hold for the pass's life.
/// @errors KA3060 or KA3062 a constant out of its range; KA0965 on Vulkan without graphics
/// pipelines; others of the device, among them KA0990 no memory.
rtapi::Result<std::unique_ptr<EffectPass>> make_filtered_shadow_map(const EffectScope& scope);

}  // namespace kaamos::effects
