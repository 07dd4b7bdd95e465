// SPDX-License-Identifier: MIT
// OPTIONS: -T lib_6_9 -disable-payload-qualifiers
// Hit objects. The first half is standard.hlsl with HitObject::TraceRay and Invoke instead of
// TraceRay.
#define THROUGH_HIT_OBJECTS
#include "standard.hlsl"

// What an object's getters give.
struct Object {
  uint isNop;
  uint isHit;
  uint isMiss;
  uint flags;
  float tMin;
  float t;
  float3 worldOrigin;
  float3 worldDirection;
  float3 objectOrigin;
  float3 objectDirection;
  float3x4 toWorld;
  float3x4 toObject;
  uint transposed;  // whether the 4x3 forms are the transposed 3x4 forms
  uint geometry;
  uint instanceIndex;
  uint instanceID;
  uint primitive;
  uint hitKind;
  uint record;
  float2 attributes;
  uint constants[2];  // of the local root table, at bytes 0 and 4
};

Object describeObject(dx::HitObject hit) {
  Object o = (Object)0;
  o.isNop = hit.IsNop();
  o.isHit = hit.IsHit();
  o.isMiss = hit.IsMiss();
  o.flags = hit.GetRayFlags();
  o.tMin = hit.GetRayTMin();
  o.t = hit.GetRayTCurrent();
  o.worldOrigin = hit.GetWorldRayOrigin();
  o.worldDirection = hit.GetWorldRayDirection();
  o.objectOrigin = hit.GetObjectRayOrigin();
  o.objectDirection = hit.GetObjectRayDirection();
  o.toWorld = hit.GetObjectToWorld3x4();
  o.toObject = hit.GetWorldToObject3x4();
  o.transposed = all(hit.GetObjectToWorld4x3() == transpose(o.toWorld)) &&
                 all(hit.GetWorldToObject4x3() == transpose(o.toObject));
  o.geometry = hit.GetGeometryIndex();
  o.instanceIndex = hit.GetInstanceIndex();
  o.instanceID = hit.GetInstanceID();
  o.primitive = hit.GetPrimitiveIndex();
  o.hitKind = hit.GetHitKind();
  o.record = hit.GetShaderTableIndex();
  BuiltInTriangleIntersectionAttributes attributes;
  hit.GetAttributes(attributes);
  o.attributes = attributes.barycentrics;
  o.constants[0] = hit.LoadLocalRootTableConstant(0);
  o.constants[1] = hit.LoadLocalRootTableConstant(4);
  return o;
}

dx::HitObject traced(Ray ray, inout Seen seen) {
  return dx::HitObject::TraceRay(scene, ray.flags, ray.mask, ray.contribution, ray.multiplier,
                                 ray.miss, describe(ray), seen);
}

// Ray.extra.x says which object, extra.y what is done with it first, extra.z an argument of that.
static const uint kTraced = 0;
static const uint kMakeMiss = 1;
static const uint kMakeNop = 2;
static const uint kNoValue = 3;
static const uint kOfQuery = 4;         // committed: the nearest triangle or box, at its middle
static const uint kOfQueryNothing = 5;  // with a box's kind and attributes in all of these
static const uint kOfQueryKind = 6;

static const uint kKeep = 0;
static const uint kSetIndex = 1;
static const uint kSetIndexOfCopy = 2;
static const uint kInvoke = 3;
static const uint kInvokeTwice = 4;

dx::HitObject ofQuery(Ray ray, bool with_kind) {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, ray.flags, ray.mask, describe(ray));
  while (query.Proceed()) {
    if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
      query.CommitNonOpaqueTriangleHit();
    } else {
      query.CommitProceduralPrimitiveHit(5);
    }
  }
  BoxAttributes attributes;
  attributes.record = asuint(0.25f);
  attributes.t = 0.75f;
  if (with_kind) return dx::HitObject::FromRayQuery(query, 17, attributes);
  return dx::HitObject::FromRayQuery(query);
}

dx::HitObject chosen(Ray ray, inout Seen seen) {
  switch (ray.extra.x) {
    case kMakeMiss:
      return dx::HitObject::MakeMiss(ray.flags, ray.miss, describe(ray));
    case kMakeNop:
      return dx::HitObject::MakeNop();
    case kNoValue: {
      dx::HitObject several[2];
      return several[1];
    }
    case kOfQuery:
      return ofQuery(ray, false);
    case kOfQueryKind:
      return ofQuery(ray, true);
  }
  return traced(ray, seen);
}

// A Seen at 512 * i, an Object after it.
[shader("raygeneration")]
void Objects() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  Seen seen = nothingSeen();
  dx::HitObject hit = chosen(ray, seen);
  if (ray.extra.y == kSetIndex) hit.SetShaderTableIndex(ray.extra.z);
  if (ray.extra.y == kSetIndexOfCopy) {
    dx::HitObject copy = hit;
    copy.SetShaderTableIndex(ray.extra.z);
  }
  if (ray.extra.y >= kInvoke || (ray.extra.y == kSetIndex && ray.extra.z >= 0x100)) {
    dx::HitObject::Invoke(hit, seen);
  }
  if (ray.extra.y == kInvokeTwice) dx::HitObject::Invoke(hit, seen);
  words.Store<Seen>(512 * i, seen);
  words.Store<Object>(512 * i + 64, describeObject(hit));
}

// The index of the record is set to Ray.extra.z, then what it names is invoked.
[shader("raygeneration")]
void Rebound() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  Seen seen = nothingSeen();
  dx::HitObject hit = chosen(ray, seen);
  hit.SetShaderTableIndex(ray.extra.z);
  dx::HitObject::Invoke(hit, seen);
  words.Store<Seen>(512 * i, seen);
  words.Store<Object>(512 * i + 64, describeObject(hit));
}

// Three objects live at once, and the last one is invoked first.
[shader("raygeneration")]
void Together() {
  dx::HitObject hits[3];
  Seen seen[3];
  for (uint i = 0; i < 3; ++i) {
    seen[i] = nothingSeen();
    hits[i] = traced(rays[i], seen[i]);
  }
  for (uint k = 3; k > 0; --k) {
    dx::MaybeReorderThread(hits[k - 1], k, 2);
    dx::HitObject::Invoke(hits[k - 1], seen[k - 1]);
  }
  for (uint j = 0; j < 3; ++j) {
    words.Store<Seen>(512 * j, seen[j]);
    words.Store<Object>(512 * j + 64, describeObject(hits[j]));
  }
}

// Objects as values: parameters of every kind, results, members.
struct Holder {
  dx::HitObject hit;
  uint number;
};

Holder hold(dx::HitObject hit, out dx::HitObject other, inout dx::HitObject changed) {
  Holder holder;
  holder.hit = hit;
  holder.number = 7;
  other = hit;
  changed.SetShaderTableIndex(3);
  return holder;
}

[shader("raygeneration")]
void Values() {
  Seen seen = nothingSeen();
  dx::HitObject first = traced(rays[0], seen);
  dx::HitObject second;
  dx::HitObject changed = first;
  const Holder holder = hold(first, second, changed);
  dx::HitObject never;
  words.Store(0, first.GetShaderTableIndex());
  words.Store(4, holder.hit.GetShaderTableIndex());
  words.Store(8, second.GetShaderTableIndex());
  words.Store(12, changed.GetShaderTableIndex());
  words.Store(16, holder.number);
  words.Store(20, uint(never.IsNop()));
  dx::HitObject::Invoke(dx::HitObject(), seen);
  words.Store(24, seen.end);
}

// Any-hit shaders with a payload of 4 bytes, the closest-hit and miss shaders with another one.
struct Small {
  uint anyHits;
};

[shader("anyhit")]
void CountSmall(inout Small small, BuiltInTriangleIntersectionAttributes attributes) {
  ++small.anyHits;
}

[shader("raygeneration")]
void TwoPayloads() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  Small small;
  small.anyHits = 40;
  const dx::HitObject hit =
      dx::HitObject::TraceRay(scene, ray.flags, ray.mask, ray.contribution, ray.multiplier,
                              ray.miss, describe(ray), small);
  Seen seen = nothingSeen();
  seen.anyHits = small.anyHits;
  dx::HitObject::Invoke(hit, seen);
  words.Store<Seen>(64 * i, seen);
}

// Reordering in a loop and in branches; the index stays that of the thread.
[shader("raygeneration")]
void Reordered() {
  const uint i = DispatchRaysIndex().x;
  uint sum = 0;
  for (uint bounce = 0; bounce < 8; ++bounce) {
    if ((i + bounce) % 3 == 0) {
      dx::MaybeReorderThread(i, bounce * 9);  // more bits than there are
    } else if (i & 1) {
      Seen seen = nothingSeen();
      const dx::HitObject hit = traced(rays[i % 2], seen);
      dx::MaybeReorderThread(hit, bounce, 3);
      dx::HitObject::Invoke(hit, seen);
      sum += seen.end;
    }
    sum += 100 * (DispatchRaysIndex().x == i);
  }
  words.Store(4 * i, sum);
}

// The object is only reordered by, with the record Ray.extra.z if Ray.extra.y is kSetIndex.
[shader("raygeneration")]
void OnlyReordered() {
  const Ray ray = rays[0];
  Seen seen = nothingSeen();
  dx::HitObject hit = chosen(ray, seen);
  if (ray.extra.y == kSetIndex) hit.SetShaderTableIndex(ray.extra.z);
  dx::MaybeReorderThread(hit);
  words.Store<Seen>(0, seen);
}

// Closest-hit shaders that trace once more, by Ray.extra.x: 1 HitObject::TraceRay, 2 and Invoke,
// 3 Invoke of a miss.
[shader("closesthit")]
void NestedClosest(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  noteHit(seen);
  Ray ray = rays[0];
  Seen inner = nothingSeen();
  if (ray.extra.x == 3) {
    dx::HitObject::Invoke(dx::HitObject::MakeMiss(0, 0, describe(ray)), inner);
  } else {
    ray.tMin = seen.t + 1;
    const dx::HitObject hit = traced(ray, inner);
    if (ray.extra.x == 2) dx::HitObject::Invoke(hit, inner);
    seen.primitive = hit.IsMiss();
  }
  seen.geometry = inner.end;
}

// Memory that a thread writes before it moves.
reordercoherent RWByteAddressBuffer moved : register(u1);

[shader("raygeneration")]
void WritesAndMoves() {
  const uint i = DispatchRaysIndex().x;
  moved.Store(4 * i, i + 1);
  Barrier(moved, REORDER_SCOPE);
  dx::MaybeReorderThread(i, 4);
  const uint first = moved.Load(4 * i);
  moved.Store(4 * i, first + 10);
  Barrier(UAV_MEMORY, REORDER_SCOPE);
  dx::MaybeReorderThread(~i, 4);
  words.Store(4 * i, moved.Load(4 * i));
}
