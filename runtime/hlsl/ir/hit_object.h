// SPDX-License-Identifier: MIT
//
// The members of the built-in struct dx::HitObject, which nothing but the compiler names. They are
// those of shader::HitObject, in its order.
#pragma once

#include <cstdint>

namespace kaamos::hlsl::ir {

enum HitObjectField : uint32_t {
  kHitState,  // shader::HitObjectState
  kHitRayFlags,
  kHitOrigin,
  kHitTMin,
  kHitDirection,
  kHitT,
  kHitInstanceIndex,
  kHitInstanceId,
  kHitGeometryIndex,
  kHitPrimitiveIndex,
  kHitHitKind,
  kHitIsBound,
  kHitRecord,
  kHitAttributes,
  kHitObjectToWorld,
  kHitWorldToObject,
};

}  // namespace kaamos::hlsl::ir
