// SPDX-License-Identifier: MIT
// Near what casts it a shadow is the hard one of a ray, far from it the soft one of a shadow map, and
// in between a mixture by the distance of what casts it. [Story 2015]

// Mirrors the member of HybridShadowConstants of hybrid_shadow.h behind `map`.
struct HybridConstants {
  float soft_from;  // metres: no hard shadow from this distance on
};
#define KAAMOS_SHADOW_MAP_MORE HybridConstants

#include "../shadow_map/pcss.hlsli"
#include "occluder.hlsli"

// Share of the sun by one map. `occluder` is the distance to what the ray met.
float Mixed(Receiver receiver, Surface surface, float occluder) {
  const bool is_lit = occluder == kNoOccluder;
  const float hard = is_lit ? 1.0 : 0.0;
  const Blockers blockers = FindBlockers(receiver, surface.turn);
  // The map misses what is thinner than a texel or touches the surface; the ray decides there.
  if (blockers.count == 0.0) return hard;
  // Beside a shadow the ray meets nothing: there the map says how far what casts it is away.
  const float distance = is_lit ? blockers.gap : occluder;
  float soft = SoftVisibility(receiver, blockers, surface.turn);
  if (Has(kInnerPenumbra)) soft = Inner(hard, soft);
  return lerp(hard, soft, saturate(distance / max(constants.more.soft_from, 1e-6)));
}

[shader("raygeneration")]
void HybridShadowRayGen() {
  const uint2 pixel = FramePixel();
  Surface surface;
  if (!LoadSurface(pixel, surface)) return;
  const float3 origin = surface.position + surface.normal * g_position[pixel].w;
  const float occluder = TraceOccluder(origin, frame.direction_to_sun, kSunDistance).distance;
  const MapChoice choice = surface.choice;
  float lit = occluder == kNoOccluder ? 1.0 : 0.0;  // beyond all maps
  if (choice.map < constants.map_count) {
    lit = Mixed(MakeReceiver(choice.map, surface.position, surface.normal), surface, occluder);
  }
  if (choice.next > 0.0) {
    const Receiver next = MakeReceiver(choice.map + 1, surface.position, surface.normal);
    lit = lerp(lit, Mixed(next, surface, occluder), choice.next);
  }
  visibility[pixel] = float4(lit, lit, lit, 1);
}
