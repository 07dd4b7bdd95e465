// SPDX-License-Identifier: MIT
// Planar reflections: the scene mirrored at a plane, seen from the camera, once for each plane; and
// the pixels of the plane look it up at their own place. [survey 6.1]
#include "../environment_map/environment_map.hlsli"
#include "../traced/reflection_shading.hlsli"

// As those of effects/reflections/traced, but no sum.
RWTexture2D<float4> reflection : register(u0, space3);
// The radiance that each plane mirrors: as many pictures side by side as there are planes.
RWTexture2D<float4> mirrored : register(u1, space3);
// Normal towards the camera, and the plane's distance from the camera along it (negative).
StructuredBuffer<float4> planes : register(t4, space3);

struct PlanarConstants {
  float longest;      // metres behind the plane that are seen
  uint sun_at_hits;   // 1: by a shadow ray
  uint plane_count;
  uint fallback;      // of other surfaces: kFallbackNone, kFallbackEnvironment
  uint plane;         // that is rendered
  uint width;         // of a plane's picture
  uint height;
};
ConstantBuffer<PlanarConstants> constants : register(b0, space3);

static const uint kFallbackEnvironment = 2;
static const uint kBlurTaps = 24;
static const float kOnPlane = 1e-3;   // of the distance from the camera
static const float kAlong = 0.999;    // cosine between a surface's normal and its plane's
// Rays start this far off the plane, in its distance from the camera: what is nearer is cut off.
static const float kClip = 1e-5;

uint SunAtHits() { return constants.sun_at_hits; }

// A ray of the mirrored camera starts where it passes the plane, which clips all in front of it.
[shader("raygeneration")]
void PlanarRayGen() {
  const uint2 texel = DispatchRaysIndex().xy;
  const uint2 at = texel + uint2(constants.plane * constants.width, 0);
  mirrored[at] = float4(0, 0, 0, 0);
  const float2 size = float2(constants.width, constants.height);
  uint2 picture;
  g_view_z.GetDimensions(picture.x, picture.y);
  const float2 uv = (float2(texel) + 0.5) / size + frame.jitter / float2(picture);
  const float2 ndc = uv * 2.0 - 1.0;
  const CameraRay through = RayThrough(ndc);
  const float3 towards = through.direction;
  const float4 plane = planes[constants.plane];
  const float facing = dot(plane.xyz, towards);
  const float above = plane.w - dot(plane.xyz, through.origin);
  if (!(facing < 0.0) || !(above < 0.0)) return;  // the plane is not seen here
  const float3 on_plane = through.origin + towards * (above / facing);
  RayDesc ray;
  ray.Origin = on_plane + plane.xyz * (kClip * length(on_plane));
  ray.TMin = 0.0;
  ray.Direction = normalize(reflect(towards, plane.xyz));
  ray.TMax = Contain(constants.longest, kLongestRay);
  ReflectionPayload payload;
  payload.radiance = float3(0, 0, 0);
  payload.distance = -1.0;
  payload.volume_jitter = kEveryCell;
  TraceRay(scene, RAY_FLAG_NONE, kMaskSolid, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
           payload);
  mirrored[at] = float4(payload.radiance, payload.distance >= 0.0 ? payload.distance : ray.TMax);
}

float4 LoadMirrored(uint plane, int2 texel) {
  const int2 size = int2(constants.width, constants.height);
  const int2 inside = clamp(texel, int2(0, 0), size - 1);
  return mirrored[uint2(inside) + uint2(plane * constants.width, 0)];
}

// Between texels.
float4 MirroredAt(uint plane, float2 place) {
  const float2 at = place - 0.5;
  const float2 corner = floor(at);
  const float2 part = at - corner;
  const int2 c = int2(corner);
  return lerp(lerp(LoadMirrored(plane, c), LoadMirrored(plane, c + int2(1, 0)), part.x),
              lerp(LoadMirrored(plane, c + int2(0, 1)), LoadMirrored(plane, c + int2(1, 1)), part.x),
              part.y);
}

// A disk about the place whose size follows from roughness alone: what touches the plane is blurred
// as much as what is far from it.
float4 Blurred(uint plane, float2 place, float alpha) {
  const float radius = 0.5 * alpha * float(constants.height);
  float4 sum = float4(0, 0, 0, 0);
  for (uint i = 0; i < kBlurTaps; ++i) {
    const float r = sqrt((float(i) + 0.5) / float(kBlurTaps)) * radius;
    const float phi = 2.3999632 * float(i);  // the golden angle
    sum += MirroredAt(plane, place + r * float2(cos(phi), sin(phi)));
  }
  return sum / float(kBlurTaps);
}

// The plane that a surface lies in; plane_count: none.
uint PlaneOf(float3 position, float3 normal) {
  const float tolerance = kOnPlane * length(position);
  uint i = 0;
  for (; i < constants.plane_count; ++i) {
    const float4 plane = planes[i];
    if (abs(dot(position, plane.xyz) - plane.w) <= tolerance && dot(normal, plane.xyz) > kAlong) break;
  }
  return i;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void PlanarReflections(uint3 id : SV_DispatchThreadID) {
  uint2 picture;
  g_view_z.GetDimensions(picture.x, picture.y);
  if (any(id.xy >= picture)) return;
  reflection[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[id.xy].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(id.xy);
  const float3 position = g_position[id.xy].xyz;
  const uint plane = PlaneOf(position, surface.normal);
  if (plane == constants.plane_count) {
    if (constants.fallback != kFallbackEnvironment) return;
    const float3 direction = reflect(SeenAlong(position), surface.shading_normal);
    reflection[id.xy] =
        float4(EnvironmentRadiance(surface.origin, direction, surface.roughness), 0.0);
    return;
  }
  const float2 place =
      (float2(id.xy) + 0.5) / float2(picture) * float2(constants.width, constants.height);
  if (!IsMirror(surface.roughness)) {
    reflection[id.xy] = Blurred(plane, place, surface.brdf.alpha);
    return;
  }
  const float4 seen = MirroredAt(plane, place);
  const float3 weight = GgxSampleWeight(surface.brdf, surface.cosine_view, surface.cosine_view,
                                        surface.cosine_view);
  reflection[id.xy] = float4(seen.rgb * weight / ReflectionScaleAt(surface), seen.w);
}
