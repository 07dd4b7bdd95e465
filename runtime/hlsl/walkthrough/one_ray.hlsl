// SPDX-License-Identifier: MIT
struct Payload { float distance; };
RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float> distances : register(u0);

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const RayDesc ray = {float3(pixel, 0), 0, float3(0, 0, 1), 100};
  Payload payload = {0};
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  distances[pixel] = payload.distance;
}

[shader("miss")]
void Miss(inout Payload payload) { payload.distance = RayTCurrent(); }
