// SPDX-License-Identifier: MIT
// A sparse volume of indirect light: cells of 25 cm in bricks of 8 x 8 x 8, stored where there is
// geometry, and baked by a path tracer that is a DXR program like every effect. [effects-spec B5.1]
#pragma once

#include <rtapi/rtapi.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "effects/common/result.h"
#include "effects/frame/frame.h"
#include "effects/lights/lighting.h"

namespace kaamos::effects {

inline constexpr std::uint32_t kBrickCells = 8;  ///< along each axis
inline constexpr std::uint32_t kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;
inline constexpr std::uint32_t kNoBrick = 0xFFFFFFFFu;
inline constexpr float kVolumeCell = 0.25f;  ///< metres, unless a scene is too large for it

/// Radiance towards a unit direction d: mean + slope_x d.x + slope_y d.y + slope_z d.z. Mirrors
/// CellSums of volume_bake.hlsl.
struct VolumeCell {
  glm::vec3 mean{0.0f};  ///< not negative
  float validity = 0;    ///< 0: the cell lies in a solid
  glm::vec3 slope_x{0.0f};
  float padding0 = 0;
  glm::vec3 slope_y{0.0f};
  float padding1 = 0;
  glm::vec3 slope_z{0.0f};
  float padding2 = 0;
};
static_assert(sizeof(VolumeCell) == 64);

/// A volume on the host, in world space.
struct IndirectVolume {
  glm::dvec3 origin{0.0};                   ///< corner of cell (0, 0, 0)
  float cell = kVolumeCell;                 ///< metres
  glm::uvec3 bricks{0};                     ///< along each axis; all 0: no volume
  std::vector<std::uint32_t> brick_starts;  ///< where a brick's cells start, or kNoBrick; x fastest
  std::vector<VolumeCell> cells;

  /// Middles of the cells, by their place in `cells`.
  std::vector<glm::dvec3> cell_centers() const;
};

/// The bricks that hold geometry, and those next to them, without light yet. Without a size of
/// cells they are of kVolumeCell, or of as many times twice that as keep the volume within
/// `most_cells`: baking takes as long as there are cells, and a large floor has many. Errors: more
/// than 2^24 cells: a larger cell is needed.
Result<IndirectVolume> layout_volume(const Scene& scene, std::optional<float> cell_metres = {},
                                     std::uint64_t most_cells = 1u << 19);

struct BakeDesc {
  std::uint32_t samples = 256;  ///< paths per cell
  std::uint32_t bounces = 3;    ///< after the first hit
  std::uint32_t seed = 0;
};

rtapi::Result<rtapi::ShaderLibrary> volume_bake_library();

/// Path traces every cell, in steps that take some tenths of a second. `progress` gets the done
/// part; `stop` ends it (an error with an empty id).
rtapi::Status bake_volume(const rtapi::Device& device, rtapi::CommandQueue& queue,
                          const Frame& frame, const GpuScene& gpu, const Lighting& lighting,
                          const glm::dvec3& origin, const rtapi::ShaderLibrary& library,
                          const BakeDesc& desc, IndirectVolume& volume,
                          const std::function<void(double)>& progress,
                          const std::atomic<bool>& stop);

/// Little-endian, with a version and the length of everything. Errors: files that cannot be written
/// or read, are of another version, cut short or damaged.
Status save_volume(const std::string& path, const IndirectVolume& volume);
Result<IndirectVolume> load_volume(const std::string& path);

/// A volume as shaders read it: registers t0 to t2 of space3.
class GpuVolume {
 public:
  /// `origin`: of the frame. An empty volume is one that has no light anywhere stored.
  static rtapi::Result<GpuVolume> create(const rtapi::Device& device, const IndirectVolume& volume,
                                         const glm::dvec3& origin);
  rtapi::Status bind(PassViews& views) const;
  /// The frame moved on to another origin. No dispatch that reads the volume may run meanwhile.
  void set_origin(const glm::dvec3& origin);

 private:
  glm::dvec3 corner_{0.0};  // the volume's corner, in world space
  rtapi::Buffer brick_starts_, cells_, constants_;
};

}  // namespace kaamos::effects
