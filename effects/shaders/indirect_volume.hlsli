// SPDX-License-Identifier: MIT
// Light that comes from everywhere, stored in cells of a sparse volume: per cell and colour a mean
// and a slope over directions (spherical harmonics to degree 1). [effects-spec B5.1]
#ifndef KAAMOS_INDIRECT_VOLUME_HLSLI
#define KAAMOS_INDIRECT_VOLUME_HLSLI

#include "frame.hlsli"

// effects/indirect_diffuse/volume.h holds the same layouts, and binds all three to a pass.
struct VolumeConstants {
  float3 origin;    // of cell (0, 0, 0)'s corner, relative to the camera
  float cell;       // metres
  uint3 bricks;     // of the grid, along each axis
  uint enabled;     // 0: there is no volume
  float over_cell;  // 1 / cell
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

float4 CellRed(VolumeCell cell) { return asfloat(cell.red & kUpper); }
float4 CellGreen(VolumeCell cell) { return asfloat(cell.green & kUpper); }
float4 CellBlue(VolumeCell cell) { return asfloat(cell.red << 21 | (cell.green & ~kUpper) << 10); }

// Sums over cells: mean and slope of each colour.
struct VolumeLight {
  float4 red;
  float4 green;
  float4 blue;
  float weight;  // what the sums are to be divided by; 0: nothing is known here
};

StructuredBuffer<uint> volume_bricks : register(t0, space3);  // where a brick's cells start; kNoBrick
StructuredBuffer<VolumeCell> volume_cells : register(t1, space3);
StructuredBuffer<VolumeConstants> volume_constants : register(t2, space3);

static const uint kBrickCells = 8;  // along each axis
static const uint kNoBrick = 0xFFFFFFFF;

// Two neighbours along an axis: what they add to the number of their brick and to their place in it,
// and how much they count. Outside the grid, where a cell below zero lies as a large one does, that
// is nothing.
struct CellPair {
  uint2 brick;
  uint2 place;
  float2 share;
};

CellPair CellsAlong(int low, float part, uint bricks, uint brick_step, uint cell_step) {
  const uint2 cell = uint2(low, low + 1);
  const uint end = bricks * kBrickCells;
  const uint2 inside = min(cell, end - 1);
  CellPair pair;
  pair.brick = inside / kBrickCells * brick_step;
  pair.place = inside % kBrickCells * cell_step;
  pair.share = float2(cell.x < end ? 1.0 - part : 0.0, cell.y < end ? part : 0.0);
  return pair;
}

// Eight cells about a point, those in solids and those not stored left out.
VolumeLight SampleVolume(float3 position) {
  VolumeLight sum;
  sum.red = sum.green = sum.blue = float4(0, 0, 0, 0);
  sum.weight = 0.0;
  const VolumeConstants volume = volume_constants[0];
  if (volume.enabled == 0) return sum;
  const float3 at = (position - volume.origin) * volume.over_cell - 0.5;
  // Far away the conversion to integers would overflow.
  if (any(abs(at) > 1e6)) return sum;
  const float3 corner = floor(at);
  const float3 part = at - corner;
  const uint3 bricks = volume.bricks;
  const CellPair x = CellsAlong(int(corner.x), part.x, bricks.x, 1, 1);
  const CellPair y = CellsAlong(int(corner.y), part.y, bricks.y, bricks.x, kBrickCells);
  const CellPair z = CellsAlong(int(corner.z), part.z, bricks.z, bricks.x * bricks.y,
                                kBrickCells * kBrickCells);
  [unroll] for (uint i = 0; i < 8; ++i) {
    const bool right = (i & 1) != 0;
    const bool upper = (i & 2) != 0;
    const bool far = (i & 4) != 0;
    const uint start = volume_bricks[(right ? x.brick.y : x.brick.x) +
                                     (upper ? y.brick.y : y.brick.x) + (far ? z.brick.y : z.brick.x)];
    if (start == kNoBrick) continue;
    const VolumeCell cell = volume_cells[start + (right ? x.place.y : x.place.x) +
                                         (upper ? y.place.y : y.place.x) +
                                         (far ? z.place.y : z.place.x)];
    if (int(cell.red.x) < 0) continue;
    const float w = (right ? x.share.y : x.share.x) * (upper ? y.share.y : y.share.x) *
                    (far ? z.share.y : z.share.x);
    sum.red += w * CellRed(cell);
    sum.green += w * CellGreen(cell);
    sum.blue += w * CellBlue(cell);
    sum.weight += w;
  }
  // Only weights that are more than rounding are worth dividing by.
  if (sum.weight < 1e-3) sum.weight = 0.0;
  return sum;
}

// The cell about a point alone; weight 0 if it is in a solid, not stored or outside.
VolumeLight SampleVolumeCell(float3 position) {
  VolumeLight light;
  light.red = light.green = light.blue = float4(0, 0, 0, 0);
  light.weight = 0.0;
  const VolumeConstants volume = volume_constants[0];
  if (volume.enabled == 0) return light;
  const float3 at = floor((position - volume.origin) * volume.over_cell);
  if (any(abs(at) > 1e6)) return light;
  const uint3 cell = uint3(int3(at));  // below zero: a large one
  if (any(cell >= volume.bricks * kBrickCells)) return light;
  const uint3 brick = cell / kBrickCells;
  const uint3 place = cell % kBrickCells;
  const uint start =
      volume_bricks[brick.x + volume.bricks.x * (brick.y + volume.bricks.y * brick.z)];
  if (start == kNoBrick) return light;
  const VolumeCell stored =
      volume_cells[start + place.x + kBrickCells * (place.y + kBrickCells * place.z)];
  if (int(stored.red.x) < 0) return light;
  light.red = CellRed(stored);
  light.green = CellGreen(stored);
  light.blue = CellBlue(stored);
  light.weight = 1.0;
  return light;
}

// What is sent towards a direction, times `slope_scale` of what depends on it; the sky's where
// nothing is stored. `jitter`, evenly from -0.5 to 0.5 along each axis, chooses one cell as often as the
// eight would weigh it; where it holds nothing all eight are read. On average over jitters that is
// what all eight give, for a quarter of the work. [Pharr et al. 2024, stochastic texture filtering]
static const float3 kEveryCell = float3(1, 1, 1);  // as a jitter: all eight, for what has no noise

float3 VolumeTowards(float3 position, float3 jitter, float3 direction, float slope_scale) {
  VolumeLight light;
  light.weight = 0.0;
  if (jitter.x < kEveryCell.x) {
    light = SampleVolumeCell(position + jitter * volume_constants[0].cell);
  }
  if (light.weight == 0.0) light = SampleVolume(position);
  if (light.weight == 0.0) return SkyTowards(direction);
  const float4 terms = float4(1.0, direction * slope_scale);
  const float3 sum = float3(dot(light.red, terms), dot(light.green, terms), dot(light.blue, terms));
  return max(sum / light.weight, float3(0, 0, 0));
}

// Radiance that arrives at a point from a direction.
float3 VolumeRadiance(float3 position, float3 jitter, float3 direction) {
  return VolumeTowards(position, jitter, direction, 1.0);
}

// Irradiance over pi on a surface: what a white diffuse surface sends back.
float3 VolumeIrradiance(float3 position, float3 jitter, float3 normal) {
  return VolumeTowards(position, jitter, normal, 2.0 / 3.0);
}

// The same two of a surface: half a cell off it, so that the cells behind it count less.
float3 VolumeIrradianceAt(float3 position, float3 jitter, float3 normal) {
  return VolumeIrradiance(position + normal * (0.5 * volume_constants[0].cell), jitter, normal);
}
float3 VolumeRadianceAt(float3 position, float3 jitter, float3 normal, float3 direction) {
  return VolumeRadiance(position + normal * (0.5 * volume_constants[0].cell), jitter, direction);
}

#endif
