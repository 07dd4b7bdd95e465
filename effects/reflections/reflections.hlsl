// SPDX-License-Identifier: MIT
// Opaque reflections: one ray per sample, in a direction drawn from the GGX facets that the camera
// sees, shaded where it hits. [effects-spec B4.10; Control]
#include "hit_indirect.hlsli"
#include "ray_key.hlsli"
#include "sampling.hlsli"

// Sums over samples: radiance / ReflectionScale, and the length of the ray (0: no ray).
RWTexture2D<float4> reflection : register(u0, space3);

struct ReflectionConstants {
  float longest;        // metres, for a mirror
  float shortest;       // metres, for a rough surface
  float length_jitter;  // fraction of the length that varies from ray to ray
  float firefly_limit;  // of a sample's luminance, in multiples of white; 0: no clamping
  uint sun_at_hits;     // 1: a shadow ray per hit
  uint single_length;   // 1: `longest` for all rays, as a reference
  uint fireflies;       // kKeep, kRetrace, kAverage
  uint more_rays;       // of a sample that is too bright
};
ConstantBuffer<ReflectionConstants> constants : register(b0, space3);

static const uint kReflectionPair = 2;  // and 3 [effects-spec B0.3]

// What is done about fireflies. [effects/reflections/reflections.h]
static const uint kKeep = 0;
static const uint kRetrace = 1;
static const uint kAverage = 2;
static const float kTooBright = 2.0;  // times white [GDC 2018 talk]
// Added to the frame's seed, so that pilots and further rays are independent of the samples.
static const uint kPilotSeed = 0x9E3779B9;
static const uint kFurtherSeed = 0x85EBCA6B;
// Above this roughness reflections are noisy and filtered anyway, so reading a single cell of the
// volume per ray adds little noise. In a mirror it would show. The value lies between two of the
// 8-bit values in g_material (53.55 of 255), so rounding never decides.
static const float kNoisyRoughness = 0.21;

struct ReflectionPayload {
  float3 radiance;
  float distance;        // of the hit, metres; negative: a miss
  float3 volume_jitter;  // of the ray's reads of the volume [VolumeTowards]
};

[shader("miss")]
void ReflectionMiss(inout ReflectionPayload payload) {
  // At the end of the ray: the volume holds the light that arrives from beyond.
  const float3 end = WorldRayOrigin() + WorldRayDirection() * RayTCurrent();
  payload.radiance = VolumeRadiance(end, payload.volume_jitter, WorldRayDirection());
  payload.distance = -1.0;
}

[shader("anyhit")]
void ReflectionAnyHit(inout ReflectionPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void ReflectionClosestHit(inout ReflectionPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface = LoadSurface(hit.barycentrics, ConeWidth());
  payload.radiance = ShadeHit(surface, -WorldRayDirection(), constants.sun_at_hits != 0) +
                     IndirectAtHit(surface, payload.volume_jitter, -WorldRayDirection());
  payload.distance = RayTCurrent();
}

// Traces the rays without any shading, to measure what shading costs.
[shader("miss")]
void ReflectionTraceMiss(inout ReflectionPayload payload) {
  payload.distance = -1.0;
}

[shader("closesthit")]
void ReflectionTraceHit(inout ReflectionPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.distance = RayTCurrent();
}

// Rough surfaces blur what is far away, and the volume gives such a blur too, so their rays can be
// shorter. [Control: 200 m to 3 m]
float ReflectionLength(float roughness, float u) {
  const float longest = Contain(constants.longest, kLongestRay);
  if (constants.single_length != 0 || longest == 0.0) return longest;
  const float ratio = clamp(Contain(constants.shortest, kLongestRay) / longest, 1e-30, 1e30);
  const float length = Contain(longest * pow(ratio, saturate(roughness)), kLongestRay);
  return length * (1.0 - Contain(constants.length_jitter, 1.0) * u);
}

// What the rays of a pixel have in common.
struct ReflectionPoint {
  float3 origin;
  float3 normal;
  float3 shading_normal;
  float roughness;
  Brdf brdf;
  float cosine_view;
  float3 local_view;
};

ReflectionPoint LoadReflectionPoint(uint2 pixel) {
  const float4 position = g_position[pixel];
  const float3 view = normalize(-position.xyz);
  ReflectionPoint surface;
  surface.normal = OctahedralDecode(g_normal[pixel]);
  surface.shading_normal = OctahedralDecode(g_shading_normal[pixel]);
  surface.origin = position.xyz + surface.normal * position.w;
  surface.roughness = g_material[pixel].x;
  surface.brdf =
      MakeBrdf(DecodeColor(g_base_color[pixel].rgb), g_material[pixel].y, surface.roughness);
  surface.cosine_view = max(dot(surface.shading_normal, view), 1e-4);
  surface.local_view = ToLocal(view, surface.shading_normal);
  return surface;
}

// In the surface's own frame, about +Z.
float3 SampleHalfVector(ReflectionPoint surface, float2 u) {
  if (IsMirror(surface.roughness)) return float3(0, 0, 1);
  return SampleGgxHalfVector(u, surface.local_view, surface.brdf.alpha);
}

// Radiance that the pixel shows of a reflection, and whether it is a firefly.
bool IsTooBright(float3 light, float3 scale) {
  return RadianceLuminance(light * scale) > kTooBright * frame.white;
}

// The light of one ray over `scale`, and the ray's length. `seed` and `index` choose the ray.
float4 TraceReflection(uint2 pixel, ReflectionPoint surface, float3 scale, uint index, uint seed) {
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kReflectionPair, seed)];
  const float3 half_vector =
      SampleHalfVector(surface, PixelSample(tile, index, kReflectionPair, seed));
  const float3 local_light = reflect(-surface.local_view, half_vector);
  const float3 direction = ToWorld(local_light, surface.shading_normal);
  // Below the surface, either the geometric or the normal-mapped one, there is no light.
  if (!(local_light.z > 0.0) || !(dot(direction, surface.normal) > 0.0)) return float4(0, 0, 0, 0);
  const float2 length_tile = blue_noise[BlueNoiseIndex(pixel, kReflectionPair + 1, seed)];
  const float2 v = PixelSample(length_tile, index, kReflectionPair + 1, seed);
  RayDesc ray;
  ray.Origin = surface.origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = ReflectionLength(surface.roughness, v.x);
  ReflectionPayload payload;
  payload.radiance = float3(0, 0, 0);
  payload.distance = -1.0;
  payload.volume_jitter = kEveryCell;
  if (surface.roughness > kNoisyRoughness) {
    payload.volume_jitter = PixelJitter(pixel, index, kReflectionPair + 1, seed);
  }
  TraceRay(scene, RAY_FLAG_NONE, ReflectionMask(surface.roughness), kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  const float3 weight = GgxSampleWeight(surface.brdf, surface.cosine_view, local_light.z,
                                        dot(surface.local_view, half_vector));
  float3 light = payload.radiance * weight / scale;
  const float luminance = RadianceLuminance(light * scale);
  const float limit = constants.firefly_limit * frame.white;
  if (limit > 0.0 && luminance > limit) light *= limit / luminance;
  return float4(light, payload.distance >= 0.0 ? payload.distance : ray.TMax);
}

[shader("raygeneration")]
void ReflectionRayGen() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    reflection[pixel] = SumBefore(reflection, pixel);
    return;
  }
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const float3 scale = ReflectionScale(
      SpecularAlbedo(surface.brdf.f0, surface.brdf.roughness, surface.cosine_view));
  uint rays_per_sample = 1;
  if (constants.fireflies == kRetrace && !IsMirror(surface.roughness)) {
    const float4 pilot = TraceReflection(pixel, surface, scale, pass_constants.first_sample,
                                         frame.seed + kPilotSeed);
    if (IsTooBright(pilot.rgb, scale)) rays_per_sample += constants.more_rays;
  }

  float4 sum = float4(0, 0, 0, 0);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    const uint index = pass_constants.first_sample + i;
    uint rays = rays_per_sample;
    float4 sample = float4(0, 0, 0, 0);
    for (uint k = 0; k < rays; ++k) {
      // The first ray is the one that would be traced alone.
      const uint ray_index = k == 0 ? index : index * constants.more_rays + k;
      const uint seed = k == 0 ? frame.seed : frame.seed + kFurtherSeed;
      const float4 one = TraceReflection(pixel, surface, scale, ray_index, seed);
      sample += one;
      if (k == 0 && constants.fireflies == kAverage && IsTooBright(one.rgb, scale)) {
        rays += constants.more_rays;
      }
    }
    sum += sample / float(rays);
  }
  reflection[pixel] = SumBefore(reflection, pixel) + sum;
}

[shader("raygeneration")]
void ReflectionKeys() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    WriteNoRayKey(pixel);
    return;
  }
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kReflectionPair, frame.seed)];
  const float2 u = PixelSample(tile, pass_constants.first_sample, kReflectionPair, frame.seed);
  const float3 local_light = reflect(-surface.local_view, SampleHalfVector(surface, u));
  WriteRayKey(pixel, surface.origin, ToWorld(local_light, surface.shading_normal));
}
