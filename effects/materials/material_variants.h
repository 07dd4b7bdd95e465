// SPDX-License-Identifier: MIT
/// @file
/// Skin, eyes and hair by models of their own, in the place of the unified one. [Control]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/effect.h"

namespace kaamos::effects {

/// Constants b0, space3.
struct VariantConstants {
  /// 1: what mirrors show has models of its own, too. 0: what the camera sees alone, as where hits
  /// of rays are shaded by one model.
  std::uint32_t at_hits = 1;
};

/// Adds what the unified model is off by in the light of the sun: "material-variants".
Effect material_variants_row();

/// The pass. Register u0 of space3 gets the radiance by the models of their own less that by the
/// unified one.
RayPassDesc material_variants_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> material_variants_library();

}  // namespace kaamos::effects
