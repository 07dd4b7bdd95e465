// SPDX-License-Identifier: MIT
// How values stand in the frame's pictures.
#ifndef KAAMOS_ENCODING_HLSLI
#define KAAMOS_ENCODING_HLSLI

// Unit vectors as two numbers in [-1, 1]. [Cigolle et al. 2014, A Survey of Efficient
// Representations for Independent Unit Vectors]
float2 OctahedralEncode(float3 n) {
  const float3 p = n / (abs(n.x) + abs(n.y) + abs(n.z));
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

// [IEC 61966-2-1]
float3 SrgbFromLinear(float3 c) {
  return select(c <= 0.0031308f, c * 12.92f, 1.055f * pow(c, 1.0f / 2.4f) - 0.055f);
}
float3 LinearFromSrgb(float3 c) {
  return select(c <= 0.04045f, c / 12.92f, pow((c + 0.055f) / 1.055f, 2.4f));
}

#endif
