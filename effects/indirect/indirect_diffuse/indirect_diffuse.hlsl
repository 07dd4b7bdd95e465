// SPDX-License-Identifier: MIT
// Indirect diffuse light of each pixel, in the variants that the talk compares: the volume alone,
// the volume times the open part of rays, rays that read it where they miss and are black where they
// hit, and near-field rays whose hits are shaded. [GDC 2018 talk; Northlight deck: Indirect Diffuse
// Illumination]
#include "hit_indirect.hlsli"
#include "ray_key.hlsli"
#include "sampling.hlsli"

// Sums over samples: irradiance / pi, and the length of the rays.
RWTexture2D<float4> indirect : register(u0, space3);

struct IndirectConstants {
  uint mode;
  float length;  // of the rays, metres
  uint sun_at_hits;
};
ConstantBuffer<IndirectConstants> constants : register(b0, space3);

// IndirectMode in indirect_diffuse.h.
static const uint kModeDirect = 0;
static const uint kModeHitBlack = 1;
static const uint kModeNearField = 2;
static const uint kModeNearFieldGlossy = 3;
static const uint kModeTimesOpen = 4;

static const uint kIndirectPair = 4;    // and 5, for the jitter of the ray's end

struct IndirectPayload {
  float3 radiance;
  float distance;        // of the hit, metres; negative: a miss
  float3 volume_jitter;  // of the ray's reads of the volume [VolumeTowards]
};

float RayLength() { return Contain(constants.length, kLongestRay); }

// Light that arrives where the ray ends, from the volume. [GDC 2018 talk: sampled in the miss
// shader]
float3 RadianceFromEnd(float3 jitter) {
  return VolumeRadiance(WorldRayOrigin() + WorldRayDirection() * RayLength(), jitter,
                        WorldRayDirection());
}

[shader("miss")]
void IndirectMiss(inout IndirectPayload payload) {
  payload.radiance = RadianceFromEnd(payload.volume_jitter);
  payload.distance = -1.0;
}

[shader("anyhit")]
void IndirectAnyHit(inout IndirectPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void IndirectClosestHit(inout IndirectPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const float3 jitter = payload.volume_jitter;
  payload.radiance = float3(0, 0, 0);
  payload.distance = RayTCurrent();
  if (constants.mode == kModeHitBlack) return;
  float3 position, normal;
  if (constants.mode == kModeNearFieldGlossy) {
    const Surface surface = LoadSurface(hit.barycentrics, RayTCurrent());
    payload.radiance = ShadeHit(surface, -WorldRayDirection(), constants.sun_at_hits) +
                       IndirectAtHit(surface, jitter, -WorldRayDirection());
    position = surface.position;
    normal = surface.normal;
  } else {
    const MatteSurface surface = LoadMatteSurface(hit.barycentrics, RayTCurrent());
    payload.radiance = ShadeMatteHit(surface, constants.sun_at_hits) +
                       IndirectAtMatteHit(surface, jitter, -WorldRayDirection());
    position = surface.position;
    normal = surface.normal;
  }
  // Near the ray's end, blend to the volume, so that no shell shows where rays end. It is read in
  // front of the surface: the ray's end lies behind it, maybe in another room.
  const float length = RayLength();
  const float far = smoothstep(0.8 * length, length, RayTCurrent());
  if (far > 0.0) {
    payload.radiance =
        lerp(payload.radiance, VolumeRadianceAt(position, jitter, normal, WorldRayDirection()), far);
  }
}

// Radiance from one direction; w is the distance that its ray reached.
float4 Gather(float3 origin, float3 direction, float3 jitter) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = RayLength();
  IndirectPayload payload;
  payload.radiance = float3(0, 0, 0);
  payload.distance = -1.0;
  payload.volume_jitter = jitter;
  TraceRay(scene, RAY_FLAG_NONE, kMaskWithoutLamps, kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  return float4(payload.radiance, payload.distance < 0.0 ? ray.TMax : payload.distance);
}

float3 IndirectDirection(float2 tile, uint index, float3 shading_normal) {
  const float2 u = PixelSample(tile, index, kIndirectPair, frame.seed);
  return ToWorld(SampleCosineHemisphere(u), shading_normal);
}

// Returns how many of the pixel's rays hit nothing.
float OpenRays(float3 origin, float2 tile, float3 normal, float3 shading_normal) {
  float open = 0.0;
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const float3 direction = IndirectDirection(tile, pass_constants.first_sample + i, shading_normal);
    if (dot(direction, normal) > 0.0) open += TraceVisibility(origin, direction, RayLength());
  }
  return open;
}

[shader("raygeneration")]
void IndirectRayGen() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    indirect[pixel] = SumBefore(indirect, pixel);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 shading_normal = OctahedralDecode(g_shading_normal[pixel]);
  if (constants.mode == kModeDirect) {
    const float count = float(pass_constants.sample_count);
    indirect[pixel] =
        SumBefore(indirect, pixel) +
        count * float4(VolumeIrradianceAt(position.xyz, kEveryCell, shading_normal), 0.0);
    return;
  }
  const float3 origin = position.xyz + normal * position.w;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kIndirectPair, frame.seed)];
  if (constants.mode == kModeTimesOpen) {
    const float open = OpenRays(origin, tile, normal, shading_normal);
    indirect[pixel] =
        SumBefore(indirect, pixel) +
        open * float4(VolumeIrradianceAt(position.xyz, kEveryCell, shading_normal), 0.0);
    return;
  }
  float4 sum = float4(0, 0, 0, 0);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const uint index = pass_constants.first_sample + i;
    const float3 direction = IndirectDirection(tile, index, shading_normal);
    if (!(dot(direction, normal) > 0.0)) continue;
    // A jitter of half a cell to each side hides the steps between cells.
    sum += Gather(origin, direction, PixelJitter(pixel, index, kIndirectPair + 1, frame.seed));
  }
  indirect[pixel] = SumBefore(indirect, pixel) + sum;
}

[shader("raygeneration")]
void IndirectKeys() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    WriteNoRayKey(pixel);
    return;
  }
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kIndirectPair, frame.seed)];
  WriteRayKey(pixel, g_position[pixel].xyz,
              IndirectDirection(tile, pass_constants.first_sample,
                                OctahedralDecode(g_shading_normal[pixel])),
              RayLength());
}
