// SPDX-License-Identifier: MIT
// Shaders of the tests of multisampled targets.

struct Vertex {
  float4 position : SV_Position;
  float2 value : VALUE;
};

cbuffer Constants : register(b0) {
  float4 tint;
};
RWStructuredBuffer<uint> counter : register(u0);

[shader("vertex")]
Vertex Corners(float3 position : POSITION, float2 value : VALUE) {
  Vertex result;
  result.position = float4(position, 1.0);
  result.value = value;
  return result;
}

// A triangle that covers the target, at the depth of tint.w.
[shader("vertex")]
Vertex Whole(uint vertex : SV_VertexID) {
  const float2 corner = float2(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? -3.0 : 1.0);
  Vertex result;
  result.position = float4(corner, tint.w, 1.0);
  result.value = corner;
  return result;
}

[shader("pixel")]
float4 Tint() : SV_Target0 {
  return tint;
}

[shader("pixel")]
float4 Value(Vertex input) : SV_Target0 {
  InterlockedAdd(counter[0], 1);
  return float4(input.value, input.position.xy);
}

// `value` at the sample of this number, and where that is.
[shader("pixel")]
float4 Evaluated(Vertex input) : SV_Target0 {
  const uint number = uint(tint.x);
  return float4(EvaluateAttributeAtSample(input.value, number), GetRenderTargetSamplePosition(number));
}

// The centroid, and how many samples there are.
[shader("pixel")]
float4 EvaluatedCentroid(Vertex input) : SV_Target0 {
  return float4(EvaluateAttributeCentroid(input.value), float(GetRenderTargetSampleCount()), 1.0);
}

struct AtCentroid {
  float4 position : SV_Position;
  centroid float2 value : VALUE;
};

[shader("pixel")]
float4 EvaluatedOfCentroid(AtCentroid input) : SV_Target0 {
  const uint number = uint(tint.x);
  return float4(EvaluateAttributeAtSample(input.value, number), GetRenderTargetSamplePosition(number));
}
[shader("pixel")]
float4 Centroid(AtCentroid input) : SV_Target0 {
  return float4(input.value, 0.0, 1.0);
}

struct AtSample {
  float4 position : SV_Position;
  sample float2 value : VALUE;
};
[shader("pixel")]
float4 Samples(AtSample input, uint index : SV_SampleIndex) : SV_Target0 {
  InterlockedAdd(counter[0], 1);
  return float4(input.value, float(index) + 1.0, 1.0);
}
[shader("pixel")]
float4 SamplePlace(float4 position : SV_Position, uint index : SV_SampleIndex) : SV_Target0 {
  return float4(position.xy, float(index), 1.0);
}

[shader("pixel")]
float4 CoverageIn(uint coverage : SV_Coverage) : SV_Target0 {
  return float4(float(coverage), 0.0, 0.0, 1.0);
}
struct Masked {
  float4 color : SV_Target0;
  uint coverage : SV_Coverage;
};
[shader("pixel")]
Masked CoverageOut(float4 position : SV_Position) {
  Masked result;
  result.color = tint;
  result.coverage = uint(position.x);
  return result;
}
[shader("pixel")]
float4 DiscardOdd(float4 position : SV_Position) : SV_Target0 {
  if ((uint(position.x) & 1) != 0) discard;
  return tint;
}
struct WithDepth {
  float4 color : SV_Target0;
  float depth : SV_Depth;
};
[shader("pixel")]
WithDepth OwnDepth() {
  WithDepth result;
  result.color = tint;
  result.depth = 0.25;
  return result;
}
// Alpha grows by an eighth with the column.
[shader("pixel")]
float4 Alpha(float4 position : SV_Position) : SV_Target0 {
  return float4(tint.xyz, floor(position.x) / 8.0);
}

Texture2DMS<float4> samples : register(t0);
Texture2DMSArray<float4> elements : register(t0);
RWStructuredBuffer<float4> texels : register(u0);

static const uint kMostSamples = 8;

// Every sample of every pixel, then what the texture says of itself.
[shader("compute")]
[numthreads(8, 8, 1)]
void Read(uint2 at : SV_DispatchThreadID) {
  uint width, height, count;
  samples.GetDimensions(width, height, count);
  if (at.x >= width || at.y >= height) return;
  const uint first = (at.y * width + at.x) * kMostSamples;
  for (uint i = 0; i < count; ++i) texels[first + i] = samples.Load(int2(at), i);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void Describe() {
  uint width, height, count;
  samples.GetDimensions(width, height, count);
  texels[0] = float4(width, height, count, 0.0);
  for (uint i = 0; i < kMostSamples; ++i) {
    texels[1 + i] = float4(samples.GetSamplePosition(i), 0.0, 1.0);
  }
  texels[9] = samples.Load(int2(0, 0), count);             // no such sample
  texels[10] = samples.Load(int2(width, 0), 0);            // no such pixel
  texels[11] = samples.Load(int2(0, 0), 1, int2(2, 1));    // an offset
  texels[12] = samples.sample[1][uint2(2, 1)];
  texels[13] = samples[uint2(2, 1)];
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ReadElement(uint2 at : SV_DispatchThreadID) {
  uint width, height, layers, count;
  elements.GetDimensions(width, height, layers, count);
  if (at.x >= width || at.y >= height) return;
  const uint first = (at.y * width + at.x) * kMostSamples;
  for (uint i = 0; i < count; ++i) {
    texels[first + i] = elements.Load(int3(at, layers - 1), i) + float4(0.0, 0.0, 0.0, layers);
  }
}
