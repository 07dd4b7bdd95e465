// SPDX-License-Identifier: MIT
//
// The any-hit shader of hit groups that have none, in pipelines that allow opacity micromaps: what
// every any-hit shader does first decides what is transparent (runtime/hlsl/glsl/micromaps.cpp), and
// the rest is hit.

struct Payload {
  uint first;  // of whatever the ray carries
};

[shader("anyhit")]
void MicromapAnyHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
}
