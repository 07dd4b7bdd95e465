// SPDX-License-Identifier: MIT
// This file holds what the draws of the raster G-buffer and its resolve pass share: the pass's
// registers of space3, and the scene's vertices and indices. [effects/surfaces/gbuffer/raster.h]
#ifndef KAAMOS_GBUFFER_DRAWS_HLSLI
#define KAAMOS_GBUFFER_DRAWS_HLSLI

#include "frame.hlsli"
#include "scene_draw.hlsli"

struct DrawConstants {
  uint draw;         // in `draws`
  float clip_scale;  // of ToClip
  float2 size;       // of the picture, pixels
};

ConstantBuffer<DrawConstants> constants : register(b0, space3);
StructuredBuffer<SceneDraw> draws : register(t0, space3);
StructuredBuffer<HitConstants> geometries : register(t1, space3);
// The visibility buffer: draw + 1 and primitive of what a pixel shows; 0: nothing.
Texture2D<uint2> visibility : register(t2, space3);
// Vertices and indices of geometry i are number 2 * i and 2 * i + 1.
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

#endif
