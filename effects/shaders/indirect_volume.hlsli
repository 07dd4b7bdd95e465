// SPDX-License-Identifier: MIT
// Indirect light, stored in the cells of a sparse volume: per cell and colour a mean and a slope
// over directions (spherical harmonics up to degree 1). Cells are small where there is geometry and
// larger away from it, so that every place of the scene has one. [Northlight deck: GI Data in
// Sparse Volume Texture]
#ifndef KAAMOS_INDIRECT_VOLUME_HLSLI
#define KAAMOS_INDIRECT_VOLUME_HLSLI

#include "frame.hlsli"

// effects/indirect/indirect_diffuse/volume.h has the same layouts and binds all three buffers to a pass.
struct VolumeConstants {
  float3 origin;    // of the corner of cell (0, 0, 0), relative to the camera
  float cell;       // metres, of the finest cells (level 0)
  uint3 bricks;     // of level 0 along each axis of the grid
  uint enabled;     // 0: there is no volume
  float over_cell;  // 1 / cell
  uint counts_reads;  // 1: volume_reads is there, and counts
};

// Radiance from a unit direction d, per colour: mean + slope.x d.x + slope.y d.y + slope.z d.z.
//
// A cell has 32 bytes, two to a cache line, because rays end anywhere and read cells from memory.
// The upper 21 bits of a word are the top of a red (or green) float; the lower 11 bits are one half
// of blue's upper 22: sign, exponent and 12 or 13 bits of mantissa. Light is never negative, so the
// sign of red's mean marks a cell inside a solid. Such a cell holds the light of cells around it.
// effects/indirect/indirect_diffuse/packed_cell.h is the same for the host.
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

// By place in the grid of level 0: where the cells of the brick that is stored there start, plus the
// brick's level; or kNoBrick. The cells of level n are 2^n times as large as those of level 0.
StructuredBuffer<uint> volume_bricks : register(t0, space3);
StructuredBuffer<VolumeCell> volume_cells : register(t1, space3);
StructuredBuffer<VolumeConstants> volume_constants : register(t2, space3);
// By cell: how often it was read. The bake gives most paths to the cells that are read most.
RWStructuredBuffer<uint> volume_reads : register(u15, space3);

static const uint kBrickCells = 8;  // along each axis
static const uint kNoBrick = 0xFFFFFFFF;
static const uint kBrickLevelBits = 0x1FF;  // bricks start at multiples of 8 x 8 x 8 cells

// Further away, in cells of level 0, the conversion to integers would overflow.
static const float kFarthestCell = 1e9;

// The brick that is stored at a cell of level 0; kNoBrick outside of the grid, too.
uint FindBrick(uint3 cell, uint3 bricks) {
  // Negative coordinates wrap to large ones, which are outside.
  if (any(cell >= bricks * kBrickCells)) return kNoBrick;
  const uint3 brick = cell / kBrickCells;
  return volume_bricks[brick.x + bricks.x * (brick.y + bricks.y * brick.z)];
}

uint BrickLevel(uint brick) { return brick & kBrickLevelBits; }

// The size of a brick's cells in cells of level 0: 2 to the power of its level.
float BrickCellSize(uint brick) { return asfloat((127 + BrickLevel(brick)) << 23); }

// Reads the cell of a brick that contains a cell of level 0.
VolumeCell LoadVolumeCell(uint brick, uint3 cell) {
  const uint3 place = (cell >> BrickLevel(brick)) % kBrickCells;
  const uint index = (brick & ~kBrickLevelBits) + place.x +
                     kBrickCells * (place.y + kBrickCells * place.z);
  if (volume_constants[0].counts_reads != 0) InterlockedAdd(volume_reads[index], 1u);
  return volume_cells[index];
}

bool IsInSolid(VolumeCell cell) { return int(cell.red.x) < 0; }

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

// Trilinear interpolation of the eight cells about `at`, given in cells of level 0, without those in
// solids unless `with_solids`. The point's own brick sets the distance of the eight. Where a
// neighbouring brick is finer, a single one of its cells stands for the eighth: the one in the
// middle of the part of a cell-sized box about the point that lies there.
VolumeLight InterpolateVolume(float3 at, float size, uint3 bricks, bool with_solids) {
  VolumeLight sum = NoVolumeLight();
  const float3 middle = floor(at / size + 0.5) * size;  // the corner that the eight share
  const float3 part = (at - middle) / size + 0.5;
  for (uint i = 0; i < 8; ++i) {
    const float3 side = float3(i & 1, (i >> 1) & 1, i >> 2);
    const uint3 cell = uint3(int3(floor(middle + (0.5 * size) * (part + side - 1.0))));
    const uint brick = FindBrick(cell, bricks);
    if (brick == kNoBrick) continue;
    VolumeCell stored = LoadVolumeCell(brick, cell);
    if (IsInSolid(stored)) {
      if (!with_solids) continue;
      stored.red.x &= 0x7FFFFFFF;
    }
    const float3 share = abs(side + part - 1.0);
    AddVolumeCell(sum, stored, share.x * share.y * share.z);
  }
  // A weight that is mere rounding error must not become a divisor.
  if (sum.weight < 1e-3) sum.weight = 0.0;
  return sum;
}

// The eight cells about a point; weight 0 outside of the volume.
VolumeLight SampleVolume(float3 position) {
  const VolumeConstants volume = volume_constants[0];
  const float3 at = (position - volume.origin) * volume.over_cell;
  if (volume.enabled == 0 || any(abs(at) > kFarthestCell)) return NoVolumeLight();
  const uint brick = FindBrick(uint3(int3(floor(at))), volume.bricks);
  const float size = brick == kNoBrick ? 1.0 : BrickCellSize(brick);
  VolumeLight light = InterpolateVolume(at, size, volume.bricks, false);
  // All of them in solids: what those hold is better than the sky.
  if (light.weight == 0.0 && brick != kNoBrick) {
    light = InterpolateVolume(at, size, volume.bricks, true);
  }
  return light;
}

// Only the cell at the point plus `jitter` cells; weight 0 if it is in a solid or outside of the
// volume.
VolumeLight SampleVolumeCell(float3 position, float3 jitter) {
  VolumeLight light = NoVolumeLight();
  const VolumeConstants volume = volume_constants[0];
  const float3 at = (position - volume.origin) * volume.over_cell;
  if (volume.enabled == 0 || any(abs(at) > kFarthestCell)) return light;
  uint3 cell = uint3(int3(floor(at + jitter)));
  uint brick = FindBrick(cell, volume.bricks);
  if (BrickLevel(brick) != 0 && brick != kNoBrick) {
    cell = uint3(int3(floor(at + jitter * BrickCellSize(brick))));
    brick = FindBrick(cell, volume.bricks);
  }
  if (brick == kNoBrick) return light;
  const VolumeCell stored = LoadVolumeCell(brick, cell);
  if (!IsInSolid(stored)) AddVolumeCell(light, stored, 1.0);
  return light;
}

// Light from a direction, of a mean and a slope over directions. A slope steeper than the mean would
// make it negative on one side. Cut off there, it would have more light than the cell has, the more
// the noisier the cell is. A power of the cosine, shifted to 0..1, keeps mean and slope; it is the
// linear one where that just reaches 0. Its highest power is 4, so a cell that a single bright path
// has reached is at most five times as bright as its mean.
static const float kSteepestSlope = 2.0;  // times the mean

float LightTowards(float4 light, float3 direction, float slope_scale) {
  const float slope = length(light.yzw);
  const float scaled = slope_scale * slope;
  if (!(light.x > 0.0)) return 0.0;
  if (scaled <= light.x) return light.x + slope_scale * dot(light.yzw, direction);
  const float mean_cosine = min(scaled, kSteepestSlope * light.x) / (3.0 * light.x);
  const float power = 2.0 * mean_cosine / (1.0 - mean_cosine);
  const float towards = saturate(0.5 + 0.5 * dot(light.yzw, direction) / slope);
  return light.x * (power + 1.0) * pow(towards, power);
}

// Light stored for `direction`: the mean plus `slope_scale` times the directional part, or the
// sky's outside of the volume. `jitter`, uniform in -0.5..0.5 along each axis, picks a single cell
// with the probability of its trilinear weight; if that cell is in a solid, all eight are read.
// Averaged over jitters the result is that of all eight cells, for a quarter of the work. [Pharr et
// al. 2024, Filtering After Shading with Stochastic Texture Filtering]
static const float3 kEveryCell = float3(1, 1, 1);  // as a jitter: reads all eight, without noise

float3 VolumeTowards(float3 position, float3 jitter, float3 direction, float slope_scale) {
  VolumeLight light;
  light.weight = 0.0;
  if (jitter.x < kEveryCell.x) light = SampleVolumeCell(position, jitter);
  if (light.weight == 0.0) light = SampleVolume(position);
  if (light.weight == 0.0) return SkyTowards(direction);
  const float over_weight = 1.0 / light.weight;
  return float3(LightTowards(light.red * over_weight, direction, slope_scale),
                LightTowards(light.green * over_weight, direction, slope_scale),
                LightTowards(light.blue * over_weight, direction, slope_scale));
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
