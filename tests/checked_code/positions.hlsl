// SPDX-License-Identifier: MIT
// What shader model 6.10 leaves undefined: positions of what is no triangle, and of a bottom level
// that does not allow it; and a DebugBreak.
// OPTIONS: -enable-experimental -T lib_6_10

RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer result : register(u0);

RayDesc ray_at(float x) {
  RayDesc ray = {float3(x, 0, -1), 0, float3(0, 0, 1), 10};
  return ray;
}

void write_position(float x) {
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, 0, 0xFF, ray_at(x));
  query.Proceed();
  result.Store3(0, asuint(query.CommittedTriangleObjectPositions().p1));
}

[shader("compute")] [numthreads(1, 1, 1)]
void Hit() {
  write_position(0);
}

[shader("compute")] [numthreads(1, 1, 1)]
void Missed() {
  write_position(100);
}

[shader("compute")] [numthreads(1, 1, 1)]
void Break() {
  result.Store(0, dx::IsDebuggingEnabled() ? 1 : 2);
  if (result.Load(0) == 2) DebugBreak();  // BREAK HERE
}
