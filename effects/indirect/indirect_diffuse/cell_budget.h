// SPDX-License-Identifier: MIT
/// @file
/// Decides how many paths each cell of a volume needs while it is baked.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

/// Sums over the samples of half a cell. Mirrors CellSums of volume_bake.hlsl.
struct CellSums {
  glm::vec3 mean{0.0f};         ///< radiance
  float back_faces = 0;         ///< samples whose ray hit a back face first
  glm::vec3 slope_x{0.0f};      ///< as in VolumeCell
  float luminance_squared = 0;  ///< of the radiance
  glm::vec3 slope_y{0.0f};      ///< as in VolumeCell
  float padding0 = 0;           ///< 0
  glm::vec3 slope_z{0.0f};      ///< as in VolumeCell
  float padding1 = 0;           ///< 0
};
static_assert(sizeof(CellSums) == 64);

/// The luminance of a radiance, as the samples of a bake count it.
double luminance(const glm::vec3& radiance);

/// Samples that every half of a cell gets before the number of the others is decided.
inline constexpr std::uint32_t kPilotSamples = 32;
/// A cell that sees back faces in more than this part of its directions lies in a solid.
inline constexpr float kMaxBackFaces = 0.25f;

/// The number of samples of each half: `cells` as in IndirectVolume::cells_in_use, `pilot` two for
/// each, of kPilotSamples samples. At least as many as these, at most half of `desc.samples`. A
/// half's number does not depend on its own samples, so it does not bias their mean; it follows
/// from the other half and the cells around, which seldom all miss what is bright and hard to find.
std::vector<std::uint32_t> samples_of_halves(const std::vector<std::uint32_t>& cells,
                                             const std::vector<CellSums>& pilot,
                                             const BakeDesc& desc);

/// Returns what a bake of these sums took, without its time. Cells without samples do not count.
BakeStatistics bake_statistics(const std::vector<CellSums>& sums,
                               const std::vector<std::uint32_t>& samples, const BakeDesc& desc);

}  // namespace kaamos::effects
