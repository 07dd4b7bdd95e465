// SPDX-License-Identifier: MIT
// Contact shadows: short rays to the two lights that matter most to a pixel. They resolve the
// places where things touch, for which shadow maps are too coarse. [Control; survey 5.3.1]
#include "occluder.hlsli"
#include "sampling.hlsli"

RWTexture2D<uint2> strongest : register(u0, space3);
// Sums over the samples; r: point light, g: spot light.
RWTexture2D<float4> contact : register(u1, space3);    // visibility
// The same sums for the blocked part: 1 / radius of the penumbra, 1/m, in r and g; what moves in b
// and a.
RWTexture2D<float4> sharpness : register(u2, space3);

struct ContactConstants {
  float length;            // metres
  uint only_where_coarse;  // 1: rays end where the light's map is fine enough
};
ConstantBuffer<ContactConstants> constants : register(b0, space3);

static const uint kNoLight = 0xFFFFFF;
static const uint kContactPair = 6;  // and 7

// The result of one ray towards a light.
struct Contact {
  float visibility;
  float sharpness;  // of the shadow, times the blocked part
  float moved;      // the part that is blocked by what moves
};

// Returns how far away an occluder may be for its penumbra, 2 r h / (d - h) wide at a distance of
// h, to be narrower than a texel of the light's map. The map can show wider ones.
float CoarseLength(LightConstants light, float distance) {
  const float texel = light.map_texel * distance;
  return distance * texel / max(2.0 * light.radius + texel, 1e-20);
}

Contact Open() {
  Contact contact;
  contact.visibility = 1.0;
  contact.sharpness = 0.0;
  contact.moved = 0.0;
  return contact;
}

// Visibility of one point of a light, by a ray of at most constants.length. An occluder fades out
// over the last fifth of that length, so that the end does not show as an edge.
Contact TraceContact(LightConstants light, float3 position, float3 normal, float offset,
                     float2 u) {
  const float3 to_center = light.position - position;
  const float distance = length(to_center);
  // Inside the light or on it, the light is visible.
  if (!(distance > light.radius)) return Open();
  const float3 target = light.position + ToWorld(float3(SampleDisk(u) * light.radius, 0.0),
                                                 to_center / distance);
  const float3 to_target = target - position;
  const float reach = length(to_target);
  const float3 direction = to_target / reach;
  Contact contact = Open();
  if (!(dot(direction, normal) > 0.0)) {
    contact.visibility = 0.0;
    contact.sharpness = kSharpest;
    return contact;
  }
  // The ray stops before the lamp's own surface, which must not shadow it.
  float longest = Contain(constants.length, kLongestRay);
  if (constants.only_where_coarse != 0) longest = min(longest, CoarseLength(light, distance));
  const float end = min(reach - light.radius, longest);
  if (!(end > 0.0)) return contact;
  const OccluderPayload occluder = TraceOccluder(position + normal * offset, direction, end);
  if (occluder.distance == kNoOccluder) return contact;
  const float hit = occluder.distance;
  contact.visibility = saturate((hit / longest - 0.8) / 0.2);
  const float penumbra_radius = light.radius * hit / max(reach - hit, 1e-6 * reach);
  contact.sharpness = (1.0 - contact.visibility) * ShadowSharpness(penumbra_radius);
  contact.moved = (1.0 - contact.visibility) * occluder.moved;
  return contact;
}

[shader("raygeneration")]
void ContactShadowRayGen() {
  const uint2 pixel = FramePixel();
  const uint count = pass_constants.sample_count;
  if (g_ids[pixel].x == 0) {
    contact[pixel] = SumBefore(contact, pixel) + float4(float(count), float(count), 0, 0);
    if (pass_constants.sharpness != 0) sharpness[pixel] = float4(0, 0, 0, 0);
    return;
  }
  const float4 position = g_position[pixel];
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  float2 visible = float2(0, 0);
  float2 sharp = float2(0, 0);
  float2 moved = float2(0, 0);
  for (uint kind = 0; kind < 2; ++kind) {
    const uint light = strongest[pixel][kind];
    // A light of the previous frame may be gone.
    if (light == kNoLight || light >= frame.light_count) {
      visible[kind] += float(count);
      continue;
    }
    const uint pair = kContactPair + kind;
    const float2 tile = blue_noise[BlueNoiseIndex(pixel, pair, frame.seed)];
    for (uint i = 0; i < count; ++i) {
      const float2 u = PixelSample(tile, pass_constants.first_sample + i, pair, frame.seed);
      const Contact traced =
          TraceContact(lights[light], position.xyz, normal, position.w, u);
      visible[kind] += traced.visibility;
      sharp[kind] += traced.sharpness;
      moved[kind] += traced.moved;
    }
  }
  contact[pixel] = SumBefore(contact, pixel) + float4(visible, 0, 0);
  if (pass_constants.sharpness == 0) return;
  sharpness[pixel] = SumBefore(sharpness, pixel) + float4(sharp, moved);
}
