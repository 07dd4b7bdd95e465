// SPDX-License-Identifier: MIT
// Shaders of the tests of draws: each shows one thing that the pipeline does.

struct Vertex {
  float4 position : SV_Position;
  float3 color : COLOR;
  nointerpolation uint id : ID;
};

cbuffer Constants : register(b0) {
  float4 tint;
};

[shader("vertex")]
Vertex FromBuffers(float3 position : POSITION, float3 color : COLOR, float2 offset : OFFSET,
                   uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Vertex result;
  result.position = float4(position.xy + offset, position.z, 1.0);
  result.color = color;
  result.id = instance * 100 + vertex;
  return result;
}

// A triangle that covers the target, at the depth of tint.w.
[shader("vertex")]
Vertex WholeTarget(uint vertex : SV_VertexID) {
  Vertex result;
  const float2 corner = float2(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? -3.0 : 1.0);
  result.position = float4(corner, tint.w, 1.0);
  result.color = tint.xyz;
  result.id = vertex;
  return result;
}

// The same, with where the draw starts.
[shader("vertex")]
Vertex StartsAt(uint vertex : SV_VertexID, int first : SV_StartVertexLocation,
                uint instance : SV_StartInstanceLocation) {
  Vertex result = WholeTarget(vertex);
  result.id = uint(first * 100) + instance;
  return result;
}

[shader("pixel")]
float4 Color(Vertex input) : SV_Target0 {
  return float4(input.color * tint.xyz, 1.0);
}

[shader("pixel")]
uint4 Facts(Vertex input, uint primitive : SV_PrimitiveID, bool front : SV_IsFrontFace) : SV_Target0 {
  return uint4(input.id, primitive, front ? 1 : 0, uint(input.position.x) + 1000 * uint(input.position.y));
}

[shader("pixel")]
float4 Constant() : SV_Target0 {
  return tint;
}

// Every second pixel goes; the derivatives of the others know it anyway.
[shader("pixel")]
float4 Checkerboard(float4 position : SV_Position) : SV_Target0 {
  const uint2 pixel = uint2(position.xy);
  if (((pixel.x + pixel.y) & 1) != 0) discard;
  const float f = position.x * position.y;
  return float4(ddx_fine(f), ddy_fine(f), ddx_coarse(f), 1.0);
}

Texture2D<float4> image : register(t0);
SamplerState linear_sampler : register(s0);

[shader("pixel")]
float4 Sampled(float4 position : SV_Position) : SV_Target0 {
  return image.Sample(linear_sampler, position.xy / 64.0);
}

[shader("pixel")]
float4 Fetched(float4 position : SV_Position) : SV_Target0 {
  return image.Load(int3(position.xy, 0));
}

RWByteAddressBuffer counter : register(u0);

[shader("pixel")]
float4 Counted(float4 position : SV_Position) : SV_Target0 {
  counter.InterlockedAdd(0, 1);
  if (position.x > 32.0) discard;
  counter.InterlockedAdd(4, 1);
  return tint;
}

// The first lane of each wave counts for all; quads ask their helpers, too.
[shader("pixel")]
uint4 Waves(float4 position : SV_Position) : SV_Target0 {
  const uint lanes = WaveActiveCountBits(true);
  if (WaveIsFirstLane()) counter.InterlockedAdd(0, lanes);
  const uint2 pixel = uint2(position.xy);
  uint turns = 0;
  uint others = 0;
  for (;;) {
    ++turns;
    const uint row = WaveReadLaneFirst(pixel.y);
    if (row == pixel.y) {
      others = WaveActiveSum(pixel.y) - WaveActiveCountBits(true) * row;
      break;
    }
  }
  const bool beside = QuadReadAcrossX(pixel.x) == (pixel.x ^ 1) && QuadReadAcrossY(pixel.y) == (pixel.y ^ 1);
  const bool any = QuadReadLaneAt(pixel.x, 0) == (pixel.x & ~1u);
  const bool sum = WaveActiveMax(WavePrefixSum(1u)) == lanes - 1 && WaveActiveBitOr(1u << 20) == 1u << 20;
  return uint4(1 + others, beside && any ? 1 : 0, sum && turns <= lanes ? 1 : 0,
               WaveGetLaneIndex() < WaveGetLaneCount() && lanes <= WaveGetLaneCount() ? 1 : 0);
}

// Only pixels of even columns stay; helpers are not covered.
[shader("pixel")]
uint4 EvenColumns(float4 position : SV_Position, uint covered : SV_Coverage, out uint mask : SV_Coverage) : SV_Target0 {
  counter.InterlockedAdd(0, 1);
  const uint2 pixel = uint2(position.xy);
  mask = (pixel.x & 1) != 0 ? ~1u : covered;
  return uint4(covered, IsHelperLane() ? 0 : 1, QuadReadAcrossX(covered), QuadReadAcrossX(IsHelperLane() ? 1u : 0u));
}

// Whether any pixel of the quad has this column, and all have it or its neighbour.
[shader("pixel")]
uint4 QuadVotes(float4 position : SV_Position) : SV_Target0 {
  const uint2 pixel = uint2(position.xy);
  return uint4(1, QuadAny((pixel.x & 1) == 0) && QuadAny((pixel.x & 1) == 1) ? 1 : 0,
               QuadAll((pixel.x & 1) == 0) ? 1 : 0, QuadAll(pixel.x < 64) ? 1 : 0);
}

RaytracingAccelerationStructure scene : register(t1);

[shader("pixel")]
float4 Traced(float4 position : SV_Position) : SV_Target0 {
  RayDesc ray;
  ray.Origin = float3(position.xy / 32.0 - 1.0, -1.0);
  ray.TMin = 0.0;
  ray.Direction = float3(0.0, 0.0, 1.0);
  ray.TMax = 10.0;
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xFF, ray);
  query.Proceed();
  if (query.CommittedStatus() != COMMITTED_TRIANGLE_HIT) return float4(0.0, 0.0, 0.0, 0.0);
  return float4(query.CommittedRayT(), query.CommittedTriangleBarycentrics(), 1.0);
}

[shader("pixel")]
float4 Barycentrics(Vertex input, float3 weights : SV_Barycentrics, uint primitive : SV_PrimitiveID) : SV_Target0 {
  return float4(weights, float(primitive * 100 + input.id));
}

struct Sliced {
  float4 position : SV_Position;
  nointerpolation uint slice : SV_RenderTargetArrayIndex;
};

// An instance for each slice.
[shader("vertex")]
Sliced WholeSlice(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Sliced result;
  result.position = float4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? -3.0 : 1.0, tint.w, 1.0);
  result.slice = instance;
  return result;
}

[shader("pixel")]
float4 SliceAndWeights(Sliced input, float3 weights : SV_Barycentrics) : SV_Target0 {
  return float4(float(input.slice), weights);
}

[shader("pixel")]
float4 DepthOfTint(float4 position : SV_Position, out float depth : SV_Depth) : SV_Target0 {
  depth = tint.x;
  return tint;
}
