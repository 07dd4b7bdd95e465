// SPDX-License-Identifier: MIT
// Ambient occlusion: the part of the hemisphere, weighted by its cosine, that is open up to a
// radius. [effects-spec B3.6]
#include "visibility.hlsli"
#include "sampling.hlsli"

[shader("raygeneration")]
void AmbientOcclusionRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  if (g_ids[pixel].x == 0) {
    ambient_occlusion_sum[pixel] += float(count);  // the sky is open
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 shading_normal = OctahedralDecode(g_shading_normal[pixel]);
  const float3 origin = position.xyz + normal * position.w;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kAmbientOcclusionPair, frame.seed)];

  float open = 0.0;
  for (uint i = 0; i < count; ++i) {
    const float2 u = PixelSample(tile, pass_constants.first_sample + i, kAmbientOcclusionPair, frame.seed);
    const float3 direction = ToWorld(SampleCosineHemisphere(u), shading_normal);
    // Below the true surface there is nothing to see: such a ray counts as blocked.
    if (dot(direction, normal) > 0.0) {
      open += TraceVisibility(origin, direction, pass_constants.radius);
    }
  }
  ambient_occlusion_sum[pixel] += open;
}
