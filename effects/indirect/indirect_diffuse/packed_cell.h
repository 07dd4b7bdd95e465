// SPDX-License-Identifier: MIT
/// @file
/// A cell of the volume as shaders read it, in half the size of VolumeCell.
#pragma once

#include <array>
#include <cstdint>

#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

/// Mirrors VolumeCell of indirect_volume.hlsli, which says what stands where. Each word: mean,
/// slope along x, y, z.
struct PackedCell {
  /// Words of the channels; blue lies in the bits that these leave.
  ///@{
  std::array<std::uint32_t, 4> red{};
  std::array<std::uint32_t, 4> green{};
  ///@}
};
static_assert(sizeof(PackedCell) == 32);

/// Every value to the nearest that there is: within 2^-13 of its size. Means below zero become
/// zero; values beyond the largest, infinities too, become that.
PackedCell pack_cell(const VolumeCell& cell);

/// Returns the cell that shaders make of it.
VolumeCell unpack_cell(const PackedCell& cell);

}  // namespace kaamos::effects
