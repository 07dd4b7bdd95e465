// SPDX-License-Identifier: MIT
// FEATURE: core RayDesc
// EXPECT f32 0 21.0
// EXPECT u32 4 32
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  RayDesc ray;
  ray.Origin = float3(1, 2, 3) + z;
  ray.TMin = 4;
  ray.Direction = float3(5, 6, 7);
  ray.TMax = 8;
  RayDesc other = ray;
  results.Store(0, asuint(other.Origin.y + other.TMin + other.Direction.z + other.TMax));
  results.Store(4, sizeof(RayDesc));
}
