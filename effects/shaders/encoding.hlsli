// SPDX-License-Identifier: MIT
// This file holds the ways in which values are stored in the frame's pictures.
#ifndef KAAMOS_ENCODING_HLSLI
#define KAAMOS_ENCODING_HLSLI

// Unit vectors as two numbers in [-1, 1]: project onto an octahedron and unfold it. [Cigolle et al.
// 2014, A Survey of Efficient Representations for Independent Unit Vectors]
float2 OctahedralEncode(float3 n) {
  const float3 p = n * (1.0f / (abs(n.x) + abs(n.y) + abs(n.z)));
  if (p.z >= 0.0f) return p.xy;
  return float2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
                (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
}

float3 OctahedralDecode(float2 p) {
  float3 n = float3(p, 1.0f - abs(p.x) - abs(p.y));
  if (n.z < 0.0f) {
    n.xy = float2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
                  (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
  }
  return normalize(n);
}

// Linear colours in 0..1 are stored in bytes as square roots. That is about as fine as sRGB (the
// largest step is 1/128 instead of 1/112) and needs no power function; UAVs have no sRGB formats.
float3 EncodeColor(float3 c) { return sqrt(c); }
float3 DecodeColor(float3 e) { return e * e; }

#endif
