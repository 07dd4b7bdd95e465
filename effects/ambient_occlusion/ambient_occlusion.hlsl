// SPDX-License-Identifier: MIT
// Ambient occlusion: the fraction of the hemisphere, weighted by the cosine, that is open up to a
// radius. Directions are cosine-distributed, so the estimate is simply the mean visibility.
// [effects-spec B3.6]
#include "visibility.hlsli"
#include "ray_key.hlsli"
#include "sampling.hlsli"

float3 OcclusionDirection(float2 tile, uint index, float3 shading_normal) {
  const float2 u = PixelSample(tile, index, kAmbientOcclusionPair, frame.seed);
  return ToWorld(SampleCosineHemisphere(u), shading_normal);
}

[shader("raygeneration")]
void AmbientOcclusionRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  // The sky is open, and with a radius of zero nothing can be in the way. [effects-spec E.2]
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
