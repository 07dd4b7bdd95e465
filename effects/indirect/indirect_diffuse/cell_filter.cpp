// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/cell_filter.h"

#include <algorithm>

#include "effects/indirect/indirect_diffuse/volume_baker.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// Two cells that can see each other, and the square of their distance in cells.
struct Pair {
  std::uint32_t a, b;
  double square_distance;
};

// One number for the mean of a cell, one for each of its slopes.
struct Parts {
  double mean = 0, slope = 0;
};

class CellFilter {
 public:
  CellFilter(const BakedCells& baked, IndirectVolume& volume)
      : baked_(baked),
        volume_(volume),
        count_(baked.cells.size()),
        variances_(count_),
        changes_(count_) {
    find_pairs();
    estimate_variances();
    estimate_changes();
  }

  void run() {
    std::vector<Sum> sums(count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (is_valid(i)) sums[i].add(cell(i), weight(i, i, 0));
    }
    for (const Pair& pair : pairs_) {
      sums[pair.a].add(cell(pair.b), weight(pair.a, pair.b, pair.square_distance));
      sums[pair.b].add(cell(pair.a), weight(pair.b, pair.a, pair.square_distance));
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (is_valid(i)) sums[i].write(volume_.cells[baked_.cells[i]]);
    }
  }

 private:
  // A weighted mean of cells.
  struct Sum {
    glm::dvec3 mean{0.0}, slope_x{0.0}, slope_y{0.0}, slope_z{0.0};
    Parts weights;

    void add(const VolumeCell& cell, const Parts& weight) {
      mean += weight.mean * glm::dvec3(cell.mean);
      slope_x += weight.slope * glm::dvec3(cell.slope_x);
      slope_y += weight.slope * glm::dvec3(cell.slope_y);
      slope_z += weight.slope * glm::dvec3(cell.slope_z);
      weights.mean += weight.mean;
      weights.slope += weight.slope;
    }
    void write(VolumeCell& cell) const {
      cell.mean = glm::vec3(mean / weights.mean);
      cell.slope_x = glm::vec3(slope_x / weights.slope);
      cell.slope_y = glm::vec3(slope_y / weights.slope);
      cell.slope_z = glm::vec3(slope_z / weights.slope);
    }
  };

  // The sum over some pairs of what they differ by.
  struct Change {
    Parts sum;
    double pairs = 0;

    void add(const Change& other) {
      sum.mean += other.sum.mean;
      sum.slope += other.sum.slope;
      pairs += other.pairs;
    }
  };

  const VolumeCell& cell(std::uint32_t i) const { return volume_.cells[baked_.cells[i]]; }
  std::uint32_t samples(std::uint32_t i) const {
    return baked_.samples[2 * i] + baked_.samples[2 * i + 1];
  }
  bool is_valid(std::uint32_t i) const { return samples(i) > 0 && cell(i).validity > 0; }

  // The weight of cell `of` in the mean of cell `in`. Both have the variance of a sample that `in`
  // has: by its own, what is dark, and so varies less, would always count more.
  Parts weight(std::uint32_t in, std::uint32_t of, double square_distance) const {
    constexpr double kLeast = 1e-30;  // where nothing varies, all are alike
    const Parts &variance = variances_[in], &change = changes_[in];
    const double samples_of = samples(of);
    return {1 / std::max(variance.mean / samples_of + square_distance * change.mean, kLeast),
            1 / std::max(variance.slope / samples_of + square_distance * change.slope, kLeast)};
  }

  void find_pairs() {
    std::vector<std::uint32_t> indices(volume_.cells.size(), kNone);
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (is_valid(i)) indices[baked_.cells[i]] = i;
    }
    const std::vector<CellPlace> places = volume_.cell_places();
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!is_valid(i)) continue;
      const CellPlace& place = places[baked_.cells[i]];
      for (std::uint32_t k = 0; k < kSeenCells; ++k) {
        if ((baked_.seen[i] >> k & 1) == 0) continue;
        const glm::dvec3 way = glm::dvec3(seen_offset(k));
        const std::uint32_t found =
            volume_.find(place.middle + static_cast<double>(place.size) * way);
        if (found == kNoBrick || indices[found] == kNone) continue;
        if (places[found].size != place.size) continue;
        pairs_.push_back({i, indices[found], glm::dot(way, way)});
      }
    }
  }

  // Estimates how much a sample of a cell's mean and slopes varies, in luminance. The samples of
  // the cells around count too: a cell that happened to miss what is bright would trust itself too
  // much.
  void estimate_variances() {
    struct Moments {
      double samples = 0, squares = 0;
      double freedom = 0, deviations = 0;  // from each cell's own mean
      void add(const Moments& other) {
        samples += other.samples;
        squares += other.squares;
        freedom += other.freedom;
        deviations += other.deviations;
      }
    };
    std::vector<Moments> own(count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!is_valid(i)) continue;
      const CellSums &a = baked_.sums[2 * i], &b = baked_.sums[2 * i + 1];
      const double count = samples(i), sum = luminance(a.mean) + luminance(b.mean);
      const double squares = static_cast<double>(a.luminance_squared) + b.luminance_squared;
      own[i] = {count, squares, count - 1, std::max(squares - sum * sum / count, 0.0)};
    }
    std::vector<Moments> all = own;
    for (const Pair& pair : pairs_) {
      all[pair.a].add(own[pair.b]);
      all[pair.b].add(own[pair.a]);
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!is_valid(i)) continue;
      // A slope's sample is 3 L d, and d squared is a third on average.
      variances_[i] = {all[i].deviations / std::max(all[i].freedom, 1.0),
                       3 * all[i].squares / all[i].samples};
    }
  }

  // How much the light changes from a cell to the next one, squared: what pairs differ by beyond
  // their noise, over the pairs of a cell and of those around it.
  void estimate_changes() {
    std::vector<Change> own(count_);
    for (const Pair& pair : pairs_) {
      const Change change = change_between(pair);
      own[pair.a].add(change);
      own[pair.b].add(change);
    }
    std::vector<Change> all = own;
    for (const Pair& pair : pairs_) {
      all[pair.a].add(own[pair.b]);
      all[pair.b].add(own[pair.a]);
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (all[i].pairs == 0) continue;
      changes_[i] = {std::max(all[i].sum.mean / all[i].pairs, 0.0),
                     std::max(all[i].sum.slope / all[i].pairs, 0.0)};
    }
  }

  // The variance of the difference of two cells that hold the same light.
  Parts noise_of(const Pair& pair) const {
    const double a = samples(pair.a), b = samples(pair.b);
    return {variances_[pair.a].mean / a + variances_[pair.b].mean / b,
            variances_[pair.a].slope / a + variances_[pair.b].slope / b};
  }

  Change change_between(const Pair& pair) const {
    const VolumeCell &a = cell(pair.a), &b = cell(pair.b);
    const Parts noise = noise_of(pair);
    const auto square = [](const glm::vec3& from, const glm::vec3& to) {
      const double difference = luminance(to) - luminance(from);
      return difference * difference;
    };
    const double slopes =
        square(a.slope_x, b.slope_x) + square(a.slope_y, b.slope_y) + square(a.slope_z, b.slope_z);
    return {{(square(a.mean, b.mean) - noise.mean) / pair.square_distance,
             (slopes / 3 - noise.slope) / pair.square_distance},
            1};
  }

  const BakedCells& baked_;
  IndirectVolume& volume_;
  std::size_t count_;
  std::vector<Pair> pairs_;
  std::vector<Parts> variances_;  // by cell: of a sample
  std::vector<Parts> changes_;    // by cell
};

}  // namespace

void filter_cells(const BakedCells& baked, IndirectVolume& volume) {
  CellFilter(baked, volume).run();
}

}  // namespace kaamos::effects
