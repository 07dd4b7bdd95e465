// SPDX-License-Identifier: MIT
#include "effects/shadows/contact_shadow/contact_shadow.h"

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
  desc.miss[kRayTypeVisibility] = "OccluderMiss";
  desc.hit[kRayTypeVisibility].any_hit = "OccluderAnyHit";
  desc.hit[kRayTypeVisibility].closest_hit = "OccluderClosestHit";
  desc.payload_bytes = 8;  // OccluderPayload
  return desc;
}

}  // namespace kaamos::effects
