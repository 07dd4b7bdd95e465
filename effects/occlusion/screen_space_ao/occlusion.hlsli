// SPDX-License-Identifier: MIT
// This file holds what every technique of this folder shares: its pictures, its radius, directions
// about a view ray and small tiles of noise.
#ifndef KAAMOS_OCCLUSION_HLSLI
#define KAAMOS_OCCLUSION_HLSLI

#include "view_space.hlsli"

static const float kTwoPi = 6.28318530718;

// The effect's picture, and what stands between its passes.
RWTexture2D<float4> result : register(u0, space3);  // visibility: 1 open, 0 occluded
RWTexture2D<float> raw : register(u1, space3);      // before the filter
RWTexture2D<float> filtered : register(u2, space3);

// As the pass has it, and never so long that points at its end have no place in the picture.
float Radius() { return min(pass_constants.radius, 1e6); }

// Two directions square to the view ray and to each other.
struct ViewBasis {
  float3 right;
  float3 up;
};

ViewBasis MakeViewBasis(float3 to_camera) {
  ViewBasis basis;
  basis.right = normalize(float3(1, 0, 0) - to_camera.x * to_camera);
  basis.up = cross(basis.right, to_camera);
  return basis;
}

// A number in 0..1 for each pixel of a tile of 4 x 4, and another one that does not go with it: a
// filter of that size sees them all.
float2 TileNoise(int2 pixel) {
  const uint x = uint(pixel.x) & 3u;
  const uint y = uint(pixel.y) & 3u;
  const uint bits = x ^ y;
  const uint rank = ((bits & 1u) << 3u) | ((y & 1u) << 2u) | (bits & 2u) | ((y & 2u) >> 1u);
  const uint other = (rank * 7u + 3u) & 15u;
  return (float2(float(rank), float(other)) + 0.5) / 16.0;
}

#endif
