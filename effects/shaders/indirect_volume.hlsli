// SPDX-License-Identifier: MIT
// Indirect light, stored in the cells of a sparse volume: per cell and colour a mean and a slope
// over directions (spherical harmonics up to degree 1). [effects-spec B5.1]
#ifndef KAAMOS_INDIRECT_VOLUME_HLSLI
#define KAAMOS_INDIRECT_VOLUME_HLSLI

#include "frame.hlsli"

// effects/indirect_diffuse/volume.h has the same layouts and binds all three buffers to a pass.
struct VolumeConstants {
  float3 origin;    // of the corner of cell (0, 0, 0), relative to the camera
  float cell;       // metres
  uint3 bricks;     // along each axis of the grid
  uint enabled;     // 0: there is no volume
  float over_cell;  // 1 / cell
};

// Radiance from a unit direction d, per colour: mean + slope.x d.x + slope.y d.y + slope.z d.z.
//
// A cell has 32 bytes, two to a cache line, because rays end anywhere and read cells from memory.
// The upper 21 bits of a word are the top of a red (or green) float; the lower 11 bits are one half
// of blue's upper 22: sign, exponent and 12 or 13 bits of mantissa. Light is never negative, so the
// sign of red's mean marks a cell inside a solid. effects/indirect_diffuse/packed_cell.h is the
// same for the host.
static const uint kUpper = 0xFFFFF800;
struct VolumeCell {
  uint4 red;    // mean, slope
  uint4 green;
};

float4 CellRed(VolumeCell cell) { return asfloat(cell.red & kUpper); }
float4 CellGreen(VolumeCell cell) { return asfloat(cell.green & kUpper); }
float4 CellBlue(VolumeCell cell) { return asfloat(cell.red << 21 | (cell.green & ~kUpper) << 10); }

// Weighted sums over cells: mean and slope of each colour.
struct VolumeLight {
  float4 red;
  float4 green;
  float4 blue;
  float weight;  // divide the sums by it; 0: nothing is stored here
};

StructuredBuffer<uint> volume_bricks : register(t0, space3);  // a brick's first cell, or kNoBrick
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

// Trilinear interpolation of the eight cells about a point, without those in solids or not stored.
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
    // Negative coordinates wrap to large ones, which are outside.
    if (!LoadVolumeCell(uint3(int3(corner)) + offset, volume.bricks, cell)) continue;
    const float3 share = select(offset != 0, part, 1.0 - part);
    AddVolumeCell(sum, cell, share.x * share.y * share.z);
  }
  // A weight that is mere rounding error must not become a divisor.
  if (sum.weight < 1e-3) sum.weight = 0.0;
  return sum;
}

// Only the cell that contains the point; weight 0 if it is in a solid, not stored or outside.
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

// Light stored for `direction`: the mean plus `slope_scale` times the directional part, or the
// sky's where nothing is stored. `jitter`, uniform in -0.5..0.5 along each axis, picks a single
// cell with the probability of its trilinear weight; if that cell is empty, all eight are read.
// Averaged over jitters the result is that of all eight cells, for a quarter of the work. [Pharr et
// al. 2024, Filtering After Shading with Stochastic Texture Filtering]
static const float3 kEveryCell = float3(1, 1, 1);  // as a jitter: reads all eight, without noise

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

// Irradiance / pi on a surface, which is what a white diffuse surface reflects. The cosine keeps
// 2/3 of the slope. [Ramamoorthi & Hanrahan 2001]
float3 VolumeIrradiance(float3 position, float3 jitter, float3 normal) {
  return VolumeTowards(position, jitter, normal, 2.0 / 3.0);
}

// The same two for a surface. They read half a cell off it, so that cells behind it count less.
float3 VolumeIrradianceAt(float3 position, float3 jitter, float3 normal) {
  return VolumeIrradiance(position + normal * (0.5 * volume_constants[0].cell), jitter, normal);
}
float3 VolumeRadianceAt(float3 position, float3 jitter, float3 normal, float3 direction) {
  return VolumeRadiance(position + normal * (0.5 * volume_constants[0].cell), jitter, direction);
}

#endif
