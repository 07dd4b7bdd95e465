// SPDX-License-Identifier: MIT
// Shaders of the rules of order, early and late tests, unordered access views and ray queries.
#include "ras.hlsli"

RWByteAddressBuffer words : register(u0);
RasterizerOrderedTexture2D<uint> ordered : register(u1);
RaytracingAccelerationStructure scene : register(t0);

// The same for the whole triangle, to be blended by half.
[shader("pixel")]
float4 HalfOfElement(float4 position : SV_Position, nointerpolation uint element : ELEMENT) : SV_Target {
  return float4(element, 0.0, 0.0, 0.5);
}

// No attribute: tests come after the shader, as it writes memory.
[shader("pixel")]
float4 CountsLate() : SV_Target {
  words.InterlockedAdd(0, 1);
  return tint;
}

[earlydepthstencil]
[shader("pixel")]
float4 CountsEarly() : SV_Target {
  words.InterlockedAdd(0, 1);
  return tint;
}

[earlydepthstencil]
[shader("pixel")]
float4 DiscardsEarly() : SV_Target {
  words.InterlockedAdd(0, 1);
  if (tint.w < 0.5) discard;
  words.InterlockedAdd(4, 1);
  return tint;
}

struct OwnDepthEarly {
  float4 color : SV_Target;
  float depth : SV_Depth;
};

[earlydepthstencil]
[shader("pixel")]
OwnDepthEarly IgnoredDepth() {
  OwnDepthEarly result;
  result.color = tint;
  result.depth = 0.0625;
  return result;
}

[shader("pixel")]
float4 CountsWithDiscard(float4 position : SV_Position) : SV_Target {
  if ((uint(position.x) & 1) != 0) discard;
  return tint;
}

// Appends, and writes no target.
[shader("pixel")]
void Appends(float4 position : SV_Position, nointerpolation uint instance : INSTANCE) {
  words.InterlockedAdd(0, 1);
  words.InterlockedAdd(4 + instance * 4, 1);
}

[shader("vertex")]
float4 StoresItsId(uint vertex : SV_VertexID) : SV_Position {
  words.Store(4 * vertex, 1000 + vertex);
  return float4(corner_of_target(vertex), depth, 1.0);
}

[shader("pixel")]
void InOrder(float4 position : SV_Position, nointerpolation uint instance : INSTANCE) {
  const uint2 place = uint2(position.xy);
  ordered[place] = ordered[place] * 3 + instance + number;
}

float hit_distance(float2 place) {
  RayDesc ray;
  ray.Origin = float3(place / 32.0 - 1.0, -1.0);
  ray.TMin = 0.0;
  ray.Direction = normalize(float3(0.1, 0.2, 1.0));
  ray.TMax = 100.0;
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xFF, ray);
  query.Proceed();
  return query.CommittedStatus() == COMMITTED_TRIANGLE_HIT ? query.CommittedRayT() : -1.0;
}

[shader("pixel")]
float4 TracesPixels(float4 position : SV_Position) : SV_Target {
  return float4(hit_distance(position.xy), 0.0, 0.0, 1.0);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void TracesThreads(uint3 id : SV_DispatchThreadID) {
  words.Store((id.y * 64 + id.x) * 4, asuint(hit_distance(float2(id.xy) + 0.5)));
}

[shader("vertex")]
Vertex TracesVertices(uint vertex : SV_VertexID) {
  Vertex result;
  result.position = float4(corner_of_target(vertex), depth, 1.0);
  result.value = float4(0, 0, 0, 0);
  result.vertex = 0;
  result.instance = 0;
  // The ray is that of pixel (number, number).
  result.element = asuint(hit_distance(float2(number, number) + 0.5));
  return result;
}

[shader("pixel")]
float4 ReadTraced(Vertex input) : SV_Target {
  return float4(asfloat(input.element), 0.0, 0.0, 1.0);
}
