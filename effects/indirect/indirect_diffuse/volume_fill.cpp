// SPDX-License-Identifier: MIT
// Light for the cells in solids, from those around them.
#include <algorithm>
#include <span>

#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

namespace {

// Visits the cells of a volume as an octree: each node is a cell of some level, either one that is
// stored or the eight of the next finer level.
class Filler {
 public:
  explicit Filler(IndirectVolume& volume) : volume_(volume) {}

  void fill() {
    std::uint32_t level = 0;  // of the one cell that holds everything
    const std::uint32_t longest =
        std::max({volume_.bricks.x, volume_.bricks.y, volume_.bricks.z}) * kBrickCells;
    while ((1u << level) < longest) ++level;
    mean_of(level, glm::uvec3(0));
  }

 private:
  // The mean of the valid cells within a node; its validity is the part of the node that they take.
  // Cells in solids within the node get it.
  VolumeCell mean_of(std::uint32_t level, const glm::uvec3& node) {
    const glm::uvec3 brick = (node << level) / kBrickCells;
    if (glm::any(glm::greaterThanEqual(brick, volume_.bricks))) return {};
    const std::uint32_t entry =
        volume_.brick_starts[brick.x + volume_.bricks.x *
                                           (brick.y + std::size_t{volume_.bricks.y} * brick.z)];
    if (entry == kNoBrick && level <= 3) return {};  // a brick has 2^3 cells along each axis
    if (entry != kNoBrick && brick_level(entry) == level) return stored(entry, node);
    const std::size_t first = pending_.size();
    VolumeCell sum;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const glm::uvec3 offset(i & 1, i >> 1 & 1, i >> 2);
      add(mean_of(level - 1, node * 2u + offset), sum);
    }
    if (!(sum.validity > 0)) return {};
    const float scale = 1.0f / sum.validity;
    for (glm::vec3* part : {&sum.mean, &sum.slope_x, &sum.slope_y, &sum.slope_z}) *part *= scale;
    for (const std::uint32_t cell : std::span(pending_).subspan(first)) {
      volume_.cells[cell] = sum;
      volume_.cells[cell].validity = 0;
    }
    pending_.resize(first);
    sum.validity /= 8;
    return sum;
  }

  VolumeCell stored(std::uint32_t entry, const glm::uvec3& node) {
    const glm::uvec3 place = node % kBrickCells;
    const std::uint32_t index =
        brick_start(entry) + place.x + kBrickCells * (place.y + kBrickCells * place.z);
    if (volume_.cells[index].validity > 0) return volume_.cells[index];
    volume_.cells[index] = {};
    pending_.push_back(index);
    return {};
  }

  static void add(const VolumeCell& cell, VolumeCell& sum) {
    sum.validity += cell.validity;
    sum.mean += cell.validity * cell.mean;
    sum.slope_x += cell.validity * cell.slope_x;
    sum.slope_y += cell.validity * cell.slope_y;
    sum.slope_z += cell.validity * cell.slope_z;
  }

  IndirectVolume& volume_;
  std::vector<std::uint32_t> pending_;  // cells in solids that have no light yet
};

}  // namespace

void fill_solids(IndirectVolume& volume) {
  if (!volume.cells.empty()) Filler(volume).fill();
}

}  // namespace kaamos::effects
