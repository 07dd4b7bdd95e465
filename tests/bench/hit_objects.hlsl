// SPDX-License-Identifier: MIT
// Ray generation shaders of hit-object/...: those of bench.hlsl, with HitObject::TraceRay and Invoke
// instead of TraceRay.
#include "bench.hlsl"

[shader("raygeneration")]
void ClosestHitObjects() {
  const uint index = RayIndex();
  Closest payload = {-1.0f, 0xFFFFFFFFu};
  const dx::HitObject hit = dx::HitObject::TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0,
                                                    LoadRay(index), payload);
  dx::HitObject::Invoke(hit, payload);
  g_closest[index] = payload;
}

[shader("raygeneration")]
void ShadedHitObjects() {
  const uint index = RayIndex();
  Shaded payload = {float3(0, 0, 0), -1.0f, float3(0, 0, 0), 0xFFFFFFFFu};
  const dx::HitObject hit = dx::HitObject::TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0,
                                                    LoadRay(index), payload);
  dx::HitObject::Invoke(hit, payload);
  g_shaded[index] = payload;
}
