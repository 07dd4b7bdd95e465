// SPDX-License-Identifier: MIT
/// @file
/// Ray traced ambient occlusion. The pass adds the number of open samples to kAmbientOcclusionSum.
#pragma once

#include "effects/frame/ray_pass.h"

namespace kaamos::effects {

/// Metres and samples per pixel that the Northlight demo used. [effects-spec B3.6]
///@{
inline constexpr float kDefaultAmbientOcclusionRadius = 4.0f;
inline constexpr std::uint32_t kDefaultAmbientOcclusionSamples = 4;
///@}

/// The pass, from the library that is built in or from one compiled at run time. Each dispatch adds
/// the open ones of its samples to kAmbientOcclusionSum; PassConstants::radius is how far rays
/// reach, metres. [effects-spec B3]
RayPassDesc ambient_occlusion_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> ambient_occlusion_library();

}  // namespace kaamos::effects
