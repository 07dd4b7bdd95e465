// SPDX-License-Identifier: MIT
// This file holds the options of reflections that are found in the picture.
// [effects/reflections/screen_space/screen_reflections.h]
#ifndef KAAMOS_SCREEN_CONSTANTS_HLSLI
#define KAAMOS_SCREEN_CONSTANTS_HLSLI

#include "../traced/reflection_ray.hlsli"

struct ScreenReflectionConstants {
  float longest;        // metres, for a mirror
  float shortest;       // metres, for a rough surface
  float length_jitter;  // fraction of the length that varies from ray to ray
  uint march;           // kMarchMetres, kMarchPixels, kMarchLine
  uint steps;
  uint refinements;
  float stride;      // pixels
  float thickness;   // metres
  float edge_fade;   // part of the picture's size at its edge where hits fade to the fallback
  uint source;       // kCurrentFrame, kPreviousFrame
  uint fallback;     // kFallbackNone, kFallbackSky, kFallbackEnvironment
  uint strict;       // 1: only hits that leave no doubt
  float step_thickness;  // depths of a step that surfaces reach back besides
};

ReflectionLengths LengthsOf(ScreenReflectionConstants screen) {
  ReflectionLengths lengths;
  lengths.longest = screen.longest;
  lengths.shortest = screen.shortest;
  lengths.jitter = screen.length_jitter;
  return lengths;
}

#endif
