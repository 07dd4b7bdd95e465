// SPDX-License-Identifier: MIT
// Bakes every cell of a volume until it is good enough.
#include <algorithm>
#include <chrono>
#include <utility>

#include "effects/indirect/indirect_diffuse/cell_budget.h"
#include "effects/indirect/indirect_diffuse/packed_cell.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/indirect/indirect_diffuse/volume_baker.h"

namespace kaamos::effects {

namespace {

// The pilot's part of the work, as far as progress shows it.
constexpr double kPilotPart = 0.2;

// Part of the work as part of the whole.
StepCallback part_of(const StepCallback& progress, double from, double to) {
  if (!progress) return {};
  return [&progress, from, to](double done) { return progress(from + (to - from) * done); };
}

}  // namespace

rtapi::Result<Outcome> bake_volume(const BakeScope& scope, const glm::dvec3& origin,
                                   const BakeDesc& desc, IndirectVolume& volume,
                                   BakeStatistics* statistics, const StepCallback& progress) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::uint32_t> cells = volume.cells_in_use();
  if (cells.empty()) return Outcome::kDone;
  auto baker = VolumeBaker::create(scope, desc, places_of(volume, cells));
  if (!baker) return baker.error();
  baker->see(origin);

  const bool adapts = desc.error > 0 && desc.samples > 4 * kPilotSamples;
  std::vector<std::uint32_t> wanted(2 * cells.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i] = adapts ? kPilotSamples : (desc.samples + (i % 2 == 0 ? 1 : 0)) / 2;
  }
  const auto pilot = baker->trace(wanted, part_of(progress, 0, adapts ? kPilotPart : 1));
  if (!is_done(pilot)) return pilot;
  auto sums = baker->sums();
  if (!sums) return sums.error();
  if (adapts) {
    wanted = samples_of_halves(cells, *sums, desc);
    const auto done = baker->trace(wanted, part_of(progress, kPilotPart, 1));
    if (!is_done(done)) return done;
    sums = baker->sums();
    if (!sums) return sums.error();
  }
  std::fill(volume.cells.begin(), volume.cells.end(), VolumeCell{});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    volume.cells[cells[i]] = cell_of(&(*sums)[2 * i], &wanted[2 * i], !adapts);
  }
  if (statistics != nullptr) {
    *statistics = bake_statistics(*sums, wanted, desc);
    statistics->bytes = volume_bytes(volume);
    const auto took = std::chrono::steady_clock::now() - start;
    statistics->seconds = std::chrono::duration<double>(took).count();
  }
  fill_solids(volume);
  return Outcome::kDone;
}

}  // namespace kaamos::effects
