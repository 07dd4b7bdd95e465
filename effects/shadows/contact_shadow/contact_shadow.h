// SPDX-License-Identifier: MIT
/// @file
/// Contact shadows of each pixel's strongest point light and strongest spot light, by short rays.
/// [Control; survey 5.3.1; Northlight deck: Contact Shadows]
#pragma once

#include <cstdint>

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// The pass. Registers u0 to u2 of space3: the lights that `direct` named, and two
/// R32G32B32A32_FLOAT pictures. To r (point light) and g (spot light) of the first it adds the
/// visible part of the samples; to the second, of the blocked part, 1 / radius of the penumbra that
/// the closest occluder casts, 1/m (r, g), and what of it is blocked by what moves (b, a).
RayPassDesc contact_shadow_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> contact_shadow_library();

/// Constants b0, space3.
struct ContactShadowConstants {
  float length = 1.0f;  ///< of the rays, metres; 0: everything is visible
  /// 1: rays end where penumbras get as wide as a texel of the light's shadow map, which shows what
  /// is farther away.
  std::uint32_t only_where_coarse = 0;
};

/// As frames have them: rays no longer than the maps require.
inline constexpr ContactShadowConstants kContactAsNeeded = {.only_where_coarse = 1};

}  // namespace kaamos::effects
