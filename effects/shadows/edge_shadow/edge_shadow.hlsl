// SPDX-License-Identifier: MIT
// Rays to the sun at the edges between light and shadow alone: where all texels of a map that can
// matter say the same, a pixel is lit or dark without one. [survey 4]

// Mirrors the members of EdgeShadowConstants of edge_shadow.h behind `map`.
struct EdgeConstants {
  float margin;  // texels, that the map may be wrong
};
#define KAAMOS_SHADOW_MAP_MORE EdgeConstants

#include "../shadow_map/shadow_map.hlsli"
#include "occluder.hlsli"

// x: kLit, kDark or kEdge, y: the rays that were traced.
RWTexture2D<float4> places : register(u1, space3);

static const uint kLit = 0;
static const uint kDark = 1;
static const uint kEdge = 2;

// How the texels around a surface see it. What stands in the sun's light at some distance hides a
// part of the sun from a surface only within the penumbra that it casts there; a texel beyond says
// nothing about it, and lets light by.
uint Classify(Receiver receiver) {
  const float texel = maps[receiver.map].texel;
  const float margin = constants.more.margin;
  const float widest =
      min(frame.tan_sun_radius * max(receiver.depth, 0.0), constants.radius) / texel + margin;
  const int2 center = int2(floor(receiver.at));
  // Where there are too many, every second or third texel stands for those around it.
  const int stride = max(int(ceil((2.0 * widest + 1.0) / float(constants.taps))), 1);
  const int steps = int(ceil(widest / float(stride)));
  float gap = -1.0;  // the largest, metres
  float nearest_open = kLongestRay;  // texels
  for (int y = -steps; y <= steps; ++y) {
    for (int x = -steps; x <= steps; ++x) {
      const int2 tap = center + stride * int2(x, y);
      const float2 away = max(abs(float2(tap) + 0.5 - receiver.at) - 0.5 * float(stride), 0.0);
      const float distance = length(away);
      if (distance > widest) continue;
      const float depth = OccluderDepth(receiver.map, tap);
      const bool is_between = depth < DepthAt(receiver, float2(tap) + 0.5);
      const float own_gap = max(receiver.depth - depth, 0.0);
      const float own_reach = frame.tan_sun_radius * own_gap / texel + margin;
      if (is_between && distance <= own_reach) {
        gap = max(gap, own_gap);
      } else if (!is_between || distance > own_reach + 1.0) {
        // The rim of an occluder that slopes is neither.
        nearest_open = min(nearest_open, distance);
      }
    }
  }
  if (gap < 0.0) return kLit;
  const float reach = min(frame.tan_sun_radius * gap / texel + margin, widest);
  return nearest_open > reach ? kDark : kEdge;
}

uint ClassifyPixel(Surface surface) {
  const float cosine = dot(surface.normal, frame.direction_to_sun);
  // A part of the sun stands above the surface's own horizon.
  if (abs(cosine) <= 1.001 * frame.tan_sun_radius) return kEdge;
  if (cosine < 0.0) return kDark;
  if (surface.choice.map >= constants.map_count) return kEdge;  // beyond all maps
  return Classify(MakeReceiver(surface.choice.map, surface.position, surface.normal));
}

[shader("raygeneration")]
void EdgeShadowRayGen() {
  const uint2 pixel = FramePixel();
  places[pixel] = float4(0, 0, 0, 0);
  Surface surface;
  LoadSurface(pixel, surface);
  if (g_ids[pixel].x == 0) return;
  const uint place = ClassifyPixel(surface);
  float lit = place == kLit ? 1.0 : 0.0;
  uint rays = 0;
  if (place == kEdge) {
    // The samples of the effect "sun".
    const float3 origin = surface.position + surface.normal * g_position[pixel].w;
    const float2 tile = blue_noise[BlueNoiseIndex(pixel, kSunPair, frame.seed)];
    for (uint i = 0; i < pass_constants.sample_count; ++i) {
      const uint index = pass_constants.first_sample + i;
      const float3 direction = SampleSun(PixelSample(tile, index, kSunPair, frame.seed),
                                         frame.direction_to_sun, frame.tan_sun_radius);
      if (!(dot(direction, surface.normal) > 0.0)) continue;
      lit += IsOpenTowards(origin, direction, kSunDistance) ? 1.0 : 0.0;
      ++rays;
    }
    lit /= float(max(pass_constants.sample_count, 1u));
  }
  visibility[pixel] = float4(lit, lit, lit, 1);
  places[pixel] = float4(float(place), float(rays), 0, 0);
}
