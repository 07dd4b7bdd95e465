// SPDX-License-Identifier: MIT
/// @file
/// The G-buffer, from one primary ray through the centre of each pixel.
#pragma once

#include "effects/frame/ray_pass.h"

namespace kaamos::effects {

/// The pass. A dispatch writes every picture from kDepth to kPosition, and kMotion. [effects-spec
/// B1]
RayPassDesc gbuffer_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> gbuffer_library();

}  // namespace kaamos::effects
