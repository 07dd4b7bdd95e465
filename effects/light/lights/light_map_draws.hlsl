// SPDX-License-Identifier: MIT
// Shadow maps of local lights and of the sun, drawn into the atlas that rays render otherwise
// [lighting.hlsl]: a draw for each geometry of each instance, into each face of each map. A spot's
// map is one face. A point light's is eight, one per octant: within an octant the octahedron is a
// perspective picture like any other, so that each texel's centre sees along the same direction as
// the ray does. The sun's is one parallel face.
#include "../../surfaces/gbuffer/scene_draw.hlsli"
#include "alpha_test.hlsli"
#include "hit_lighting.hlsli"

struct LightMapConstants {
  uint draw;   // in `draws`
  uint light;  // in `lights`
  uint face;   // an octant (bit 0: x < 0, 1: y < 0, 2: z < 0), kSpotFace or kSunFace
};
ConstantBuffer<LightMapConstants> constants : register(b0, space3);
StructuredBuffer<SceneDraw> draws : register(t0, space3);
StructuredBuffer<HitConstants> geometries : register(t1, space3);
// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

static const uint kSpotFace = 8;
static const uint kSunFace = 9;
// As of the rays in lighting.hlsl.
static const float kLeastCosine = 0.02;

struct MapCorner {
  float3 position : POSITION;  // object space
  float2 uv : TEXCOORD;
};

struct MapVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
};

// Lengths along rays from the light between which surfaces count.
float NearestOf(LightConstants light) { return min(light.radius, light.range); }

float3 OctantSigns(uint face) {
  return float3((face & 1) != 0 ? -1.0 : 1.0, (face & 2) != 0 ? -1.0 : 1.0,
                (face & 4) != 0 ? -1.0 : 1.0);
}

uint OctantOf(float3 direction) {
  return (direction.x < 0.0 ? 1 : 0) | (direction.y < 0.0 ? 2 : 0) | (direction.z < 0.0 ? 4 : 0);
}

// From relative to the light to the clip space of a face. Depth is reversed: near over w.
float4 ToFace(LightConstants light, float3 p) {
  float2 at;
  float w;
  if (constants.face == kSpotFace) {
    w = dot(p, light.direction);
    at = float2(dot(p, light.map_right), dot(p, light.map_up));
  } else {
    // [OctahedralEncode, times |x| + |y| + |z|]
    const float3 s = OctantSigns(constants.face);
    w = dot(s, p);
    at = p.xy;
    if (s.z < 0.0) at = s.xy * float2(w - s.y * p.y, w - s.x * p.x);
  }
  // The rows of the atlas go up with `at`, those of a picture down with y.
  const float nearest = max(0.5 * NearestOf(light), 1e-5 * light.range);
  return float4(at.x, -at.y, nearest, w);
}

// The same for the sun's map; `p` is relative to the map's centre.
float4 ToSunFace(float3 p) {
  const float along = -dot(p, frame.direction_to_sun);
  return float4(dot(p, frame.sun_map_right), -dot(p, frame.sun_map_up),
                0.5 - 0.5 * along / frame.sun_map_reach, 1.0);
}

[shader("vertex")]
MapVertex LightMapVertex(MapCorner corner) {
  const float3 world = mul(ObjectToWorld(draws[constants.draw]), float4(corner.position, 1.0));
  MapVertex result;
  if (constants.face == kSunFace) {
    result.position = ToSunFace(world - frame.sun_map_centre);
  } else {
    const LightConstants light = lights[constants.light];
    result.position = ToFace(light, world - light.position);
  }
  result.uv = corner.uv;
  return result;
}

// The same with what IsOpenAtUv asks for.
struct HoleVertex {
  float4 position : SV_Position;
  float2 uv : TEXCOORD;
  float alpha : ALPHA;
};

[shader("vertex")]
HoleVertex LightMapHoleVertex(MapCorner corner, uint vertex : SV_VertexID) {
  const MapVertex place = LightMapVertex(corner);
  const uint geometry = draws[constants.draw].geometry;
  HoleVertex result;
  result.position = place.position;
  result.uv = HoleUv(geometry_buffers[2 * geometry], geometries[geometry], vertex, place.uv);
  result.alpha = VertexAlpha(geometry_buffers[2 * geometry], geometries[geometry], vertex);
  return result;
}

// A triangle of a draw, relative to the camera.
struct MapTriangle {
  float3 corner;
  float3 normal;  // unit
};

MapTriangle LoadMapTriangle(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of,
                            uint primitive) {
  const SceneDraw draw = draws[constants.draw];
  const HitConstants layout = geometries[draw.geometry];
  const float3x4 to_world = ObjectToWorld(draw);
  const uint3 corners = LoadTriangle(indices_of, layout.index_size_bytes, primitive);
  const float3 a = LoadVertexFloat3(vertices_of, layout.vertex_stride, 0, corners.x);
  const float3 b = LoadVertexFloat3(vertices_of, layout.vertex_stride, 0, corners.y);
  const float3 c = LoadVertexFloat3(vertices_of, layout.vertex_stride, 0, corners.z);
  MapTriangle result;
  result.corner = mul(to_world, float4(a, 1.0));
  result.normal =
      normalize(cross(mul((float3x3)to_world, b - a), mul((float3x3)to_world, c - a)));
  return result;
}

// Metres along a ray from `origin` to the triangle's plane.
float DistanceToPlane(MapTriangle triangle_seen, float3 origin, float3 direction) {
  return dot(triangle_seen.normal, triangle_seen.corner - origin) /
         dot(triangle_seen.normal, direction);
}

// Returns what a texel of the atlas holds of a triangle, as the hit shaders of lighting.hlsl say.
float4 SeenFromLight(uint2 texel, MapTriangle seen) {
  const LightConstants light = lights[constants.light];
  const float2 uv = (float2(texel % kShadowTile) + 0.5) / float(kShadowTile);
  const float3 direction = ShadowMapDirection(light, uv);
  if (constants.face != kSpotFace && OctantOf(direction) != constants.face) discard;
  const float distance = DistanceToPlane(seen, light.position, direction);
  if (!(distance >= NearestOf(light) && distance <= light.range)) discard;
  const float cosine = dot(seen.normal, direction);
  const bool faces = abs(cosine) > kLeastCosine;
  return float4(faces ? seen.normal / cosine : direction, 1.0) / distance;
}

float4 SeenFromSun(uint2 texel, MapTriangle seen) {
  const float half_side = 0.5 * frame.sun_map_texel * float(frame.sun_map_size);
  const float2 at =
      ((float2(texel - SunMapOrigin()) + 0.5) / float(frame.sun_map_size) * 2.0 - 1.0) *
      (half_side * half_side);
  const float3 direction = -frame.direction_to_sun;
  const float3 origin =
      frame.sun_map_centre + frame.sun_map_right * at.x + frame.sun_map_up * at.y;
  const float cosine = dot(seen.normal, direction);
  float2 slope = float2(0, 0);
  if (abs(cosine) > kLeastCosine) {
    const float step = half_side * frame.sun_map_texel;
    slope = float2(dot(seen.normal, frame.sun_map_right), dot(seen.normal, frame.sun_map_up)) *
            (-step / cosine);
  }
  return float4(DistanceToPlane(seen, origin, direction), slope, 1.0);
}

float4 Seen(uint2 texel, uint primitive) {
  const uint geometry = draws[constants.draw].geometry;
  const MapTriangle seen = LoadMapTriangle(geometry_buffers[2 * geometry],
                                           geometry_buffers[2 * geometry + 1], primitive);
  if (constants.face == kSunFace) return SeenFromSun(texel, seen);
  return SeenFromLight(texel, seen);
}

[shader("pixel")]
float4 LightMapPixel(MapVertex vertex, uint primitive : SV_PrimitiveID) : SV_Target {
  return Seen(uint2(vertex.position.xy), primitive);
}

// Leaves out the holes of the material.
[shader("pixel")]
float4 LightMapHoles(HoleVertex vertex, uint primitive : SV_PrimitiveID) : SV_Target {
  const HitConstants layout = geometries[draws[constants.draw].geometry];
  if (IsOpenAtUv(materials[layout.material_id], vertex.uv, vertex.alpha)) discard;
  return Seen(uint2(vertex.position.xy), primitive);
}
