// SPDX-License-Identifier: MIT
// Random numbers and sampling routines. effects/assets/common/sampling.h, sobol.h and blue_noise.h have
// the same functions for the host, with the same values.
#ifndef KAAMOS_SAMPLING_HLSLI
#define KAAMOS_SAMPLING_HLSLI

// One step of a permuted congruential generator, used as a hash. [O'Neill 2014; Jarzynski & Olano
// 2020, Hash Functions for GPU Rendering]
uint PcgHash(uint v) {
  const uint state = v * 747796405u + 2891336453u;
  const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

uint HashCombine(uint seed, uint v) { return PcgHash(seed ^ PcgHash(v)); }

// The upper 24 bits as a float in [0, 1).
float UnitFloat(uint bits) { return float(bits >> 8u) * (1.0f / 16777216.0f); }

// The two dimensions of the Sobol sequence, as 32-bit fractions.
uint Sobol0(uint index) { return reversebits(index); }

// The second dimension, lowest bit first.
uint ReversedSobol1(uint index) {
  // Multiplication by Pascal's triangle modulo 2, in five steps.
  uint x = index;
  x ^= (x & 0xAAAAAAAAu) >> 1u;
  x ^= (x & 0xCCCCCCCCu) >> 2u;
  x ^= (x & 0xF0F0F0F0u) >> 4u;
  x ^= (x & 0xFF00FF00u) >> 8u;
  x ^= (x & 0xFFFF0000u) >> 16u;
  return x;
}

uint Sobol1(uint index) { return reversebits(ReversedSobol1(index)); }

// Owen scrambling (nested uniform scrambling) by a hash, of a fraction with its lowest bit first.
// [Laine & Karras 2011, constants of Vegdahl 2021]
uint ScrambleReversed(uint fraction, uint seed) {
  uint x = fraction;
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return x;
}

uint OwenScramble(uint fraction, uint seed) {
  return reversebits(ScrambleReversed(reversebits(fraction), seed));
}

// Point `index` of an Owen-scrambled and shuffled Sobol sequence: OwenScramble of Sobol0 and
// Sobol1, without reversing the bits twice. [Burley 2020, Practical Hash-based Owen Scrambling]
float2 SobolOwen(uint index, uint seed) {
  const uint shuffled = OwenScramble(index, seed);
  const uint x = ScrambleReversed(shuffled, PcgHash(seed ^ 0x9E3779B9u));
  const uint y = ScrambleReversed(ReversedSobol1(shuffled), PcgHash(seed ^ 0x85EBCA6Bu));
  return float2(UnitFloat(reversebits(x)), UnitFloat(reversebits(y)));
}

static const uint kBlueNoiseSize = 128u;

// Index of a pixel's value for a dimension pair in the blue-noise tile (a StructuredBuffer of
// kBlueNoiseSize * kBlueNoiseSize float2).
uint BlueNoiseIndex(uint2 pixel, uint pair, uint seed) {
  const uint h = HashCombine(seed, pair);
  const uint mask = kBlueNoiseSize - 1u;
  return ((pixel.y + ((h >> 16u) & mask)) & mask) * kBlueNoiseSize +
         ((pixel.x + (h & mask)) & mask);
}

// Sample `index` of a dimension pair: the pixel's blue-noise value plus the Sobol point, modulo 1.
// [GDC 2018 talk]
float2 PixelSample(float2 tile_value, uint index, uint pair, uint seed) {
  const float2 u = tile_value + SobolOwen(index, PcgHash(HashCombine(seed, pair)));
  return u - floor(u);
}

// Uniform in -0.5..0.5 along each axis, independent from pixel to pixel.
float3 PixelJitter(uint2 pixel, uint index, uint pair, uint seed) {
  const uint key = HashCombine(HashCombine(seed, pixel.y * 65536u + pixel.x), index * 8u + pair);
  return float3(UnitFloat(PcgHash(key)), UnitFloat(PcgHash(key + 1u)),
                UnitFloat(PcgHash(key + 2u))) - 0.5f;
}

// Maps the unit square to the unit disk, preserving area.
float2 SampleDisk(float2 u) {
  const float r = sqrt(u.x);
  const float phi = 6.2831853f * u.y;
  return float2(r * cos(phi), r * sin(phi));
}

// Direction about +Z with density cos(theta) / pi.
float3 SampleCosineHemisphere(float2 u) {
  return float3(SampleDisk(u), sqrt(max(0.0f, 1.0f - u.x)));
}

// Rotates `local` from about +Z to about the unit vector `n`. [Duff et al. 2017, Building an
// Orthonormal Basis, Revisited]
float3 ToWorld(float3 local, float3 n) {
  const float s = n.z >= 0.0f ? 1.0f : -1.0f;
  const float a = -1.0f / (s + n.z);
  const float b = n.x * n.y * a;
  const float3 t = float3(1.0f + s * n.x * n.x * a, s * b, -s * n.x);
  const float3 v = float3(b, s + n.y * n.y * a, -n.y);
  return t * local.x + v * local.y + n * local.z;
}

// The inverse of ToWorld.
float3 ToLocal(float3 world, float3 n) {
  const float s = n.z >= 0.0f ? 1.0f : -1.0f;
  const float a = -1.0f / (s + n.z);
  const float b = n.x * n.y * a;
  return float3(dot(world, float3(1.0f + s * n.x * n.x * a, s * b, -s * n.x)),
                dot(world, float3(b, s + n.y * n.y * a, -n.y)), dot(world, n));
}

// Direction to a random point of the sun's disk.
float3 SampleSun(float2 u, float3 direction_to_sun, float tan_angular_radius) {
  return normalize(ToWorld(float3(SampleDisk(u) * tan_angular_radius, 1.0f), direction_to_sun));
}

#endif
