// SPDX-License-Identifier: MIT
// Light that comes from everywhere, stored in cells of a sparse volume: per cell and colour a mean
// and a slope over directions (spherical harmonics to degree 1). [effects-spec B5.1]
#ifndef KAAMOS_INDIRECT_VOLUME_HLSLI
#define KAAMOS_INDIRECT_VOLUME_HLSLI

#include "frame.hlsli"

// effects/indirect_diffuse/volume.h holds the same layouts, and binds all three to a pass.
struct VolumeConstants {
  float3 origin;  // of cell (0, 0, 0)'s corner, relative to the camera
  float cell;     // metres
  uint3 bricks;   // of the grid, along each axis
  uint enabled;   // 0: there is no volume
};

// Radiance towards a unit direction d, by colour: mean + slope.x d.x + slope.y d.y + slope.z d.z.
// Kept short, because rays that end anywhere read cells from memory: 32 bytes, two to a cache line.
// The upper 21 bits of a word are those of a float of red (or green), the lower 11 one half of blue's
// upper 22: sign, exponent and 12 or 13 bits more. The sign of red's mean, which light does not have,
// marks a cell in a solid. effects/indirect_diffuse/packed_cell.h has the same for the host.
static const uint kUpper = 0xFFFFF800;
struct VolumeCell {
  uint4 red;    // mean, slope
  uint4 green;
};

// Sums or means over cells: mean and slope of each colour.
struct VolumeLight {
  float4 red;
  float4 green;
  float4 blue;
};

StructuredBuffer<uint> volume_bricks : register(t0, space3);  // where a brick's cells start; kNoBrick
StructuredBuffer<VolumeCell> volume_cells : register(t1, space3);
StructuredBuffer<VolumeConstants> volume_constants : register(t2, space3);

static const uint kBrickCells = 8;  // along each axis
static const uint kNoBrick = 0xFFFFFFFF;

// The cell's index, or kNoBrick where nothing is stored.
uint VolumeIndex(VolumeConstants volume, int3 cell) {
  const uint3 at = uint3(cell);  // one that is less than zero lies outside as a large one does
  if (any(at >= volume.bricks * kBrickCells)) return kNoBrick;
  const uint3 brick = at / kBrickCells;
  const uint start = volume_bricks[(brick.z * volume.bricks.y + brick.y) * volume.bricks.x + brick.x];
  if (start == kNoBrick) return kNoBrick;
  const uint3 inside = at % kBrickCells;
  return start + (inside.z * kBrickCells + inside.y) * kBrickCells + inside.x;
}

// Eight cells about a point, those in solids and those not stored left out. weight: how much of the
// eight was there, and what the sums are to be divided by; 0: nothing is known here.
VolumeLight SampleVolume(float3 position, out float weight) {
  VolumeLight sum;
  sum.red = sum.green = sum.blue = float4(0, 0, 0, 0);
  weight = 0.0;
  const VolumeConstants volume = volume_constants[0];
  if (volume.enabled == 0) return sum;
  const float3 at = (position - volume.origin) / volume.cell - 0.5;
  // Far away the conversion to integers would overflow.
  if (any(abs(at) > 1e6)) return sum;
  const float3 corner = floor(at);
  const float3 part = at - corner;
  // Mostly all eight lie in one brick, which is looked up once.
  const int3 low = int3(corner);
  const uint3 last = uint3(kBrickCells - 1, kBrickCells - 1, kBrickCells - 1);
  const bool one_brick = all(low >= int3(0, 0, 0)) && all(uint3(low) % kBrickCells != last);
  const uint first = one_brick ? VolumeIndex(volume, low) : 0;
  if (first == kNoBrick) return sum;
  [unroll] for (uint i = 0; i < 8; ++i) {
    const uint3 offset = uint3(i & 1, (i >> 1) & 1, i >> 2);
    const uint index = one_brick ? first + (offset.z * kBrickCells + offset.y) * kBrickCells + offset.x
                                 : VolumeIndex(volume, low + int3(offset));
    if (index == kNoBrick) continue;
    const VolumeCell cell = volume_cells[index];
    if (int(cell.red.x) < 0) continue;
    const float w = (offset.x == 1 ? part.x : 1.0 - part.x) * (offset.y == 1 ? part.y : 1.0 - part.y) *
                    (offset.z == 1 ? part.z : 1.0 - part.z);
    sum.red += w * asfloat(cell.red & kUpper);
    sum.green += w * asfloat(cell.green & kUpper);
    sum.blue += w * asfloat(cell.red << 21 | (cell.green & ~kUpper) << 10);
    weight += w;
  }
  // Only weights that are more than rounding are worth dividing by.
  if (weight < 1e-3) weight = 0.0;
  return sum;
}

// What is sent towards a direction, times `slope_scale` of what depends on it; the sky's where
// nothing is stored.
float3 VolumeTowards(float3 position, float3 direction, float slope_scale, float3 fallback) {
  float weight;
  const VolumeLight light = SampleVolume(position, weight);
  if (weight == 0.0) return fallback;
  const float4 terms = float4(1.0, direction * slope_scale);
  return max(float3(dot(light.red, terms), dot(light.green, terms), dot(light.blue, terms)) / weight,
             float3(0, 0, 0));
}

// Radiance that arrives at a point from a direction.
float3 VolumeRadiance(float3 position, float3 direction, float3 fallback) {
  return VolumeTowards(position, direction, 1.0, fallback);
}

// Irradiance over pi on a surface: what a white diffuse surface sends back.
float3 VolumeIrradiance(float3 position, float3 normal, float3 fallback) {
  return VolumeTowards(position, normal, 2.0 / 3.0, fallback);
}

// The same two of a surface: half a cell off it, so that the cells behind it count less.
float3 VolumeIrradianceAt(float3 position, float3 normal, float3 fallback) {
  return VolumeIrradiance(position + normal * (0.5 * volume_constants[0].cell), normal, fallback);
}
float3 VolumeRadianceAt(float3 position, float3 normal, float3 direction, float3 fallback) {
  return VolumeRadiance(position + normal * (0.5 * volume_constants[0].cell), direction, fallback);
}

#endif
