// SPDX-License-Identifier: MIT
// This file holds what the shaders of all shadow maps share: the maps, where a surface lies in
// them, and the comparison with its bias. Depths are linear, in metres along the sun's light from
// the plane where the maps begin; larger is farther away from the sun. [effects/SOURCES.md: E10]
#ifndef KAAMOS_SHADOW_MAP_HLSLI
#define KAAMOS_SHADOW_MAP_HLSLI

#include "../../surfaces/gbuffer/scene_draw.hlsli"
#include "alpha_test.hlsli"
#include "sampling.hlsli"

// One map. Mirrors SunMap of effects/shadows/shadow_map/sun_maps.h.
struct ShadowMap {
  // From a position relative to the camera: texels from the map's upper left corner, and depth.
  float4 to_map[3];
  float texel;  // metres along its side
  float range;  // metres that the stored depths 0 to 1 stand for
  float end;    // view depth to which it is used, metres
  float padding;
};

// Mirrors ShadowMapConstants of effects/shadows/shadow_map/shadow_map.h.
struct ShadowMapConstants {
  uint method;
  uint flags;
  uint size;             // texels along a map's side
  uint map_count;        // at least 1
  float constant_bias;   // texels
  float slope_bias;      // texels, times the tangent of the angle between normal and light
  float normal_offset;   // texels along the normal, times the sine
  float most_bias;       // texels
  float radius;          // metres: of the filter, or the widest one
  uint taps;             // of the filter
  uint blocker_taps;     // of the search for what casts the shadow
  float blend;           // share of a map's reach in which it goes over into the next
  float split_share;
  float reach;
  uint draw;             // in `draws`
  uint map;              // in `maps`
#ifdef KAAMOS_SHADOW_MAP_MORE
  KAAMOS_SHADOW_MAP_MORE more;  // what the including file has besides
#endif
};

ConstantBuffer<ShadowMapConstants> constants : register(b0, space3);
StructuredBuffer<SceneDraw> draws : register(t0, space3);
StructuredBuffer<HitConstants> geometries : register(t1, space3);
StructuredBuffer<ShadowMap> maps : register(t2, space3);
StructuredBuffer<float2> disk : register(t3, space3);  // kDiskPoints, evenly spread
Texture2DArray<float> shadow_depth : register(t4, space3);  // share of ShadowMap::range
RWTexture2D<float4> visibility : register(u0, space3);

static const uint kReceiverPlane = 1;
static const uint kGrid = 2;
static const uint kSurveyRule = 4;
static const uint kInnerPenumbra = 16;
static const uint kPerObject = 32;
static const uint kDiskPoints = 64;

bool Has(uint flag) { return (constants.flags & flag) != 0; }

// No surface is taken to be steeper against the light than this: 87 degrees.
static const float kSteepest = 20.0;

// The place of a surface in a map.
struct Receiver {
  uint map;
  float2 at;     // texels
  float depth;   // metres
  float bias;    // metres that it is taken to be nearer to the sun
  float2 slope;  // of the surface's plane: metres of depth per texel
};

Receiver MakeReceiver(uint index, float3 position, float3 normal) {
  const ShadowMap map = maps[index];
  const float cosine = dot(normal, frame.direction_to_sun);
  const float sine = sqrt(saturate(1.0 - cosine * cosine));
  const float3 moved = position + normal * (constants.normal_offset * map.texel * sine);
  Receiver result;
  result.map = index;
  result.at = float2(dot(map.to_map[0], float4(moved, 1)), dot(map.to_map[1], float4(moved, 1)));
  result.depth = dot(map.to_map[2], float4(moved, 1));
  const float over_cosine = 1.0 / max(cosine, 1.0 / kSteepest);
  result.bias = map.texel * min(constants.constant_bias + constants.slope_bias * sine * over_cosine,
                                constants.most_bias);
  // The rows of to_map are the map's axes over the texel's side.
  result.slope = float2(dot(map.to_map[0].xyz, normal), dot(map.to_map[1].xyz, normal)) *
                 (map.texel * map.texel * over_cosine);
  return result;
}

// Depth that a tap at `at` is compared with: of the surface's plane there, or of the point.
float DepthAt(Receiver receiver, float2 at) {
  const float2 away = Has(kReceiverPlane) ? at - receiver.at : float2(0, 0);
  return receiver.depth - receiver.bias + dot(receiver.slope, away);
}

bool IsInMap(int2 texel) {
  return all(texel >= int2(0, 0)) && all(texel < int2(constants.size, constants.size));
}

// Metres; outside of the map nothing casts a shadow.
float OccluderDepth(uint map, int2 texel) {
  if (!IsInMap(texel)) return kLongestRay;
  const float share = shadow_depth[uint3(uint2(texel), map)];
  return share < 1.0 ? share * maps[map].range : kLongestRay;
}

// 1: the texel says that the sun is visible. Lit where the surface is not farther away from the sun
// than what the map holds, once the bias is taken off.
float IsLit(Receiver receiver, int2 texel) {
  const float occluder = OccluderDepth(receiver.map, texel);
  return DepthAt(receiver, float2(texel) + 0.5) <= occluder ? 1.0 : 0.0;
}

// Returns how much the four texels around a point are lit, as if the comparisons were interpolated.
float IsLitSmoothly(Receiver receiver, float2 at) {
  const float2 corner = floor(at - 0.5);
  const float2 part = at - 0.5 - corner;
  const int2 texel = int2(corner);
  const float upper = lerp(IsLit(receiver, texel), IsLit(receiver, texel + int2(1, 0)), part.x);
  const float lower = lerp(IsLit(receiver, texel + int2(0, 1)), IsLit(receiver, texel + int2(1, 1)),
                           part.x);
  return lerp(upper, lower, part.y);
}

// A map and, near the end of its reach, how much of the next one is to be seen.
struct MapChoice {
  uint map;    // map_count: beyond all of them
  float next;
};

MapChoice ChooseMap(float view_z) {
  MapChoice result;
  result.map = 0;
  result.next = 0.0;
  float begin = 0.0;
  while (result.map < constants.map_count && !(view_z <= maps[result.map].end)) {
    begin = maps[result.map].end;
    ++result.map;
  }
  if (result.map + 1 >= constants.map_count) return result;
  const float end = maps[result.map].end;
  const float band = constants.blend * (end - begin);
  if (band > 0.0) result.next = saturate((view_z - (end - band)) / band);
  return result;
}

// The finest map that holds all that a filter around the point reads: what casts a shadow there lies
// in the same texels. The last map holds the scene.
MapChoice ChooseFinestMap(float3 position) {
  MapChoice result;
  result.map = 0;
  result.next = 0.0;
  while (result.map + 1 < constants.map_count) {
    const ShadowMap map = maps[result.map];
    const float border = 1.0 + abs(constants.normal_offset) +
                         (constants.method == 0 ? 0.0 : constants.radius / map.texel);
    const float2 at =
        float2(dot(map.to_map[0], float4(position, 1)), dot(map.to_map[1], float4(position, 1)));
    if (all(at > border) && all(at < float(constants.size) - border)) break;
    ++result.map;
  }
  return result;
}

// The surface that the pixel of a thread shows, and whether the maps have to be asked.
struct Surface {
  float3 position;
  float3 normal;
  float2 turn;  // cosine and sine by which the pixel turns its taps
  MapChoice choice;
};

// False where the answer is known, and written: no pixel, the sky, a surface that faces away. Beyond
// all maps it is written as lit.
bool LoadSurface(uint2 pixel, out Surface surface) {
  surface = (Surface)0;
  uint width, height;
  visibility.GetDimensions(width, height);
  if (pixel.x >= width || pixel.y >= height) return false;
  visibility[pixel] = float4(1, 1, 1, 1);
  if (g_ids[pixel].x == 0) return false;
  surface.position = g_position[pixel].xyz;
  surface.normal = OctahedralDecode(g_normal[pixel]);
  if (!(dot(surface.normal, frame.direction_to_sun) > 0.0)) {
    visibility[pixel] = float4(0, 0, 0, 1);
    return false;
  }
  surface.choice =
      Has(kPerObject) ? ChooseFinestMap(surface.position) : ChooseMap(g_view_z[pixel]);
  const float angle =
      6.2831853 * blue_noise[BlueNoiseIndex(pixel, kSunPair, frame.seed)].x;
  surface.turn = float2(cos(angle), sin(angle));
  return true;
}

// A shader over all pixels of a lookup `float LOOKUP(Receiver, Surface)`.
#define KAAMOS_SHADOW_LOOKUP(NAME, LOOKUP)                                                        \
  [shader("compute")]                                                                             \
  [numthreads(8, 8, 1)]                                                                           \
  void NAME(uint3 id : SV_DispatchThreadID) {                                                     \
    Surface surface;                                                                              \
    if (!LoadSurface(id.xy, surface)) return;                                                     \
    const MapChoice choice = surface.choice;                                                      \
    if (choice.map >= constants.map_count) return;                                                \
    float lit = LOOKUP(MakeReceiver(choice.map, surface.position, surface.normal), surface);      \
    if (choice.next > 0.0) {                                                                      \
      const Receiver next = MakeReceiver(choice.map + 1, surface.position, surface.normal);       \
      lit = lerp(lit, LOOKUP(next, surface), choice.next);                                        \
    }                                                                                             \
    visibility[id.xy] = float4(lit, lit, lit, 1);                                                 \
  }

#endif
