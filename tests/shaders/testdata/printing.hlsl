// SPDX-License-Identifier: MIT
// Prints in every stage. printing_test.cpp has the lines that must come.
RaytracingAccelerationStructure scene : register(t0);

struct Payload {
  float t;
};
struct Attributes {
  float2 at;
};

[shader("compute")]
[numthreads(4, 2, 1)]
void Threads(uint3 id : SV_DispatchThreadID) {
  if (id.x != 1) printf("x %u y %d", id.x, int(id.y) - 1);
  if (id.x == 3) printf("last");
}

// Values of every type and conversion.
[shader("compute")]
[numthreads(1, 1, 1)]
void Values(uint zero : SV_GroupIndex) {
  const int minus = int(zero) - 5;
  printf("%d %i %u %x %X %o %c", minus, minus, 42u + zero, 0xBEEFu + zero, 0xBEEFu, 8u, 65u);
  printf("%5.2f|%-8.3e|%g|%.0f%%", 3.14159 + zero, 12345.678, 0.1f, 2.5);
  printf("%v3f %v2d %v4u", float3(1, 2.5, -3), int2(minus, 7), uint4(1, 2, 3, 4));
  printf("%s and %s: %v", "text with %d", "more", true);
  printf("%v %v %v", float2x3(1, 2, 3, 4, 5, 6), 0.1f, bool2(true, false));
  printf("%lu %ld %v", 0xFFFFFFFFFFull + zero, -1099511627776ll - zero, 1.0l / 3.0l);
  printf("%v %f", half3(1, 2, 0.5), min16float(0.25));
  errorf("NaN %v and %v, infinity %v", asfloat(0x7FC00000u + zero), -asfloat(0x7FC00000u + zero),
         1.0 / float(zero));
}

// Eight threads at once on the CPU.
[shader("raygeneration")]
void Rows() {
  const uint x = DispatchRaysIndex().x;
  float sum = 0;
  for (uint i = 0; i < x; ++i) sum += sqrt(float(i));
  if ((x & 1) == 1) printf("row %u: %.3f", x, sum);
}

[shader("raygeneration")]
void Rays() {
  RayDesc ray = {float3(0, 0, -1), 0, float3(0, 0, 1), 10};
  Payload payload = {0};
  printf("before");
  TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, payload);
  ray.Origin.x = DispatchRaysIndex().x == 0 ? 4 : 100;
  TraceRay(scene, 0, 0xFF, 1, 0, 0, ray, payload);
  CallShader(0, payload);
  printf("after %v", payload.t);
}
[shader("anyhit")]
void AnyHit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  printf("any hit of %u", InstanceID());
}
[shader("closesthit")]
void ClosestHit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  printf("closest hit at %v", RayTCurrent());
}
[shader("intersection")]
void Intersection() {
  printf("box %u", PrimitiveIndex());
  Attributes attributes = {float2(0, 0)};
  ReportHit(2.5, 0, attributes);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  printf("box hit at %v", RayTCurrent());
}
[shader("miss")]
void Miss(inout Payload payload) {
  printf("miss");
}
[shader("callable")]
void Callable(inout Payload payload) {
  payload.t = 7;
  printf("callable");
}
TriangleHitGroup Triangles = {"AnyHit", "ClosestHit"};
ProceduralPrimitiveHitGroup Boxes = {"", "BoxHit", "Intersection"};
RaytracingShaderConfig shader_config = {4, 8};
RaytracingPipelineConfig pipeline_config = {1};

[shader("vertex")]
float4 Vertex(uint vertex : SV_VertexID) : SV_Position {
  if (vertex == 2) printf("vertex");
  return float4(vertex == 1 ? 3.0 : -1.0, vertex == 2 ? -3.0 : 1.0, 0.5, 1.0);
}
// Its position is no input.
[shader("pixel")]
float4 Pixel() : SV_Target {
  printf("pixel");
  return 1;
}
// Helpers print nothing, and discarded pixels nothing after they are.
[shader("pixel")]
float4 Discards(float4 position : SV_Position) : SV_Target {
  if (position.x < 2) discard;
  printf("kept at %v2f, %v", position.xy, ddx(position.x));
  return 1;
}

// More than the buffer holds: 32 bytes a record.
[shader("compute")]
[numthreads(64, 1, 1)]
void Many(uint3 id : SV_DispatchThreadID) {
  printf("%u", id.x);
  printf("%u", id.x + 1000000);
}
