// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/cell_budget.h"

#include <algorithm>
#include <cmath>

namespace kaamos::effects {

namespace {

// In the dark, errors count relative to this part of the volume's mean.
constexpr double kDarkPart = 0.25;
// Most of a cell's directions see back faces: no more samples will change that it is in a solid.
constexpr float kSurelySolid = 0.5f;

// The luminance of some samples, as far as it is known.
struct Spread {
  double mean = 0, variance = 0;  // of one sample
};

Spread spread_of(const CellSums& sums, double samples) {
  if (samples < 1) return {};
  const double mean = luminance(sums.mean) / samples;
  const double squares = static_cast<double>(sums.luminance_squared) / samples - mean * mean;
  return {mean, std::max(squares, 0.0) * samples / std::max(samples - 1, 1.0)};
}

bool is_solid(const CellSums& a, const CellSums& b, double samples, float part = kMaxBackFaces) {
  return a.back_faces + b.back_faces > part * static_cast<float>(samples);
}

// The mean luminance of the cells that are not in solids.
double mean_luminance(const std::vector<CellSums>& sums,
                      const std::vector<std::uint32_t>& samples) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i + 1 < sums.size(); i += 2) {
    const double all = static_cast<double>(samples[i]) + samples[i + 1];
    if (all == 0 || is_solid(sums[i], sums[i + 1], all)) continue;
    sum += luminance(sums[i].mean + sums[i + 1].mean) / all;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// Means of the pilot's halves over the cells around each one.
class Neighbours {
 public:
  Neighbours(const std::vector<std::uint32_t>& cells, const std::vector<CellSums>& pilot)
      : cells_(cells),
        pilot_(pilot),
        places_(cells.back() / kCellsPerBrick * kCellsPerBrick + kCellsPerBrick, kNone) {
    for (std::uint32_t i = 0; i < cells.size(); ++i) places_[cells[i]] = i;
    for (const CellSums& sums : pilot) spreads_.push_back(spread_of(sums, kPilotSamples));
  }

  const Spread& half(std::size_t i) const { return spreads_[i]; }

  // Over the cells of the brick next to half `half`'s, and its own other half; not over cells in
  // solids.
  Spread around(std::size_t half) const {
    const std::uint32_t cell = cells_[half / 2];
    const std::uint32_t start = cell / kCellsPerBrick * kCellsPerBrick;
    const glm::ivec3 at(cell % kBrickCells, cell / kBrickCells % kBrickCells,
                        cell % kCellsPerBrick / (kBrickCells * kBrickCells));
    const glm::ivec3 low = glm::max(at - 1, glm::ivec3(0));
    const glm::ivec3 high = glm::min(at + 1, glm::ivec3(kBrickCells - 1));
    Spread sum = spreads_[half ^ 1];
    double count = 1;
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          const std::uint32_t i =
              places_[start +
                      static_cast<std::uint32_t>(x + static_cast<int>(kBrickCells) *
                                                         (y + static_cast<int>(kBrickCells) * z))];
          if (i == kNone || i == half / 2) continue;
          if (is_solid(pilot_[2 * i], pilot_[2 * i + 1], 2 * kPilotSamples)) continue;
          for (const Spread& s : {spreads_[2 * i], spreads_[2 * i + 1]}) {
            sum.mean += s.mean;
            sum.variance += s.variance;
            ++count;
          }
        }
      }
    }
    return {sum.mean / count, sum.variance / count};
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  const std::vector<std::uint32_t>& cells_;
  const std::vector<CellSums>& pilot_;
  std::vector<std::uint32_t> places_;  // by place in the volume: in cells_
  std::vector<Spread> spreads_;        // by half
};

}  // namespace

double luminance(const glm::vec3& radiance) {
  return glm::dot(glm::dvec3(radiance), glm::dvec3(0.2126, 0.7152, 0.0722));
}

std::vector<std::uint32_t> samples_of_halves(const std::vector<std::uint32_t>& cells,
                                             const std::vector<CellSums>& pilot,
                                             const BakeDesc& desc) {
  std::vector<std::uint32_t> samples(pilot.size(), kPilotSamples);
  const double dark = kDarkPart * mean_luminance(pilot, samples);
  const Neighbours neighbours(cells, pilot);
  for (std::size_t i = 0; i < pilot.size(); ++i) {
    const CellSums& other = pilot[i ^ 1];
    if (is_solid(other, {}, kPilotSamples, kSurelySolid)) continue;
    const Spread& own = neighbours.half(i ^ 1);
    const Spread around = neighbours.around(i);
    const double variance = std::max(own.variance, around.variance);
    const double allowed =
        static_cast<double>(desc.error) * std::max(std::min(own.mean, around.mean), dark);
    const double most = desc.samples / 2;
    // Both halves together have twice the samples.
    const double wanted = variance > 0 ? variance / (2 * allowed * allowed) : 0;
    samples[i] = static_cast<std::uint32_t>(
        std::clamp(std::ceil(wanted), static_cast<double>(kPilotSamples), most));
  }
  return samples;
}

BakeStatistics bake_statistics(const std::vector<CellSums>& sums,
                               const std::vector<std::uint32_t>& samples, const BakeDesc& desc) {
  BakeStatistics out;
  const double dark = kDarkPart * mean_luminance(sums, samples);
  double squares = 0;
  for (std::size_t i = 0; i + 1 < sums.size(); i += 2) {
    const std::uint64_t all = std::uint64_t{samples[i]} + samples[i + 1];
    if (all == 0) continue;
    ++out.cells;
    out.paths += all;
    if (is_solid(sums[i], sums[i + 1], static_cast<double>(all))) {
      ++out.in_solids;
      continue;
    }
    if (all < desc.samples) ++out.at_bound;
    double mean = 0, variance = 0;  // of the mean of both halves
    for (const std::size_t half : {i, i + 1}) {
      if (samples[half] == 0) continue;
      const Spread spread = spread_of(sums[half], samples[half]);
      mean += 0.5 * spread.mean;
      variance += 0.25 * spread.variance / samples[half];
    }
    const double scale = std::max(mean, dark);
    if (scale > 0) squares += variance / (scale * scale);
  }
  const double counted = static_cast<double>(out.cells - out.in_solids);
  out.error = counted > 0 ? std::sqrt(squares / counted) : 0;
  return out;
}

}  // namespace kaamos::effects
