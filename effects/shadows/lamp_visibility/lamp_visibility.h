// SPDX-License-Identifier: MIT
/// @file
/// Hard shadows of all local lights by rays: a visibility buffer with a bit for each light.
/// [survey 5.3]
#pragma once

#include <rtapi/rtapi.h>

#include <memory>

#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

/// Radiance of all local lights: register u0 of space3 is no sum. It is what main lighting finds
/// [effects/light/direct], with a ray to each light's centre in place of its map; of the first 128
/// lights of a pixel. `scope` needs EffectNeeds::lights.
/// @errors those of the device.
rtapi::Result<std::unique_ptr<EffectPass>> make_lamp_visibility(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> lamp_visibility_library();

}  // namespace kaamos::effects
