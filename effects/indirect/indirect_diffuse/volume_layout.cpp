// SPDX-License-Identifier: MIT
// Decides which bricks a volume has.
#include <algorithm>
#include <cmath>

#include "effects/indirect/indirect_diffuse/volume.h"

namespace kaamos::effects {

namespace {

constexpr std::uint64_t kMaxCells = 1u << 24;
// Bricks: what ends at a brick's border does not reach into the next one by rounding, so that the
// same scene in other units has the same bricks.
constexpr double kBorder = 1e-6;

// The bricks of one level, and which of them are stored.
struct Level {
  glm::uvec3 bricks{0};
  std::vector<bool> stored;

  explicit Level(const glm::uvec3& count)
      : bricks(count), stored(std::size_t{count.x} * count.y * count.z) {}
  std::size_t index(const glm::uvec3& brick) const {
    return (std::size_t{brick.z} * bricks.y + brick.y) * bricks.x + brick.x;
  }
  glm::uvec3 brick(std::size_t index) const {
    return {index % bricks.x, index / bricks.x % bricks.y,
            index / (std::size_t{bricks.x} * bricks.y)};
  }
  // All bricks from `from` to `to`, both included, as far as they are in the grid.
  void store(const glm::ivec3& from, const glm::ivec3& to) {
    const glm::ivec3 last = glm::ivec3(bricks) - 1;
    const glm::ivec3 low = glm::clamp(from, glm::ivec3(0), last);
    const glm::ivec3 high = glm::clamp(to, glm::ivec3(0), last);
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) stored[index(glm::uvec3(x, y, z))] = true;
      }
    }
  }
};

// Stores the bricks that the triangles of an instance touch.
void store_instance(const Scene& scene, const Instance& instance, const IndirectVolume& volume,
                    Level& level) {
  const double size = static_cast<double>(volume.cell) * kBrickCells;
  // Two more cells on each side, because surfaces look up half a cell away and between cells, and
  // because larger cells begin there.
  const glm::dvec3 margin(2.0 * volume.cell);
  const Mesh& mesh = scene.meshes[instance.mesh];
  for (const Geometry& geometry : mesh.geometries) {
    for (std::uint32_t i = 0; i + 2 < geometry.index_count; i += 3) {
      Bounds bounds;
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const glm::dvec3 position(mesh.corner(geometry, i / 3, corner).position);
        bounds.add(glm::dvec3(instance.transform * glm::dvec4(position, 1)));
      }
      const glm::dvec3 from = (bounds.min - margin - volume.origin) / size;
      const glm::dvec3 to = (bounds.max + margin - volume.origin) / size;
      level.store(glm::ivec3(glm::floor(from + kBorder)), glm::ivec3(glm::floor(to - kBorder)));
    }
  }
}

// The next level has the parents of all bricks of this one and of their neighbours.
Level coarser(const Level& fine) {
  Level coarse((fine.bricks + 1u) / 2u);
  for (std::size_t i = 0; i < fine.stored.size(); ++i) {
    if (!fine.stored[i]) continue;
    const glm::ivec3 brick(fine.brick(i));
    coarse.store((brick - 1) >> 1, (brick + 1) >> 1);
  }
  return coarse;
}

// The levels from the finest to the one that has a single brick.
std::vector<Level> find_levels(const Scene& scene, const IndirectVolume& volume) {
  std::vector<Level> levels = {Level(volume.bricks)};
  for (const Instance& instance : scene.instances) {
    if (is_baked(instance)) store_instance(scene, instance, volume, levels[0]);
  }
  while (levels.back().stored.size() > 1) levels.push_back(coarser(levels.back()));
  levels.back().stored[0] = true;
  return levels;
}

// Gives each place the finest brick that is stored there, and that its place among the cells, in
// the order of levels. Returns the number of cells.
std::uint64_t number_bricks(const std::vector<Level>& levels, std::vector<std::uint32_t>& starts) {
  starts.assign(levels[0].stored.size(), kNoBrick);
  std::uint64_t cells = 0;
  for (std::uint32_t n = 0; n < levels.size(); ++n) {
    const Level& level = levels[n];
    std::vector<std::uint32_t> numbers(level.stored.size(), kNoBrick);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (starts[i] != kNoBrick) continue;
      const std::size_t brick = level.index(levels[0].brick(i) >> n);
      if (!level.stored[brick]) continue;
      if (numbers[brick] == kNoBrick) {
        // Volumes with more cells than this are refused.
        numbers[brick] = static_cast<std::uint32_t>(std::min(cells, kMaxCells)) + n;
        cells += kCellsPerBrick;
      }
      starts[i] = numbers[brick];
    }
  }
  return cells;
}

// Lays out the bricks and counts their cells, without allocating them.
Result<IndirectVolume> layout_bricks(const Scene& scene, float cell_metres, std::uint64_t& cells) {
  cells = 0;
  IndirectVolume volume;
  volume.cell = cell_metres;
  const Bounds bounds = scene_bounds(scene);
  if (bounds.empty()) return volume;
  const double size = static_cast<double>(cell_metres) * kBrickCells;
  const glm::dvec3 margin(2.0 * cell_metres);
  volume.origin = bounds.min - margin;
  const glm::dvec3 count = glm::ceil((bounds.max + margin - volume.origin) / size - kBorder);
  // A scene that spans many kilometres may have few bricks, but its grid must stay small too.
  if (!(count.x * count.y * count.z < static_cast<double>(kMaxCells))) {
    return make_error(ErrorId::kVolume, "a volume with cells of " + std::to_string(cell_metres) +
                                            " m would need a grid of " + std::to_string(count.x) +
                                            " x " + std::to_string(count.y) + " x " +
                                            std::to_string(count.z) +
                                            " bricks, more than 2^24; choose larger cells");
  }
  volume.bricks = glm::uvec3(count);
  cells = number_bricks(find_levels(scene, volume), volume.brick_starts);
  if (cells > kMaxCells) {
    return make_error(ErrorId::kVolume, "a volume with cells of " + std::to_string(cell_metres) +
                                            " m would have " + std::to_string(cells) +
                                            " of them, more than 2^24; choose larger cells");
  }
  return volume;
}

// Calls `visit` with each stored brick's entry and its place in the grid of its own level.
template <class Visit>
void for_bricks(const IndirectVolume& volume, Visit visit) {
  std::vector<bool> seen(volume.cells.size() / kCellsPerBrick);
  for (std::uint32_t b = 0; b < volume.brick_starts.size(); ++b) {
    const std::uint32_t entry = volume.brick_starts[b];
    if (entry == kNoBrick || seen[entry / kCellsPerBrick]) continue;
    seen[entry / kCellsPerBrick] = true;
    const glm::uvec3 brick(b % volume.bricks.x, b / volume.bricks.x % volume.bricks.y,
                           b / (volume.bricks.x * volume.bricks.y));
    visit(entry, brick >> brick_level(entry));
  }
}

glm::uvec3 place_in_brick(std::uint32_t i) {
  return {i % kBrickCells, i / kBrickCells % kBrickCells, i / (kBrickCells * kBrickCells)};
}

}  // namespace

std::vector<CellPlace> IndirectVolume::cell_places() const {
  std::vector<CellPlace> places(cells.size());
  for_bricks(*this, [&](std::uint32_t entry, const glm::uvec3& brick) {
    const double size = std::ldexp(static_cast<double>(cell), static_cast<int>(brick_level(entry)));
    for (std::uint32_t i = 0; i < kCellsPerBrick; ++i) {
      places[brick_start(entry) + i] = {
          origin + (glm::dvec3(brick * kBrickCells + place_in_brick(i)) + 0.5) * size,
          static_cast<float>(size)};
    }
  });
  return places;
}

std::vector<glm::dvec3> IndirectVolume::cell_centers() const {
  std::vector<glm::dvec3> centers;
  for (const CellPlace& place : cell_places()) centers.push_back(place.middle);
  return centers;
}

std::uint32_t IndirectVolume::find(const glm::dvec3& place) const {
  const glm::dvec3 at = glm::floor((place - origin) / static_cast<double>(cell));
  const glm::dvec3 end(bricks * kBrickCells);
  if (!glm::all(glm::greaterThanEqual(at, glm::dvec3(0))) || !glm::all(glm::lessThan(at, end))) {
    return kNoBrick;
  }
  const glm::uvec3 fine(at), brick = fine / kBrickCells;
  const std::uint32_t entry =
      brick_starts[brick.x + bricks.x * (brick.y + std::size_t{bricks.y} * brick.z)];
  if (entry == kNoBrick) return kNoBrick;
  const glm::uvec3 within = (fine >> brick_level(entry)) % kBrickCells;
  return brick_start(entry) + within.x + kBrickCells * (within.y + kBrickCells * within.z);
}

std::vector<std::uint32_t> IndirectVolume::cells_in_use() const {
  std::vector<std::uint32_t> used;
  for_bricks(*this, [&](std::uint32_t entry, const glm::uvec3& brick) {
    for (std::uint32_t i = 0; i < kCellsPerBrick; ++i) {
      // All places of a cell have the same brick, so its first one tells.
      const glm::uvec3 at =
          ((brick * kBrickCells + place_in_brick(i)) << brick_level(entry)) / kBrickCells;
      if (at.x >= bricks.x || at.y >= bricks.y || at.z >= bricks.z) continue;
      if (brick_starts[at.x + bricks.x * (at.y + std::size_t{bricks.y} * at.z)] == entry) {
        used.push_back(brick_start(entry) + i);
      }
    }
  });
  std::sort(used.begin(), used.end());
  return used;
}

Result<IndirectVolume> layout_volume(const Scene& scene, std::optional<float> cell_metres,
                                     std::uint64_t most_cells) {
  constexpr float kLargestCell = 1e6f;
  for (float cell = cell_metres.value_or(kVolumeCell);; cell *= 2) {
    std::uint64_t cells = 0;
    auto volume = layout_bricks(scene, cell, cells);
    const bool fits = volume.ok() && cells <= most_cells;
    if (!cell_metres && !fits && cell < kLargestCell) continue;
    if (volume.ok()) volume.value().cells.resize(cells);
    return volume;
  }
}

}  // namespace kaamos::effects
