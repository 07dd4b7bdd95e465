// SPDX-License-Identifier: MIT
/// @file
/// Contact shadows of each pixel's strongest point light and strongest spot light, by short rays.
/// [effects-spec B2.12]
#pragma once

#include "effects/frame/ray_pass.h"

namespace kaamos::effects {

/// The pass. Registers u0 and u1 of space3: the lights that `direct` named, and a
/// R32G32B32A32_FLOAT picture to whose r (point light) and g (spot light) the visible samples are
/// added.
RayPassDesc contact_shadow_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> contact_shadow_library();

/// Constants b0, space3.
struct ContactShadowConstants {
  float length = 1.0f;  ///< of the rays, metres; 0: everything is visible
};

}  // namespace kaamos::effects
