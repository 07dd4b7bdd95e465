// SPDX-License-Identifier: MIT
// Reads a geometry in a hit shader: two root SRVs (indices, vertices) and root constants, as in the
// Northlight deck ("Root SRVs and Constants for Vertex Data"). effects/assets/scene/mesh.h has the layout.
#ifndef KAAMOS_GEOMETRY_HLSLI
#define KAAMOS_GEOMETRY_HLSLI

// Root constants of a hit record, 32 bytes. A vertex begins with its position.
struct HitConstants {
  uint vertex_stride;
  uint normal_offset;
  uint tangent_offset;
  uint uv_offset;
  uint index_size_bytes;  // 2 or 4
  uint material_id;
  uint color_offset;      // bytes from the start of a vertex, second texture coordinates follow;
                          // 0: all vertices are white, and the second coordinates are the first
  uint geometry_id;
};

// The vertex numbers of a triangle. Triangles with 16-bit indices are 6 bytes long, so every second
// one starts in the middle of a word.
uint3 LoadTriangle(ByteAddressBuffer indices, uint index_size_bytes, uint primitive) {
  if (index_size_bytes == 4u) return indices.Load3(primitive * 12u);
  const uint first = primitive * 6u;
  const uint2 words = indices.Load2(first & ~3u);
  if ((first & 2u) == 0u) return uint3(words.x & 0xFFFFu, words.x >> 16u, words.y & 0xFFFFu);
  return uint3(words.x >> 16u, words.y & 0xFFFFu, words.y >> 16u);
}

float2 LoadVertexFloat2(ByteAddressBuffer vertices, uint stride, uint offset, uint vertex) {
  return asfloat(vertices.Load2(vertex * stride + offset));
}

float3 LoadVertexFloat3(ByteAddressBuffer vertices, uint stride, uint offset, uint vertex) {
  return asfloat(vertices.Load3(vertex * stride + offset));
}

float4 LoadVertexFloat4(ByteAddressBuffer vertices, uint stride, uint offset, uint vertex) {
  return asfloat(vertices.Load4(vertex * stride + offset));
}

// The colour of a vertex and its opacity, linear: 16 bits each.
float4 LoadVertexColor(ByteAddressBuffer vertices, uint stride, uint offset, uint vertex) {
  const uint2 words = vertices.Load2(vertex * stride + offset);
  return float4(float(words.x & 0xFFFFu), float(words.x >> 16u), float(words.y & 0xFFFFu),
                float(words.y >> 16u)) / 65535.0f;
}

// `barycentrics` are the weights of the second and third vertex, as DXR gives them.
float2 Interpolate(float2 a, float2 b, float2 c, float2 barycentrics) {
  return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}
float3 Interpolate(float3 a, float3 b, float3 c, float2 barycentrics) {
  return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}
float4 Interpolate(float4 a, float4 b, float4 c, float2 barycentrics) {
  return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}

float2 LoadUv(ByteAddressBuffer vertices, HitConstants hit, uint3 triangle_vertices,
              float2 barycentrics) {
  return Interpolate(
      LoadVertexFloat2(vertices, hit.vertex_stride, hit.uv_offset, triangle_vertices.x),
      LoadVertexFloat2(vertices, hit.vertex_stride, hit.uv_offset, triangle_vertices.y),
      LoadVertexFloat2(vertices, hit.vertex_stride, hit.uv_offset, triangle_vertices.z),
      barycentrics);
}

// From the start of a vertex to its first or second texture coordinates.
uint UvOffset(HitConstants hit, bool second) {
  return second && hit.color_offset != 0u ? hit.color_offset + 8u : hit.uv_offset;
}

// As LoadUv: the first or the second.
float2 LoadUvOf(ByteAddressBuffer vertices, HitConstants hit, uint3 triangle_vertices,
                float2 barycentrics, bool second) {
  HitConstants layout = hit;
  layout.uv_offset = UvOffset(hit, second);
  return LoadUv(vertices, layout, triangle_vertices, barycentrics);
}

// Only where `hit.color_offset` is not 0.
float4 LoadColor(ByteAddressBuffer vertices, HitConstants hit, uint3 triangle_vertices,
                 float2 barycentrics) {
  return Interpolate(
      LoadVertexColor(vertices, hit.vertex_stride, hit.color_offset, triangle_vertices.x),
      LoadVertexColor(vertices, hit.vertex_stride, hit.color_offset, triangle_vertices.y),
      LoadVertexColor(vertices, hit.vertex_stride, hit.color_offset, triangle_vertices.z),
      barycentrics);
}

// The interpolated normal in object space, not of unit length.
float3 LoadNormal(ByteAddressBuffer vertices, HitConstants hit, uint3 triangle_vertices,
                  float2 barycentrics) {
  return Interpolate(
      LoadVertexFloat3(vertices, hit.vertex_stride, hit.normal_offset, triangle_vertices.x),
      LoadVertexFloat3(vertices, hit.vertex_stride, hit.normal_offset, triangle_vertices.y),
      LoadVertexFloat3(vertices, hit.vertex_stride, hit.normal_offset, triangle_vertices.z),
      barycentrics);
}

// The interpolated tangent in object space; w is the handedness: bitangent = w * cross(normal,
// tangent).
float4 LoadTangent(ByteAddressBuffer vertices, HitConstants hit, uint3 triangle_vertices,
                   float2 barycentrics) {
  return Interpolate(
      LoadVertexFloat4(vertices, hit.vertex_stride, hit.tangent_offset, triangle_vertices.x),
      LoadVertexFloat4(vertices, hit.vertex_stride, hit.tangent_offset, triangle_vertices.y),
      LoadVertexFloat4(vertices, hit.vertex_stride, hit.tangent_offset, triangle_vertices.z),
      barycentrics);
}

// Transforms a normal to world space by the inverse transpose, and normalises it.
float3 NormalToWorld(float3 normal, float3x4 world_to_object) {
  return normalize(mul(normal, (float3x3)world_to_object));
}

// A point on a triangle in world space, with a bound of its rounding error.
struct SpawnPoint {
  float3 position;
  float3 normal;  // of the triangle, unit; zero if the triangle has no area
  float offset;   // metres along the normal
};

// Instead of a fixed epsilon, bounds the rounding error of this very point. [error bound of
// Waechter, van Antwerpen and Klehm 2023] effects/assets/common/ray_origin.h is the same for the host.
SpawnPoint MakeSpawnPoint(float3 v0, float3 v1, float3 v2, float2 barycentrics,
                          float3x4 object_to_world, float3x4 world_to_object) {
  const float c0 = 5.9604644775390625e-8f;   // 2^-24
  const float c1 = 1.78813934326171875e-7f;  // 3 * 2^-24
  const float c2 = 1.1920928955078125e-7f;   // 2^-23
  precise const float3 e1 = v1 - v0;
  precise const float3 e2 = v2 - v0;
  precise const float3 p = v0 + (e1 * barycentrics.x + e2 * barycentrics.y);

  const float3 a1 = abs(e1);
  const float3 a2 = abs(e2);
  const float3 extents = a1 + a2 + abs(a1 - a2);
  const float extent = max(max(extents.x, extents.y), extents.z);
  // The normal's squared length grows with the fourth power of the edges: it would underflow for
  // edges below 1e-10 m and overflow above 1e9 m. Scaling them by 1 / extent, reduced to a power of
  // two, changes no digit.
  const float power = asfloat((254u << 23) - (asuint(extent) & 0x7F800000u));
  precise const float3 n = cross(e1 * power, e2 * power);
  float3 object_error = c0 * abs(v0) + c1 * extent;

  SpawnPoint result;
  precise float3 world;
  world.x = object_to_world[0].w + (object_to_world[0].x * p.x + (object_to_world[0].y * p.y +
                                                                  object_to_world[0].z * p.z));
  world.y = object_to_world[1].w + (object_to_world[1].x * p.x + (object_to_world[1].y * p.y +
                                                                  object_to_world[1].z * p.z));
  world.z = object_to_world[2].w + (object_to_world[2].x * p.x + (object_to_world[2].y * p.y +
                                                                  object_to_world[2].z * p.z));
  result.position = world;
  const float3 translation =
      float3(object_to_world[0].w, object_to_world[1].w, object_to_world[2].w);
  const float3 world_error =
      c1 * mul(abs((float3x3)object_to_world), abs(p)) + c2 * abs(translation);
  object_error += c2 * mul(abs(world_to_object), float4(abs(world), 1.0f));

  const float3 world_normal = mul(n, (float3x3)world_to_object);
  const float length_squared = dot(world_normal, world_normal);
  result.normal = float3(0.0f, 0.0f, 0.0f);
  result.offset = 0.0f;
  if (length_squared > 0.0f) {
    const float scale = 1.0f / sqrt(length_squared);
    result.normal = world_normal * scale;
    result.offset = scale * dot(object_error, abs(n)) + dot(world_error, abs(result.normal));
  }
  return result;
}

// Origin of a ray towards `direction`, on that side of the triangle. With it, TMin can be 0.
float3 SpawnOrigin(SpawnPoint point_, float3 direction) {
  const float side = dot(point_.normal, direction) >= 0.0f ? 1.0f : -1.0f;
  return point_.position + point_.normal * (side * point_.offset);
}

#endif
