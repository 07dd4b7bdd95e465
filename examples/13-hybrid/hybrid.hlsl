// SPDX-License-Identifier: MIT
// What the eye sees is rasterized; shadows and reflections are traced.

cbuffer Constants : register(b0) {
  uint2 size;  // of the picture
};
RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<float3> box_colors : register(t1);  // by instance
// The G-buffer.
Texture2D<float4> albedo : register(t0, space1);
Texture2D<float4> normals : register(t1, space1);
Texture2D<float> depth : register(t2, space1);
Texture2D<float> sunlight : register(t3, space1);
RWTexture2D<float> sunlight_out : register(u0, space1);

static const float3 kEye = float3(0, 3.2, -9);
static const float kFocalLength = 1.6, kNear = 0.1, kPitch = 0.25;
static const float3 kToSun = normalize(float3(-0.55, 0.75, -0.45));

// ---------------------------------------------------------------------------------------------
// Pass 1, rasterized: the G-buffer.

struct Box {
  float3 corner : CORNER;
  // Rows of the instance's transform, as acceleration structures have it, too.
  float4 x : TRANSFORM0;
  float4 y : TRANSFORM1;
  float4 z : TRANSFORM2;
  uint instance : SV_InstanceID;
};
struct Corner {
  float4 position : SV_Position;
  float3 world : WORLD;
  nointerpolation float3 color : COLOR;
};

// Reversed depth: near / z is 1 at the near plane and 0 infinitely far away.
[shader("vertex")]
Corner SeenFromEye(Box box) {
  const float4 p = float4(box.corner, 1);
  Corner corner;
  corner.world = float3(dot(box.x, p), dot(box.y, p), dot(box.z, p));
  corner.color = box_colors[box.instance];
  const float3 from_eye = corner.world - kEye;
  const float y = cos(kPitch) * from_eye.y + sin(kPitch) * from_eye.z;
  const float z = cos(kPitch) * from_eye.z - sin(kPitch) * from_eye.y;
  const float aspect = float(size.x) / float(size.y);
  corner.position = float4(from_eye.x * kFocalLength / aspect, y * kFocalLength, kNear, z);
  return corner;
}

struct Surface {
  float4 albedo : SV_Target0;
  float4 normal : SV_Target1;
};

[shader("pixel")]
Surface StoreSurface(Corner corner) {
  Surface surface;
  surface.albedo = float4(corner.color, 1);
  surface.normal = float4(normalize(cross(ddx(corner.world), ddy(corner.world))), 0);
  return surface;
}

// ---------------------------------------------------------------------------------------------
// Pass 2, traced: whether the sun reaches what is in the G-buffer.

float3 eye_direction(uint2 pixel) {
  const float2 p = (2 * (float2(pixel) + 0.5) - float2(size)) / float(size.y) / kFocalLength;
  return float3(p.x, -cos(kPitch) * p.y - sin(kPitch), cos(kPitch) - sin(kPitch) * p.y);
}

// eye_direction has length 1 along the axis of the eye, so z times it is the way to the surface.
float3 surface_position(uint2 pixel) {
  return kEye + kNear / depth[pixel] * eye_direction(pixel);
}

// Depth and the corners of triangles are rounded, so the position is a little off its surface.
float3 ray_origin(float3 position, float3 normal) {
  return position + 1e-3 * normal;
}

struct ShadowPayload {
  float light;
};

[shader("raygeneration")]
void TraceSun() {
  const uint2 pixel = DispatchRaysIndex().xy;
  ShadowPayload payload = {0};
  const float3 normal = normals[pixel].xyz;
  if (depth[pixel] > 0 && dot(normal, kToSun) > 0) {
    RayDesc ray = {ray_origin(surface_position(pixel), normal), 0, kToSun, 100};
    TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
             0xff, 0, 0, 0, ray, payload);
  }
  sunlight_out[pixel] = payload.light;
}

[shader("miss")]
void SunIsSeen(inout ShadowPayload payload) {
  payload.light = 1;
}

// ---------------------------------------------------------------------------------------------
// Pass 3, rasterized: a triangle over the whole picture, whose pixels trace their reflections.

[shader("vertex")]
float4 WholePicture(uint vertex : SV_VertexID) : SV_Position {
  return float4(vertex == 1 ? 3 : -1, vertex == 2 ? -3 : 1, 0, 1);
}

float3 sky(float3 direction) {
  return lerp(float3(0.8, 0.88, 0.95), float3(0.3, 0.5, 0.8), saturate(2 * direction.y));
}

float3 lit(float3 color, float3 normal, float light) {
  return color * (0.3 + 0.1 * normal.y + 0.7 * light * saturate(dot(normal, kToSun)));
}

// Returns what a mirror at the ray's origin shows.
float3 reflected(RayDesc ray) {
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  query.Proceed();
  if (query.CommittedStatus() == COMMITTED_NOTHING) return sky(ray.Direction);
  // Two triangles to a side of the cube; sides in the order of the indices.
  static const float3 kSides[6] = {float3(0, 0, -1), float3(1, 0, 0), float3(0, 0, 1),
                                   float3(-1, 0, 0), float3(0, 1, 0), float3(0, -1, 0)};
  const float3 side = kSides[query.CommittedPrimitiveIndex() / 2];
  const float3 normal = normalize(mul(side, (float3x3)query.CommittedWorldToObject3x4()));
  RayDesc to_sun = {ray.Origin + query.CommittedRayT() * ray.Direction + 1e-3 * normal, 0, kToSun,
                    100};
  RayQuery<RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH> shadow;
  shadow.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, to_sun);
  shadow.Proceed();
  const float light = shadow.CommittedStatus() == COMMITTED_NOTHING ? 1 : 0;
  return lit(box_colors[query.CommittedInstanceIndex()], normal, light);
}

[shader("pixel")]
float4 Compose(float4 position : SV_Position) : SV_Target {
  const uint2 pixel = uint2(position.xy);
  const float3 direction = normalize(eye_direction(pixel));
  if (depth[pixel] == 0) return float4(sky(direction), 1);
  const float3 normal = normals[pixel].xyz;
  const float3 color = lit(albedo[pixel].rgb, normal, sunlight[pixel]);
  // A wet floor: Schlick's approximation of Fresnel's reflection on sides that look upwards.
  if (normal.y < 0.99) return float4(color, 1);
  const float share = 0.04 + 0.96 * pow(1 - saturate(-dot(direction, normal)), 5);
  RayDesc ray = {ray_origin(surface_position(pixel), normal), 0, reflect(direction, normal), 100};
  return float4(lerp(color, reflected(ray), share), 1);
}
