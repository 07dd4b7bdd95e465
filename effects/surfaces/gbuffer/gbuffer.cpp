// SPDX-License-Identifier: MIT
#include "effects/surfaces/gbuffer/gbuffer.h"

#include <shaders/curvature.h>
#include <shaders/gbuffer.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> gbuffer_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_gbuffer());
}

RayPassDesc gbuffer_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "G-buffer";
  desc.library = std::move(library);
  desc.ray_generation = "GBufferRayGen";
  desc.miss[kRayTypeSurface] = "GBufferMiss";
  desc.hit[kRayTypeSurface] = {"GBufferAnyHit", "GBufferClosestHit"};
  return desc;
}

rtapi::Result<rtapi::ShaderLibrary> curvature_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_curvature());
}

rtapi::Result<ComputePass> curvature_pass(const rtapi::Device& device, const Frame& frame,
                                          const rtapi::ShaderLibrary& library) {
  return ComputePass::create(device, frame, library, "CurvatureToRoughness");
}

}  // namespace kaamos::effects
