// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"

#include <shaders/indirect_diffuse.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> indirect_diffuse_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_indirect_diffuse());
}

RayPassDesc indirect_diffuse_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "indirect diffuse";
  desc.library = std::move(library);
  desc.ray_generation = "IndirectRayGen";
  desc.key_generation = "IndirectKeys";
  desc.miss[kRayTypeSurface] = "IndirectMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"IndirectAnyHit", "IndirectClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 28;
  desc.max_recursion_depth = 2;  // a hit traces a shadow ray to the sun
  return desc;
}

}  // namespace kaamos::effects
