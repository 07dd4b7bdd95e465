// SPDX-License-Identifier: MIT
// A sampler is right if its points are where they belong, and their means are those of the density.
#include <kaamos/test.hlsli>

#include "sampling.hlsli"

[test]
[cases((0, 0.0), (1, 0.5), (2, 0.25), (3, 0.75), (0x80000000u, 0.0))]
void RadicalInverseMirrorsBits(uint i, float expected) {
  // The last case has its one in a bit below float's precision.
  EXPECT_EQ(radical_inverse(i), expected);
}

// Sixteen points in sixteen boxes, in whatever way 16 is divided.
[test]
[cases(1, 2, 4, 8, 16)]
void EachBoxHasOnePoint(uint columns) {
  uint boxes = 0;
  for (uint i = 0; i < 16; ++i) {
    const uint2 box = uint2(hammersley(i, 16) * float2(columns, 16 / columns));
    boxes |= 1u << (box.y * columns + box.x);
  }
  EXPECT_EQ(boxes, 0xFFFF);
}

[test]
void CosineSamplesHaveTheMeansOfTheirDensity() {
  const uint kCount = 4096;
  float3 mean = 0;
  float square = 0;
  for (uint i = 0; i < kCount; ++i) {
    const float3 w = cosine_hemisphere(hammersley(i, kCount));
    EXPECT_NEAR(length(w), 1, 1e-5);
    ASSERT_LE(0, w.z);
    mean += w / kCount;
    square += w.z * w.z / kCount;
  }
  EXPECT_NEAR(mean, float3(0, 0, 2.0 / 3.0), 2e-3);
  EXPECT_NEAR(square, 0.5, 1e-3);
}

// A group of threads: their partial sums in groupshared memory.
groupshared float partial[64];

[test]
[numthreads(64, 1, 1)]
void GroupsSumInParallel(uint i : SV_GroupIndex) {
  partial[i] = cosine_hemisphere(hammersley(i, 64)).z;
  for (uint step = 32; step > 0; step >>= 1) {
    GroupMemoryBarrierWithGroupSync();
    if (i < step) partial[i] += partial[i + step];
  }
  GroupMemoryBarrierWithGroupSync();
  EXPECT_NEAR(partial[0] / 64, 2.0 / 3.0, 1e-2);
}
