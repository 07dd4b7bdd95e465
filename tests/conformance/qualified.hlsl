// SPDX-License-Identifier: MIT
// Payload access qualifiers, in lib_6_7, where DXC takes no payload without them.
#include "common.hlsli"

#ifdef ENABLED_IN_6_6
#define QUALIFIED(name) name##66
#else
#define QUALIFIED(name) name
#endif

struct [raypayload] Inner {
  uint toMiss : write(caller) : read(miss);
  uint answer : write(closesthit, miss) : read(caller);
};

struct [raypayload] Qualified {
  uint toStages : write(caller) : read(closesthit, miss, anyhit);
  uint answer : write(closesthit, miss) : read(caller);
  uint kept : write(caller) : read(caller);
  uint everywhere : write(caller, closesthit, miss, anyhit) : read(caller, closesthit, miss, anyhit);
  uint ofAnyHit : write(caller, anyhit) : read(caller);
  uint list[3] : write(anyhit) : read(closesthit, miss);
  uint none : write() : read();
  Inner inner;
};

static const uint kSeenByShader = 256;  // byte offsets in `words`
static const uint kSeenAfter = 512;
static const uint kSeenWhenNested = 768;

Qualified numbered(uint first) {
  Qualified q;
  q.toStages = first;
  q.answer = first + 1;
  q.kept = first + 2;
  q.everywhere = first + 3;
  q.ofAnyHit = first + 4;
  q.list[0] = first + 5;
  q.list[1] = first + 6;
  q.list[2] = first + 7;
  q.none = first + 8;
  q.inner.toMiss = first + 9;
  q.inner.answer = first + 10;
  return q;
}

void note(uint offset, Qualified q) {
  words.Store4(offset, uint4(q.toStages, q.answer, q.kept, q.everywhere));
  words.Store4(offset + 16, uint4(q.ofAnyHit, q.list[0], q.list[1], q.list[2]));
  words.Store3(offset + 32, uint3(q.none, q.inner.toMiss, q.inner.answer));
}

// Hit record 0 and miss record 0 have qualified payloads.
[shader("raygeneration")]
void QUALIFIED(TraceQualified)() {
  const Ray ray = rays[0];
  Qualified q = numbered(10);
  TraceRay(scene, ray.flags, ray.mask, ray.contribution, 0, 0, describe(ray), q);
  note(kSeenAfter, q);
}

[shader("closesthit")]
void QUALIFIED(ClosestQualified)(inout Qualified q,
                                 BuiltInTriangleIntersectionAttributes attributes) {
  note(kSeenByShader, q);
  q = numbered(100);
}

[shader("closesthit")]
void QUALIFIED(ClosestIdle)(inout Qualified q, BuiltInTriangleIntersectionAttributes attributes) {}

// Passes its own payload to a second trace, then traces with a new one.
[shader("closesthit")]
void QUALIFIED(ClosestNested)(inout Qualified q, BuiltInTriangleIntersectionAttributes attributes) {
  RayDesc ray;
  ray.Origin = float3(0, 0, -5);
  ray.TMin = 0;
  ray.Direction = float3(0, 0, -1);
  ray.TMax = 1000;
  q.kept = 500;
  TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, q);
  words.Store(kSeenWhenNested, q.kept);
  Qualified other = numbered(600);
  TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, other);
  q.answer += other.answer;
}

[shader("miss")]
void QUALIFIED(MissQualified)(inout Qualified q) {
  note(kSeenByShader, q);
  q = numbered(200);
}

// Record 0 chooses: 1 writes nothing, 2 writes, 3 writes and ignores the hit, 4 writes and ends the
// search, 5 does the same from a function.
void endFrom(inout Qualified q) {
  q.everywhere += 7;
  AcceptHitAndEndSearch();
}

[shader("anyhit")]
void QUALIFIED(AnyQualified)(inout Qualified q, BuiltInTriangleIntersectionAttributes attributes) {
  if (ordinal == 1) return;
  q.toStages = 300;
  q.kept = 302;
  q.everywhere += 1;
  q.ofAnyHit = 304;
  q.list[1] = 306;
  if (ordinal == 3) IgnoreHit();
  if (ordinal == 4) AcceptHitAndEndSearch();
  if (ordinal == 5) endFrom(q);
}
