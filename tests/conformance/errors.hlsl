// SPDX-License-Identifier: MIT
// Rays with constant shader table indices, so what they can reach is known before the dispatch.
#include "common.hlsli"

[shader("raygeneration")]
void One() {
  Seen seen = nothingSeen();
  TraceRay(scene, 0, 0xFF, 0, 1, 0, describe(rays[0]), seen);
  words.Store<Seen>(0, seen);
}

[shader("miss")]
void Sky(inout Seen seen) { seen.end = 2; }

// Traces again and again.
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

// Reports a hit kind that the record chooses.
[shader("intersection")]
void Reports() {
  BuiltInTriangleIntersectionAttributes attributes;
  attributes.barycentrics = float2(0, 0);
  ReportHit(reportedT, reportedKind, attributes);
}

// Traces one ray with a query that commits boxes at `extra.x`.
[shader("raygeneration")]
void Commits() {
  RayQuery<RAY_FLAG_SKIP_TRIANGLES> query;
  query.TraceRayInline(scene, 0, 0xFF, describe(rays[0]));
  while (query.Proceed()) {
    query.CommitProceduralPrimitiveHit(asfloat(rays[0].extra.x));
  }
  words.Store(0, query.CommittedStatus());
}

struct Other {
  float4 color;
};

[shader("miss")]
void OtherSky(inout Other other) { other.color = float4(0, 0, 1, 1); }

struct Numbers {
  uint first;
  uint second;
};
struct Number {
  uint only;
};

[shader("raygeneration")]
void Calls() {
  Numbers numbers = {1, 2};
  CallShader(0, numbers);
  words.Store(0, numbers.first);
}

[shader("callable")]
void Takes(inout Numbers numbers) { numbers.first += numbers.second; }

[shader("callable")]
void TakesOne(inout Number number) { number.only += 1; }
