// SPDX-License-Identifier: MIT
// Instance descs written by a shader, and which primitives an intersection shader was run for.
#include "standard.hlsl"

// A "ray" is 64 bytes, as an instance desc is.
[shader("raygeneration")]
void WriteInstances() {
  const uint i = DispatchRaysIndex().x;
  words.Store<Ray>(64 * i, rays[i]);
}

[shader("intersection")]
void NotePrimitive() {
  words.InterlockedOr(kIntersectionCounter, 1u << (8 * GeometryIndex() + PrimitiveIndex()));
}
