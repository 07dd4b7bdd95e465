// SPDX-License-Identifier: MIT
/// @file
/// The G-buffer, from one primary ray through the centre of each pixel.
#pragma once

#include "effects/engine/compute_pass.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// The pass. A dispatch writes every picture from kDepth to kPosition, and kMotion.
RayPassDesc gbuffer_pass(rtapi::ShaderLibrary library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> gbuffer_library();

/// A pass over a finished G-buffer: kMaterial becomes rougher where kShadingNormal varies from
/// pixel to pixel, so that small highlights of curved, smooth surfaces do not flicker.
/// [Tokuyoshi & Kaplanyan 2019; GDC 2018 talk: questions]
/// @errors KA0537 a library without the pass; those of rtapi::Device::CreateComputePipelineState.
rtapi::Result<ComputePass> curvature_pass(const rtapi::Device& device, const Frame& frame,
                                          const rtapi::ShaderLibrary& library);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> curvature_library();

}  // namespace kaamos::effects
