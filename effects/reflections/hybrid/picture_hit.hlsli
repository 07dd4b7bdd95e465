// SPDX-License-Identifier: MIT
// Light from the picture where it leaves no doubt, for passes that have rays otherwise. [survey 6.4]
#ifndef KAAMOS_PICTURE_HIT_HLSLI
#define KAAMOS_PICTURE_HIT_HLSLI

#include "../screen_space/screen_light.hlsli"

static const float kMostMetal = 0.5;

// Follows a ray over the picture. False: it does not tell what the ray meets.
bool LightOfPicture(uint2 pixel, ReflectionPoint surface, ReflectionRay sample,
                    ScreenReflectionConstants screen, float2 size, inout ScreenHit hit,
                    out float3 light) {
  light = float3(0, 0, 0);
  hit = MarchReflection(surface, sample, g_ids[pixel].x, screen, size);
  // The picture has no reflections yet: a metal that is hit would be black.
  if (hit.outcome == kHit && g_material[hit.pixel].y > kMostMetal) hit.outcome = kNotLookedFor;
  if (hit.outcome == kHit) light = LightOfHit(hit, screen, int2(size));
  return hit.outcome == kHit;
}

#endif
