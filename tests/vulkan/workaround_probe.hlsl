// SPDX-License-Identifier: MIT
// Shaders for two workarounds that change no pixel: work only in the lower half of the picture
// (B11), and nested traces with a payload of 4 KiB (PAYLOAD).

RaytracingAccelerationStructure g_nothing : register(t0);
RWStructuredBuffer<uint> g_results : register(u0);
cbuffer Constants : register(b0) {
  uint g_count;  // steps of work per pixel, or traces
}

[shader("raygeneration")]
void WorkBelow() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const uint2 size = DispatchRaysDimensions().xy;
  const uint steps = 2 * pixel.y < size.y ? 0 : g_count;
  uint state = pixel.x;
  for (uint i = 0; i < steps; ++i) state = state * 747796405u + 2891336453u;
  g_results[pixel.y * size.x + pixel.x] = state;
}

struct LargePayload {
  uint traces;
  uint words[1023];
};

void TraceDeeper(inout LargePayload payload) {
  RayDesc ray;
  ray.Origin = float3(0, 0, 0);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, 1);
  ray.TMax = 1;
  TraceRay(g_nothing, RAY_FLAG_NONE, 0xFF, 0, 0, 0, ray, payload);
}

[shader("raygeneration")]
void Nest() {
  LargePayload payload;
  payload.traces = 1;
  payload.words[DispatchRaysIndex().x] = 7;
  TraceDeeper(payload);
  g_results[DispatchRaysIndex().x] = payload.traces + payload.words[DispatchRaysIndex().x];
}

[shader("miss")]
void NestDeeper(inout LargePayload payload) {
  if (payload.traces == g_count) return;
  LargePayload next = payload;
  ++next.traces;
  TraceDeeper(next);
  payload.traces = next.traces;
}
