// SPDX-License-Identifier: MIT
/// @file
/// A sparse volume of indirect light: cells of 25 cm in bricks of 8 x 8 x 8, stored where there is
/// geometry, and baked by a path tracer that is a DXR program like every effect. [effects-spec
/// B5.1]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "effects/common/errors.h"
#include "effects/frame/frame.h"
#include "effects/frame/outcome.h"
#include "effects/lights/lighting.h"

namespace kaamos::effects {

/// Cells along each axis of a brick.
inline constexpr std::uint32_t kBrickCells = 8;
/// Cells of a brick.
inline constexpr std::uint32_t kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;
/// IndirectVolume::brick_starts: nothing is stored there.
inline constexpr std::uint32_t kNoBrick = 0xFFFFFFFFu;
/// Size of a cell, metres, unless a scene is too large for it.
inline constexpr float kVolumeCell = 0.25f;

/// Radiance towards a unit direction d: mean + slope_x d.x + slope_y d.y + slope_z d.z. Mirrors
/// CellSums of volume_bake.hlsl.
struct VolumeCell {
  glm::vec3 mean{0.0f};  ///< not negative
  float validity = 0;    ///< 0: the cell lies in a solid
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

/// A volume on the host, in world space.
struct IndirectVolume {
  glm::dvec3 origin{0.0};                   ///< corner of cell (0, 0, 0)
  float cell = kVolumeCell;                 ///< metres
  glm::uvec3 bricks{0};                     ///< along each axis; all 0: no volume
  std::vector<std::uint32_t> brick_starts;  ///< where a brick's cells start, or kNoBrick; x fastest
  std::vector<VolumeCell> cells;            ///< kCellsPerBrick for each stored brick, x fastest

  /// Middles of the cells, by their place in `cells`.
  std::vector<glm::dvec3> cell_centers() const;
};

/// A volume of the bricks that hold geometry, and of those next to them, without light yet. If no
/// size of cells is given, it is kVolumeCell, doubled until the volume has `most_cells` at most:
/// baking takes as long as there are cells, and a large floor has many. [effects-spec B5.1]
/// @errors KA3045 more than 2^24 cells or bricks: larger cells are needed.
Result<IndirectVolume> layout_volume(const Scene& scene, std::optional<float> cell_metres = {},
                                     std::uint64_t most_cells = 1u << 19);

/// How well a volume is baked.
struct BakeDesc {
  std::uint32_t samples = 256;  ///< paths per cell
  std::uint32_t bounces = 3;    ///< after the first hit
  std::uint32_t seed = 0;       ///< of the random numbers
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> volume_bake_library();

/// Path traces every cell, in steps that take some tenths of a second. `origin` is that of `gpu`
/// and `frame`. After kStopped the cells hold nothing of use.
/// @errors those of the device.
rtapi::Result<Outcome> bake_volume(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                   const Frame& frame, const GpuScene& gpu,
                                   const Lighting& lighting, const glm::dvec3& origin,
                                   const rtapi::ShaderLibrary& library, const BakeDesc& desc,
                                   IndirectVolume& volume, const StepCallback& progress = {});

/// Writes a volume to a file: little-endian, with a version and the length of everything. An
/// earlier file at `path` stays as it was on any error.
/// @errors those of write_file_atomically.
Status save_volume(const std::string& path, const IndirectVolume& volume);
/// Reads a volume from a file that save_volume wrote.
/// @errors KA3000 as of read_file; KA3045 a file of another version, cut short or damaged.
Result<IndirectVolume> load_volume(const std::string& path);

/// A volume as shaders read it: registers t0 to t2 of space3.
class GpuVolume {
 public:
  /// Uploads a volume. `origin` is that of the frame, world space. An empty volume has no light
  /// stored anywhere.
  /// @errors those of rtapi::Device::CreateBuffer.
  static rtapi::Result<GpuVolume> create(const rtapi::Device& device, const IndirectVolume& volume,
                                         const glm::dvec3& origin);
  /// Binds the volume to a pass: registers t0 to t2 of space3.
  /// @errors those of PassViews::set_shader_resource.
  rtapi::Status bind(PassViews& views) const;
  /// Follows the frame to another origin. No dispatch that reads the volume may run meanwhile.
  void set_origin(const glm::dvec3& origin);

 private:
  glm::dvec3 corner_{0.0};  // the volume's corner, in world space
  rtapi::Buffer brick_starts_, cells_, constants_;
};

}  // namespace kaamos::effects
