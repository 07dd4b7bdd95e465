// SPDX-License-Identifier: MIT
// Sorts the pixels of each tile by eight bits of their rays' keys. The counting sort is stable, so
// a second pass makes it sixteen bits, and the result is the same on every run.
#include "frame.hlsli"

static const uint2 kTile = uint2(64, 128);
static const uint kBlock = 16;  // side of a block of pixels that a dispatch runs together
static const uint kBins = 256;
static const uint kThreads = 16;
static const uint kPixelsOfThread = 512;  // kTile.x * kTile.y / kThreads

StructuredBuffer<uint> pixels_before : register(t0, space3);
RWStructuredBuffer<uint> pixels_sorted : register(u0, space3);

struct SortConstants {
  uint width;
  uint height;
  uint shift;  // lowest of the key's eight bits
  uint first;  // 1: first pass, so pixels_before is empty
};
ConstantBuffer<SortConstants> constants : register(b0, space3);

groupshared uint g_counts[kBins * kThreads];  // by bin, then by thread
groupshared uint g_sums[kThreads];

// Pixel of place `slot` in a tile of `size`. Places fill one block of kBlock x kBlock after
// another, so that neighbours in the order are neighbours in a dispatch too.
uint2 PlaceInTile(uint slot, uint2 size) {
  const uint strip = slot / (kBlock * size.x);
  const uint in_strip = slot - strip * kBlock * size.x;
  const uint height = min(kBlock, size.y - strip * kBlock);
  const uint block = in_strip / (kBlock * height);
  const uint in_block = in_strip - block * kBlock * height;
  const uint width = min(kBlock, size.x - block * kBlock);
  return uint2(block * kBlock + in_block % width, strip * kBlock + in_block / width);
}

[shader("compute")]
[numthreads(kThreads, 1, 1)]
void SortRays(uint3 group : SV_GroupID, uint thread : SV_GroupIndex) {
  const uint2 corner = group.xy * kTile;
  const uint2 size = min(kTile, uint2(constants.width, constants.height) - corner);
  const uint begin = thread * kPixelsOfThread;
  const uint end = min(begin + kPixelsOfThread, size.x * size.y);

  for (uint bin = 0; bin < kBins; ++bin) g_counts[bin * kThreads + thread] = 0;
  for (uint slot = begin; slot < end; ++slot) {
    const uint2 place = corner + PlaceInTile(slot, size);
    const uint index = place.y * constants.width + place.x;
    const uint pixel = constants.first != 0 ? place.x + 65536 * place.y : pixels_before[index];
    const uint key = ray_keys[(pixel >> 16) * constants.width + (pixel & 0xFFFFu)];
    g_counts[((key >> constants.shift) & (kBins - 1)) * kThreads + thread] += 1;
  }
  GroupMemoryBarrierWithGroupSync();

  // Prefix sum: where each thread's pixels of each bin begin.
  const uint run = kBins;  // counts per thread
  uint sum = 0;
  for (uint i = 0; i < run; ++i) {
    const uint count = g_counts[thread * run + i];
    g_counts[thread * run + i] = sum;
    sum += count;
  }
  g_sums[thread] = sum;
  GroupMemoryBarrierWithGroupSync();
  uint before = 0;
  for (uint other = 0; other < thread; ++other) before += g_sums[other];
  for (uint j = 0; j < run; ++j) g_counts[thread * run + j] += before;
  GroupMemoryBarrierWithGroupSync();

  for (uint from = begin; from < end; ++from) {
    const uint2 place = corner + PlaceInTile(from, size);
    const uint index = place.y * constants.width + place.x;
    const uint pixel = constants.first != 0 ? place.x + 65536 * place.y : pixels_before[index];
    const uint key = ray_keys[(pixel >> 16) * constants.width + (pixel & 0xFFFFu)];
    const uint counter = ((key >> constants.shift) & (kBins - 1)) * kThreads + thread;
    const uint to = g_counts[counter];
    g_counts[counter] = to + 1;
    const uint2 target = corner + PlaceInTile(to, size);
    pixels_sorted[target.y * constants.width + target.x] = pixel;
  }
}
