// SPDX-License-Identifier: MIT
// The G-buffer, from one primary ray through the centre of each pixel.
#pragma once

#include "effects/frame/ray_pass.h"

namespace kaamos::effects {

RayPassDesc gbuffer_pass(rtapi::ShaderLibrary library);
rtapi::Result<rtapi::ShaderLibrary> gbuffer_library();

}  // namespace kaamos::effects
