// SPDX-License-Identifier: MIT
// A shadow map: the scene's depth as the sun sees it, compared when the scene is drawn.

cbuffer Constants : register(b0) {
  float aspect;       // of the picture, width over height
  float texel;        // of the map, in texture coordinates
};
Texture2D<float> shadow_map : register(t0);
SamplerComparisonState is_nearer : register(s0);

// A vertex of the unit cube, and the box that an instance makes of it.
struct Box {
  float3 corner : CORNER;
  float3 center : CENTER;
  float3 half_size : HALF_SIZE;
  float turn : TURN;
  float3 color : COLOR;
};

float3 world_position(Box box) {
  const float3 p = box.corner * box.half_size;
  const float c = cos(box.turn), s = sin(box.turn);
  return box.center + float3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
}

// The sun sees 18 x 18 x 30 metres round the origin, without perspective.
static const float3 kToSun = normalize(float3(-0.55, 0.75, -0.45));
static const float3 kRight = normalize(cross(kToSun, float3(0, 1, 0)));
static const float3 kUp = cross(kRight, kToSun);

float4 sun_position(float3 world) {
  return float4(dot(world, kRight) / 9, dot(world, kUp) / 9, 0.5 - dot(world, kToSun) / 30, 1);
}

// No pixel shader goes with it: depth is all that is written.
[shader("vertex")]
float4 SeenFromSun(Box box) : SV_Position {
  return sun_position(world_position(box));
}

struct Corner {
  float4 position : SV_Position;
  float3 world : WORLD;
  nointerpolation float3 color : COLOR;
};

// Reversed depth: near / z is 1 at the near plane and 0 infinitely far away.
[shader("vertex")]
Corner SeenFromEye(Box box) {
  static const float kFocalLength = 1.6, kNear = 0.1, kPitch = 0.42;
  Corner corner;
  corner.world = world_position(box);
  corner.color = box.color;
  const float3 p = corner.world - float3(0, 5, -9);
  const float3 view = float3(p.x, cos(kPitch) * p.y + sin(kPitch) * p.z,
                             cos(kPitch) * p.z - sin(kPitch) * p.y);
  corner.position = float4(view.x * kFocalLength / aspect, view.y * kFocalLength, kNear, view.z);
  return corner;
}

// The share of nine comparisons that the sun reaches; each is a mean of four texels.
float sunlight(float3 world) {
  const float3 p = sun_position(world).xyz;
  const float2 uv = float2(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y);
  float sum = 0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      sum += shadow_map.SampleCmpLevelZero(is_nearer, uv + float2(x, y) * texel, p.z);
    }
  }
  return sum / 9;
}

[shader("pixel")]
float4 Shade(Corner corner) : SV_Target {
  // Neighbouring pixels of a quad lie on the same plane.
  const float3 normal = normalize(cross(ddx(corner.world), ddy(corner.world)));
  const float facing = saturate(dot(normal, kToSun));
  const float sky = 0.25 + 0.1 * normal.y;
  return float4(corner.color * (sky + 0.75 * facing * sunlight(corner.world)), 1);
}
