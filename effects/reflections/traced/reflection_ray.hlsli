// SPDX-License-Identifier: MIT
// The rays of reflections, which are the same for every technique that follows them: through the
// scene or over the screen. [GDC 2018 talk; Control]
#ifndef KAAMOS_REFLECTION_RAY_HLSLI
#define KAAMOS_REFLECTION_RAY_HLSLI

#include "brdf.hlsli"
#include "sampling.hlsli"

static const uint kReflectionPair = 2;  // and 3

// The lengths of rays.
struct ReflectionLengths {
  float longest;   // metres, for a mirror
  float shortest;  // metres, for a rough surface
  float jitter;    // fraction of the length that varies from ray to ray
};

// Rough surfaces blur what is far away, and the volume gives such a blur too, so their rays can be
// shorter. [Control: 200 m to 3 m]
float ReflectionLength(ReflectionLengths lengths, float roughness, float u) {
  const float longest = Contain(lengths.longest, kLongestRay);
  if (longest == 0.0) return longest;
  const float ratio = clamp(Contain(lengths.shortest, kLongestRay) / longest, 1e-30, 1e30);
  const float length = Contain(longest * pow(ratio, saturate(roughness)), kLongestRay);
  return length * (1.0 - Contain(lengths.jitter, 1.0) * u);
}

// The surface data that the rays of a pixel have in common.
struct ReflectionPoint {
  float3 origin;
  float3 normal;
  float3 shading_normal;
  float roughness;
  Brdf brdf;
  float cosine_view;
  float3 local_view;
};

// The unit vector from which the camera sees a point. A sample of the previous frame is taken again
// from the previous camera: then the ray is the same, and what differs is what it meets.
float3 ViewFrom(float3 position) {
  if (pass_constants.again == 0) return -SeenAlong(position);
  return frame.is_orthographic != 0 ? -frame.previous_forward
                                    : -normalize(position + frame.camera_motion);
}

ReflectionPoint LoadReflectionPoint(uint2 pixel) {
  const float4 position = g_position[pixel];
  const float3 view = ViewFrom(position.xyz);
  ReflectionPoint surface;
  surface.normal = OctahedralDecode(g_normal[pixel]);
  surface.shading_normal = OctahedralDecode(g_shading_normal[pixel]);
  surface.origin = position.xyz + surface.normal * position.w;
  surface.roughness = g_material[pixel].x;
  surface.brdf = PixelBrdf(pixel);
  surface.cosine_view = max(dot(surface.shading_normal, view), 1e-4);
  surface.local_view = ToLocal(view, surface.shading_normal);
  return surface;
}

// Returns the divisor of the sum of a pixel's samples. [ReflectionScale]
float3 ReflectionScaleAt(ReflectionPoint surface) {
  return ReflectionScale(
      SpecularAlbedo(surface.brdf.f0, surface.brdf.f90, surface.brdf.roughness, surface.cosine_view));
}

// In the surface's own frame, about +Z.
float3 SampleHalfVector(ReflectionPoint surface, float2 u) {
  if (IsMirror(surface.roughness)) return float3(0, 0, 1);
  return SampleGgxHalfVector(u, surface.local_view, surface.brdf.alpha);
}

// Density of the directions that SampleGgxHalfVector gives, about the normal.
float GgxDirectionDensity(ReflectionPoint surface, float3 local_light) {
  const float3 half_vector = normalize(surface.local_view + local_light);
  const float d = GgxDensity(surface.brdf.alpha, float3(0, 0, 1), half_vector);
  return d / (2.0 * (surface.cosine_view + GgxShadowing(surface.brdf.alpha, surface.cosine_view)));
}

struct ReflectionRay {
  bool exists;  // false: below the surface, the geometric or the normal-mapped one, is no light
  float3 direction;
  float length;   // metres
  float3 weight;  // BRDF times cosine over the density of the direction
  float u;        // uniform in 0..1, independent of all that
};

// `index` and `seed` choose the ray, from the part `tail` of the lobe about its peak.
ReflectionRay SampleReflectionRayOfTail(uint2 pixel, ReflectionPoint surface,
                                        ReflectionLengths lengths, uint index, uint seed,
                                        float tail) {
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kReflectionPair, seed)];
  const float2 u = PixelSample(tile, index, kReflectionPair, seed);
  const float3 half_vector = SampleHalfVector(surface, float2(u.x, u.y * tail));
  const float3 local_light = reflect(-surface.local_view, half_vector);
  ReflectionRay ray;
  ray.direction = ToWorld(local_light, surface.shading_normal);
  ray.exists = local_light.z > 0.0 && dot(ray.direction, surface.normal) > 0.0;
  const float2 length_tile = blue_noise[BlueNoiseIndex(pixel, kReflectionPair + 1, seed)];
  const float2 v = PixelSample(length_tile, index, kReflectionPair + 1, seed);
  ray.length = ReflectionLength(lengths, surface.roughness, v.x);
  ray.weight = GgxSampleWeight(surface.brdf, surface.cosine_view, local_light.z,
                               dot(surface.local_view, half_vector));
  ray.u = v.y;
  return ray;
}

// From the whole lobe.
ReflectionRay SampleReflectionRay(uint2 pixel, ReflectionPoint surface, ReflectionLengths lengths,
                                  uint index, uint seed) {
  return SampleReflectionRayOfTail(pixel, surface, lengths, index, seed, 1.0);
}

#endif
