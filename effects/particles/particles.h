// SPDX-License-Identifier: MIT
/// @file
/// Particles that are drawn over the finished frame. [survey 6.2]
#pragma once

#include <rtapi/rtapi.h>

#include <memory>

#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

/// Draws Scene::particles: "particles".
Effect particles_row();

/// The pass. Register u0 of space3 gets the light of the particles of each pixel, and in w the part
/// of the frame that they hide.
/// @errors those of the device.
rtapi::Result<std::unique_ptr<EffectPass>> make_particles(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> particles_library();

}  // namespace kaamos::effects
