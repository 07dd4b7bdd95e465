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

// What a surface reflects where it is no metal, in two channels of 8 bits and a half float: f0 of
// light that comes straight at it, f90 of light that grazes it. Glass, 0.04 and 1, has a code of its
// own. x: 128ths, below 1/2: 64 where f0 has a colour, and 63rds by which f90 is below 1. y: root of
// the largest component of f0. `tint`: f0 over that, roots in 15ths.
static const float kPlainDielectric = 51.0f / 255.0f;  // the root of 0.04
static const float kNoTint = 2047.0f;

float2 EncodeDielectric(float3 f0, float f90, out float tint) {
  const float largest = max(f0.x, max(f0.y, f0.z));
  const float3 part = round(15.0f * sqrt(saturate(f0 / max(largest, 1e-6f))));
  const bool is_tinted = largest > 0.0f && any(part < 14.5f);
  tint = is_tinted ? part.x + 16.0f * part.y + 256.0f * part.z - 2048.0f : 0.0f;
  const float code = (is_tinted ? 64.0f : 0.0f) + round(63.0f * saturate(1.0f - f90));
  return float2(code / 255.0f, sqrt(saturate(largest)));
}

bool IsPlainDielectric(float4 material) {
  return material.z == 0.0f && abs(material.w - kPlainDielectric) < 0.001f;
}

bool IsTinted(float4 material) { return material.z > 63.5f / 255.0f; }

void DecodeDielectric(float4 material, float tint, out float3 f0, out float f90) {
  const float code = round(material.z * 255.0f);
  f90 = 1.0f - (code >= 64.0f ? code - 64.0f : code) / 63.0f;
  const uint packed = uint(tint + 2048.0f);
  const float3 part = float3(float(packed & 15u), float(packed >> 4u & 15u),
                             float(packed >> 8u & 15u)) / 15.0f;
  f0 = (material.w * material.w) * (part * part);
}

#endif
