// SPDX-License-Identifier: MIT
// Keys to sort rays by, so that neighbours in a dispatch go the same way: 8 bits of direction, 8
// bits of origin. [effects-spec B1.5]
#ifndef KAAMOS_RAY_KEY_HLSLI
#define KAAMOS_RAY_KEY_HLSLI

#include "frame.hlsli"

static const float kOriginCell = 0.5;  // metres
static const uint kNoRayKey = 0xFFFF;  // sorts after all rays

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

// Cells repeat every 4 m, vertically every 2 m. Points that far apart rarely share a tile.
uint OriginKey(float3 origin) {
  const int3 cell = int3(floor(origin / kOriginCell));
  const uint3 low = uint3(cell & int3(7, 3, 7));
  return InterleaveBits(low.x, low.z) | (low.y & 1) << 6 | (low.y >> 1) << 7;
}

void WriteKey(uint2 pixel, uint key) {
  ray_keys[pixel.y * DispatchRaysDimensions().x + pixel.x] = key;
}

void WriteRayKey(uint2 pixel, float3 origin, float3 direction) {
  WriteKey(pixel, DirectionKey(direction) | OriginKey(origin) << 8);
}

void WriteNoRayKey(uint2 pixel) { WriteKey(pixel, kNoRayKey); }

#endif
