// SPDX-License-Identifier: MIT
#include "effects/shadows/lamp_shadow/lamp_shadow.h"

#include <shaders/lamp_shadow.h>

#include <utility>

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> lamp_shadow_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_lamp_shadow());
}

RayPassDesc lamp_shadow_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "lamp shadow";
  desc.library = std::move(library);
  desc.ray_generation = "LampShadowRayGen";
  desc.miss[kRayTypeVisibility] = "OccluderMiss";
  desc.hit[kRayTypeVisibility].any_hit = "OccluderAnyHit";
  desc.hit[kRayTypeVisibility].closest_hit = "OccluderClosestHit";
  desc.payload_bytes = 8;  // OccluderPayload
  return desc;
}

}  // namespace kaamos::effects
