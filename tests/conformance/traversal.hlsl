// SPDX-License-Identifier: MIT
// Any-hit shaders that keep a log and decide by a number that the ray carries; intersection shaders
// that report spheres, or whatever a script says.
#include "standard.hlsl"

// One any-hit invocation: its identity as packed by pack(), and RayTCurrent().
static const uint kEventsPerRay = 48;
static const uint kEvents = 65536;  // byte offset in `words`
// Byte in `words`: how often a ray's any-hit shaders overlapped or ran after its closest hit.
static const uint kFaults = 32772;
static const uint kGuards = 40960;  // a word per ray, set while one of its any-hit shaders runs

enum Mode : uint {
  kIgnoreAll,
  kAcceptAll,
  kAcceptSome,  // by hash
  kEndSome,     // accept, ignore, or accept and end
};

struct Box {
  float3 lower;
  float3 upper;
};
StructuredBuffer<Box> boxes : register(t2);

uint pack(uint kind) {
  return InstanceIndex() << 24 | GeometryIndex() << 20 | PrimitiveIndex() << 8 | kind;
}

uint decide(uint mode, uint seed, uint who) {
  uint h = seed ^ (who * 0x9E3779B1u);
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  h ^= h >> 15;
  if (mode == kIgnoreAll) return 0;
  if (mode == kAcceptAll) return 1;
  return h % (mode == kAcceptSome ? 2 : 3);  // ignore, accept, end
}

uint log(inout Seen seen) {
  const uint ray = DispatchRaysIndex().x;
  const uint who = pack(HitKind());
  if (seen.anyHits < kEventsPerRay) {
    words.Store2(kEvents + 8 * (ray * kEventsPerRay + seen.anyHits),
                 uint2(who, asuint(RayTCurrent())));
  }
  if (words.Load(kGuards + 4 * ray) != 0 || seen.end != 0) words.InterlockedAdd(kFaults, 1u);
  words.Store(kGuards + 4 * ray, 1);
  noteCandidate(seen);
  const uint decision = decide(rays[ray].extra.x, rays[ray].extra.y, who);
  words.Store(kGuards + 4 * ray, 0);
  return decision;
}

[shader("anyhit")]
void Walk(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  const uint decision = log(seen);
  if (decision == 0) IgnoreHit();
  if (decision == 2) AcceptHitAndEndSearch();
}

[shader("anyhit")]
void BoxWalk(inout Seen seen, BoxAttributes attributes) {
  const uint decision = log(seen);
  if (decision == 0) IgnoreHit();
  if (decision == 2) AcceptHitAndEndSearch();
}

void report(float t, uint kind) {
  BoxAttributes attributes;
  attributes.record = PrimitiveIndex() << 8 | kind;
  attributes.t = t;
  ReportHit(t, kind, attributes);
}

// Reports the sphere inside the box where the ray enters it (kind 1) and leaves it (kind 2); odd
// primitives report in the other order. The record says where its geometry's boxes begin.
[shader("intersection")]
void Sphere() {
  const Box box = boxes[reportedKind + PrimitiveIndex()];
  const float3 extent = 0.5 * (box.upper - box.lower);
  const float radius = min(extent.x, min(extent.y, extent.z));
  const float3 d = ObjectRayDirection();
  const float3 toCentre = 0.5 * (box.lower + box.upper) - ObjectRayOrigin();
  const float along = dot(toCentre, d) / dot(d, d);
  const float3 aside = toCentre - along * d;
  const float rest = radius * radius - dot(aside, aside);
  if (rest < 0) return;
  const float reach = sqrt(rest / dot(d, d));
  if (PrimitiveIndex() % 2 == 0) {
    report(along - reach, 1);
    report(along + reach, 2);
  } else {
    report(along + reach, 2);
    report(along - reach, 1);
  }
}

// A report of Script. The ray's extra.x is the first one, extra.y their number.
struct Report {
  float t;
  uint kind;
  uint value;     // passed through the attributes
  uint decision;  // as returned by decide()
};
StructuredBuffer<Report> script : register(t3);

// For each report {RayTCurrent() before, 1 if accepted or 2, RayTCurrent() after, RayTMin()}; all 0
// if it did not return. One word per ray says that Script reached its end.
static const uint kScriptEnds = 49152;

[shader("intersection")]
void Script() {
  const uint ray = DispatchRaysIndex().x;
  const uint first = rays[ray].extra.x;
  for (uint i = 0; i < rays[ray].extra.y; ++i) {
    const Report report = script[first + i];
    const uint at = kEvents + 16 * (first + i);
    BoxAttributes attributes;
    attributes.record = report.value;
    attributes.t = asfloat(report.decision);
    words.Store(at, asuint(RayTCurrent()));
    const bool accepted = ReportHit(report.t, report.kind, attributes);
    words.Store3(at + 4, uint3(accepted ? 1 : 2, asuint(RayTCurrent()), asuint(RayTMin())));
  }
  words.Store(kScriptEnds + 4 * ray, 1);
}

[shader("anyhit")]
void ScriptAny(inout Seen seen, BoxAttributes attributes) {
  noteCandidate(seen);
  const uint decision = asuint(attributes.t);
  if (decision == 0) {
    IgnoreHit();
    seen.anyHits += 1000;  // must not run
  }
  if (decision == 2) {
    AcceptHitAndEndSearch();
    seen.anyHits += 1000;
  }
}

// Counts the any-hit shaders that ran, in one word per ray from kEvents on.
[shader("raygeneration")]
void CountCandidates() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  Seen seen = nothingSeen();
  TraceRay(scene, ray.flags, ray.mask, ray.contribution, ray.multiplier, ray.miss, describe(ray),
           seen);
  words.Store(kEvents + 4 * i, seen.anyHits);
}

// Accepts a hit if an inline query finds another instance (mask 2) that shadows it from +x.
[shader("anyhit")]
void Shadowed(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  const float before = RayTCurrent();
  RayDesc ray;
  ray.Origin = WorldRayOrigin() + before * WorldRayDirection();
  ray.TMin = 0.01;
  ray.Direction = float3(1, 0, 0);
  ray.TMax = 1000;
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 2, ray);
  query.Proceed();
  noteCandidate(seen);
  if (RayTCurrent() != before || WorldRayDirection().z != 1) words.InterlockedAdd(kFaults, 1u);
  if (query.CommittedStatus() != COMMITTED_TRIANGLE_HIT) IgnoreHit();
}

// Four traces with one payload, then four calls; other live values must survive.
struct Sum {
  uint value;
};

[shader("raygeneration")]
void Straight() {
  Seen seen = nothingSeen();
  const Seen untouched = seen;
  uint local = 5;
  for (uint i = 0; i < 4; ++i) {
    TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
    local = local * 3 + seen.closestHits;
  }
  Sum sums[2] = {{1}, {1000}};
  for (uint k = 0; k < 4; ++k) CallShader(0, sums[k % 2]);
  words.Store4(0, uint4(seen.closestHits, untouched.closestHits, local, sums[0].value));
  words.Store(16, sums[1].value);
}

[shader("callable")]
void AddTen(inout Sum sum) {
  sum.value += 10;
}

globallycoherent RWByteAddressBuffer board : register(u1);

// Passes a word from caller to callee and one back.
[shader("raygeneration")]
void WriteBoard() {
  const uint at = 16 * DispatchRaysIndex().x;
  board.Store(at, 41 + at);
  DeviceMemoryBarrier();
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
  words.Store2(8 * DispatchRaysIndex().x, uint2(seen.record, board.Load(at + 4)));
}

[shader("closesthit")]
void AnswerBoard(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  const uint at = 16 * DispatchRaysIndex().x;
  seen.record = board.Load(at);
  board.Store(at + 4, 77 + at);
  DeviceMemoryBarrier();
}

// Stores what the query sees of the scene, and what TraceRay does.
[shader("raygeneration")]
void QueryAndTrace() {
  RayQuery<RAY_FLAG_FORCE_OPAQUE> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xFF, describe(rays[0]));
  query.Proceed();
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
  words.Store3(0, uint3(query.CommittedStatus(), asuint(query.CommittedRayT()), seen.end));
}

[shader("raygeneration")]
void QueryWithSkip() {
  RayQuery<RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER> fixed;
  fixed.TraceRayInline(scene, RAY_FLAG_NONE, 0xFF, describe(rays[0]));
  fixed.Proceed();
  RayQuery<RAY_FLAG_FORCE_OPAQUE> dynamic;
  dynamic.TraceRayInline(scene, RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 0xFF, describe(rays[0]));
  dynamic.Proceed();
  words.Store2(0, uint2(fixed.CommittedStatus(), dynamic.CommittedStatus()));
}

// A bit for each property that this thread's wave violates.
uint waveFaults(uint x) {
  const uint lane = WaveGetLaneIndex();
  const uint4 ballot = WaveActiveBallot(true);
  uint faults = 0;
  if (lane >= WaveGetLaneCount()) faults |= 1;
  if (WaveActiveSum(1u) != WaveActiveCountBits(true)) faults |= 2;
  if ((ballot[lane / 32] >> (lane % 32) & 1) == 0) faults |= 4;
  if (WavePrefixCountBits(true) >= WaveActiveCountBits(true)) faults |= 8;
  if (WaveReadLaneAt(x, lane) != x) faults |= 16;
  if (WaveActiveMin(x) > x || WaveActiveMax(x) < x) faults |= 32;
  if (!WaveActiveAnyTrue(true) || WaveActiveAllTrue(false)) faults |= 64;
  if (WaveIsFirstLane() != (WavePrefixSum(1u) == 0)) faults |= 128;
  if (any(WaveActiveSum(float2(0, 0)) != 0) || WavePrefixProduct(1.0) != 1) faults |= 256;
  if (!all(WaveActiveAllEqual(int3(7, 8, 9)))) faults |= 512;
  if (WaveIsFirstLane() && WaveReadLaneFirst(x) != x) faults |= 1024;
  if ((WaveActiveBitOr(x) & x) != x || (WaveActiveBitAnd(x) & ~x) != 0) faults |= 2048;
  return faults;
}

// Before and after a trace, where an implementation may regroup waves.
[shader("raygeneration")]
void Waves() {
  const uint x = DispatchRaysIndex().x;
  uint faults = waveFaults(x);
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
  faults |= waveFaults(x) | seen.record;
  words.Store2(8 * x, uint2(faults, WaveGetLaneCount()));
}

[shader("closesthit")]
void WavesInHit(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  seen.record = waveFaults(DispatchRaysIndex().x);
}
