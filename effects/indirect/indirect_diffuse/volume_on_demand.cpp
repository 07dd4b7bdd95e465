// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/volume_on_demand.h"

#include <chrono>
#include <utility>

#include "effects/indirect/indirect_diffuse/cell_filter.h"

namespace kaamos::effects {

rtapi::Result<VolumeOnDemand> VolumeOnDemand::create(const BakeScope& scope, const BakeDesc& desc,
                                                     IndirectVolume volume) {
  auto baker = VolumeBaker::create(scope, desc, places_of(volume, volume.cells_in_use()));
  if (!baker) return baker.error();
  return VolumeOnDemand(std::move(volume), desc, std::move(*baker));
}

VolumeOnDemand::VolumeOnDemand(IndirectVolume volume, const BakeDesc& desc, VolumeBaker baker)
    : volume_(std::move(volume)),
      desc_(desc),
      cells_(volume_.cells_in_use()),
      baker_(std::move(baker)),
      sums_(2 * cells_.size()) {
  for (const std::uint32_t cell : cells_) volume_.cells[cell].validity = 1;
}

std::vector<std::uint32_t> VolumeOnDemand::missing(const std::vector<std::uint32_t>& reads) const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    if (reads[cells_[i]] > 0 && baker_.samples()[2 * i] == 0) out.push_back(i);
  }
  return out;
}

rtapi::Result<Outcome> VolumeOnDemand::bake(const std::vector<std::uint32_t>& reads,
                                            const glm::dvec3& origin, const StepCallback& progress,
                                            std::uint32_t& baked) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::uint32_t> cells = missing(reads);
  baked = static_cast<std::uint32_t>(cells.size());
  if (cells.empty()) return Outcome::kDone;
  std::vector<std::uint32_t> wanted = baker_.samples();
  for (const std::uint32_t cell : cells) {
    wanted[2 * cell] = (desc_.samples + 1) / 2;
    wanted[2 * cell + 1] = desc_.samples / 2;
  }
  baker_.see(origin);
  if (const auto s = baker_.see_around(cells); !s) return s.error();
  if (const auto s = baker_.trace(wanted, progress); !is_done(s)) return s;
  auto sums = baker_.sums();
  if (!sums) return sums.error();
  sums_ = std::move(*sums);
  for (const std::uint32_t cell : cells) {
    volume_.cells[cells_[cell]] = cell_of(&sums_[2 * cell], &baker_.samples()[2 * cell], true);
  }
  const auto took = std::chrono::steady_clock::now() - start;
  seconds_ += std::chrono::duration<double>(took).count();
  return Outcome::kDone;
}

rtapi::Result<IndirectVolume> VolumeOnDemand::known() const {
  const auto seen = baker_.seen();
  if (!seen) return seen.error();
  IndirectVolume out = volume_;
  filter_cells({cells_, *seen, baker_.samples(), sums_}, out);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (baker_.samples()[2 * i] == 0) out.cells[cells_[i]] = {};
  }
  fill_solids(out);
  return out;
}

BakeStatistics VolumeOnDemand::statistics() const {
  BakeStatistics out = bake_statistics(sums_, baker_.samples(), desc_);
  out.bytes = volume_bytes(volume_);
  out.seconds = seconds_;
  return out;
}

}  // namespace kaamos::effects
