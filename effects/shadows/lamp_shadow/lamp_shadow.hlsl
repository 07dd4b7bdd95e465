// SPDX-License-Identifier: MIT
// The shadow of one local light, or of each pixel's two strongest: by its map in the atlas, hard,
// filtered as wide everywhere, or as wide as the penumbra; by rays; or by a ray near what casts it
// and by the map far from it.
// [survey 5.1.4; Fernando 2005; Story 2015]
#include "hit_lighting.hlsli"
#include "occluder.hlsli"
#include "sampling.hlsli"

RWTexture2D<uint2> strongest : register(u0, space3);  // point light, spot light [direct.hlsl]
RWTexture2D<float4> visibility : register(u1, space3);

// Mirrors LampShadowConstants of effects/shadows/lamp_shadow/lamp_shadow.h.
struct LampShadowConstants {
  uint light;
  uint method;
  uint taps;
  uint blocker_taps;
  float near_plane;  // metres
  float widest;      // metres on the surface
  float soft_from;   // metres
};
ConstantBuffer<LampShadowConstants> constants : register(b0, space3);

static const uint kMapHard = 0;
static const uint kMapPcf = 1;
static const uint kMapPcss = 2;
static const uint kHybrid = 3;
static const uint kRayHard = 4;

static const uint kStrongest = 0xFFFFFF;  // for constants.light; in `strongest`: none
static const uint kLampPair = 6;          // and 7
static const float kGoldenAngle = 2.3999632;

// A surface as the light sees it. Points are relative to the light.
struct LampReceiver {
  uint lamp;         // a place in `lights`
  float3 at;         // moved along the normal, as ShadowMapVisibility does
  float3 normal;
  float distance;    // metres
  float texel;       // of the map, metres on the surface
  float turn;        // radians by which the pixel turns its taps
};

// Point `i` of `count` that are evenly spread over the unit disk, turned.
float2 DiskTap(uint i, uint count, float turn) {
  const float angle = float(i) * kGoldenAngle + turn;
  return sqrt((float(i) + 0.5) / float(count)) * float2(cos(angle), sin(angle));
}

// The point of the surface's plane that stands `away` metres beside the receiver, seen from the
// light. Far out the plane is not followed, which would end nowhere.
float3 PointBeside(LampReceiver receiver, float2 away) {
  const float3 beside = receiver.at + ToWorld(float3(away, 0.0), receiver.at / receiver.distance);
  const float along = dot(receiver.normal, beside);
  const float scale = dot(receiver.normal, receiver.at) / (along < 0.0 ? along : -1e-20);
  return beside * clamp(scale, 0.5, 2.0);
}

// The texel that a point falls on; all are 0 where the light saw nothing, or a spot does not shine.
float4 AtlasTexel(LightConstants light, uint lamp, float3 at, float distance) {
  const float2 uv = ShadowMapUv(light, at, distance);
  if (any(uv < 0.0) || any(uv >= 1.0)) return float4(0, 0, 0, 0);
  return shadow_atlas[ShadowTileOrigin(lamp) + uint2(uv * float(kShadowTile))];
}

bool IsHidden(LampReceiver receiver, float4 occluder, float3 at) {
  return IsBehind(occluder, at, length(at), kShadowTolerance * receiver.texel);
}

// The part of a disk of this radius, metres, that the map shows as lit.
float Filter(LightConstants light, LampReceiver receiver, float radius) {
  const uint taps = max(constants.taps, 1u);
  float lit = 0.0;
  for (uint i = 0; i < taps; ++i) {
    const float3 at = PointBeside(receiver, radius * DiskTap(i, taps, receiver.turn));
    lit += IsHidden(receiver, AtlasTexel(light, receiver.lamp, at, length(at)), at) ? 0.0 : 1.0;
  }
  return lit / float(taps);
}

// What the map has between a surface and the light.
struct LampBlockers {
  float count;     // taps that found any
  float distance;  // metres from the light, their mean
};

// Looks where the light's sphere lies over the map, as if that were near_plane away from the light:
// w_light * (p_z - z_near) / p_z there, p_z / z_near times as much on the surface.
LampBlockers FindBlockers(LightConstants light, LampReceiver receiver) {
  LampBlockers result;
  result.count = 0.0;
  result.distance = 0.0;
  const float near_plane = min(constants.near_plane, receiver.distance);
  const float radius = min(light.radius * (receiver.distance - near_plane) / max(near_plane, 1e-6),
                           constants.widest);
  const uint taps = max(constants.blocker_taps, 1u);
  for (uint i = 0; i < taps; ++i) {
    const float3 at = PointBeside(receiver, radius * DiskTap(i, taps, receiver.turn));
    const float distance = length(at);
    const float4 occluder = AtlasTexel(light, receiver.lamp, at, distance);
    if (!IsHidden(receiver, occluder, at)) continue;
    const float ratio = distance * occluder.w;
    result.distance += distance / clamp(dot(occluder.xyz, at), 0.5 * ratio, 2.0 * ratio);
    result.count += 1.0;
  }
  if (result.count > 0.0) result.distance = min(result.distance / result.count, receiver.distance);
  return result;
}

// The survey's two formulas: the penumbra on the surface is w_pen = (p_z - z) / z * w_light wide,
// and z_near / p_z of that on a map that is z_near away from the light. There a texel is z_near / p_z
// of what it is on the surface, so that the filter is w_pen wide on the surface. [survey 5.1.4]
float SoftVisibility(LightConstants light, LampReceiver receiver, LampBlockers blockers) {
  if (blockers.count == 0.0) return 1.0;
  const float penumbra = light.radius * (receiver.distance - blockers.distance) /
                         max(blockers.distance, 1e-6 * receiver.distance);
  const float least = 0.5 * receiver.texel;
  return Filter(light, receiver, clamp(penumbra, least, max(constants.widest, least)));
}

float Pcss(LightConstants light, LampReceiver receiver) {
  return SoftVisibility(light, receiver, FindBlockers(light, receiver));
}

// `occluder`: metres from the surface to what a ray has met.
float Hybrid(LightConstants light, LampReceiver receiver, float occluder) {
  const bool is_lit = occluder == kNoOccluder;
  const float hard = is_lit ? 1.0 : 0.0;
  const LampBlockers blockers = FindBlockers(light, receiver);
  // The map misses what is thinner than a texel or touches the surface; the ray decides there.
  if (blockers.count == 0.0) return hard;
  // Beside a shadow the ray meets nothing: there the map says how far what casts it is away.
  const float distance = is_lit ? receiver.distance - blockers.distance : occluder;
  return lerp(hard, SoftVisibility(light, receiver, blockers),
              saturate(distance / max(constants.soft_from, 1e-6)));
}

// Metres to what a ray from the surface to a point of the light meets. A surface that faces away
// meets itself. `beside`: metres from the light's centre, across the way to it.
float Occluder(LightConstants light, float3 position, float3 normal, float offset, float2 beside) {
  const float3 to_center = light.position - position;
  const float3 target =
      to_center + ToWorld(float3(beside, 0.0), to_center / length(to_center));
  const float reach = length(target);
  const float3 direction = target / reach;
  if (!(dot(direction, normal) > 0.0)) return 0.0;
  // The lamp's own surface must not shadow it.
  const float end = reach - light.radius;
  if (!(end > 0.0)) return kNoOccluder;
  const float3 origin = position + normal * offset;
  if (constants.method == kHybrid) return TraceOccluder(origin, direction, end).distance;
  return IsOpenTowards(origin, direction, end) ? kNoOccluder : 0.0;
}

float ByRays(LightConstants light, uint2 pixel, uint pair, float3 position, float3 normal,
             float offset) {
  const uint count = constants.method == kRayHard ? 1u : max(pass_constants.sample_count, 1u);
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, pair, frame.seed)];
  float visible = 0.0;
  for (uint i = 0; i < count; ++i) {
    const float2 u = PixelSample(tile, pass_constants.first_sample + i, pair, frame.seed);
    const float2 beside =
        constants.method == kRayHard ? float2(0, 0) : SampleDisk(u) * light.radius;
    visible += Occluder(light, position, normal, offset, beside) == kNoOccluder ? 1.0 : 0.0;
  }
  return visible / float(count);
}

// Within the light's range and a spot's cone.
bool IsInReach(LightConstants light, float3 from_light, float distance) {
  if (distance >= light.range) return false;
  return light.is_spot == 0 ||
         dot(from_light, light.direction) > light.cos_outer * distance;
}

float Visibility(uint lamp, uint2 pixel, uint pair) {
  const LightConstants light = lights[lamp];
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 from_light = position.xyz - light.position;
  const float distance = length(from_light);
  if (!(distance > light.radius)) return 1.0;
  if (!IsInReach(light, from_light, distance)) return 0.0;
  if (constants.method >= kRayHard) {
    return ByRays(light, pixel, pair, position.xyz, normal, position.w);
  }
  if (!(dot(from_light, normal) < 0.0)) return 0.0;
  if (constants.method == kMapHard) {
    return ShadowMapVisibility(lamp, light, position.xyz, normal);
  }
  LampReceiver receiver;
  receiver.lamp = lamp;
  receiver.texel = distance * light.map_texel;
  receiver.at = from_light + normal * (kShadowOffset * receiver.texel);
  receiver.normal = normal;
  receiver.distance = length(receiver.at);
  receiver.turn = 6.2831853 * blue_noise[BlueNoiseIndex(pixel, pair, frame.seed)].x;
  if (!(receiver.distance > 0.0)) return 1.0;
  if (constants.method == kMapPcf) return Filter(light, receiver, constants.widest);
  if (constants.method == kMapPcss) return Pcss(light, receiver);
  return Hybrid(light, receiver,
                Occluder(light, position.xyz, normal, position.w, float2(0, 0)));
}

[shader("raygeneration")]
void LampShadowRayGen() {
  const uint2 pixel = FramePixel();
  float2 visible = float2(1, 1);
  if (g_ids[pixel].x != 0) {
    for (uint kind = 0; kind < 2; ++kind) {
      const uint lamp = constants.light == kStrongest ? strongest[pixel][kind] : constants.light;
      if (lamp < frame.light_count) visible[kind] = Visibility(lamp, pixel, kLampPair + kind);
      if (constants.light != kStrongest) break;
    }
  }
  visibility[pixel] = float4(visible, visible.x, 1.0);
}
