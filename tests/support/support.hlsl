// SPDX-License-Identifier: MIT
// Small shaders, one for each thing that a call must do. All write numbers to g_out.

RWStructuredBuffer<uint> g_out : register(u0);
struct Constants {
  uint scale;
  uint offset;
};
ConstantBuffer<Constants> g_constants : register(b0);
StructuredBuffer<uint> g_structured : register(t0);
RaytracingAccelerationStructure g_scene : register(t1);

// In the descriptor table.
StructuredBuffer<uint> g_view : register(t0, space1);
Buffer<uint> g_typed : register(t1, space1);
ByteAddressBuffer g_bytes : register(t2, space1);
Texture2D<float4> g_texture : register(t3, space1);
RaytracingAccelerationStructure g_scene_view : register(t4, space1);
RWBuffer<uint> g_typed_out : register(u0, space1);
RWTexture2D<float4> g_texture_out : register(u1, space1);
AppendStructuredBuffer<uint2> g_appended : register(u2, space1);
ConsumeStructuredBuffer<uint2> g_consumed : register(u3, space1);
RWStructuredBuffer<uint> g_counted : register(u4, space1);
ConstantBuffer<Constants> g_constants_view : register(b0, space1);
SamplerState g_sampler : register(s0, space1);
SamplerState g_static_sampler : register(s1, space1);

[shader("compute")] [numthreads(8, 1, 1)]
void FromRootConstants(uint3 id : SV_DispatchThreadID) {
  g_out[id.x] = id.x * g_constants.scale + g_constants.offset;
}

[shader("compute")] [numthreads(8, 1, 1)]
void FromRootBuffer(uint3 id : SV_DispatchThreadID) { g_out[id.x] = g_structured[id.x] + 1; }

[shader("compute")] [numthreads(8, 1, 1)]
void FromStructuredView(uint3 id : SV_DispatchThreadID) { g_out[id.x] = g_view[id.x] + 2; }

[shader("compute")] [numthreads(8, 1, 1)]
void FromTypedView(uint3 id : SV_DispatchThreadID) { g_out[id.x] = g_typed[id.x] + 3; }

[shader("compute")] [numthreads(8, 1, 1)]
void FromRawView(uint3 id : SV_DispatchThreadID) { g_out[id.x] = g_bytes.Load(id.x * 4) + 4; }

[shader("compute")] [numthreads(8, 1, 1)]
void FromTexture(uint3 id : SV_DispatchThreadID) {
  g_out[id.x] = uint(g_texture.Load(int3(id.x, 0, 0)).x * 255.0f + 0.5f);
}

[shader("compute")] [numthreads(8, 1, 1)]
void FromSampler(uint3 id : SV_DispatchThreadID) {
  const float2 uv = float2((float(id.x) + 0.5f) / 8.0f, 0.5f);
  g_out[id.x] = uint(g_texture.SampleLevel(g_sampler, uv, 0.0f).x * 255.0f + 0.5f);
}

[shader("compute")] [numthreads(8, 1, 1)]
void FromStaticSampler(uint3 id : SV_DispatchThreadID) {
  const float2 uv = float2((float(id.x) + 0.5f) / 8.0f, 0.5f);
  g_out[id.x] = uint(g_texture.SampleLevel(g_static_sampler, uv, 0.0f).x * 255.0f + 0.5f);
}

[shader("compute")] [numthreads(8, 1, 1)]
void FromConstantView(uint3 id : SV_DispatchThreadID) {
  g_out[id.x] = id.x * g_constants_view.scale + g_constants_view.offset;
}

[shader("compute")] [numthreads(8, 1, 1)]
void ToTypedView(uint3 id : SV_DispatchThreadID) { g_typed_out[id.x] = id.x + 5; }

// Each thread moves a pair from one buffer to the other, and takes a number.
[shader("compute")] [numthreads(8, 1, 1)]
void ThroughCounters(uint3 id : SV_DispatchThreadID) {
  const uint2 pair = g_consumed.Consume();
  g_appended.Append(pair + uint2(100, 0));
  g_counted[id.x] = 50 + g_counted.IncrementCounter();
  uint count, stride;
  g_appended.GetDimensions(count, stride);
  g_out[id.x] = count * 1000 + stride;
}

// A buffer without a counter has one that is always 0.
[shader("compute")] [numthreads(1, 1, 1)]
void WithoutCounter() {
  g_counted[0] = 7;
  g_out[0] = g_counted.IncrementCounter();
  g_out[1] = g_counted.IncrementCounter();
  g_out[2] = g_counted[0];
}

[shader("compute")] [numthreads(8, 1, 1)]
void ToTexture(uint3 id : SV_DispatchThreadID) {
  g_texture_out[uint2(id.x, 0)] = float4(float(id.x + 10) / 255.0f, 0, 0, 1);
}

groupshared uint shared_words[8];
[shader("compute")] [numthreads(8, 1, 1)]
void ThroughGroupMemory(uint3 id : SV_DispatchThreadID) {
  shared_words[id.x] = id.x;
  GroupMemoryBarrierWithGroupSync();
  g_out[id.x] = shared_words[7 - id.x];
}

[shader("compute")] [numthreads(8, 1, 1)]
void Atomically(uint3 id : SV_DispatchThreadID) { InterlockedAdd(g_out[0], id.x); }

// Rays. Ray i goes along +z at x = i; a hit adds to 100.

struct Payload {
  uint value;
  uint depth;
};
struct Attributes {
  float2 place;
};
struct Data {
  uint value;
};
ConstantBuffer<Constants> l_constants : register(b0, space2);
StructuredBuffer<uint> l_words : register(t0, space2);

RayDesc RayOf(uint index) {
  RayDesc ray;
  ray.Origin = float3(float(index), 0, -5);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 100;
  return ray;
}

[shader("raygeneration")]
void TraceRootView() {
  const uint index = DispatchRaysIndex().x;
  Payload payload = {0, 0};
  TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, RayOf(index), payload);
  g_out[index] = payload.value;
}

[shader("raygeneration")]
void TraceTableView() {
  const uint index = DispatchRaysIndex().x;
  Payload payload = {0, 0};
  TraceRay(g_scene_view, RAY_FLAG_NONE, 0xFF, 0, 1, 0, RayOf(index), payload);
  g_out[index] = payload.value;
}

[shader("raygeneration")]
void CallTwo() {
  const uint index = DispatchRaysIndex().x;
  Data data = {index};
  CallShader(index % 2, data);
  g_out[index] = data.value;
}

[shader("raygeneration")]
void TakeLong() {
  uint sum = DispatchRaysIndex().x;
  for (uint i = 0; i < 100000; ++i) sum = sum * 1664525 + 1013904223;
  g_out[DispatchRaysIndex().x] = sum;
}

[shader("raygeneration")]
void WriteIndex() {
  const uint3 size = DispatchRaysDimensions();
  const uint3 at = DispatchRaysIndex();
  g_out[(at.z * size.y + at.y) * size.x + at.x] = at.x + 10 * at.y + 100 * at.z;
}

[shader("callable")]
void AddOne(inout Data data) { data.value += 1; }

[shader("callable")]
void Double(inout Data data) { data.value *= 2; }

[shader("miss")]
void Miss(inout Payload payload) { payload.value = 7; }

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.value = 100 + 10 * PrimitiveIndex() + InstanceID();
}

[shader("closesthit")]
void HitWithRecord(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.value = l_constants.scale + l_words[PrimitiveIndex()];
}

[shader("closesthit")]
void HitAgain(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  Payload deeper = {0, payload.depth + 1};
  if (payload.depth < 3) {
    TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, RayOf(DispatchRaysIndex().x), deeper);
  }
  payload.value = deeper.value + 1;
}

[shader("anyhit")]
void IgnoreOdd(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  if (PrimitiveIndex() % 2 == 1) IgnoreHit();
}

[shader("intersection")]
void Box() {
  Attributes attributes;
  attributes.place = float2(PrimitiveIndex(), 1);
  ReportHit(5.0f, 3, attributes);
}

[shader("closesthit")]
void HitBox(inout Payload payload, Attributes attributes) {
  payload.value = 200 + uint(attributes.place.x) + HitKind();
}

// Three triangles that cover the target, each with the depth of its instance.
struct Corner {
  float4 position : SV_Position;
  nointerpolation uint instance : INSTANCE;
};

[shader("vertex")]
Corner CoverAll(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Corner corner;
  const float2 side = float2(vertex == 1 ? 3.0f : -1.0f, vertex == 2 ? -3.0f : 1.0f);
  corner.position = float4(side, float(instance + 1) / 4.0f, 1.0f);
  corner.instance = instance;
  return corner;
}

[shader("vertex")]
Corner FromVertexBuffer(float2 position : POSITION) {
  Corner corner;
  corner.position = float4(position, 0.5f, 1.0f);
  corner.instance = 6;
  return corner;
}

[shader("pixel")]
uint PixelNumber(Corner corner) : SV_Target {
  return (corner.instance + 1) * 100 + uint(corner.position.x);
}
