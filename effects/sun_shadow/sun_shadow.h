// SPDX-License-Identifier: MIT
// Shadow of a sun with an area. The pass adds the number of samples that see it to
// kSunVisibilitySum.
#pragma once

#include "effects/frame/ray_pass.h"

namespace kaamos::effects {

/// Samples per pixel of the deck's timings. [effects-spec B2.11]
inline constexpr std::uint32_t kDefaultSunSamples = 2;

RayPassDesc sun_shadow_pass(rtapi::ShaderLibrary library);
rtapi::Result<rtapi::ShaderLibrary> sun_shadow_library();

}  // namespace kaamos::effects
