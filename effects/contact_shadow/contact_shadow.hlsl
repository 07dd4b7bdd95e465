// SPDX-License-Identifier: MIT
// Contact shadows: short rays to the two lights that matter most to a pixel. They resolve the
// places where things touch, for which shadow maps are too coarse. [effects-spec B2.12; Control]
#include "visibility.hlsli"
#include "sampling.hlsli"

RWTexture2D<uint2> strongest : register(u0, space3);
RWTexture2D<float4> contact : register(u1, space3);  // sums; r: point light, g: spot light

struct ContactConstants {
  float length;  // metres
};
ConstantBuffer<ContactConstants> constants : register(b0, space3);

static const uint kNoLight = 0xFFFFFF;
static const uint kContactPair = 6;  // and 7 [effects-spec B0.3]

// Visibility of one point of a light by a ray of at most constants.length. Rays end at a random
// place in the last fifth, so an occluder fades out there and the end does not show as an edge.
float ContactVisibility(LightConstants light, float3 position, float3 normal, float offset, float2 u,
                        float end_fraction) {
  const float3 to_center = light.position - position;
  const float distance = length(to_center);
  // Inside the light or on it, the light is visible.
  if (!(distance > light.radius)) return 1.0;
  const float3 target = light.position + ToWorld(float3(SampleDisk(u) * light.radius, 0.0),
                                                 to_center / distance);
  const float3 to_target = target - position;
  const float reach = length(to_target);
  const float3 direction = to_target / reach;
  if (!(dot(direction, normal) > 0.0)) return 0.0;
  // The ray stops before the lamp's own surface, which must not shadow it.
  const float longest = Contain(constants.length, kLongestRay) * (0.8 + 0.2 * end_fraction);
  const float end = min(reach - light.radius, longest);
  if (!(end > 0.0)) return 1.0;
  return TraceVisibility(position + normal * offset, direction, end);
}

[shader("raygeneration")]
void ContactShadowRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  if (g_ids[pixel].x == 0) {
    contact[pixel] = SumBefore(contact, pixel) + float4(float(count), float(count), 0, 0);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  float2 visible = float2(0, 0);
  for (uint kind = 0; kind < 2; ++kind) {
    const uint light = strongest[pixel][kind];
    if (light == kNoLight) {
      visible[kind] += float(count);
      continue;
    }
    const uint pair = kContactPair + kind;
    const float2 tile = blue_noise[BlueNoiseIndex(pixel, pair, frame.seed)];
    for (uint i = 0; i < count; ++i) {
      const float2 u = PixelSample(tile, pass_constants.first_sample + i, pair, frame.seed);
      const float end_fraction = UnitFloat(HashCombine(HashCombine(frame.seed, pixel.y * 65536 + pixel.x),
                                                       2 * (pass_constants.first_sample + i) + kind));
      visible[kind] += ContactVisibility(lights[light], position.xyz, normal, position.w, u,
                                         end_fraction);
    }
  }
  contact[pixel] = SumBefore(contact, pixel) + float4(visible, 0, 0);
}
