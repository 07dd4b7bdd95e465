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

// Reads a cell by its place in the grid. False: it lies outside, is not stored or lies in a solid.
bool LoadVolumeCell(uint3 cell, uint3 bricks, out VolumeCell stored) {
  stored.red = stored.green = uint4(0, 0, 0, 0);
  if (any(cell >= bricks * kBrickCells)) return false;
  const uint3 brick = cell / kBrickCells;
  const uint3 place = cell % kBrickCells;
  const uint start = volume_bricks[brick.x + bricks.x * (brick.y + bricks.y * brick.z)];
  if (start == kNoBrick) return false;
  stored = volume_cells[start + place.x + kBrickCells * (place.y + kBrickCells * place.z)];
  return int(stored.red.x) >= 0;
}

void AddVolumeCell(inout VolumeLight sum, VolumeCell cell, float weight) {
  sum.red += weight * CellRed(cell);
  sum.green += weight * CellGreen(cell);
  sum.blue += weight * CellBlue(cell);
  sum.weight += weight;
}

VolumeLight NoVolumeLight() {
  VolumeLight light;
  light.red = light.green = light.blue = float4(0, 0, 0, 0);
  light.weight = 0.0;
  return light;
}

// Eight cells about a point, those in solids and those not stored left out.
VolumeLight SampleVolume(float3 position) {
  VolumeLight sum = NoVolumeLight();
  const VolumeConstants volume = volume_constants[0];
  if (volume.enabled == 0) return sum;
  const float3 at = (position - volume.origin) * volume.over_cell - 0.5;
  // Far away the conversion to integers would overflow.
  if (any(abs(at) > 1e6)) return sum;
  const float3 corner = floor(at);
  const float3 part = at - corner;
  for (uint i = 0; i < 8; ++i) {
    const uint3 offset = uint3(i & 1, (i >> 1) & 1, i >> 2);
    VolumeCell cell;
    // Below zero a place in the grid is a large one.
    if (!LoadVolumeCell(uint3(int3(corner)) + offset, volume.bricks, cell)) continue;
    const float3 share = select(offset != 0, part, 1.0 - part);
    AddVolumeCell(sum, cell, share.x * share.y * share.z);
  }
  // Only weights that are more than rounding are worth dividing by.
  if (sum.weight < 1e-3) sum.weight = 0.0;
  return sum;
}

// The cell about a point alone; weight 0 if it is in a solid, not stored or outside.
VolumeLight SampleVolumeCell(float3 position) {
  VolumeLight light = NoVolumeLight();
  const VolumeConstants volume = volume_constants[0];
  if (volume.enabled == 0) return light;
  const float3 at = floor((position - volume.origin) * volume.over_cell);
  if (any(abs(at) > 1e6)) return light;
  VolumeCell cell;
  if (LoadVolumeCell(uint3(int3(at)), volume.bricks, cell)) AddVolumeCell(light, cell, 1.0);
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
