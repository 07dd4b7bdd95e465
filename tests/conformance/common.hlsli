// SPDX-License-Identifier: MIT
// This file holds what the rules' shaders share: rays in, words out, records with an ordinal each.

struct Ray {
  float3 origin;
  float tMin;
  float3 direction;
  float tMax;
  uint flags;
  uint mask;
  uint contribution;
  uint multiplier;
  uint miss;
  uint3 extra;
};

// The fate of a ray. `end`: 0 no shader ran after traversal, 1 closest hit, 2 miss.
struct Seen {
  uint end;
  uint record;     // of the closest-hit or miss shader
  uint anyHits;    // invocations
  uint anyRecord;  // of the last any-hit invocation
  uint boxRecord;  // of the intersection shader that reported the committed hit
  uint instanceIndex;
  uint instanceID;
  uint geometry;
  uint primitive;
  uint hitKind;
  uint flags;
  float t;
  float anyT;
  float2 barycentrics;
  uint closestHits;  // invocations
};

struct BoxAttributes {
  uint record;
  float t;
};

RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<Ray> rays : register(t1);
RWByteAddressBuffer words : register(u0);

// The local arguments of every record.
cbuffer Record : register(b0, space1) {
  uint ordinal;
  float reportedT;      // of intersection shaders
  uint reportedKind;
  uint unusedConstant;
};

static const uint kNothing = 0xFFFFFFFFu;
static const uint kIntersectionCounter = 32768;  // byte offset in `words`

Seen nothingSeen() {
  Seen seen = (Seen)0;
  seen.record = seen.anyRecord = seen.boxRecord = seen.geometry = seen.hitKind = kNothing;
  return seen;
}

RayDesc describe(Ray ray) {
  RayDesc desc;
  desc.Origin = ray.origin;
  desc.TMin = ray.tMin;
  desc.Direction = ray.direction;
  desc.TMax = ray.tMax;
  return desc;
}
