// SPDX-License-Identifier: MIT
/// @file
/// A sparse volume of indirect light: cells of 25 cm in bricks of 8 x 8 x 8 where there is
/// geometry, larger ones away from it, so that every place of the scene has a cell. It is baked by
/// a path tracer that is a DXR program like every effect.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/engine/frame.h"
#include "effects/engine/outcome.h"
#include "effects/light/lights/lighting.h"

namespace kaamos::effects {

/// Cells along each axis of a brick.
inline constexpr std::uint32_t kBrickCells = 8;
/// Cells of a brick.
inline constexpr std::uint32_t kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;
/// IndirectVolume::brick_starts: nothing is stored there.
inline constexpr std::uint32_t kNoBrick = 0xFFFFFFFFu;
/// IndirectVolume::brick_starts: the bits of the level. Bricks start at multiples of
/// kCellsPerBrick, which leaves these.
inline constexpr std::uint32_t kBrickLevelBits = kCellsPerBrick - 1;
/// The coarsest level that a volume may have: a grid has at most 2^24 bricks.
inline constexpr std::uint32_t kMaxBrickLevel = 24;
/// Size of the finest cells, metres, unless a scene is too large for it.
inline constexpr float kVolumeCell = 0.25f;

/// Radiance towards a unit direction d: mean + slope_x d.x + slope_y d.y + slope_z d.z. Mirrors
/// CellSums of volume_bake.hlsl.
struct VolumeCell {
  glm::vec3 mean{0.0f};  ///< not negative
  /// 0: the cell lies in a solid, and its light is that of valid cells around it [fill_solids]
  float validity = 0;
  /// By colour, along the axes; the padding is 0.
  ///@{
  glm::vec3 slope_x{0.0f};
  float padding0 = 0;
  glm::vec3 slope_y{0.0f};
  float padding1 = 0;
  glm::vec3 slope_z{0.0f};
  float padding2 = 0;
  ///@}
};
static_assert(sizeof(VolumeCell) == 64);

/// The place of a cell in world space.
struct CellPlace {
  glm::dvec3 middle{0.0};  ///< metres
  float size = 0;          ///< metres
};

/// A volume on the host, in world space. Cells of level n are 2^n times as large as the finest, and
/// so are bricks, which lie in the grid of their own size. Each place has cells of one level.
struct IndirectVolume {
  glm::dvec3 origin{0.0};    ///< corner of cell (0, 0, 0)
  float cell = kVolumeCell;  ///< metres, of level 0
  glm::uvec3 bricks{0};      ///< of level 0 along each axis; all 0: no volume
  /// By brick of level 0, x fastest: where the cells of the brick that is stored there start, plus
  /// that brick's level; or kNoBrick. A brick of level n is named by up to 8^n places.
  std::vector<std::uint32_t> brick_starts;
  std::vector<VolumeCell> cells;  ///< kCellsPerBrick for each stored brick, x fastest

  /// Places of the cells, by their index in `cells`.
  std::vector<CellPlace> cell_places() const;
  /// Their middles alone.
  std::vector<glm::dvec3> cell_centers() const;
  /// The index in `cells` of the cell at a place in world space; kNoBrick: there is none.
  std::uint32_t find(const glm::dvec3& place) const;
  /// Places in `cells` that are read: not those in a part of a brick that finer bricks replace, or
  /// that lies outside of the grid. In rising order.
  std::vector<std::uint32_t> cells_in_use() const;
};

/// The level of a brick and the place in IndirectVolume::cells where it starts, by its entry.
///@{
constexpr std::uint32_t brick_level(std::uint32_t entry) {
  return entry & kBrickLevelBits;
}
constexpr std::uint32_t brick_start(std::uint32_t entry) {
  return entry & ~kBrickLevelBits;
}
///@}

/// A volume over a scene's bounds, without light yet: bricks of level 0 hold the geometry that
/// stands still, and what is within two cells of it. Further away levels rise by one from brick to
/// neighbouring brick at most, so that whatever is read at level n is at least a cell of level n
/// away from any geometry: interpolation between coarse cells never reaches through a wall. If no
/// size of cells is given, it is kVolumeCell, doubled until the volume has `most_cells` at most:
/// baking takes as long as there are cells, and a large floor has many.
/// @errors KA3045 more than 2^24 cells or bricks: larger cells are needed.
Result<IndirectVolume> layout_volume(const Scene& scene, std::optional<float> cell_metres = {},
                                     std::uint64_t most_cells = 1u << 19);

/// Gives cells in solids the light of the valid cells around them: of the smallest cell of a
/// coarser level that holds a valid one, up to the one cell that holds the whole scene. Shaders
/// read it where all cells about a point lie in solids.
void fill_solids(IndirectVolume& volume);

/// The lights that a bake counts, as bits. Of local lights, those with Light::baked.
enum BakedLights : std::uint32_t {
  kBakeSun = 1,       ///< Scene::sun
  kBakeSky = 2,       ///< Scene::sky
  kBakeLocal = 4,     ///< Scene::lights
  kBakeEmissive = 8,  ///< materials that shine
  kBakeAll = 15,      ///< all of these
};

/// Describes how well a volume is baked, and with which lights.
struct BakeDesc {
  std::uint32_t samples = 1024;  ///< paths per cell at most, up to 2^20
  /// Standard error that is good enough for a cell: of the luminance of its mean, relative to that
  /// or, in the dark, to a quarter of the volume's mean. 0: every cell gets all paths.
  float error = 0.03f;
  std::uint32_t bounces = 64;  ///< after the first hit, at most; Russian roulette ends paths before
  std::uint32_t seed = 0;      ///< of the random numbers
  std::uint32_t lights = kBakeAll;  ///< BakedLights
};

/// The cost and the quality of a bake.
struct BakeStatistics {
  double seconds = 0;           ///< all of it
  std::uint64_t cells = 0;      ///< that were baked
  std::uint64_t in_solids = 0;  ///< of these, those that lie in solids
  std::uint64_t at_bound = 0;   ///< of these, those that needed less than all paths
  std::uint64_t paths = 0;      ///< of all cells
  std::uint64_t bytes = 0;      ///< of the volume as shaders read it
  double error = 0;  ///< standard error of a cell as in BakeDesc, root mean square of all cells
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> volume_bake_library();

/// What a bake works with. All of it must stay while it does.
struct BakeScope {
  const rtapi::Device& device;          ///< executes it
  rtapi::CommandQueue& queue;           ///< on which
  const Frame& frame;                   ///< its root table and heap
  const GpuScene& gpu;                  ///< `scene` on the device
  const Scene& scene;                   ///< what is lit
  const Lighting& lighting;             ///< its local lights
  const rtapi::ShaderLibrary& library;  ///< volume_bake_library
};

/// Path traces every cell, in steps that take some tenths of a second. `origin` is that of the
/// frame. Every cell first gets a few paths, which tell how many more it needs. They do not
/// favour dark results: a cell has two halves, and what one of them and the cells around have found
/// decides about the other. After kStopped the cells hold nothing of use.
/// @errors those of the device.
rtapi::Result<Outcome> bake_volume(const BakeScope& scope, const glm::dvec3& origin,
                                   const BakeDesc& desc, IndirectVolume& volume,
                                   BakeStatistics* statistics = nullptr,
                                   const StepCallback& progress = {});

/// Bytes of a volume as shaders read it.
std::uint64_t volume_bytes(const IndirectVolume& volume);

/// Writes a volume to a file: little-endian, with a version and the length of everything. An
/// earlier file at `path` stays as it was on any error.
/// @errors those of write_file.
Status save_volume(const std::string& path, const IndirectVolume& volume);
/// Reads a volume from a file that save_volume wrote.
/// @errors KA3000 as of read_file; KA3045 a file of another version, cut short or damaged.
Result<IndirectVolume> load_volume(const std::string& path);

/// A volume as shaders read it: registers t0 to t2 and u15 of space3.
class GpuVolume {
 public:
  /// Uploads a volume. `origin` is that of the frame, world space. An empty volume has no light
  /// stored anywhere. `counts_reads`: shaders count how often they read each cell.
  /// @errors those of rtapi::Device::CreateBuffer.
  static rtapi::Result<GpuVolume> create(const rtapi::Device& device, const IndirectVolume& volume,
                                         const glm::dvec3& origin, bool counts_reads = false);
  /// Binds the volume to a pass: registers t0 to t2 and u15 of space3.
  /// @errors those of PassViews::set_shader_resource and set_unordered_access.
  rtapi::Status bind(PassViews& views) const;
  /// Follows the frame to another origin. No dispatch that reads the volume may run meanwhile.
  void set_origin(const glm::dvec3& origin);
  /// Takes the light of a volume with the same bricks. No dispatch that reads it may run meanwhile.
  void set_cells(const IndirectVolume& volume);
  /// How often each cell was read since the last call. Precondition: created with `counts_reads`.
  /// @errors those of the device.
  rtapi::Result<std::vector<std::uint32_t>> take_reads(const rtapi::Device& device,
                                                       rtapi::CommandQueue& queue);

 private:
  glm::dvec3 corner_{0.0};  // the volume's corner, in world space
  rtapi::Buffer brick_starts_, cells_, constants_, reads_;
  std::vector<std::uint32_t> taken_;  // what `reads_` held when they were taken last
};

}  // namespace kaamos::effects
