// SPDX-License-Identifier: MIT
//
// RAY_FLAG as shaders and traversals hold them: bits of a word. [DXR: Ray flags]
#pragma once

#include <cstdint>

#include <rtapi/raytracing.h>
#include <rtapi/state_object.h>

#include "kaamos/shader/query_permissions.h"

namespace kaamos::runtime {

constexpr uint32_t bits_of(rtapi::RayFlags flags) {
  return static_cast<uint32_t>(flags);
}
constexpr bool has(uint32_t flags, rtapi::RayFlags flag) {
  return (flags & bits_of(flag)) != 0;
}

inline constexpr uint32_t kRayForceOpaque = bits_of(rtapi::RayFlags::kForceOpaque);
inline constexpr uint32_t kRayForceNonOpaque = bits_of(rtapi::RayFlags::kForceNonOpaque);
inline constexpr uint32_t kRayAcceptFirstHitAndEndSearch =
    bits_of(rtapi::RayFlags::kAcceptFirstHitAndEndSearch);
inline constexpr uint32_t kRaySkipClosestHitShader =
    bits_of(rtapi::RayFlags::kSkipClosestHitShader);
inline constexpr uint32_t kRayCullBackFacingTriangles =
    bits_of(rtapi::RayFlags::kCullBackFacingTriangles);
inline constexpr uint32_t kRayCullFrontFacingTriangles =
    bits_of(rtapi::RayFlags::kCullFrontFacingTriangles);
inline constexpr uint32_t kRayCullOpaque = bits_of(rtapi::RayFlags::kCullOpaque);
inline constexpr uint32_t kRayCullNonOpaque = bits_of(rtapi::RayFlags::kCullNonOpaque);
inline constexpr uint32_t kRaySkipTriangles = bits_of(rtapi::RayFlags::kSkipTriangles);
inline constexpr uint32_t kRaySkipProceduralPrimitives =
    bits_of(rtapi::RayFlags::kSkipProceduralPrimitives);
inline constexpr uint32_t kRayForceOmm2State = bits_of(rtapi::RayFlags::kForceOmm2State);
inline constexpr uint32_t kAllRayFlags = 0x7FF;

// What a pipeline's flags add to those of its rays.
inline uint32_t ray_flags_of(rtapi::RaytracingPipelineFlags flags) {
  using Flags = rtapi::RaytracingPipelineFlags;
  const auto skips =
      static_cast<uint32_t>(flags & (Flags::kSkipTriangles | Flags::kSkipProceduralPrimitives));
  const bool micromaps = rtapi::HasAny(flags, Flags::kAllowOpacityMicromaps);
  return skips | (micromaps ? shader::kRayQueryAllowsMicromaps : 0);
}

}  // namespace kaamos::runtime
