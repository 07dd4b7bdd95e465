// SPDX-License-Identifier: MIT
/// @file
/// Shadows of the sun by depth maps, drawn each frame. One pass; its method is a constant.
/// [survey 5.1]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"
#include "effects/shadows/shadow_map/sun_maps.h"

namespace kaamos::effects {

/// The method by which a map is looked up.
enum ShadowMapMethod : std::uint32_t {
  kShadowMapHard,  ///< one texel
  kShadowMapPcf,   ///< percentage-closer filtering, of one width [Reeves, Salesin & Cook 1987]
  kShadowMapPcss,  ///< as wide as the penumbra [Fernando 2005]
  /// The part of the sun that texels hide, seen from the surface [Guennebaud, Barthe & Paulin 2006]
  kShadowMapBackprojection,
  kShadowMapMethodCount
};

/// Bits of ShadowMapConstants::flags.
enum ShadowMapFlags : std::uint32_t {
  /// Taps are compared with the depth that the surface's plane has there, not with the point's.
  kShadowMapReceiverPlane = 1,
  /// Filters take a square of taps, between texels. Else a disk that each pixel turns.
  kShadowMapGrid = 2,
  /// The comparison as the survey has it, with reversed depth: wrong. [effects/SOURCES.md: E10]
  kShadowMapSurveyRule = 4,
  /// Cascades are as tight as it goes, and shadows' edges crawl when the camera moves.
  kShadowMapTight = 8,
  /// PCSS's penumbra lies inside the hard shadow, from its edge to where the sun is hidden whole.
  /// For what is blended with hard shadows: it never leaves them. [Story 2015]
  kShadowMapInnerPenumbra = 16,
  /// `cascades` counts objects instead: the scene's first instances of BuildClass::kHero have a map
  /// of their own, besides the scene's. Those that it lacks have the scene's. [survey 5.1.1]
  kShadowMapPerObject = 32,
};

/// Constants b0, space3: mirrors ShadowMapConstants of shadow_map.hlsli. A texel is one of the map
/// that a pixel looks at.
struct ShadowMapConstants {
  std::uint32_t method = kShadowMapHard;  ///< ShadowMapMethod
  std::uint32_t flags = 0;                ///< ShadowMapFlags
  std::uint32_t size = 2048;              ///< texels along a map's side, 4 to 16,384
  std::uint32_t cascades = 0;             ///< or objects; 0: one map over the scene; up to 4
  /// A surface is taken to be this much nearer to the sun: `constant_bias` texels, and `slope_bias`
  /// times the tangent of the angle between its normal and the sun, `most_bias` at most.
  ///@{
  float constant_bias = 1.5f;
  float slope_bias = 1.5f;
  ///@}
  float normal_offset = 0.0f;  ///< texels along the normal, times the sine of that angle
  float most_bias = 8.0f;      ///< texels
  float radius = 0.03f;        ///< of PCF's filter, and the most of PCSS's, metres
  std::uint32_t taps = 16;     ///< of the filter, 1 to 64; of backprojection: in a row, of as many
  std::uint32_t blocker_taps = 16;  ///< of PCSS's search, 1 to 64
  float blend = 0.1f;               ///< share of a cascade in which the next one comes in, 0 to 1
  float split_share = 0.75f;        ///< SunMapsDesc::split_share
  float reach = 0.0f;               ///< SunMapsDesc::reach, metres
  std::uint32_t draw = 0;           ///< set by the pass
  std::uint32_t map = 0;            ///< set by the pass
};
static_assert(sizeof(ShadowMapConstants) == 64);

/// The shaders that draw maps, as they are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> shadow_draws_library();
/// The shaders that look maps up, as they are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> shadow_map_library();

/// Says what is wrong with constants; of any method.
/// @errors KA3060 a constant out of its range.
rtapi::Status check_shadow_map(const ShadowMapConstants& constants);
/// The points of filters' disks, which the shaders of pcss.hlsli read from t3; it must stay.
/// @errors those of rtapi::Device::CreateBuffer.
rtapi::Result<rtapi::Buffer> bind_disk(const EffectScope& scope);
/// Describes where maps of these constants lie, over a scene with `bounds`, for the frame's
/// picture.
SunMapsDesc describe_sun_maps(const ShadowMapConstants& constants, const Scene& scene,
                              const Bounds& bounds, const Frame& frame);

/// The passes that ShadowMapConstants of `scope.settings` ask for. What they say about maps, their
/// number and size, and the method, holds for the pass's life.
/// @errors KA3060 a constant out of its range; KA0965 on Vulkan without graphics pipelines; others
/// of the device, among them KA0990 no memory.
rtapi::Result<std::unique_ptr<EffectPass>> make_shadow_map(const EffectScope& scope);

}  // namespace kaamos::effects
