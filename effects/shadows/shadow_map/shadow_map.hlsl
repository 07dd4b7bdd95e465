// SPDX-License-Identifier: MIT
// Finds how much of the sun each pixel sees by comparing depths with a shadow map: at one texel,
// over a filter of one width, and over one as wide as the penumbra. [survey 5.1]
#include "pcss.hlsli"

// The survey writes "lit if p_z is smaller than what is stored" and says neither which way depth
// grows nor what happens where both are the same. With the reversed depth that the rest of the frame
// has, that says the opposite of what is meant. For the test of it alone. [effects/SOURCES.md: E10]
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

// [Fernando 2005]
float Pcss(Receiver receiver, Surface surface) {
  const float lit = SoftVisibility(receiver, FindBlockers(receiver, surface.turn), surface.turn);
  return Has(kInnerPenumbra) ? Inner(IsLit(receiver, int2(floor(receiver.at))), lit) : lit;
}

// Backprojection: each texel that stands in between is a small square at its depth; seen from the
// surface it hides a part of the sun, and the parts are summed up. The sun is taken for a square of
// the same area along the map's axes. [Guennebaud et al. 2006; Atty et al. 2006]
float Backprojection(Receiver receiver, Surface surface) {
  const float texel = maps[receiver.map].texel;
  const float half_sun = 0.8862269 * frame.tan_sun_radius;  // sqrt(pi) / 2
  const float search = min(half_sun * max(receiver.depth, 0.0), constants.radius) / texel;
  // A sun that is a point: one texel.
  if (!(search > 0.0)) return IsLit(receiver, int2(floor(receiver.at)));
  const float gap = FarthestBlocker(receiver, search, surface.turn);
  if (!(gap > 0.0)) return IsLit(receiver, int2(floor(receiver.at)));
  // No square beyond this hides anything. Where there are too many, every second or third texel
  // stands for those around it.
  const float reach = min(half_sun * gap / texel, search);
  const int stride = max(int(ceil((2.0 * reach + 1.0) / float(constants.taps))), 1);
  const int steps = int(ceil(reach / float(stride)));
  float hidden = 0.0;
  for (int y = -steps; y <= steps; ++y) {
    for (int x = -steps; x <= steps; ++x) {
      const int2 tap = int2(floor(receiver.at)) + stride * int2(x, y);
      const float depth = OccluderDepth(receiver.map, tap);
      if (!(depth < DepthAt(receiver, float2(tap) + 0.5))) continue;
      const float over_gap = texel / max(receiver.depth - depth, 1e-3 * texel);
      const float2 at = (float2(tap) + 0.5 - receiver.at) * over_gap;
      const float half_side = 0.5 * float(stride) * over_gap;
      const float2 overlap =
          max(min(at + half_side, half_sun) - max(at - half_side, -half_sun), float2(0, 0));
      hidden += overlap.x * overlap.y;
    }
  }
  return saturate(1.0 - hidden / (4.0 * half_sun * half_sun));
}

KAAMOS_SHADOW_LOOKUP(ShadowMapHard, Hard)
KAAMOS_SHADOW_LOOKUP(ShadowMapPcf, Pcf)
KAAMOS_SHADOW_LOOKUP(ShadowMapPcss, Pcss)
KAAMOS_SHADOW_LOOKUP(ShadowMapBackprojection, Backprojection)
