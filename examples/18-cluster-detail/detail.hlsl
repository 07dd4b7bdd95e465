// SPDX-License-Identifier: MIT
// A field of tiles, each of which is there twice: as a cluster of many triangles and as one of few.
// Choose runs before the bottom level is built, and writes the arguments of its build.

static const uint kTiles = 16;             // along a side
static const float kFine = 7.0;            // how far from the camera tiles are fine,
static const float kFar = 15.0;            // and from where on they are left out
static const float3 kCamera = float3(0, 3.2, -7.5);

ByteAddressBuffer clusters : register(t0);       // addresses: all fine ones, then all coarse ones
RWByteAddressBuffer chosen : register(u0);       // the addresses of those that are used
RWByteAddressBuffer arguments : register(u1);    // RtasBuildBlasFromClasArgs
cbuffer Constants : register(b0) {
  uint2 chosenAddress;  // of `chosen`
};

float2 middle_of(uint tile) {
  return (float2(tile % kTiles, tile / kTiles) - 0.5 * float(kTiles) + 0.5) * float2(1.25, 1.25) +
         float2(0, 3);
}

[shader("compute")]
[numthreads(64, 1, 1)]
void Choose(uint tile : SV_DispatchThreadID) {
  if (tile == 0) arguments.Store3(4, uint3(0, chosenAddress));
  const float2 middle = middle_of(tile);
  const float distance = length(float3(middle.x, 0, middle.y) - kCamera);
  if (distance > kFar) return;
  uint place;
  arguments.InterlockedAdd(0, 1, place);  // ClasAddressCount
  const uint cluster = distance < kFine ? tile : kTiles * kTiles + tile;
  chosen.Store2(8 * place, clusters.Load2(8 * cluster));
}

RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);

struct [raypayload] Payload {
  float3 color : write(caller, closesthit, miss) : read(caller);
};

[shader("raygeneration")]
void RayGen() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 size = float2(DispatchRaysDimensions().xy);
  const float2 uv = (float2(pixel) + 0.5) / size * 2.0 - 1.0;
  RayDesc ray;
  ray.Origin = kCamera;
  ray.Direction = normalize(float3(uv.x * size.x / size.y, -uv.y - 0.55, 1.7));
  ray.TMin = 0.0;
  ray.TMax = 1000.0;
  Payload payload = { float3(0, 0, 0) };
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 0, 0, ray, payload);
  image[pixel] = float4(sqrt(payload.color), 1.0);
}

[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = lerp(float3(0.75, 0.8, 0.88), float3(0.25, 0.4, 0.7),
                       saturate(2.0 * WorldRayDirection().y + 0.7));
}

// A shade for each triangle, to show how many there are; warm where the tile is fine.
[shader("closesthit")]
void ClosestHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const BuiltInTrianglePositions at = TriangleObjectPositions();
  const float3 normal = normalize(cross(at.p1 - at.p0, at.p2 - at.p0));
  const float light = 0.25 + 0.75 * saturate(dot(normal, normalize(float3(-0.6, 0.7, -0.4))));
  const bool fine = ClusterID() < kTiles * kTiles;
  const float shade = 0.8 + 0.2 * frac(float(PrimitiveIndex()) * 0.618034);
  const float3 color = fine ? float3(0.85, 0.5, 0.2) : float3(0.25, 0.5, 0.6);
  payload.color = color * shade * light;
}
