// SPDX-License-Identifier: MIT
// Ambient occlusion: the fraction of the hemisphere, weighted by the cosine, that is open up to a
// radius. Directions are cosine-distributed, so the estimate is simply the mean visibility. Further
// down, the same with directions that are uniform over the hemisphere. [GDC 2018 talk; survey 7.4]
#include "visibility.hlsli"
#include "ray_key.hlsli"
#include "sampling.hlsli"

// Open samples.
RWTexture2D<float> ambient_occlusion_sum : register(u0, space3);

float3 OcclusionDirection(float2 tile, uint index, float3 shading_normal) {
  const float2 u = PixelSample(tile, index, kAmbientOcclusionPair, frame.seed);
  return ToWorld(SampleCosineHemisphere(u), shading_normal);
}

[shader("raygeneration")]
void AmbientOcclusionRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  // The sky is open, and with a radius of zero nothing can be in the way.
  if (g_ids[pixel].x == 0 || !(pass_constants.radius > 0.0)) {
    ambient_occlusion_sum[pixel] = SumBefore(ambient_occlusion_sum, pixel) + float(count);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 shading_normal = OctahedralDecode(g_shading_normal[pixel]);
  const float3 origin = position.xyz + normal * position.w;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kAmbientOcclusionPair, frame.seed)];

  float open = 0.0;
  for (uint i = 0; i < count; ++i) {
    const float3 direction = OcclusionDirection(tile, pass_constants.first_sample + i, shading_normal);
    // Directions below the geometric surface count as blocked; they would see the inside of the
    // object.
    if (dot(direction, normal) > 0.0) {
      open += TraceVisibility(origin, direction, pass_constants.radius);
    }
  }
  ambient_occlusion_sum[pixel] = SumBefore(ambient_occlusion_sum, pixel) + open;
}

[shader("raygeneration")]
void AmbientOcclusionKeys() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    WriteNoRayKey(pixel);
    return;
  }
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kAmbientOcclusionPair, frame.seed)];
  WriteRayKey(pixel, g_position[pixel].xyz,
              OcclusionDirection(tile, pass_constants.first_sample,
                                 OctahedralDecode(g_shading_normal[pixel])),
              pass_constants.radius);
}

// Uniform directions: each counts by its cosine, over their density of 1 / (2 pi).
RWTexture2D<float4> uniform_sum : register(u0, space3);

struct UniformOcclusionConstants {
  uint survey_rule;  // 1: the survey's sum, without the density
};
ConstantBuffer<UniformOcclusionConstants> uniform_constants : register(b0, space3);

static const float kPi = 3.14159265359;

// Direction about +Z with density 1 / (2 pi).
float3 SampleUniformHemisphere(float2 u) {
  const float r = sqrt(max(0.0, 1.0 - u.x * u.x));
  const float phi = 2.0 * kPi * u.y;
  return float3(r * cos(phi), r * sin(phi), u.x);
}

float3 UniformDirection(float2 tile, uint index, float3 shading_normal) {
  const float2 u = PixelSample(tile, index, kAmbientOcclusionPair, frame.seed);
  return ToWorld(SampleUniformHemisphere(u), shading_normal);
}

[shader("raygeneration")]
void UniformOcclusionRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  if (g_ids[pixel].x == 0 || !(pass_constants.radius > 0.0)) {
    uniform_sum[pixel] = SumBefore(uniform_sum, pixel) + float(count);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 shading_normal = OctahedralDecode(g_shading_normal[pixel]);
  const float3 origin = position.xyz + normal * position.w;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kAmbientOcclusionPair, frame.seed)];

  float open = 0.0;
  for (uint i = 0; i < count; ++i) {
    const float3 direction = UniformDirection(tile, pass_constants.first_sample + i, shading_normal);
    if (dot(direction, normal) > 0.0) {
      open += max(dot(direction, shading_normal), 0.0) *
              TraceVisibility(origin, direction, pass_constants.radius);
    }
  }
  // cosine / pi over the density is twice the cosine. Without the density an open plane would get
  // 1 / (2 pi) instead of 1. [effects/SOURCES.md: E4]
  open *= uniform_constants.survey_rule != 0 ? 1.0 / kPi : 2.0;
  uniform_sum[pixel] = SumBefore(uniform_sum, pixel) + open;
}

[shader("raygeneration")]
void UniformOcclusionKeys() {
  const uint2 pixel = FramePixel();
  if (g_ids[pixel].x == 0) {
    WriteNoRayKey(pixel);
    return;
  }
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kAmbientOcclusionPair, frame.seed)];
  WriteRayKey(pixel, g_position[pixel].xyz,
              UniformDirection(tile, pass_constants.first_sample,
                               OctahedralDecode(g_shading_normal[pixel])),
              pass_constants.radius);
}
