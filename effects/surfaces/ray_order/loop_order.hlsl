// SPDX-License-Identifier: MIT
// Finds what each pixel shows without an acceleration structure, by two loops over pixels and
// triangles, nested as in rasterization or as in ray tracing. Both ask the same question with the
// same arithmetic, so their pictures are the same. [survey 3.5]
#include "../gbuffer/store.hlsli"

static const uint kSide = 8;
static const uint kPixels = kSide * kSide;  // of the tile that a thread works on

struct Corners {
  float3 a, b, c;  // relative to the camera
};
StructuredBuffer<Corners> triangles : register(t0, space3);
RWTexture2D<float2> seen : register(u0, space3);  // view depth, triangle + 1; 0: nothing

struct LoopConstants {
  uint triangle_count;
  uint pixels_inside;  // 1: for each triangle, for each pixel; 0: the other way round
  uint width;
  uint height;
};
ConstantBuffer<LoopConstants> constants : register(b0, space3);

// The values that are the same for all rays from the camera: a rasterizer's edge functions, in
// three dimensions. [Olano & Greer 1997]
struct Edges {
  float3 ab, bc, ca;  // normals of the planes through the camera and an edge
  float3 normal;      // of the triangle
  float distance;     // of its plane, in lengths of the normal
};

// cross(v, w), doubled: small triangles far away keep their digits, and cross(w, v) is exactly the
// opposite, so that no ray passes between two triangles that share an edge.
float3 EdgePlane(float3 v, float3 w) {
  precise const float3 plane = cross(v + w, w - v);
  return plane;
}

Edges MakeEdges(Corners corners) {
  Edges edges;
  edges.ab = EdgePlane(corners.a, corners.b);
  edges.bc = EdgePlane(corners.b, corners.c);
  edges.ca = EdgePlane(corners.c, corners.a);
  precise const float3 normal = cross(corners.b - corners.a, corners.c - corners.a);
  precise const float distance = dot(corners.a, normal);
  edges.normal = normal;
  edges.distance = distance;
  return edges;
}

// Takes the triangle if the ray meets it before what was seen so far. A ray along an edge meets the
// triangles on both sides of it, and the one with the lower number stays.
void See(Edges edges, float3 direction, uint number, inout float2 nearest) {
  precise const float x = dot(edges.bc, direction);
  precise const float y = dot(edges.ca, direction);
  precise const float z = dot(edges.ab, direction);
  if (!(min(x, min(y, z)) >= 0.0 || max(x, max(y, z)) <= 0.0)) return;
  precise const float depth = edges.distance / dot(edges.normal, direction);
  if (depth > 0.0 && (nearest.y == 0.0 || depth < nearest.x)) {
    nearest = float2(depth, float(number + 1));
  }
}

[shader("compute")]
[numthreads(8, 1, 1)]
void FindSeen(uint3 id : SV_DispatchThreadID) {
  const uint2 corner = id.xy * kSide;
  const uint2 size = uint2(constants.width, constants.height);
  if (corner.x >= size.x) return;
  float3 directions[kPixels];
  float2 nearest[kPixels];
  for (uint i = 0; i < kPixels; ++i) {
    directions[i] = PixelRay(corner + uint2(i % kSide, i / kSide), size).direction;
    nearest[i] = float2(0, 0);
  }
  if (constants.pixels_inside != 0) {
    for (uint t = 0; t < constants.triangle_count; ++t) {
      const Edges edges = MakeEdges(triangles[t]);
      for (uint p = 0; p < kPixels; ++p) See(edges, directions[p], t, nearest[p]);
    }
  } else {
    for (uint p = 0; p < kPixels; ++p) {
      const float3 direction = directions[p];
      float2 best = float2(0, 0);
      for (uint t = 0; t < constants.triangle_count; ++t) {
        See(MakeEdges(triangles[t]), direction, t, best);
      }
      nearest[p] = best;
    }
  }
  for (uint j = 0; j < kPixels; ++j) {
    const uint2 pixel = corner + uint2(j % kSide, j / kSide);
    if (all(pixel < size)) seen[pixel] = nearest[j];
  }
}
