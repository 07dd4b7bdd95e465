// SPDX-License-Identifier: MIT
// Instance descs written by a shader; which primitives an intersection shader ran for.
#include "standard.hlsl"

// A "ray" has 64 bytes here, like an instance desc.
[shader("raygeneration")]
void WriteInstances() {
  const uint i = DispatchRaysIndex().x;
  words.Store<Ray>(64 * i, rays[i]);
}

[shader("intersection")]
void NotePrimitive() {
  words.InterlockedOr(kIntersectionCounter, 1u << (8 * GeometryIndex() + PrimitiveIndex()));
}
