// SPDX-License-Identifier: MIT
// Keys to sort rays by, so that neighbours in a dispatch go the same way: 8 bits of direction, 8
// bits of origin, 8 bits of where the ray is thought to end. [Meister, Boksansky, Guthe & Bittner
// 2020]
#ifndef KAAMOS_RAY_KEY_HLSLI
#define KAAMOS_RAY_KEY_HLSLI

#include "frame.hlsli"

static const float kOriginCell = 0.5;  // metres
static const float kEndCell = 1.0;  // metres
static const uint kNoRayKey = 0xFFFFFF;  // sorts after all rays
// Rays without a limit are thought to end at this distance, others halfway, at most there. Cells of
// ends repeat every 8 m, so what lies beyond could not be told apart.
static const float kLongestGuess = 4.0;

// Interleaves 4 bits of `x` and `y` (Morton order), so that close keys are mostly close in space.
uint InterleaveBits(uint x, uint y) {
  uint key = 0;
  [unroll] for (uint bit = 0; bit < 4; ++bit) {
    key |= ((x >> bit) & 1) << (2 * bit) | ((y >> bit) & 1) << (2 * bit + 1);
  }
  return key;
}

uint DirectionKey(float3 direction) {
  const float2 place = OctahedralEncode(direction) * 0.5 + 0.5;
  const uint2 cell = min(uint2(place * 16.0), 15u);
  return InterleaveBits(cell.x, cell.y);
}

// Cells repeat every 8 of them, vertically every 4. Points that far apart rarely share a tile.
uint CellKey(float3 position, float size) {
  const int3 cell = int3(floor(position / size));
  const uint3 low = uint3(cell & int3(7, 3, 7));
  return InterleaveBits(low.x, low.z) | (low.y & 1) << 6 | (low.y >> 1) << 7;
}

void WriteKey(uint2 pixel, uint key) {
  ray_keys[pixel.y * DispatchRaysDimensions().x + pixel.x] = key;
}

// `reach`: how long the ray may be, metres.
void WriteRayKey(uint2 pixel, float3 origin, float3 direction, float reach) {
  const float3 end = origin + direction * min(0.5 * reach, kLongestGuess);
  WriteKey(pixel, DirectionKey(direction) | CellKey(origin, kOriginCell) << 8 |
                      CellKey(end, kEndCell) << 16);
}

void WriteNoRayKey(uint2 pixel) { WriteKey(pixel, kNoRayKey); }

#endif
