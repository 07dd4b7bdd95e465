// SPDX-License-Identifier: MIT
#include "effects/shadows/sun_shadow/sun_shadow.h"

#include <shaders/sun_shadow.h>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> sun_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_sun_shadow());
}

RayPassDesc sun_shadow_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "sun shadow";
  desc.library = std::move(library);
  desc.ray_generation = "SunShadowRayGen";
  desc.key_generation = "SunShadowKeys";
  desc.miss[kRayTypeVisibility] = "OccluderMiss";
  desc.hit[kRayTypeVisibility].any_hit = "OccluderAnyHit";
  desc.hit[kRayTypeVisibility].closest_hit = "OccluderClosestHit";
  desc.payload_bytes = 8;  // OccluderPayload
  return desc;
}

}  // namespace kaamos::effects
