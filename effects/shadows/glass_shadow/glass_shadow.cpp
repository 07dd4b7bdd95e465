// SPDX-License-Identifier: MIT
#include "effects/shadows/glass_shadow/glass_shadow.h"

#include <shaders/glass_shadow.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> glass_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_glass_shadow());
}

RayPassDesc glass_shadow_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "shadows of glass";
  desc.library = std::move(library);
  desc.ray_generation = "GlassShadowRayGen";
  desc.miss[kRayTypeVisibility] = "PanesMiss";
  desc.hit[kRayTypeVisibility].any_hit = "PanesAnyHit";
  desc.payload_bytes = 12;  // PanesPayload
  return desc;
}

}  // namespace kaamos::effects
