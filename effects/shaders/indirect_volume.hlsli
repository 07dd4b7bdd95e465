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

// Radiance towards a unit direction d: mean + slope_x d.x + slope_y d.y + slope_z d.z.
struct VolumeCell {
  float3 mean;
  float validity;  // 0: the cell lies in a solid
  float3 slope_x;
  float padding0;
  float3 slope_y;
  float padding1;
  float3 slope_z;
  float padding2;
};

StructuredBuffer<uint> volume_bricks : register(t0, space3);  // where a brick's cells start; kNoBrick
StructuredBuffer<VolumeCell> volume_cells : register(t1, space3);
StructuredBuffer<VolumeConstants> volume_constants : register(t2, space3);

static const int kBrickCells = 8;  // along each axis
static const uint kNoBrick = 0xFFFFFFFF;

// The cell's index, or kNoBrick where nothing is stored.
uint VolumeIndex(VolumeConstants volume, int3 cell) {
  const int3 cells = int3(volume.bricks) * kBrickCells;
  if (any(cell < int3(0, 0, 0)) || any(cell >= cells)) return kNoBrick;
  const uint3 brick = uint3(cell / kBrickCells);
  const uint start = volume_bricks[(brick.z * volume.bricks.y + brick.y) * volume.bricks.x + brick.x];
  if (start == kNoBrick) return kNoBrick;
  const uint3 inside = uint3(cell % kBrickCells);
  return start + (inside.z * kBrickCells + inside.y) * kBrickCells + inside.x;
}

// Eight cells about a point, those in solids and those not stored left out. weight: how much of the
// eight was there; 0: nothing is known here.
VolumeCell SampleVolume(float3 position, out float weight) {
  VolumeCell sum;
  sum.mean = sum.slope_x = sum.slope_y = sum.slope_z = float3(0, 0, 0);
  sum.validity = sum.padding0 = sum.padding1 = sum.padding2 = 0.0;
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
  const bool one_brick = all(low >= int3(0, 0, 0)) &&
                         all(low % kBrickCells < int3(kBrickCells - 1, kBrickCells - 1, kBrickCells - 1));
  const uint first = one_brick ? VolumeIndex(volume, low) : 0;
  if (first == kNoBrick) return sum;
  for (int i = 0; i < 8; ++i) {
    const int3 offset = int3(i & 1, (i >> 1) & 1, i >> 2);
    const uint index = one_brick ? first + uint((offset.z * kBrickCells + offset.y) * kBrickCells + offset.x)
                                 : VolumeIndex(volume, low + offset);
    if (index == kNoBrick) continue;
    const VolumeCell cell = volume_cells[index];
    const float w = (offset.x == 1 ? part.x : 1.0 - part.x) * (offset.y == 1 ? part.y : 1.0 - part.y) *
                    (offset.z == 1 ? part.z : 1.0 - part.z) * cell.validity;
    sum.mean += w * cell.mean;
    sum.slope_x += w * cell.slope_x;
    sum.slope_y += w * cell.slope_y;
    sum.slope_z += w * cell.slope_z;
    weight += w;
  }
  // Only weights that are more than rounding are worth dividing by.
  if (weight < 1e-3) {
    weight = 0.0;
    return sum;
  }
  sum.mean /= weight;
  sum.slope_x /= weight;
  sum.slope_y /= weight;
  sum.slope_z /= weight;
  return sum;
}

// Radiance that arrives at a point from a direction; the sky's where nothing is stored.
float3 VolumeRadiance(float3 position, float3 direction, float3 fallback) {
  float weight;
  const VolumeCell cell = SampleVolume(position, weight);
  if (weight == 0.0) return fallback;
  return max(cell.mean + cell.slope_x * direction.x + cell.slope_y * direction.y +
                 cell.slope_z * direction.z, float3(0, 0, 0));
}

// Irradiance over pi on a surface: what a white diffuse surface sends back.
float3 VolumeIrradiance(float3 position, float3 normal, float3 fallback) {
  float weight;
  const VolumeCell cell = SampleVolume(position, weight);
  if (weight == 0.0) return fallback;
  const float3 slope = cell.slope_x * normal.x + cell.slope_y * normal.y + cell.slope_z * normal.z;
  return max(cell.mean + (2.0 / 3.0) * slope, float3(0, 0, 0));
}

// The same of a surface: half a cell off it, so that the cells behind it count less.
float3 VolumeIrradianceAt(float3 position, float3 normal, float3 fallback) {
  return VolumeIrradiance(position + normal * (0.5 * volume_constants[0].cell), normal, fallback);
}

#endif
