// SPDX-License-Identifier: MIT
// How much of the sun each pixel sees, by comparing depths with a shadow map: at one texel, over a
// filter of one width, and over one as wide as the penumbra. [effects-spec B2.1, B2.3, B2.7]
#include "shadow_map.hlsli"

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

// Point `i` of the disk, turned; length up to 1.
float2 DiskTap(uint i, float2 turn) {
  const float2 p = disk[i % kDiskPoints];
  return float2(p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x);
}

// Mean of the comparisons within `radius` texels: over a square of as many rows of taps as columns,
// or over a disk, whose taps each pixel turns by another angle. [Reeves, Salesin & Cook 1987]
float Filter(Receiver receiver, float radius, float2 turn) {
  float lit = 0.0;
  if (Has(kGrid)) {
    const uint rows = max(uint(sqrt(float(constants.taps)) + 0.5), 1u);
    for (uint i = 0; i < rows * rows; ++i) {
      const float2 place = (float2(i % rows, i / rows) + 0.5) * (2.0 / float(rows)) - 1.0;
      lit += IsLitSmoothly(receiver, receiver.at + radius * place);
    }
    return lit / float(rows * rows);
  }
  const uint taps = max(constants.taps, 1u);
  for (uint i = 0; i < taps; ++i) {
    lit += IsLit(receiver, int2(floor(receiver.at + radius * DiskTap(i, turn))));
  }
  return lit / float(taps);
}

float Pcf(Receiver receiver, Surface surface) {
  return Filter(receiver, constants.radius / maps[receiver.map].texel, surface.turn);
}

// The half of a penumbra that lies in the hard shadow, with twice the contrast: all of the sun where
// the hard shadow ends, none where all of the sun is hidden. [effects-spec B2.13]
float Inner(Receiver receiver, float lit) {
  return IsLit(receiver, int2(floor(receiver.at))) > 0.0 ? 1.0 : saturate(2.0 * lit);
}

// Percentage-closer soft shadows: the mean depth of what stands between here and the sun gives the
// width of the penumbra, and that is the width of the filter. [Fernando 2005; effects-spec B2.7]
float Pcss(Receiver receiver, Surface surface) {
  const float texel = maps[receiver.map].texel;
  const float most = constants.radius;
  const float search = min(frame.tan_sun_radius * max(receiver.depth, 0.0), most) / texel;
  // A sun that is a point: one tap.
  if (!(search > 0.0)) return IsLit(receiver, int2(floor(receiver.at)));
  float sum = 0.0;
  float blockers = 0.0;
  const uint taps = max(constants.blocker_taps, 1u);
  for (uint i = 0; i < taps; ++i) {
    const int2 tap = int2(floor(receiver.at + search * DiskTap(i, surface.turn)));
    const float depth = OccluderDepth(receiver.map, tap);
    if (depth < DepthAt(receiver, float2(tap) + 0.5)) {
      sum += depth;
      blockers += 1.0;
    }
  }
  if (blockers == 0.0) return 1.0;
  // Rounding may put the mean behind the surface.
  const float gap = max(receiver.depth - sum / blockers, 0.0);
  const float penumbra = clamp(frame.tan_sun_radius * gap, 0.5 * texel, max(most, 0.5 * texel));
  const float lit = Filter(receiver, penumbra / texel, surface.turn);
  return Has(kInnerPenumbra) ? Inner(receiver, lit) : lit;
}

KAAMOS_SHADOW_LOOKUP(ShadowMapHard, Hard)
KAAMOS_SHADOW_LOOKUP(ShadowMapPcf, Pcf)
KAAMOS_SHADOW_LOOKUP(ShadowMapPcss, Pcss)
