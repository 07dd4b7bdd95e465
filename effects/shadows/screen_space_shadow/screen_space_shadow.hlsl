// SPDX-License-Identifier: MIT
// Contact shadows from the depth picture: a march from each pixel's surface towards a light, which
// is hidden where a point of the ray lies a little behind what the picture shows there. Plain, with
// several pixels tested at each point, or as several marches with steps of different size.
// [survey 5.2; Seibert & Radicke 2017, Spatial Multisampling and Multipass Occlusion Testing]
#include "sampling.hlsli"
#include "view_space.hlsli"

RWTexture2D<uint2> strongest : register(u0, space3);  // point light, spot light; not for the sun
RWTexture2D<float4> result : register(u1, space3);    // visibility; r: point light or sun, g: spot

// Mirrors ScreenSpaceShadowConstants in screen_space_shadow.h.
struct ScreenShadowConstants {
  float length;      // metres
  float thickness;   // metres that everything is taken to reach back
  float bias;        // part of its depth that an occluder stands above the receiver's plane
  float border;      // part of the picture's width over which shadows fade at its borders
  uint steps;        // of the march with the largest
  uint marches;
  uint threshold;    // marches that must hit
  float spread;      // pixels between a point's own pixel and the four others; 0: no others
  uint noise;        // 0: the points of a march stand at the same distances everywhere
  uint toward_sun;   // 0: the strongest lights
};
ConstantBuffer<ScreenShadowConstants> constants : register(b0, space3);

static const uint kNoLight = 0xFFFFFF;
static const uint kContactPair = 6;  // and 7
static const float kGolden = 1.61803399;
// The last fifth of the length fades out, as for traced contact shadows.
static const float kFadeFrom = 0.8;

// A surface that may be in shadow, in view space.
struct Receiver {
  int2 pixel;
  int2 size;  // of the picture
  float3 position;
  float3 normal;
};

// Tells whether the surface of a pixel hides a point of a ray that is `view_z` away. What does not
// stand above the receiver's plane cannot hide it: without that rule a plane seen along itself
// shadows itself, because a pixel has but one depth for all that it covers.
bool Hides(Receiver receiver, int2 pixel, float view_z) {
  if (!IsInside(pixel, receiver.size) || all(pixel == receiver.pixel)) return false;
  const float shown_z = g_view_z[pixel];
  if (!IsSurface(shown_z)) return false;
  const float behind = view_z - shown_z;
  if (!(behind > 0.0) || !(behind < constants.thickness)) return false;
  const float3 shown = ViewPosition(pixel, shown_z, receiver.size);
  return dot(shown - receiver.position, receiver.normal) > constants.bias * shown_z;
}

// The same for the pixel of a place, and its neighbours where they are asked for.
bool HidesNear(Receiver receiver, float2 place, float view_z) {
  if (Hides(receiver, int2(floor(place)), view_z)) return true;
  const float spread = constants.spread;
  if (!(spread > 0.0)) return false;
  return Hides(receiver, int2(floor(place + float2(spread, 0.0))), view_z) ||
         Hides(receiver, int2(floor(place - float2(spread, 0.0))), view_z) ||
         Hides(receiver, int2(floor(place + float2(0.0, spread))), view_z) ||
         Hides(receiver, int2(floor(place - float2(0.0, spread))), view_z);
}

// Returns how dark the first hit of a march makes the pixel, 0 to 1: less near the ray's end and
// near the borders of the picture, where the next frame may see no occluder.
float March(Receiver receiver, float3 direction, float end, float longest, uint steps, float jitter) {
  const float2 size = float2(receiver.size);
  for (uint i = 0; i < steps; ++i) {
    const float distance = end * (float(i) + jitter) / float(steps);
    const float3 position = receiver.position + direction * distance;
    if (!(position.z > frame.near_plane)) return 0.0;
    const float2 place = PlaceOf(position, receiver.size);
    if (!(all(place >= float2(0, 0)) && all(place < size))) return 0.0;
    if (!HidesNear(receiver, place, position.z)) continue;
    const float2 inside = min(place, size - place);
    const float border = constants.border * size.x;
    const float at_border = border > 0.0 ? saturate(min(inside.x, inside.y) / border) : 1.0;
    return at_border * (1.0 - saturate((distance / longest - kFadeFrom) / (1.0 - kFadeFrom)));
  }
  return 0.0;
}

// Visibility of a light in a unit direction, `reach` metres away.
float LightVisibility(Receiver receiver, float3 direction, float reach, float jitter) {
  const float longest = Contain(constants.length, kLongestRay);
  const float end = min(reach, longest);
  if (!(end > 0.0)) return 1.0;
  if (!(dot(direction, receiver.normal) > 0.0)) return 0.0;
  uint hits = 0;
  float sum = 0.0;
  float steps = float(constants.steps);
  for (uint march = 0; march < constants.marches; ++march) {
    const float offset = frac(jitter + float(march) / kGolden);
    const float shadow = March(receiver, direction, end, longest, uint(ceil(steps)), offset);
    hits += shadow > 0.0 ? 1 : 0;
    sum += shadow;
    steps *= kGolden;
  }
  return hits >= constants.threshold ? 1.0 - sum / float(hits) : 1.0;
}

float Jitter(uint2 pixel, uint pair) {
  if (constants.noise == 0) return 0.5;
  const float2 tile = blue_noise[BlueNoiseIndex(pixel, pair, frame.seed)];
  return PixelSample(tile, pass_constants.first_sample, pair, frame.seed).x;
}

// Returns the visibility of the strongest light of a kind.
float LocalVisibility(Receiver receiver, uint kind) {
  const uint light = strongest[receiver.pixel][kind];
  if (light == kNoLight) return 1.0;
  const float3 to_light = ViewDirection(lights[light].position) - receiver.position;
  const float distance = length(to_light);
  // Inside the light or on it, the light is visible.
  if (!(distance > lights[light].radius)) return 1.0;
  return LightVisibility(receiver, to_light / distance, distance - lights[light].radius,
                         Jitter(uint2(receiver.pixel), kContactPair + kind));
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ScreenSpaceShadow(uint3 id : SV_DispatchThreadID) {
  Receiver receiver;
  receiver.pixel = int2(id.xy);
  receiver.size = PictureSize();
  if (!IsInside(receiver.pixel, receiver.size)) return;
  const float view_z = g_view_z[receiver.pixel];
  if (!IsSurface(view_z)) {
    result[receiver.pixel] = float4(1, 1, 0, 0);
    return;
  }
  receiver.position = ViewPosition(receiver.pixel, view_z, receiver.size);
  receiver.normal = ViewNormal(g_normal[receiver.pixel], ToCamera(receiver.position));
  float2 visible = float2(1, 1);
  if (constants.toward_sun != 0) {
    visible.x = LightVisibility(receiver, ViewDirection(frame.direction_to_sun), kSunDistance,
                                Jitter(uint2(receiver.pixel), kSunPair));
  } else {
    visible = float2(LocalVisibility(receiver, 0), LocalVisibility(receiver, 1));
  }
  result[receiver.pixel] = float4(visible, 0, 0);
}
