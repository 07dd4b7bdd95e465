// SPDX-License-Identifier: MIT
// Root arguments of every kind, local and global.
#include "standard.hlsl"

// {one constant, SRV, three constants, table}: the worked example of record layout.
cbuffer First : register(b1, space1) {
  uint first;
}
ByteAddressBuffer second : register(t2, space1);
cbuffer Third : register(b2, space1) {
  uint3 third;
}
ByteAddressBuffer fourth : register(t3, space1);

[shader("raygeneration")]
void ReadExample() {
  words.Store(0, first);
  words.Store(4, second.Load(0));
  words.Store3(8, third);
  words.Store(20, fourth.Load(0));
}

[shader("raygeneration")]
void ReadConstants() {
  words.Store(0, first);
  words.Store3(4, third);
}

[shader("miss")]
void MissReads(inout Seen seen) {
  seen.end = 2;
  seen.record = first;
  seen.primitive = second.Load(0);
}

[shader("closesthit")]
void ClosestBare(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  seen.end = 1;
  seen.record = 999;
}

[shader("closesthit")]
void ClosestWide(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  seen.end = 1;
  seen.record = second.Load(0) + third.z;
}

[shader("raygeneration")]
void OrdinalAroundTrace() {
  const uint before = ordinal;
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
  words.Store(0, before);
  words.Store(4, seen.record);
  words.Store(8, ordinal);
}

// One set of compute root arguments, which both kinds of work read.
cbuffer Shared : register(b0, space2) {
  uint place;
  uint value;
}
ByteAddressBuffer common : register(t0, space2);

[shader("compute")]
[numthreads(1, 1, 1)]
void ComputeShared() {
  words.Store(4 * place, value + common.Load(0));
}

[shader("raygeneration")]
void RaysShared() {
  words.Store(4 * place + 4, value + common.Load(0) + 1);
}

RaytracingAccelerationStructure inTable : register(t1, space2);
RaytracingAccelerationStructure inArray[] : register(t0, space3);

[shader("raygeneration")]
void TraceBound() {
  for (uint i = 0; i < 4; ++i) {
    Seen seen = nothingSeen();
    if (i == 0) TraceRay(scene, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
    if (i == 1) TraceRay(inTable, 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
    if (i >= 2) TraceRay(inArray[i - 2], 0, 0xFF, 0, 0, 0, describe(rays[0]), seen);
    words.Store<Seen>(64 * i, seen);
  }
}

// Functions that are themselves exports of the library.
export uint firstOfRecord() {
  return first;
}
export uint twiceFirst() {
  return 2 * firstOfRecord();
}

[shader("raygeneration")]
void CallsFunctions() {
  words.Store(0, twiceFirst());
}
