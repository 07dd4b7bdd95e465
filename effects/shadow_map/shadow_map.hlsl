// SPDX-License-Identifier: MIT
// How much of the sun each pixel sees, by comparing depths with a shadow map: at one texel, over a
// filter of one width, and over one as wide as the penumbra. [effects-spec B2.1, B2.3, B2.7]
#include "pcss.hlsli"

// The survey writes "lit if p_z is smaller than what is stored" and says neither which way depth
// grows nor what happens where both are the same. With the reversed depth that the rest of the frame
// has, that says the opposite of what is meant. For the test of it alone. [effects-spec E10]
float SurveyRule(Receiver receiver) {
  const float range = maps[receiver.map].range;
  const int2 texel = int2(floor(receiver.at));
  const float stored = IsInMap(texel) ? 1.0 - shadow_depth[uint3(uint2(texel), receiver.map)] : 0.0;
  return 1.0 - receiver.depth / range < stored ? 1.0 : 0.0;
}

float Hard(Receiver receiver, Surface surface) {
  if (Has(kSurveyRule)) return SurveyRule(receiver);
  return IsLit(receiver, int2(floor(receiver.at)));
}

float Pcf(Receiver receiver, Surface surface) {
  return Filter(receiver, constants.radius / maps[receiver.map].texel, surface.turn);
}

// [effects-spec B2.7]
float Pcss(Receiver receiver, Surface surface) {
  const float lit = SoftVisibility(receiver, FindBlockers(receiver, surface.turn), surface.turn);
  return Has(kInnerPenumbra) ? Inner(IsLit(receiver, int2(floor(receiver.at))), lit) : lit;
}

KAAMOS_SHADOW_LOOKUP(ShadowMapHard, Hard)
KAAMOS_SHADOW_LOOKUP(ShadowMapPcf, Pcf)
KAAMOS_SHADOW_LOOKUP(ShadowMapPcss, Pcss)
