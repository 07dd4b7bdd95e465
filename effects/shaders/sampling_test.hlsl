// SPDX-License-Identifier: MIT
// Random numbers and sampling routines against what defines them: stratification, areas, means.
#include <kaamos/test.hlsli>
#include "sampling.hlsli"

// The first values of the reference program of the same generator.
[test]
[cases((0, 129708002u), (1, 2831084092u), (0xFFFFFFFFu, 3861530882u))]
void HashesAreThoseOfTheReference(uint v, uint expected) {
  EXPECT_EQ(PcgHash(v), expected);
}

[test] void FractionsStayBelowOne() {
  EXPECT_EQ(UnitFloat(0), 0);
  EXPECT_LT(UnitFloat(0xFFFFFFFFu), 1);
  EXPECT_EQ(UnitFloat(0x80000000u), 0.5);
}

// Point i of the sequence, in 8ths. [Sobol 1967]
[test]
[cases((0, 0, 0), (1, 4, 4), (2, 2, 6), (3, 6, 2), (4, 1, 5), (5, 5, 1), (6, 3, 3), (7, 7, 7))]
void SobolsFirstPoints(uint index, float x, float y) {
  EXPECT_EQ(UnitFloat(Sobol0(index)) * 8, x);
  EXPECT_EQ(UnitFloat(Sobol1(index)) * 8, y);
}

// Scrambled or not, the first 16 points have one in each of 16 boxes of every shape: 16 x 1 to 1 x 16.
[test]
[cases(0u, 1u, 77u, 0xDEADBEEFu)]
void ScrambledPointsStayStratified(uint seed) {
  [loop] for (uint rows = 0; rows <= 4; ++rows) {
    uint seen = 0;
    [loop] for (uint i = 0; i < 16; ++i) {
      const uint2 at = uint2(SobolOwen(i, seed) * 16);
      seen |= 1u << ((at.x >> rows) | (at.y >> (4 - rows)) << (4 - rows));
    }
    EXPECT_EQ(seen, 0xFFFFu);
  }
}

[test] void SeedsGiveOtherPoints() {
  EXPECT_TRUE(any(SobolOwen(3, 1) != SobolOwen(3, 2)));
  EXPECT_TRUE(HashCombine(1, 2) != HashCombine(2, 1));
}

// The tile repeats after its side, in both directions.
[test]
[cases((0, 0), (127, 5), (64, 127))]
void BlueNoiseRepeats(uint x, uint y) {
  const uint index = BlueNoiseIndex(uint2(x, y), 3, 9);
  EXPECT_EQ(BlueNoiseIndex(uint2(x + kBlueNoiseSize, y + 3 * kBlueNoiseSize), 3, 9), index);
  EXPECT_LT(index, kBlueNoiseSize * kBlueNoiseSize);
}

// A quarter of the square goes to a quarter of the disk's area, and directions are even.
[test] void TheDiskKeepsAreas() {
  float2 sum = 0;
  uint inner = 0;
  [loop] for (uint i = 0; i < 4096; ++i) {
    const float2 p = SampleDisk(SobolOwen(i, 5));
    EXPECT_LE(dot(p, p), 1);
    inner += dot(p, p) < 0.25 ? 1 : 0;
    sum += p;
  }
  EXPECT_EQ(inner, 1024);
  EXPECT_NEAR(sum / 4096, float2(0, 0), 1e-3);
}

// With the density cos / pi, the mean cosine is 2/3 and that of its square 1/2.
[test] void TheHemisphereHasTheCosinesDensity() {
  float first = 0, second = 0;
  [loop] for (uint i = 0; i < 4096; ++i) {
    const float3 d = SampleCosineHemisphere(SobolOwen(i, 9));
    EXPECT_NEAR(length(d), 1, 1e-6);
    first += d.z;
    second += d.z * d.z;
  }
  EXPECT_NEAR(first / 4096, 2.0 / 3, 1e-4);
  EXPECT_NEAR(second / 4096, 0.5, 1e-4);
}

// At the poles, too, where other bases fail.
[test]
[cases((0, 0, 1), (0, 0, -1), (1e-4, -1e-4, -1), (1, 0, 0), (0, -1, 0), (0.6, 0, -0.8))]
void TheBasisIsARotation(float x, float y, float z) {
  const float3 n = normalize(float3(x, y, z));
  EXPECT_NEAR(ToWorld(float3(0, 0, 1), n), n, 1e-6);
  const float3 t = ToWorld(float3(1, 0, 0), n), b = ToWorld(float3(0, 1, 0), n);
  EXPECT_NEAR(float3(dot(t, b), dot(t, n), dot(b, n)), float3(0, 0, 0), 1e-6);
  EXPECT_NEAR(float2(length(t), length(b)), float2(1, 1), 1e-6);
  EXPECT_NEAR(dot(cross(t, b), n), 1, 1e-6);
  EXPECT_NEAR(ToLocal(ToWorld(float3(0.2, -0.7, 0.4), n), n), float3(0.2, -0.7, 0.4), 1e-6);
}

[test] void TheSunIsADisk() {
  const float3 sun = normalize(float3(0.3, -0.9, 0.1));
  const float tan_radius = 0.00465;
  float3 sum = 0;
  [loop] for (uint i = 0; i < 256; ++i) {
    const float3 d = SampleSun(SobolOwen(i, 2), sun, tan_radius);
    EXPECT_LE(length(cross(d, sun)) / dot(d, sun), tan_radius * 1.0001);
    sum += d;
  }
  EXPECT_NEAR(normalize(sum), sun, 1e-5);
}
