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
// The same of bent normals: the mean open direction in view space, longer the more is open.
RWTexture2D<float4> raw_bent : register(u14, space3);
RWTexture2D<float4> filtered_bent : register(u15, space3);

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

// At half resolution one of each 2 x 2 pixels is looked at: always the same, or each in turn where
// frames are averaged. Every other one lies across. Returns its place in the 2 x 2.
int2 PlaceInBlock(bool takes_turns) {
  if (!takes_turns) return int2(0, 0);
  const uint turn = frame.frame_index % 4u;
  const uint place = turn == 0 ? 0u : turn == 1 ? 3u : turn - 1u;
  return int2(place & 1u, place >> 1u);
}

// The blocks of `step` x `step` pixels that cover the picture, and the pixel of one that is looked
// at.
int2 Blocks(int2 size, int step) { return (size + step - 1) / step; }
int2 PixelOfBlock(int2 block, int step, bool takes_turns, int2 size) {
  if (step == 1) return block;
  return min(block * step + PlaceInBlock(takes_turns), size - 1);
}

// The tile's numbers as they are in this frame. The first one is turned by a part of the whole from
// frame to frame, and by a part of what is between the tile's own numbers: `rotations` frames have
// 16 times as many directions. [Jimenez et al. 2016: 4 x 4 pixels, 6 frames, 96 directions]
float2 RotatedNoise(int2 block, uint rotations) {
  const float2 noise = TileNoise(block);
  if (rotations == 0) return noise;
  const float turn = float(frame.frame_index % rotations);
  return frac(noise + turn * float2((1.0 + 1.0 / 16.0) / float(rotations), 0.6180339887));
}

#endif
