// SPDX-License-Identifier: MIT
// Radiance of each pixel, from the G-buffer and the results of the effects.
//
// Composite: a diffuse surface under the part of the sun it sees and the open part of the sky, plus
// emission; where nothing is hit, the sky. ComposeFrame, further down, adds up all effects.
#include "brdf.hlsli"
#include "frame.hlsli"

static const float kPi = 3.14159265;

// Mean radiance over the hemisphere about a normal, weighted by the cosine. The sky is a smooth
// gradient, so three directions are enough.
float3 SkyAround(float3 normal) {
  const float3 up = SkyTowards(normal);
  const float3 tilted = SkyTowards(normalize(normal + float3(0.0, 0.8, 0.0)));
  const float3 down = SkyTowards(normalize(normal + float3(0.0, -0.8, 0.001)));
  return (2.0 * up + tilted + down) * 0.25;
}

RWTexture2D<float> sun_visibility_sum : register(u5, space3);
RWTexture2D<float> ambient_occlusion_sum : register(u6, space3);

// pass_constants.first_sample is the number of samples in the sum of ambient occlusion,
// sample_count that of the sun.
[shader("compute")]
[numthreads(8, 8, 1)]
void Composite(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  const uint2 pixel = id.xy;
  if (pixel.x >= width || pixel.y >= height) {
    return;
  }
  const float2 ndc = (float2(pixel) + 0.5) / float2(width, height) * 2.0 - 1.0;
  if (g_ids[pixel].x == 0) {
    radiance[pixel] = float4(SkyTowards(normalize(RayThrough(ndc).direction)), 1.0);
    return;
  }
  const float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  const float3 base_color = DecodeColor(g_base_color[pixel].rgb);
  const uint ao_samples = pass_constants.first_sample;
  const uint sun_samples = pass_constants.sample_count;
  const float open = ao_samples > 0 ? ambient_occlusion_sum[pixel] / float(ao_samples) : 1.0;
  const float sun = sun_samples > 0 ? sun_visibility_sum[pixel] / float(sun_samples) : 0.0;

  const float3 from_sun = frame.sun_irradiance * (saturate(dot(normal, frame.direction_to_sun)) * sun / kPi);
  const float3 from_sky = SkyAround(normal) * open;
  radiance[pixel] = float4(base_color * (from_sun + from_sky) + g_emissive[pixel].rgb, 1.0);
}

// The whole frame: adds up what the effects have found. An effect that was not rendered is left
// out; without indirect light, the open sky stands in for it.
RWTexture2D<float4> sun_visibility : register(u0, space3);
RWTexture2D<float4> ambient : register(u1, space3);       // ambient visibility
RWTexture2D<float4> local_lights : register(u2, space3);  // radiance
RWTexture2D<float4> indirect : register(u3, space3);      // irradiance / pi
RWTexture2D<float4> reflection : register(u4, space3);    // radiance / ReflectionScale
RWTexture2D<float4> sun_tint : register(u5, space3);      // what glass lets through, by colour
RWTexture2D<float4> bent_normal : register(u7, space3);   // from where the sky is seen

static const uint kHasSun = 1;
static const uint kHasAmbient = 2;
static const uint kHasLocalLights = 4;
static const uint kHasIndirect = 8;
static const uint kHasReflections = 16;
static const uint kHasSunTint = 32;
static const uint kIsMatte = 64;
static const uint kHasBentNormal = 128;

struct ComposeConstants {
  uint has;
};
ConstantBuffer<ComposeConstants> compose : register(b0, space3);

[shader("compute")]
[numthreads(8, 8, 1)]
void ComposeFrame(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  const uint2 pixel = id.xy;
  if (pixel.x >= width || pixel.y >= height) {
    return;
  }
  const float2 ndc = (float2(pixel) + 0.5) / float2(width, height) * 2.0 - 1.0;
  if (g_ids[pixel].x == 0) {
    radiance[pixel] = float4(SkyTowards(normalize(RayThrough(ndc).direction)), 1.0);
    return;
  }
  if (g_material[pixel].z > 0.5) {
    radiance[pixel] = float4(g_emissive[pixel].rgb, 1.0);
    return;
  }
  const float3 normal = OctahedralDecode(g_shading_normal[pixel]);
  const Brdf brdf = PixelBrdf(pixel);
  const BrdfView view = MakeBrdfView(brdf, normal, -SeenAlong(g_position[pixel].xyz));
  float3 sum = g_emissive[pixel].rgb;
  if ((compose.has & kHasSun) != 0) {
    float3 from_sun = frame.sun_irradiance * sun_visibility[pixel].x;
    if ((compose.has & kHasSunTint) != 0) from_sun *= sun_tint[pixel].rgb;
    sum += from_sun * EvaluateBrdf(brdf, view, frame.direction_to_sun);
  }
  if ((compose.has & kHasLocalLights) != 0) sum += local_lights[pixel].rgb;
  float3 around;  // mean radiance from all sides
  if ((compose.has & kHasIndirect) != 0) {
    around = indirect[pixel].rgb;
  } else {
    const float3 from = (compose.has & kHasBentNormal) != 0 ? bent_normal[pixel].xyz : normal;
    around = SkyAround(from);
    if ((compose.has & kHasAmbient) != 0) around *= ambient[pixel].rgb;
  }
  sum += view.diffuse * around;
  if ((compose.has & kHasReflections) != 0) {
    sum += ReflectionScale(view.specular) * reflection[pixel].rgb;
  } else if ((compose.has & kIsMatte) != 0) {
    sum += view.specular * around;
  }
  radiance[pixel] = float4(sum, 1.0);
}

// The finished radiance and the view depths, for the next frame. [effects/composition/composite/kept_radiance.h]
RWTexture2D<float4> kept_radiance : register(u0, space3);

[shader("compute")]
[numthreads(8, 8, 1)]
void KeepRadiance(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  kept_radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  kept_radiance[id.xy] = float4(radiance[id.xy].rgb, g_view_z[id.xy]);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ForgetRadiance(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  kept_radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  kept_radiance[id.xy] = float4(0, 0, 0, -1);
}
