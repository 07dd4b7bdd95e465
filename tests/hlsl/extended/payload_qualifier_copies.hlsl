// SPDX-License-Identifier: MIT
// FEATURE: extended payload access qualifiers [raypayload]
// OPTIONS: -T lib_6_7 -no-warnings
// The any-hit shaders wrote this, the last one in a function that ignores the hit: 2 + 20.
// EXPECT u32 0 22
// A field that stays the caller's own, although the shaders write it.
// EXPECT u32 4 12
// Not returned, so undefined; 0 here.
// EXPECT u32 8 0
// The miss shader found this in the fields that it may and may not read, and wrote the last.
// EXPECT u32 12 10
// EXPECT f32 16 0 0 0
// EXPECT f32 28 4 5 6
// A bool in a nested payload struct.
// EXPECT u32 40 1
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);

struct [raypayload] Inner {
  bool missed : read(caller) : write(miss);
};
struct [raypayload] Payload {
  uint sent : read(anyhit, miss) : write(caller);
  uint counted : read(caller, anyhit, miss) : write(caller, anyhit);
  uint own : read(caller) : write(caller);
  float3 vectors[2] : read(caller) : write(miss);
  Inner inner;
};

void ignore(inout Payload p, uint by) {
  p.counted += by;
  p.own = 70;
  p.sent = 80;
  IgnoreHit();
  p.counted += 1000;
}

[shader("anyhit")]
void AnyHit(inout Payload p, BuiltInTriangleIntersectionAttributes a) {
  p.counted += 1;
  if (p.sent == 10) ignore(p, 10 * 1);
  p.counted += 1000;
}

[shader("closesthit")]
void Closest(inout Payload p, BuiltInTriangleIntersectionAttributes a) {
  p.counted = 5000;
}

[shader("miss")]
void Miss(inout Payload p) {
  results.Store(12, p.sent);
  results.Store3(16, asuint(p.vectors[1]));
  p.vectors[1] = float3(4, 5, 6);
  p.inner.missed = p.counted == 22;
  p.own = 90;
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(-3, 2, 0), 0, float3(0, 0, 1), 100};
  Payload p;
  p.sent = 10;
  p.counted = 0;
  p.own = 12;
  p.vectors[0] = 1;
  p.vectors[1] = 2;
  p.inner.missed = false;
  TraceRay(scene, 0, 0xff, 0, 0, 0, ray, p);
  results.Store(0, p.counted);
  results.Store(4, p.own);
  results.Store(8, p.sent);
  results.Store3(28, asuint(p.vectors[1]));
  results.Store(40, p.inner.missed ? 1 : 0);
}
