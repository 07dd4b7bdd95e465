// SPDX-License-Identifier: MIT
/// @file
/// A volume of which only those cells are baked that rays read.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/indirect/indirect_diffuse/volume_baker.h"

namespace kaamos::effects {

/// Bakes what was read and holds nothing yet, each cell by the same few paths, and takes the noise
/// out by filter_cells. To give more paths to what varies more was no gain: it made the picture
/// darker, because what is bright and was missed got fewer.
class VolumeOnDemand {
 public:
  /// For a volume that layout_volume made; a cell that was read gets `desc.samples` paths.
  /// @errors those of the device.
  static rtapi::Result<VolumeOnDemand> create(const BakeScope& scope, const BakeDesc& desc,
                                              IndirectVolume volume);

  /// Bakes the cells that were read and hold nothing yet, and says how many they were. `reads` is
  /// how often each of IndirectVolume::cells was read; `origin` that of the frame, world space.
  /// After kStopped it holds nothing of use.
  /// @errors those of the device.
  rtapi::Result<Outcome> bake(const std::vector<std::uint32_t>& reads, const glm::dvec3& origin,
                              const StepCallback& progress, std::uint32_t& baked);

  /// The volume as far as it is known, filtered: cells that were never read hold the light of those
  /// around them, as cells in solids do.
  /// @errors those of the device.
  rtapi::Result<IndirectVolume> known() const;
  /// The volume for finding out what is read: cells that were never read count as cells in the
  /// open, so that what reads them reads no others in their place.
  const IndirectVolume& asking() const { return volume_; }
  /// The cost and the quality of all that was baked, before it is filtered.
  BakeStatistics statistics() const;

 private:
  VolumeOnDemand(IndirectVolume volume, const BakeDesc& desc, VolumeBaker baker);
  // The cells of `cells_` that were read and hold nothing yet.
  std::vector<std::uint32_t> missing(const std::vector<std::uint32_t>& reads) const;

  IndirectVolume volume_;
  BakeDesc desc_;
  std::vector<std::uint32_t> cells_;  // in use
  VolumeBaker baker_;
  std::vector<CellSums> sums_;  // by half
  double seconds_ = 0;
};

}  // namespace kaamos::effects
