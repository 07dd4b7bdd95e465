// SPDX-License-Identifier: MIT
// FEATURE: extended waves in ray tracing shaders
// Each thread is a wave of one lane.
// DISPATCH: 2 1 1
// EXPECT u32 0 1 0 1 5
// EXPECT u32 16 5 0 1 1
// EXPECT u32 32 0 5 5 1
// EXPECT u32 48 0 1 0 0xffffffff
// EXPECT u32 64 1 1 0 1
// EXPECT u32 80 0xfffffffb 5 0 0
// EXPECT u32 128 1 0 1 6
// EXPECT u32 144 6 0 1 1
// EXPECT u32 160 0 6 6 1
// EXPECT u32 176 0 1 0 0xffffffff
// EXPECT u32 192 1 1 0 1
// EXPECT u32 208 0xfffffffa 6 0 0
// EXPECT u32 256 1 7 0 99
// EXPECT u32 272 0x40800000 0x40800000 0x3f800000 0x3f800000
// EXPECT u32 288 2
#include "scene.hlsli"

void store_all(uint at, uint x) {
  const bool odd_or_even = x == 5 || x == 6;
  const uint4 same = WaveMatch(x);
  results.Store4(at, uint4(WaveGetLaneCount(), WaveGetLaneIndex(), WaveIsFirstLane(), WaveActiveSum(x)));
  results.Store4(at + 16, uint4(WaveActiveProduct(x), WavePrefixSum(x), WavePrefixProduct(x),
                                WaveActiveBallot(odd_or_even).x));
  results.Store4(at + 32, uint4(WaveActiveBallot(odd_or_even).y, WaveReadLaneAt(x, x),
                                WaveReadLaneFirst(x), WaveActiveCountBits(odd_or_even)));
  results.Store4(at + 48, uint4(WavePrefixCountBits(true), same.x, WaveMultiPrefixSum(x, same),
                                WaveMultiPrefixBitAnd(x, same)));
  results.Store4(at + 64, uint4(WaveMultiPrefixProduct(x, same), WaveActiveAllEqual(float2(x, 1)).y,
                                WaveActiveAnyTrue(!odd_or_even), WaveActiveAllTrue(odd_or_even)));
  results.Store4(at + 80, uint4(WaveActiveMin(-int(x)), WaveActiveBitXor(x),
                                WaveMultiPrefixCountBits(true, same), WaveMultiPrefixBitOr(x, same)));
}

struct Attributes {
  float3 normal;
};

[shader("intersection")]
void Box() {
  Attributes attributes = (Attributes)0;
  if (WaveActiveAllTrue(WaveIsFirstLane())) ReportHit(19, 0, attributes);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.color = WaveReadLaneFirst(float4(3, 3, 0, 0)) + WavePrefixProduct(float4(0, 0, 0, 1));
}
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.x = WaveActiveCountBits(true);
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.numbers.yzw = uint3(WaveActiveMax(payload.numbers.x + 6), WavePrefixSum(4u), 99);
}

[shader("raygeneration")]
void Main() {
  const uint thread = DispatchRaysIndex().x;
  store_all(thread * 128, 5 + thread);
  // A count that the first lane of each wave adds to.
  if (WaveIsFirstLane()) {
    uint old;
    results.InterlockedAdd(288, WaveActiveCountBits(true), old);
  }
  if (thread == 1) {
    results.Store4(256, trace(RAY_FLAG_FORCE_NON_OPAQUE, 0x0f, test_ray(0)).numbers);
    results.Store4(272, asuint(trace(RAY_FLAG_SKIP_TRIANGLES, 0xff, test_ray(-10)).color));
  }
}
