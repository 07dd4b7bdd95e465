// SPDX-License-Identifier: MIT
#include "effects/contact_shadow/contact_shadow.h"

#include <shaders/contact_shadow.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> contact_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_contact_shadow());
}

RayPassDesc contact_shadow_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "contact shadow";
  desc.library = std::move(library);
  desc.ray_generation = "ContactShadowRayGen";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  return desc;
}

}  // namespace kaamos::effects
