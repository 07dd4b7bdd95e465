// SPDX-License-Identifier: MIT
/// @file
/// Path traces cells of a volume on a device.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "effects/engine/pass_views.h"
#include "effects/engine/ray_pass.h"
#include "effects/indirect/indirect_diffuse/cell_budget.h"
#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

/// The cells around a cell, of its size, that see_around looks for: 13 of 26, which come behind it
/// in the order of a brick's cells. Mirrors SeeRayGen of volume_bake.hlsl.
///@{
inline constexpr std::uint32_t kSeenCells = 13;
constexpr glm::ivec3 seen_offset(std::uint32_t bit) {
  const auto at = static_cast<int>(14 + bit);  // of 3 x 3 x 3
  return {at % 3 - 1, at / 3 % 3 - 1, at / 9 - 1};
}
///@}

/// The sums of some cells, to which paths can be added at any time. Each cell has two halves, which
/// have sums of their own: 2 c and 2 c + 1.
class VolumeBaker {
 public:
  /// For these cells, at least one. No sum has samples yet.
  /// @errors those of the device.
  static rtapi::Result<VolumeBaker> create(const BakeScope& scope, const BakeDesc& desc,
                                           std::vector<CellPlace> cells);
  /// Follows the frame's origin, world space. Once before anything is traced.
  void see(const glm::dvec3& origin);
  /// Brings each half to as many samples as `wanted` says, in steps that take some tenths of a
  /// second; those that have as many stay as they are. After kStopped the sums are of no use.
  /// @errors those of the device.
  rtapi::Result<Outcome> trace(const std::vector<std::uint32_t>& wanted,
                               const StepCallback& progress);
  /// Finds the cells around these cells that can be seen from them; all others keep what they have
  /// in seen().
  /// @errors those of the device.
  rtapi::Status see_around(const std::vector<std::uint32_t>& cells);
  /// By cell: bit i is set if the cell at seen_offset(i) from it can be seen; 0 before see_around.
  /// @errors those of the device.
  rtapi::Result<std::vector<std::uint32_t>> seen() const;
  /// By half: the samples that it has.
  const std::vector<std::uint32_t>& samples() const { return samples_; }
  /// By half: the sums of its samples.
  /// @errors those of the device.
  rtapi::Result<std::vector<CellSums>> sums() const;

 private:
  VolumeBaker(const BakeScope& scope, const BakeDesc& desc) : scope_(scope), desc_(desc) {}
  rtapi::Status create_buffers();
  rtapi::Status create_views();
  // Executes a pass over the first `count` tasks, which have `done` of the samples that they need
  // and get `samples` more at most.
  rtapi::Status run(const RayPass& pass, std::uint32_t count, std::uint32_t done,
                    std::uint32_t samples);

  BakeScope scope_;
  BakeDesc desc_;
  std::vector<CellPlace> cells_;
  std::vector<std::uint32_t> samples_;
  rtapi::Buffer centers_, lights_, tasks_, sums_, seen_;
  PassViews views_;
  RayPass pass_;
  std::optional<RayPass> see_pass_;  // made when it is needed first
  rtapi::CommandList list_;
};

/// The places of some cells of a volume.
std::vector<CellPlace> places_of(const IndirectVolume& volume,
                                 const std::vector<std::uint32_t>& cells);

/// The cell of two halves, of which each has sums and a number of samples. `by_samples`: both
/// halves count as much as they have samples; else by half each, because a half whose number of
/// samples was decided by the other one would count too much by its size.
VolumeCell cell_of(const CellSums* sums, const std::uint32_t* samples, bool by_samples);

}  // namespace kaamos::effects
