// SPDX-License-Identifier: MIT
// Computes what a ray sees that leaves the scene. Mirrors sky_radiance in
// effects/assets/scene/scene.h.
#ifndef KAAMOS_SKY_HLSLI
#define KAAMOS_SKY_HLSLI

float3 SkyRadiance(float3 zenith, float3 horizon, float3 ground, float3 direction) {
  if (direction.y >= 0.0f) return lerp(horizon, zenith, sqrt(min(direction.y, 1.0f)));
  return lerp(horizon, ground, min(1.0f, -direction.y * 8.0f));
}

#endif
