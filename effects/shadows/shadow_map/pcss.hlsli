// SPDX-License-Identifier: MIT
// Percentage-closer soft shadows: the mean depth of what stands between a surface and the sun gives
// the width of the penumbra, and that is the width of the filter. [Fernando 2005]
#ifndef KAAMOS_PCSS_HLSLI
#define KAAMOS_PCSS_HLSLI

#include "shadow_map.hlsli"

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

// The occluders that the map has between a surface and the sun.
struct Blockers {
  bool searched;  // false: the sun is a point, or nothing can be in between
  float count;    // taps that found any
  float gap;      // metres from their mean depth to the surface
};

Blockers FindBlockers(Receiver receiver, float2 turn) {
  Blockers result;
  const float texel = maps[receiver.map].texel;
  const float search =
      min(frame.tan_sun_radius * max(receiver.depth, 0.0), constants.radius) / texel;
  result.searched = search > 0.0;
  result.count = 0.0;
  result.gap = 0.0;
  if (!result.searched) return result;
  float sum = 0.0;
  const uint taps = max(constants.blocker_taps, 1u);
  for (uint i = 0; i < taps; ++i) {
    const int2 tap = int2(floor(receiver.at + search * DiskTap(i, turn)));
    const float depth = OccluderDepth(receiver.map, tap);
    if (depth < DepthAt(receiver, float2(tap) + 0.5)) {
      sum += depth;
      result.count += 1.0;
    }
  }
  // Rounding may put the mean behind the surface.
  if (result.count > 0.0) result.gap = max(receiver.depth - sum / result.count, 0.0);
  return result;
}

// Metres from a surface to the nearest to the sun of what stands in between, by the same taps; 0:
// they meet nothing. `search` in texels.
float FarthestBlocker(Receiver receiver, float search, float2 turn) {
  float gap = 0.0;
  const uint taps = max(constants.blocker_taps, 1u);
  for (uint i = 0; i < taps; ++i) {
    const int2 tap = int2(floor(receiver.at + search * DiskTap(i, turn)));
    const float depth = OccluderDepth(receiver.map, tap);
    if (depth < DepthAt(receiver, float2(tap) + 0.5)) gap = max(gap, receiver.depth - depth);
  }
  return gap;
}

float SoftVisibility(Receiver receiver, Blockers blockers, float2 turn) {
  if (!blockers.searched) return IsLit(receiver, int2(floor(receiver.at)));
  if (blockers.count == 0.0) return 1.0;
  const float texel = maps[receiver.map].texel;
  const float penumbra = clamp(frame.tan_sun_radius * blockers.gap, 0.5 * texel,
                               max(constants.radius, 0.5 * texel));
  return Filter(receiver, penumbra / texel, turn);
}

// The half of a penumbra that lies in the hard shadow, with twice the contrast: all of the sun where
// the hard shadow ends, none where all of the sun is hidden. [Story 2015]
float Inner(float hard, float lit) { return hard > 0.0 ? 1.0 : saturate(2.0 * lit); }

#endif
