// SPDX-License-Identifier: MIT
// RayQuerys with and without permissions for what they meet.

RaytracingAccelerationStructure scene : register(t0);
RaytracingAccelerationStructure many[] : register(t0, space1);
RWByteAddressBuffer results : register(u0);

RayDesc straight() {
  RayDesc ray;
  ray.Origin = float3(0.1, 0.2, -1.0);
  ray.Direction = float3(0.0, 0.0, 1.0);
  ray.TMin = 0.0;
  ray.TMax = 100.0;
  return ray;
}

template <uint Flags, uint Second>
void trace(RayQuery<Flags, Second> query, RaytracingAccelerationStructure level, uint mask) {
  query.TraceRayInline(level, RAY_FLAG_NONE, mask, straight());
  query.Proceed();
  results.Store(0, query.CommittedStatus());
}

[shader("compute")]
[numthreads(1, 1, 1)]
void Plain() {
  RayQuery<RAY_FLAG_NONE> query;
  trace(query, scene, 0xFF);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void OtherMask() {
  RayQuery<RAY_FLAG_NONE> query;
  trace(query, scene, 2);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void SkipsTriangles() {
  RayQuery<RAY_FLAG_SKIP_TRIANGLES> query;
  trace(query, scene, 0xFF);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void AllowsClusters() {
  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY> query;
  trace(query, scene, 0xFF);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void AllowsMicromaps() {
  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS> query;
  trace(query, scene, 0xFF);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void AllowsBoth() {
  RayQuery<RAY_FLAG_NONE,
           RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS | RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY> query;
  trace(query, scene, 0xFF);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void FromArray() {
  RayQuery<RAY_FLAG_NONE> query;
  trace(query, many[1], 0xFF);
}

[shader("raygeneration")]
void PlainRayGen() {
  RayQuery<RAY_FLAG_NONE> query;
  trace(query, scene, 0xFF);
}
