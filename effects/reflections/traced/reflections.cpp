// SPDX-License-Identifier: MIT
#include "effects/reflections/traced/reflections.h"

#include <shaders/reflections.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_reflections());
}

RayPassDesc reflection_shading_pass(const char* name, rtapi::ShaderLibrary library,
                                    const char* ray_generation) {
  RayPassDesc desc;
  desc.name = name;
  desc.library = std::move(library);
  desc.ray_generation = ray_generation;
  desc.miss[kRayTypeSurface] = "ReflectionMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"ReflectionAnyHit", "ReflectionClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 28;
  desc.max_recursion_depth = 2;  // a hit traces a shadow ray to the sun
  return desc;
}

RayPassDesc reflections_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc = reflection_shading_pass("reflections", std::move(library), "ReflectionRayGen");
  desc.key_generation = "ReflectionKeys";
  return desc;
}

RayPassDesc reflections_trace_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc = reflections_pass(std::move(library));
  desc.name = "reflections' rays";
  desc.miss[kRayTypeSurface] = "ReflectionTraceMiss";
  desc.hit[kRayTypeSurface].closest_hit = "ReflectionTraceHit";
  return desc;
}

}  // namespace kaamos::effects
