// SPDX-License-Identifier: MIT
// Marches over the depths of the picture. They differ in where they take samples, and in whether a
// sample stands for a point of the ray or for all of it since the last one. [survey 6.2; McGuire &
// Mara 2014; GDC 2018 talk]
#ifndef KAAMOS_SCREEN_MARCH_HLSLI
#define KAAMOS_SCREEN_MARCH_HLSLI

#include "screen_ray.hlsli"

// The mask of each instance. [effects/assets/scene/scene.h: InstanceMask]
StructuredBuffer<uint> instance_masks : register(t4, space3);
static const uint kMaskLamp = 0x10;

static const uint kMarchMetres = 0;  // samples at equal distances in the scene; points
static const uint kMarchPixels = 1;  // every `stride` pixels; the ray in between counts too
static const uint kMarchLine = 2;    // a fixed number up to the edge of the picture, as before

struct MarchSettings {
  uint march;
  uint steps;        // most samples of a ray
  uint refinements;  // halvings of the step that crosses a surface
  float stride;      // pixels
};

static const float kNearestSample = 1.5;  // pixels from the ray's own

bool IsMet(int2 pixel, ScreenRule rule) {
  if (!rule.without_lamps) return true;
  const uint id = g_ids[pixel].x;
  return id == 0 || (instance_masks[id - 1] & kMaskLamp) == 0;
}

// Returns where sample `at` of a ray is, counted from 1; above 1 it is behind the ray's end.
float SampleParameter(ScreenRay ray, MarchSettings settings, float length, float major, float at) {
  if (settings.march == kMarchMetres) {
    return ScreenParameter(ray, length * at / float(settings.steps));
  }
  if (settings.march == kMarchPixels) return at * max(settings.stride, 1.0) / major;
  return at / float(settings.steps);
}

// Halves the step in which the ray goes behind a surface.
void Refine(ScreenRay ray, uint times, inout float s0, inout float s1) {
  for (uint i = 0; i < times; ++i) {
    const float s = 0.5 * (s0 + s1);
    if (ScreenDepth(ray, s) >= SceneDepth(int2(ScreenPlace(ray, s)))) {
      s1 = s;
    } else {
      s0 = s;
    }
  }
}

// The depth in metres that a surface is taken to have where the ray goes from s0 to s1.
float Thickness(ScreenRay ray, ScreenRule rule, float s0, float s1) {
  return rule.thickness +
         rule.step_thickness * abs(ScreenDepth(ray, s1) - ScreenDepth(ray, s0));
}

// `length` is the whole ray's, metres; `jitter`, 0 to 1, moves all samples by that part of a step.
ScreenHit MarchScreen(ScreenRay ray, ScreenRule rule, MarchSettings settings, float length,
                      float jitter, float2 size) {
  ScreenHit hit;
  hit.outcome = kOffScreen;
  hit.distance = length;
  hit.place = ray.from;
  hit.pixel = int2(0, 0);
  if (!ray.exists) return hit;
  MarchState state;
  state.passed_behind = state.met_back = false;
  const float2 extent = abs(ray.along);
  const float major = max(extent.x, extent.y);
  float s0 = 0.0;
  bool is_behind = false;  // the point before, of what its pixel shows
  uint i = 0;
  for (; i < settings.steps && s0 < 1.0; ++i) {
    const float s =
        min(1.0, SampleParameter(ray, settings, length, major, float(i) + 0.5 + 0.5 * jitter));
    const float before = s0;
    s0 = s;
    const float2 place = ScreenPlace(ray, s);
    const int2 pixel = min(int2(place), int2(size) - 1);
    if (s * major < kNearestSample || !IsMet(pixel, rule)) continue;
    const float surface = SceneDepth(pixel);
    const float depth = ScreenDepth(ray, s);
    const bool are_points = settings.march == kMarchMetres;
    const float depth_before = are_points ? depth : ScreenDepth(ray, before);
    const bool was_behind = is_behind;
    is_behind = max(depth, depth_before) >= surface;
    if (surface == kSkyZ || !is_behind) continue;
    // How far behind a surface points are says nothing where a step is longer than it is thick: the
    // place where the step crosses it does.
    const bool is_refined = settings.refinements > 0;
    const bool is_crossed = are_points && is_refined && !was_behind;
    const float thickness = Thickness(ray, rule, before, s);
    bool is_passed = !is_crossed && min(depth, depth_before) > surface + thickness;
    float from = before, to = s;
    if (!is_passed) Refine(ray, settings.refinements, from, to);
    const int2 refined = min(int2(ScreenPlace(ray, to)), int2(size) - 1);
    if (is_refined && !is_passed) {
      is_passed = ScreenDepth(ray, to) > SceneDepth(refined) + thickness;
    }
    if (is_passed) {
      state.passed_behind = true;
      if (rule.strict) break;
      continue;
    }
    if (AcceptHit(ray, rule, refined, before, s, state, hit)) return hit;
  }
  hit.outcome = s0 < 1.0 && i == settings.steps && settings.march == kMarchPixels
                    ? kOutOfSteps
                    : MissOutcome(ray, state, size);
  return hit;
}

#endif
