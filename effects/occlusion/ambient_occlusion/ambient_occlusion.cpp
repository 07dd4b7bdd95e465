// SPDX-License-Identifier: MIT
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"

#include <shaders/ambient_occlusion.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> ambient_occlusion_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_ambient_occlusion());
}

RayPassDesc ambient_occlusion_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "ambient occlusion";
  desc.library = std::move(library);
  desc.ray_generation = "AmbientOcclusionRayGen";
  desc.key_generation = "AmbientOcclusionKeys";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  return desc;
}

RayPassDesc uniform_ambient_occlusion_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc = ambient_occlusion_pass(std::move(library));
  desc.name = "uniform ambient occlusion";
  desc.ray_generation = "UniformOcclusionRayGen";
  desc.key_generation = "UniformOcclusionKeys";
  return desc;
}

}  // namespace kaamos::effects
