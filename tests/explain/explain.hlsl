// SPDX-License-Identifier: MIT
// The shaders to be explained: x selects what the ray generation shader does.

RaytracingAccelerationStructure scene : register(t0);
RWStructuredBuffer<float4> results : register(u0);

cbuffer Leaf : register(b0, space1) {
  float cutout;  // hits with a barycentrics.x below this fall into a hole
  uint leaf_id;
};
StructuredBuffer<float4> colors : register(t0, space1);

struct Payload {
  float3 color;
  uint leaves;
};

struct ShadowPayload {
  float open;
};

struct CallData {
  float2 uv;
  bool done;
};

struct SphereAttributes {
  float distance;
};

RayDesc MakeRay(float3 origin, float3 direction, float t_max) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = t_max;
  return ray;
}

float4 Primary(float x) {
  Payload payload;
  payload.color = float3(0, 0, 0);
  payload.leaves = 0;
  TraceRay(scene, RAY_FLAG_CULL_BACK_FACING_TRIANGLES, 0x01, 0, 2, 0,
           MakeRay(float3(x, 0.25, 0), float3(0, 0, 1), 6.5), payload);
  return float4(payload.color, payload.leaves);
}

float4 Query() {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, RAY_FLAG_CULL_BACK_FACING_TRIANGLES, 0x01,
                       MakeRay(float3(0.25, 0.25, 0), float3(0, 0, 1), 6.5));
  while (query.Proceed()) {
    if (query.CandidateTriangleRayT() > 1.5) {
      query.CommitNonOpaqueTriangleHit();
    }
  }
  return float4(query.CommittedRayT(), 0, 0, 0);
}

float4 Call() {
  CallData data;
  data.uv = float2(0.5, 0.25);
  data.done = false;
  CallShader(0, data);
  return float4(data.uv, data.done ? 1 : 0, 0);
}

[shader("raygeneration")]
void ExplainRayGen() {
  const uint x = DispatchRaysIndex().x;
  float4 result = float4(0, 0, 0, 0);
  switch (x) {
    case 0:
      result = Primary(0.25);
      break;
    case 1:
      result = Query();
      break;
    case 2:
      result = Call();
      break;
    default:
      result = Primary(10.25);
      break;
  }
  results[x] += result;
}

[shader("anyhit")]
void LeafAnyHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  payload.leaves += 1;
  if (hit.barycentrics.x < cutout) {
    IgnoreHit();
  }
}

[shader("anyhit")]
void LeafShadow(inout ShadowPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (hit.barycentrics.x < cutout) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void WallHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  ShadowPayload shadow;
  shadow.open = 0;
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0x01,
           1, 2, 1, MakeRay(float3(0.25, 0.25, 4.5), float3(0, 0, -1), 10), shadow);
  payload.color = colors[0].rgb * shadow.open;
}

[shader("miss")]
void SkyMiss(inout Payload payload) {
  payload.color = float3(0.5, 0.75, 1);
}

[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) {
  payload.open = 1;
}

[shader("callable")]
void Tint(inout CallData data) {
  data.uv *= 2;
  data.done = true;
}

[shader("intersection")]
void SphereIntersection() {
  SphereAttributes attributes;
  attributes.distance = 9;
  ReportHit(9, 1, attributes);  // beyond TMax
  attributes.distance = 3;
  ReportHit(3, 2, attributes);
}

[shader("closesthit")]
void SphereHit(inout Payload payload, in SphereAttributes hit) {
  payload.color = float3(hit.distance, 0, 0);
}
