// SPDX-License-Identifier: MIT
// The rays of reflections over the picture, and the light of what they hit there. [survey 6.2]
#ifndef KAAMOS_SCREEN_LIGHT_HLSLI
#define KAAMOS_SCREEN_LIGHT_HLSLI

#include "screen_constants.hlsli"
#include "screen_march.hlsli"

// The finished radiance of the previous frame and its view depths (0: sky; negative: there is no
// previous frame).
RWTexture2D<float4> previous_radiance : register(u19, space3);

static const uint kCurrentFrame = 0;
static const uint kPreviousFrame = 1;

static const float kSameDepth = 0.05;  // of the view depth: what moved is still the same
static const float kMostRadiance = 1e30;

// Radiance between the pixels of one surface: those within `reach` of the view depth.
float3 LightAround(RWTexture2D<float4> light, RWTexture2D<float4> depths, bool is_current,
                   float2 place, float view_z, float reach, int2 size, out bool is_known) {
  const float2 at = place - 0.5;
  const float2 corner = floor(at);
  const float2 part = at - corner;
  float3 sum = float3(0, 0, 0);
  float weights = 0.0;
  [unroll] for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const int2 tap = clamp(int2(corner) + offset, int2(0, 0), size - 1);
    const float depth = is_current ? g_view_z[tap] : depths[tap].w;
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    if (!(abs(depth - view_z) <= reach)) continue;
    sum += weight * Contain(light[tap].rgb, kMostRadiance);
    weights += weight;
  }
  is_known = weights > 1e-3;
  return is_known ? sum / weights : float3(0, 0, 0);
}

// Returns the light of the hit's surface towards the camera, which stands for that towards the
// ray's origin.
float3 LightOfHit(inout ScreenHit hit, ScreenReflectionConstants screen, int2 size) {
  const float view_z = g_view_z[hit.pixel];
  const float reach = max(screen.thickness, kSameDepth * view_z);
  bool is_known;
  const bool has_previous = previous_radiance[hit.pixel].w >= 0.0;
  if (screen.source == kCurrentFrame || !has_previous) {
    const float3 light =
        LightAround(radiance, previous_radiance, true, hit.place, view_z, reach, size, is_known);
    return is_known ? light : Contain(radiance[hit.pixel].rgb, kMostRadiance);
  }
  const float4 motion = g_motion[hit.pixel];
  const float2 moved = motion.xy * float2(size) + frame.jitter - frame.previous_jitter;
  const float2 place = hit.place + moved;
  if (!IsInPicture(place, float2(size))) {
    hit.outcome = kStale;
    return float3(0, 0, 0);
  }
  const float depth = view_z + motion.z;
  const float3 light =
      LightAround(previous_radiance, previous_radiance, false, place, depth, reach, size, is_known);
  if (is_known) return light;
  // The place lies between pixels of other surfaces: the hit's own pixel alone is left.
  const int2 own = int2(floor(float2(hit.pixel) + 0.5 + moved));
  if (IsInPicture(float2(own), float2(size)) && abs(previous_radiance[own].w - depth) <= reach) {
    return Contain(previous_radiance[own].rgb, kMostRadiance);
  }
  hit.outcome = kStale;
  return float3(0, 0, 0);
}

// 1 in the middle of the picture; 0 at its edge, where hits would end abruptly.
float EdgeConfidence(float2 place, float edge_fade, float2 size) {
  if (!(edge_fade > 0.0)) return 1.0;
  const float2 inside = min(place, size - place) / (edge_fade * size);
  return saturate(min(inside.x, inside.y));
}

// Follows a reflection's ray over the picture.
ScreenHit MarchReflection(ReflectionPoint surface, ReflectionRay sample, uint own_instance,
                          ScreenReflectionConstants screen, float2 size) {
  ScreenRule rule;
  rule.thickness = Contain(screen.thickness, kLongestRay);
  rule.step_thickness = screen.step_thickness;
  rule.strict = screen.strict != 0;
  rule.without_lamps = !IsMirror(surface.roughness);
  rule.own_instance = own_instance;
  MarchSettings settings;
  settings.march = screen.march;
  settings.steps = screen.steps;
  settings.refinements = screen.refinements;
  settings.stride = screen.stride;
  const ScreenRay ray = MakeScreenRay(surface.origin, sample.direction, sample.length, size);
  return MarchScreen(ray, rule, settings, sample.length, sample.u, size);
}

#endif
