// SPDX-License-Identifier: MIT
// The colour that glass gives to the sun's light on its way to each surface: rays to random points
// of the sun's disk meet nothing but glass, and their any-hit shader multiplies what each pane lets
// through. [survey 5.3; McGuire & Enderton 2011, Colored Stochastic Shadow Maps]
#include "pane_tint.hlsli"
#include "sampling.hlsli"

// Transmittances of the samples, by colour.
RWTexture2D<float4> glass_shadow_sum : register(u0, space3);

struct GlassShadowConstants {
  float tint;  // of PaneTransmittance
};
ConstantBuffer<GlassShadowConstants> constants : register(b0, space3);

static const uint kMaskGlass = 0x02;  // [effects/assets/scene/scene.h: InstanceMask]

// Any-hit shaders run in no certain order, and products of floats depend on it in their last digit.
// Sums of whole numbers do not: each pane adds its optical depth, -log2 of what it lets through,
// counted in steps so small that a float of the transmittance has no finer ones.
static const float kStepsOfDepth = 1048576.0;   // in a factor of two
static const uint kDarkest = 24u * 1048576u;    // as good as nothing goes through

struct PanesPayload {
  uint3 depth;  // by colour, in steps
};

uint3 StepsOf(float3 transmittance) {
  return uint3(min(-log2(max(transmittance, 1e-9)), 24.0) * kStepsOfDepth + 0.5);
}

float3 TransmittanceOf(uint3 depth) {
  return float3(depth.x < kDarkest ? exp2(-(float(depth.x) / kStepsOfDepth)) : 0.0,
                depth.y < kDarkest ? exp2(-(float(depth.y) / kStepsOfDepth)) : 0.0,
                depth.z < kDarkest ? exp2(-(float(depth.z) / kStepsOfDepth)) : 0.0);
}

[shader("miss")]
void PanesMiss(inout PanesPayload payload) {}

[shader("anyhit")]
void PanesAnyHit(inout PanesPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const float3 open = PaneTransmittance(PaneColorAt(hit.barycentrics), constants.tint);
  payload.depth = min(payload.depth + StepsOf(open), uint3(kDarkest, kDarkest, kDarkest));
  IgnoreHit();
}

// What all panes between a point and the sun let through. The origin must be off the surface.
float3 LightThroughPanes(float3 origin, float3 direction) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = kSunDistance;
  PanesPayload payload;
  payload.depth = uint3(0, 0, 0);
  TraceRay(scene, RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, kMaskGlass, kRayTypeVisibility, kRayTypeCount,
           kRayTypeVisibility, ray, payload);
  return TransmittanceOf(payload.depth);
}

[shader("raygeneration")]
void GlassShadowRayGen() {
  const uint2 pixel = FramePixel();
  const float4 before = SumBefore(glass_shadow_sum, pixel);
  const uint count = pass_constants.sample_count;
  if (g_ids[pixel].x == 0) {
    glass_shadow_sum[pixel] = before + float4(1, 1, 1, 1) * float(count);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  const float3 origin = position.xyz + normal * position.w;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, kSunPair, frame.seed)];
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < count; ++i) {
    const float2 u = PixelSample(tile, pass_constants.first_sample + i, kSunPair, frame.seed);
    const float3 direction = SampleSun(u, frame.direction_to_sun, frame.tan_sun_radius);
    // Behind the surface no sun is to be seen, whatever glass is there.
    sum += dot(direction, normal) > 0.0 ? LightThroughPanes(origin, direction) : float3(1, 1, 1);
  }
  glass_shadow_sum[pixel] = before + float4(sum, float(count));
}
