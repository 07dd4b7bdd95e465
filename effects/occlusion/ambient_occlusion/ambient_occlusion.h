// SPDX-License-Identifier: MIT
/// @file
/// Ray traced ambient occlusion, by cosine-distributed or by uniform directions.
#pragma once

#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// Metres and samples per pixel that the Northlight demo used. [GDC 2018 talk]
///@{
inline constexpr float kDefaultAmbientOcclusionRadius = 4.0f;
inline constexpr std::uint32_t kDefaultAmbientOcclusionSamples = 4;
///@}

/// The pass, from the library that is built in or from one compiled at run time. Each dispatch adds
/// the open ones of its samples to register u0 of space3, R32_FLOAT; PassConstants::radius is how
/// far rays reach, metres. [GDC 2018 talk; survey 7.4]
RayPassDesc ambient_occlusion_pass(rtapi::ShaderLibrary library);
/// The same with directions uniform over the hemisphere, each counted by twice its cosine: right on
/// average, but noisier; a pixel's mean may be above 1. Register u0 of space3 is
/// R32G32B32A32_FLOAT, to which the samples are added; b0 is UniformOcclusionConstants.
/// [survey 7.4]
RayPassDesc uniform_ambient_occlusion_pass(rtapi::ShaderLibrary library);

/// Constants b0, space3 of the uniform pass.
struct UniformOcclusionConstants {
  /// 1: the survey's sum, which forgets the density of the directions: an open plane gets
  /// 1 / (2 pi). To show the error. [effects/SOURCES.md: E4]
  std::uint32_t survey_rule = 0;
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> ambient_occlusion_library();

}  // namespace kaamos::effects
