// SPDX-License-Identifier: MIT
// Each ray generation shader makes one mistake, with the settings that a test gives it.

struct Payload {
  float3 color;
  uint depth;
};
struct Other {
  uint a;
  uint b;
};
struct Data {
  uint value;
};
struct Attributes {
  float2 place;
};

RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<float4> vertices : register(t1);
ByteAddressBuffer raw : register(t2);
RWStructuredBuffer<uint> result : register(u0);
cbuffer Settings : register(b0) {
  uint index;
  uint flags;
  float number;
  float t_min;
};
ByteAddressBuffer leaf : register(t0, space1);

ByteAddressBuffer many[3] : register(t0, space2);
ByteAddressBuffer any_number[] : register(t0, space3);
Texture2D<float> pictures[] : register(t0, space4);
RaytracingAccelerationStructure scenes[] : register(t0, space5);

RayDesc ray_at(float x) {
  RayDesc ray;
  ray.Origin = float3(x, 0, -1);
  ray.TMin = t_min;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 100;
  return ray;
}

[shader("raygeneration")] void ReadVertex() { result[0] = asuint(vertices[index].x); }

[shader("raygeneration")] void WriteResult() { result[index] = 7; }

[shader("raygeneration")] void AddToResult() { InterlockedAdd(result[index], 7); }

[shader("raygeneration")] void ReadRaw() { result[0] = raw.Load(index); }

[shader("raygeneration")] void ReadHeap() {
  ByteAddressBuffer buffer = ResourceDescriptorHeap[index];
  result[0] = buffer.Load(0);
}

[shader("raygeneration")] void Trace() {
  RayDesc ray = ray_at(0);
  ray.Direction = normalize(float3(0, 0, number));
  Payload payload = {float3(0, 0, 0), index};
  TraceRay(scene, flags, 0xFF, 0, 1, 0, ray, payload);
  result[0] = payload.depth;
}

// One RayDesc for both traces.
[shader("raygeneration")] void TraceTwice() {
  RayDesc ray = ray_at(0);
  Payload payload = {float3(0, 0, 0), 0};
  TraceRay(scene, flags, 0xFF, 0, 1, 0, ray, payload);
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, flags, 0xFF, ray);
  while (query.Proceed()) {
  }
  result[0] = payload.depth + query.CommittedStatus();
}

[shader("raygeneration")] void ReadTransform() {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, RAY_FLAG_FORCE_OPAQUE, 0xFF, ray_at(number));
  while (query.Proceed()) {
  }
  result[0] = asuint(query.CommittedObjectToWorld3x4()[0][0]);
}

[shader("raygeneration")] void ReadCandidate() {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, 0, 0xFF, ray_at(number));
  query.Proceed();
  query.Proceed();
  result[0] = query.CandidatePrimitiveIndex();
}

[shader("raygeneration")] void CommitBox() {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, RAY_FLAG_SKIP_TRIANGLES, 0xFF, ray_at(10));
  while (query.Proceed()) {
    if (query.CandidateType() == CANDIDATE_PROCEDURAL_PRIMITIVE) {
      query.CommitProceduralPrimitiveHit(number);
    }
  }
  result[0] = query.CommittedStatus();
}

[shader("raygeneration")] void TraceOther() {
  Other other = {1, 2};
  TraceRay(scene, RAY_FLAG_SKIP_TRIANGLES, 0xFF, 0, 1, 0, ray_at(0), other);
  result[0] = other.a;
}

[shader("raygeneration")] void CallOther() {
  Other other = {1, 2};
  CallShader(0, other);
  result[0] = other.a;
}

[shader("raygeneration")] void TraceBox() {
  Payload payload = {float3(0, 0, 0), 0};
  TraceRay(scene, 0, 0xFF, 0, 1, 0, ray_at(10), payload);
  result[0] = payload.depth;
}

// Everything that the others do, but correctly.
[shader("raygeneration")] void Clean() {
  Payload payload = {vertices[3].xyz, 0};
  TraceRay(scene, RAY_FLAG_FORCE_NON_OPAQUE, 0xFF, 0, 1, 0, ray_at(0), payload);
  TraceRay(scene, 0, 0xFF, 0, 1, 0, ray_at(10), payload);
  Data data = {raw.Load(4)};
  CallShader(0, data);
  ByteAddressBuffer buffer = ResourceDescriptorHeap[0];
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, 0, 0xFF, ray_at(0));
  while (query.Proceed()) {
  }
  if (query.CommittedStatus() == COMMITTED_TRIANGLE_HIT) {
    payload.depth += asuint(query.CommittedObjectToWorld3x4()[0][0]) & 1;
  }
  InterlockedAdd(result[1], buffer.Load(0));
  result[0] = payload.depth + data.value;
}

[shader("closesthit")] void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  if (payload.depth > 0) {
    payload.depth -= 1;
    TraceRay(scene, 0, 0xFF, 0, 1, 0, ray_at(0), payload);
  }
}

[shader("anyhit")] void Leaf(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  if (leaf.Load(16) == 3) IgnoreHit();
}

[shader("intersection")] void Box() {
  Attributes attributes = {float2(0, 0)};
  ReportHit(1.5, index, attributes);
}

[shader("closesthit")] void BoxHit(inout Payload payload, Attributes attributes) {
  payload.depth = 1;
}

[shader("miss")] void Miss(inout Payload payload) { payload.color = float3(0, 1, 0); }

[shader("callable")] void Call(inout Data data) { data.value += 1; }

[shader("callable")] void CallWide(inout Payload payload) { payload.depth += 1; }

[shader("raygeneration")] void ReadMany() { result[0] = many[index].Load(0); }

[shader("raygeneration")] void ReadAnyNumber() { result[0] = any_number[index].Load(0); }

[shader("raygeneration")] void ReadPictureOfHeap() {
  Texture2D<float> picture = ResourceDescriptorHeap[index];
  result[0] = picture.Load(int3(0, 0, 0)) == 0.0 ? 0x7FC0 : 1;
}
[shader("raygeneration")] void ReadPicture() {
  result[0] = asuint(pictures[index].Load(int3(0, 0, 0)));
}

// None of these calls has constant arguments.
[shader("raygeneration")] void TraceAny() {
  Payload payload = {float3(0, 0, 0), 0};
  TraceRay(scene, 0, 0xFF, index & 0xFF, 0, index >> 8, ray_at(0), payload);
  result[0] = payload.depth;
}

[shader("raygeneration")] void CallAny() {
  Data data = {1};
  CallShader(index, data);
  result[0] = data.value;
}

[shader("raygeneration")] void TraceAnyScene() {
  Payload payload = {float3(0, 0, 0), 0};
  TraceRay(scenes[index], 0, 0xFF, 0, 1, 0, ray_at(0), payload);
  result[0] = payload.depth;
}

[shader("raygeneration")] void QueryAnyScene() {
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scenes[index], 0, 0xFF, ray_at(0));
  query.Proceed();
  result[0] = query.CommittedStatus();
}

struct OtherAttributes {
  uint2 place;
};

[shader("closesthit")] void BoxHitOther(inout Payload payload, OtherAttributes attributes) {
  payload.depth = attributes.place.x;
}
