// SPDX-License-Identifier: MIT
/// @file
/// Glass: the light it sends, what it mirrors, and what it lets through. [Control; Northlight deck:
/// Transparent objects]
#pragma once

#include <cstdint>

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// The pass that traces glass. Registers of space3: u0 R32G32B32A32_FLOAT, radiance of the glass
/// and view depth of its first layer (metres, 0: no glass); u1 R32G32B32A32_FLOAT, transmittance by
/// colour and the number of layers traced one by one. Lighting::bind and GpuVolume::bind are needed
/// too. TransparentCompose of the library, a compute shader that takes the same views and
/// constants, multiplies the frame's kRadiance with u1 and adds u0.
RayPassDesc transparent_pass(rtapi::ShaderLibrary library);
/// The nearest layer alone, for glass that is drawn. Register u2 of space3, R32G32B32A32_FLOAT:
/// radiance that it mirrors and its view depth (metres, 0: no glass). Otherwise as
/// transparent_pass. [effects/glass/drawn_glass]
RayPassDesc glass_reflection_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> transparent_library();

/// The weight of layers without an order, by their view depth z. [McGuire and Bavoil 2013]
enum class BlendWeight : std::uint32_t {
  kNone,    ///< all alike
  kSquare,  ///< alpha clamp(10 / (1e-5 + (z / 5)^2 + (z / 200)^6), 0.01, 3000)
  kCube,    ///< with (z / 10)^3
  kFar,     ///< alpha clamp(0.03 / (1e-5 + (z / 200)^4), 0.01, 3000)
  kDepth,   ///< alpha max(3000 (near / z)^3, 0.01)
};

/// Most layers that are traced one by one.
inline constexpr std::uint32_t kMaxSortedLayers = 8;

/// Constants b0, space3. The defaults are Control's: the first layer reflects.
struct TransparentConstants {
  std::uint32_t reflecting_layers = 1;  ///< nearest layers with a mirrored ray each
  /// Nearest layers traced one by one, in their exact order, at most kMaxSortedLayers; those that
  /// do not reflect are lit only. What lies behind is blended without an order.
  std::uint32_t sorted_layers = 1;
  BlendWeight weight = BlendWeight::kSquare;  ///< of layers that are blended without an order
  std::uint32_t sun = 1;  ///< 1: shadow rays to the sun; 0: the sun does not shine on glass
  float reflection_length = 60.0f;  ///< metres; beyond it the volume is mirrored
  float fade = 0.2f;                ///< last part of that length, over which the volume takes over
  /// 1: a layer reflects as much as glass does however little it covers (and lets that much less
  /// through). 0: coverage takes the reflection with it, as glTF has it.
  std::uint32_t full_reflection = 1;
  float depth_scale = 1.0f;  ///< of z in kSquare, kCube and kFar: scenes that are not metres large
};
static_assert(sizeof(TransparentConstants) == 32);

/// The deck's settings: `layers` with reflections, 0 to kMaxSortedLayers, the rest blended.
TransparentConstants deck_layers(std::uint32_t layers);
/// The settings of a reference: every layer in its order and with its reflection.
TransparentConstants sorted_reference();

}  // namespace kaamos::effects
