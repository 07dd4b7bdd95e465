// SPDX-License-Identifier: MIT
// For tests: draws directions from the samplers of the reference, with independent random numbers,
// and evaluates its material and the frame's side by side.
#include "brdf.hlsli"
#include "path_lights.hlsli"
#include "sampling.hlsli"

// A direction and its density.
RWStructuredBuffer<float4> drawn : register(u0, space3);
// The two materials' values for one pair of directions: diffuse and specular, of the reference and
// of the frame, each times the cosine, for a grey surface.
RWStructuredBuffer<float4> values : register(u1, space3);

struct SampleConstants {
  uint kind;
  uint count;
  uint seed;
  float base;
  float metallic;
  float roughness;
  float cosine_view;
  float size;  // of a cone: the sine of its half angle; of an emitter: how many there are
};
ConstantBuffer<SampleConstants> constants : register(b0, space3);

static const uint kMaterialDirections = 0;
static const uint kFacets = 1;
static const uint kCone = 2;
static const uint kSkyDirections = 3;
static const uint kEmitterDirections = 4;

float3 SlantedView() {
  return float3(sqrt(1.0 - constants.cosine_view * constants.cosine_view), 0.0,
                constants.cosine_view);
}

PathBsdf TestBsdf() {
  const float3 base = float3(1, 1, 1) * constants.base;
  return MakePathBsdf(specular_albedo, base, constants.metallic, constants.roughness,
                      float3(0.04, 0.04, 0.04), 1.0, float3(0, 0, 1), SlantedView());
}

[shader("compute")]
[numthreads(64, 1, 1)]
void DrawDirections(uint3 id : SV_DispatchThreadID) {
  if (id.x >= constants.count) return;
  const uint key = HashCombine(constants.seed, id.x);
  const float2 u = float2(UnitFloat(PcgHash(key)), UnitFloat(PcgHash(key + 1)));
  const float choice = UnitFloat(PcgHash(key + 2));
  float4 result = float4(0, 0, 0, 0);
  if (constants.kind == kMaterialDirections) {
    const PathDirection sampled = PathSampleDirection(TestBsdf(), u, choice);
    if (sampled.is_valid) result = float4(sampled.direction, sampled.density);
  } else if (constants.kind == kFacets) {
    const float alpha = constants.roughness * constants.roughness;
    result = float4(SampleFacet(u, SlantedView(), alpha), 0.0);
  } else if (constants.kind == kCone) {
    const float height = CapHeight(constants.size * constants.size);
    result = float4(SampleCone(u, float3(0, 0, 1), height), ConeDensity(height));
  } else if (constants.kind == kSkyDirections) {
    const LightRay ray = SampleSky(u);
    result = float4(ray.direction, ray.density);
  } else {
    const LightRay ray = SampleEmitter(u, choice, uint(constants.size), float3(0, 0, 0));
    result = float4(ray.direction, ray.density);
  }
  drawn[id.x] = result;
}

[shader("compute")]
[numthreads(64, 1, 1)]
void CompareMaterials(uint3 id : SV_DispatchThreadID) {
  if (id.x >= constants.count) return;
  const uint key = HashCombine(constants.seed, id.x);
  const float2 u = float2(UnitFloat(PcgHash(key)), UnitFloat(PcgHash(key + 1)));
  const float z = 0.001 + 0.999 * u.x;
  const float r = sqrt(1.0 - z * z);
  const float3 light = float3(r * cos(6.2831853 * u.y), r * sin(6.2831853 * u.y), z);
  const PathValue value = PathEvaluate(TestBsdf(), light);
  const Brdf brdf = MakeBrdf(float3(1, 1, 1) * constants.base, constants.metallic, constants.roughness);
  const BrdfView view = MakeBrdfView(brdf, float3(0, 0, 1), SlantedView());
  values[id.x] = float4(value.lobes.diffuse.x, value.lobes.specular.x,
                        EvaluateBrdf(brdf, view, light).x, z);
}
