// SPDX-License-Identifier: MIT
// Rays whose shader table indices are constants: what they can reach is known before the dispatch.
#include "common.hlsli"

[shader("raygeneration")]
void One() {
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 1, 0, describe(rays[0]), seen);
  words.Store<Seen>(0, seen);
}

[shader("miss")]
void Sky(inout Seen seen) { seen.end = 2; }

// Traces again, and again.
[shader("closesthit")]
void Deeper(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  Seen inner = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 1, 0, describe(rays[0]), inner);
  seen.end = 1;
}

[shader("closesthit")]
void Floor(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  seen.end = 1;
  seen.record = ordinal;
}

[shader("intersection")]
void Front() {
  BuiltInTriangleIntersectionAttributes attributes;
  attributes.barycentrics = float2(0, 0);
  ReportHit(1.0, 0, attributes);
}
