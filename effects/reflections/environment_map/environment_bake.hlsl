// SPDX-License-Identifier: MIT
// Fills environment maps: rays from each probe through the texels of its cube, shaded as those of
// reflections are, and then a blur for each level of roughness. Nothing that moves is seen, nor
// lamps, which surfaces have as lights. [Karis 2013, Real Shading in UE4]
#include "hit_indirect.hlsli"
#include "probe_sights.hlsli"
#include "sampling.hlsli"

RWTexture2DArray<float4> texels : register(u20, space3);  // one level; six faces for each probe
TextureCubeArray<float4> finest : register(t5, space3);
SamplerState finest_sampler : register(s0, space3);

struct BakeConstants {
  float3 probe;      // relative to the camera
  uint first_face;   // of the probe
  uint side;         // texels, of the level
  uint samples;      // rays of a texel, or directions of its blur
  float roughness;   // that the level is for
};
ConstantBuffer<BakeConstants> constants : register(b0, space3);

static const uint kEnvironmentPair = 2;

struct EnvironmentPayload {
  float3 radiance;
};

[shader("miss")]
void EnvironmentMiss(inout EnvironmentPayload payload) {
  payload.radiance = SkyTowards(WorldRayDirection());
}

[shader("anyhit")]
void EnvironmentAnyHit(inout EnvironmentPayload payload,
                       in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void EnvironmentClosestHit(inout EnvironmentPayload payload,
                           in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface = LoadSurface(hit.barycentrics, 0.0);
  payload.radiance = ShadeHit(surface, -WorldRayDirection(), kSunAtHitsByRay) +
                     IndirectAtHit(surface, kEveryCell, -WorldRayDirection());
}

// A row of six faces.
[shader("raygeneration")]
void EnvironmentRayGen() {
  const uint face = DispatchRaysIndex().x / constants.side;
  const uint2 texel = uint2(DispatchRaysIndex().x % constants.side, DispatchRaysIndex().y);
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < constants.samples; ++i) {
    const float2 u = SobolOwen(i, HashCombine(frame.seed, kEnvironmentPair));
    RayDesc ray;
    ray.Origin = constants.probe;
    ray.TMin = 0.0;
    ray.Direction = normalize(FaceDirection(face, (float2(texel) + u) / float(constants.side)));
    ray.TMax = kLongestRay;
    EnvironmentPayload payload;
    payload.radiance = float3(0, 0, 0);
    TraceRay(scene, RAY_FLAG_NONE, kMaskBaked, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
             payload);
    sum += Contain(payload.radiance, kLargestRadiance);
  }
  texels[uint3(texel, constants.first_face + face)] =
      float4(sum / float(max(constants.samples, 1u)), 1.0);
}

// The mean of the finest level about a direction, weighted as GGX reflects it to an eye that looks
// along the normal.
[shader("compute")]
[numthreads(8, 8, 1)]
void FilterEnvironment(uint3 id : SV_DispatchThreadID) {
  const uint side = constants.side;
  if (id.x >= 6 * side || id.y >= side) return;
  const uint face = id.x / side;
  const float2 uv = (float2(id.x % side, id.y) + 0.5) / float(side);
  const float3 normal = normalize(FaceDirection(face, uv));
  const float cube = float(constants.first_face / 6);
  const float alpha = constants.roughness * constants.roughness;
  float3 sum = float3(0, 0, 0);
  float weights = 0.0;
  for (uint i = 0; i < constants.samples; ++i) {
    const float2 u = SobolOwen(i, HashCombine(frame.seed, kEnvironmentPair));
    const float3 half_vector = SampleGgxHalfVector(u, float3(0, 0, 1), alpha);
    const float3 light = reflect(float3(0, 0, -1), half_vector);
    if (!(light.z > 0.0)) continue;
    sum += light.z * finest.SampleLevel(finest_sampler, float4(ToWorld(light, normal), cube), 0.0).rgb;
    weights += light.z;
  }
  if (constants.samples == 0 || !(weights > 0.0)) {
    sum = finest.SampleLevel(finest_sampler, float4(normal, cube), 0.0).rgb;
    weights = 1.0;
  }
  texels[uint3(id.x % side, id.y, constants.first_face + face)] = float4(sum / weights, 1.0);
}
