// SPDX-License-Identifier: MIT
// Stochastic reflections: rays at a quarter of the pixels keep what they hit, and every pixel takes
// the hits of the rays about it as if it had sent them itself. [Stachowiak 2015, Stochastic
// Screen-Space Reflections]
#include "../screen_space/screen_follow.hlsli"

// Sums over samples, as those of effects/reflections/traced.
RWTexture2D<float4> reflection : register(u0, space3);
// The rays, one for 2 x 2 pixels: where they hit, relative to the camera, and the density of their
// direction (0: no ray); and the radiance that they found, and their length.
RWTexture2D<float4> ray_hits : register(u1, space3);
RWTexture2D<float4> ray_light : register(u2, space3);

struct StochasticConstants {
  ScreenReflectionConstants screen;
  uint neighbours;  // rays that a pixel takes: 1, 4 or 9
  float tail;       // 0 to 1: part of the lobe that directions are drawn from
};
ConstantBuffer<StochasticConstants> constants : register(b0, space3);

static const float kLeastWeight = 1e-12;

// Returns which of 2 x 2 pixels sends the ray; all of them do in four frames or samples.
uint2 SendingPixel(uint2 ray, uint sample, uint2 size) {
  const uint2 offset = uint2(sample & 1, ((sample >> 1) ^ sample) & 1);
  return min(2 * ray + offset, size - 1);
}

// The specular part of the BRDF times cosine, without Fresnel's factor, which the sum is over.
float GgxLobe(ReflectionPoint surface, float3 local_light) {
  const float n_l = local_light.z;
  if (!(n_l > 0.0)) return 0.0;
  const float alpha = surface.brdf.alpha;
  const float3 half_vector = normalize(surface.local_view + local_light);
  const float both = n_l * GgxShadowing(alpha, surface.cosine_view) +
                     surface.cosine_view * GgxShadowing(alpha, n_l);
  return GgxDensity(alpha, float3(0, 0, 1), half_vector) * n_l / (2.0 * both);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void SendRays(uint3 id : SV_DispatchThreadID) {
  uint2 rays;
  ray_hits.GetDimensions(rays.x, rays.y);
  if (any(id.xy >= rays)) return;
  const float2 size = PictureSize();
  const uint sample_index = pass_constants.first_sample;
  const uint2 pixel = SendingPixel(id.xy, sample_index, uint2(size));
  ray_hits[id.xy] = float4(0, 0, 0, 0);
  ray_light[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[pixel].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(pixel);
  if (IsMirror(surface.roughness)) return;  // mirrors send their own
  const ReflectionRay sample = SampleReflectionRayOfTail(
      pixel, surface, LengthsOf(constants.screen), sample_index, frame.seed, constants.tail);
  if (!sample.exists) return;
  ScreenHit hit;
  const float4 light = LightOfRay(pixel, surface, sample, constants.screen, true, size, hit);
  const float3 local_light = ToLocal(sample.direction, surface.shading_normal);
  ray_hits[id.xy] = float4(surface.origin + sample.direction * light.w,
                           GgxDirectionDensity(surface, local_light));
  ray_light[id.xy] = light;
}

// Returns what the neighbours' rays found, weighted as this pixel would reflect it. The sum of
// weights takes the noise of the weights with it.
float4 Resolve(uint2 pixel, ReflectionPoint surface) {
  uint2 rays;
  ray_hits.GetDimensions(rays.x, rays.y);
  const int2 centre = int2(pixel / 2);
  // If four are taken, they are those on the pixel's side.
  const int2 side = int2(pixel & 1) * 2 - 1;
  float4 sum = float4(0, 0, 0, 0);
  float weights = 0.0;
  for (uint i = 0; i < constants.neighbours; ++i) {
    int2 offset = int2(int(i % 3) - 1, int(i / 3) - 1);
    if (constants.neighbours == 1) offset = int2(0, 0);
    if (constants.neighbours == 4) offset = int2(int(i & 1), int(i >> 1)) * side;
    const int2 ray = centre + offset;
    if (any(ray < int2(0, 0)) || any(ray >= int2(rays))) continue;
    const float4 hit = ray_hits[ray];
    if (!(hit.w > 0.0)) continue;
    const float3 towards = hit.xyz - surface.origin;
    const float distance = length(towards);
    if (!(distance > 0.0)) continue;
    const float3 direction = towards / distance;
    if (!(dot(direction, surface.normal) > 0.0)) continue;
    const float weight = GgxLobe(surface, ToLocal(direction, surface.shading_normal)) / hit.w;
    if (!(weight > kLeastWeight) || !isfinite(weight)) continue;
    sum += weight * float4(ray_light[ray].rgb, distance);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : float4(0, 0, 0, 0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ResolveRays(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  const float2 size = PictureSize();
  if (any(float2(pixel) >= size)) return;
  float4 light = float4(0, 0, 0, 0);
  if (g_ids[pixel].x != 0) {
    const ReflectionPoint surface = LoadReflectionPoint(pixel);
    if (IsMirror(surface.roughness)) {
      const ReflectionRay sample =
          SampleReflectionRay(pixel, surface, LengthsOf(constants.screen),
                              pass_constants.first_sample, frame.seed);
      if (sample.exists) {
        ScreenHit hit;
        light = LightOfRay(pixel, surface, sample, constants.screen, true, size, hit);
        light.rgb *= sample.weight / ReflectionScaleAt(surface);
      }
    } else {
      light = Resolve(pixel, surface);
    }
  }
  reflection[pixel] = SumBefore(reflection, pixel) + light;
}
