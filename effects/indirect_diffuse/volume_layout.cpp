// SPDX-License-Identifier: MIT
// Decides which bricks a volume has.
#include <algorithm>
#include <cmath>

#include "effects/indirect_diffuse/volume.h"

namespace kaamos::effects {

namespace {

constexpr std::uint64_t kMaxCells = 1u << 24;

// Calls `visit` with the coordinates of every brick that the box [low, high] touches.
template <class Visit>
void for_bricks(const IndirectVolume& volume, const glm::dvec3& low, const glm::dvec3& high,
                Visit visit) {
  const double size = static_cast<double>(volume.cell) * kBrickCells;
  const glm::ivec3 last = glm::ivec3(volume.bricks) - 1;
  // One more cell on each side, because surfaces look up half a cell away and between cells.
  const glm::dvec3 margin(2.0 * volume.cell);
  const glm::ivec3 from = glm::clamp(glm::ivec3(glm::floor((low - margin - volume.origin) / size)),
                                     glm::ivec3(0), last);
  const glm::ivec3 to = glm::clamp(glm::ivec3(glm::floor((high + margin - volume.origin) / size)),
                                   glm::ivec3(0), last);
  for (int z = from.z; z <= to.z; ++z) {
    for (int y = from.y; y <= to.y; ++y) {
      for (int x = from.x; x <= to.x; ++x) visit(glm::uvec3(x, y, z));
    }
  }
}

std::size_t brick_index(const IndirectVolume& volume, const glm::uvec3& brick) {
  return (std::size_t{brick.z} * volume.bricks.y + brick.y) * volume.bricks.x + brick.x;
}

// Marks the bricks that the triangles of an instance touch.
void mark_instance(const Scene& scene, const Instance& instance, IndirectVolume& volume) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  for (const Geometry& geometry : mesh.geometries) {
    for (std::uint32_t i = 0; i + 2 < geometry.index_count; i += 3) {
      glm::dvec3 low(1e300), high(-1e300);
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const glm::dvec3 p(
            instance.transform *
            glm::dvec4(glm::dvec3(mesh.corner(geometry, i / 3, corner).position), 1));
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
      for_bricks(volume, low, high, [&](const glm::uvec3& brick) {
        volume.brick_starts[brick_index(volume, brick)] = 0;
      });
    }
  }
}

}  // namespace

std::vector<glm::dvec3> IndirectVolume::cell_centers() const {
  std::vector<glm::dvec3> centers(cells.size());
  for (std::uint32_t b = 0; b < brick_starts.size(); ++b) {
    if (brick_starts[b] == kNoBrick) continue;
    const glm::uvec3 brick(b % bricks.x, b / bricks.x % bricks.y, b / (bricks.x * bricks.y));
    for (std::uint32_t i = 0; i < kCellsPerBrick; ++i) {
      const glm::uvec3 inside(i % kBrickCells, i / kBrickCells % kBrickCells,
                              i / (kBrickCells * kBrickCells));
      centers[brick_starts[b] + i] =
          origin + (glm::dvec3(brick * kBrickCells + inside) + 0.5) * static_cast<double>(cell);
    }
  }
  return centers;
}

namespace {

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
  const glm::dvec3 count = glm::ceil((bounds.max + margin - volume.origin) / size);
  // A scene that spans many kilometres may have few bricks, but its grid must stay small too.
  if (!(count.x * count.y * count.z < static_cast<double>(kMaxCells))) {
    return make_error(ErrorId::kVolume, "a volume with cells of " + std::to_string(cell_metres) +
                                            " m would need a grid of " + std::to_string(count.x) +
                                            " x " + std::to_string(count.y) + " x " +
                                            std::to_string(count.z) +
                                            " bricks, more than 2^24; choose larger cells");
  }
  volume.bricks = glm::uvec3(count);
  volume.brick_starts.assign(std::size_t{volume.bricks.x} * volume.bricks.y * volume.bricks.z,
                             kNoBrick);
  for (const Instance& instance : scene.instances) {
    if (instance.mask != kMaskEmissiveProxy) mark_instance(scene, instance, volume);
  }
  for (std::uint32_t& start : volume.brick_starts) {
    if (start == kNoBrick) continue;
    start = static_cast<std::uint32_t>(std::min<std::uint64_t>(cells, kNoBrick - 1));
    cells += kCellsPerBrick;
  }
  if (cells > kMaxCells) {
    return make_error(ErrorId::kVolume, "a volume with cells of " + std::to_string(cell_metres) +
                                            " m would have " + std::to_string(cells) +
                                            " of them, more than 2^24; choose larger cells");
  }
  return volume;
}

}  // namespace

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
