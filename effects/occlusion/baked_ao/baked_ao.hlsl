// SPDX-License-Identifier: MIT
// Ambient occlusion of what stands still, traced once into texels on its triangles and looked up where
// a pixel shows them. Every triangle has a grid of texels of its own, so that nothing has to be
// unwrapped. [survey 7; Yuksel, Keyser & House 2010]
#include "../../surfaces/gbuffer/scene_draw.hlsli"
#include "sampling.hlsli"
#include "visibility.hlsli"

// Mirrors BakeConstants of baked_ao.cpp.
struct BakeConstants {
  uint rays;     // of a texel
  uint texels;   // of all triangles
  uint columns;  // of the grid that is dispatched
  uint mask;     // of the instances that rays see
};
ConstantBuffer<BakeConstants> constants : register(b0, space3);

// A geometry of an instance that was baked, where it stands now. Mirrors BakedPart of baked_ao.cpp.
struct BakedPart {
  SceneDraw draw;
  uint first_triangle;  // in `grids`
  uint triangles;
  uint sides;  // 2: the back has texels too
  uint padding;
};

// The texels of a triangle, in rows along one of its edges. Mirrors BakedGrid of baked_ao.cpp.
struct BakedGrid {
  uint first;    // in `texels`
  uint2 cells;   // along the two edges that meet at `corner`
  uint part;     // in `parts`
  uint corner;   // that is opposite the longest edge
};

StructuredBuffer<BakedPart> parts : register(t0, space3);
StructuredBuffer<HitConstants> geometries : register(t1, space3);
StructuredBuffer<BakedGrid> grids : register(t2, space3);
StructuredBuffer<uint2> instance_parts : register(t3, space3);  // by instance: first, count
RWTexture2D<float4> result : register(u0, space3);              // visibility: 1 open, 0 occluded
RWStructuredBuffer<float> texels : register(u1, space3);
// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

uint GridTexels(BakedGrid grid) { return (grid.cells.x + 1) * (grid.cells.y + 1); }

// Barycentrics of the second and third corner, counted from the first vertex or from the grid's
// corner.
float2 FromCorner(float2 barycentrics, uint corner) {
  const float first = 1.0 - barycentrics.x - barycentrics.y;
  if (corner == 0) return barycentrics;
  return corner == 1 ? float2(barycentrics.y, first) : float2(first, barycentrics.x);
}
float2 FromVertex(float2 along, uint corner) { return FromCorner(along, (3 - corner) % 3); }

static const float2 kMiddle = float2(1.0 / 3.0, 1.0 / 3.0);
// Points on edges move inwards: on the edge itself rays would start in the neighbour's plane. By a
// part of a texel, and no more than a part of the triangle.
static const float kInset = 0.1, kMostInset = 0.02;

// The place of a texel, of those behind the longest edge the nearest on the triangle.
float2 TexelPlace(uint texel, BakedGrid grid) {
  const uint2 at = uint2(texel % (grid.cells.x + 1), texel / (grid.cells.x + 1));
  const float2 cells = max(float2(grid.cells), 1.0);
  const float2 inset = min(kInset / cells, kMostInset);
  const float2 place = float2(grid.cells.x > 0 ? float(at.x) / cells.x : kMiddle.x,
                              grid.cells.y > 0 ? float(at.y) / cells.y : kMiddle.y);
  float2 inside = max(place - inset, 0.0);
  const float room = 1.0 - inset.x - inset.y - max(inset.x, inset.y);
  inside *= min(1.0, room / max(inside.x + inside.y, room));
  return FromVertex(inset + inside, grid.corner);
}

// The triangle that a texel belongs to.
uint GridOf(uint texel) {
  uint count, stride;
  grids.GetDimensions(count, stride);
  uint low = 0;
  while (count > 1) {
    const uint upper = count / 2;
    if (grids[low + upper].first <= texel) {
      low += upper;
      count -= upper;
    } else {
      count = upper;
    }
  }
  return low;
}

bool IsBakedOpen(float3 origin, float3 direction) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = pass_constants.radius;
  VisibilityPayload payload;
  payload.visibility = 0.0;
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
           constants.mask, kRayTypeVisibility, kRayTypeCount, kRayTypeVisibility, ray, payload);
  return payload.visibility > 0.0;
}

// The open part of the hemisphere above a point. The directions are the same at all points, so that
// neighbours on a plane differ by what they see alone.
float OpenPart(SpawnPoint point_, float3 normal, float3 shading_normal) {
  const float3 origin = SpawnOrigin(point_, normal);
  const uint seed = HashCombine(frame.seed, kAmbientOcclusionPair);
  float open = 0.0;
  for (uint i = 0; i < constants.rays; ++i) {
    const float3 direction = ToWorld(SampleCosineHemisphere(SobolOwen(i, seed)), shading_normal);
    if (dot(direction, normal) > 0.0 && IsBakedOpen(origin, direction)) open += 1.0;
  }
  return open / float(max(constants.rays, 1u));
}

float BakedTexel(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of, BakedPart part,
                 BakedGrid grid, uint primitive, uint texel) {
  const bool is_back = texel >= GridTexels(grid);
  const float2 place = TexelPlace(is_back ? texel - GridTexels(grid) : texel, grid);
  const HitConstants layout = geometries[part.draw.geometry];
  const uint stride = layout.vertex_stride;
  const uint3 corners = LoadTriangle(indices_of, layout.index_size_bytes, primitive);
  const float3x4 to_object = WorldToObject(part.draw);
  const SpawnPoint point_ =
      MakeSpawnPoint(LoadVertexFloat3(vertices_of, stride, 0, corners.x),
                     LoadVertexFloat3(vertices_of, stride, 0, corners.y),
                     LoadVertexFloat3(vertices_of, stride, 0, corners.z), place,
                     ObjectToWorld(part.draw), to_object);
  const float side = is_back ? -1.0 : 1.0;
  const float3 normal = side * point_.normal;
  const float3 smooth =
      side * NormalToWorld(LoadNormal(vertices_of, layout, corners, place), to_object);
  // A broken vertex normal, or one of the other side, tells nothing.
  return OpenPart(point_, normal, dot(smooth, normal) > 0.0 ? smooth : normal);
}

[shader("raygeneration")]
void BakeOcclusion() {
  const uint texel = DispatchRaysIndex().y * constants.columns + DispatchRaysIndex().x;
  if (texel >= constants.texels) return;
  if (!(pass_constants.radius > 0.0)) {
    texels[texel] = 1.0;
    return;
  }
  const uint number = GridOf(texel);
  const BakedGrid grid = grids[number];
  const BakedPart part = parts[grid.part];
  const uint buffer = 2 * part.draw.geometry;
  texels[texel] = BakedTexel(geometry_buffers[NonUniformResourceIndex(buffer)],
                             geometry_buffers[NonUniformResourceIndex(buffer + 1)], part, grid,
                             number - part.first_triangle, texel - grid.first);
}

// A triangle that a pixel may show.
struct BakedPlace {
  float2 barycentrics;  // of its point that is nearest to the pixel's, or close to that
  float distance;       // squared, object space
  bool is_back;         // the pixel shows its back
};

BakedPlace PlaceOnTriangle(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of,
                           BakedPart part, uint primitive, float3 position, float3 normal) {
  const HitConstants layout = geometries[part.draw.geometry];
  const uint3 corners = LoadTriangle(indices_of, layout.index_size_bytes, primitive);
  const float3 v0 = LoadVertexFloat3(vertices_of, layout.vertex_stride, 0, corners.x);
  const float3 e1 = LoadVertexFloat3(vertices_of, layout.vertex_stride, 0, corners.y) - v0;
  const float3 e2 = LoadVertexFloat3(vertices_of, layout.vertex_stride, 0, corners.z) - v0;
  const float3x4 to_object = WorldToObject(part.draw);
  const float3 from_v0 = mul(to_object, float4(position, 1.0)) - v0;
  // Gram's system of the two edges.
  const float a = dot(e1, e1);
  const float b = dot(e1, e2);
  const float c = dot(e2, e2);
  const float d1 = dot(e1, from_v0);
  const float d2 = dot(e2, from_v0);
  const float determinant = a * c - b * b;
  BakedPlace place;
  place.barycentrics = kMiddle;
  if (determinant > 0.0) {
    place.barycentrics = saturate(float2(c * d1 - b * d2, a * d2 - b * d1) / determinant);
    place.barycentrics /= max(place.barycentrics.x + place.barycentrics.y, 1.0);
  }
  const float3 off = from_v0 - e1 * place.barycentrics.x - e2 * place.barycentrics.y;
  place.distance = dot(off, off);
  place.is_back = dot(mul(cross(e1, e2), (float3x3)to_object), normal) < 0.0;
  return place;
}

// Between the four texels around a place.
float FilteredTexels(BakedGrid grid, bool is_back, float2 barycentrics) {
  const float2 at = FromCorner(barycentrics, grid.corner) * float2(grid.cells);
  const uint2 cell = min(uint2(max(at, 0.0)), grid.cells);
  const uint2 next = min(cell + 1, grid.cells);
  const float2 part = saturate(at - float2(cell));
  const uint first = grid.first + (is_back ? GridTexels(grid) : 0);
  const uint row = first + cell.y * (grid.cells.x + 1);
  const uint next_row = first + next.y * (grid.cells.x + 1);
  return lerp(lerp(texels[row + cell.x], texels[row + next.x], part.x),
              lerp(texels[next_row + cell.x], texels[next_row + next.x], part.x), part.y);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void LookUpOcclusion(uint3 id : SV_DispatchThreadID) {
  const uint2 pixel = id.xy;
  uint2 size;
  g_view_z.GetDimensions(size.x, size.y);
  if (any(pixel >= size)) return;
  result[pixel] = float4(1, 1, 1, 1);
  const uint2 ids = g_ids[pixel];
  if (ids.x == 0) return;
  const uint2 range = instance_parts[ids.x - 1];
  const float3 position = g_position[pixel].xyz;
  const float3 normal = OctahedralDecode(g_normal[pixel]);
  float nearest = 3e38;
  // A primitive's number is one of its geometry: several of an instance may have it.
  for (uint i = 0; i < range.y; ++i) {
    const BakedPart part = parts[range.x + i];
    if (ids.y >= part.triangles) continue;
    const uint buffer = 2 * part.draw.geometry;
    const BakedPlace place =
        PlaceOnTriangle(geometry_buffers[NonUniformResourceIndex(buffer)],
                        geometry_buffers[NonUniformResourceIndex(buffer + 1)], part, ids.y,
                        position, normal);
    if (!(place.distance < nearest)) continue;
    nearest = place.distance;
    const float open = FilteredTexels(grids[part.first_triangle + ids.y],
                                      place.is_back && part.sides > 1, place.barycentrics);
    result[pixel] = float4(open, open, open, 1);
  }
}
