// SPDX-License-Identifier: MIT
/// @file
/// Takes noise out of baked cells.
#pragma once

#include <cstdint>
#include <vector>

#include "effects/indirect/indirect_diffuse/cell_budget.h"
#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

/// Cells of a volume as a bake knows them; all by cell, or two for each, as `cells` has them.
struct BakedCells {
  const std::vector<std::uint32_t>& cells;    ///< in IndirectVolume::cells
  const std::vector<std::uint32_t>& seen;     ///< [VolumeBaker::seen]
  const std::vector<std::uint32_t>& samples;  ///< two for each cell; 0: not baked
  const std::vector<CellSums>& sums;          ///< two for each cell
};

/// Averages each cell with those of the 26 around it that have its size and can be seen from it,
/// each by how uncertain it is. A neighbour is uncertain by its own noise and by how much the light
/// changes from cell to cell there, which is what neighbours differ by beyond their noise. So light
/// that changes keeps its edges, and what is well known stays as it is. Cells in solids are left
/// alone, and walls are not averaged across.
void filter_cells(const BakedCells& baked, IndirectVolume& volume);

}  // namespace kaamos::effects
