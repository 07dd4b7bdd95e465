// SPDX-License-Identifier: MIT
/// @file
/// The local lights of a frame: light lists per cluster and an atlas of shadow maps. Both are made
/// anew each frame and bound to every pass whose shaders include hit_lighting.hlsli.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <optional>

#include "effects/assets/scene/light_constants.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"
#include "effects/engine/ray_pass.h"
#include "effects/light/lights/light_map_draws.h"

namespace kaamos::effects {

/// Mirrors of hit_lighting.hlsli: cells of clusters along each axis and in all, lights that a
/// cluster holds, the count of one that has more, shadow maps in a row of the atlas and in all.
///@{
inline constexpr std::uint32_t kClusterCells = 32;
inline constexpr std::uint32_t kClusterCount = kClusterCells * kClusterCells * kClusterCells;
inline constexpr std::uint32_t kClusterCapacity = 64;
inline constexpr std::uint32_t kClusterOverflow = 0xFFFFFFFFu;
inline constexpr std::uint32_t kMaxAtlasLights = kShadowTilesPerRow * 128;
///@}

/// Says whether what rays hit is lit by the sun, and how its shadows are found there. Mirrors
/// hit_shading.hlsli.
enum class SunAtHits : std::uint32_t {
  kNone,   ///< it is not
  kByRay,  ///< by a ray to the sun's centre
  kByMap,  ///< by the sun's map in the atlas; by a ray beside it, and where FrameDesc has none
};

/// The way the atlas of shadow maps is rendered.
enum class LightMaps : std::uint32_t {
  kTraced,  ///< a ray for each texel
  kDrawn,   ///< the rasterizer [LightMapDraws]
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> lighting_library();

/// The local lights of a frame, for passes that shade: what update() records.
class Lighting {
 public:
  /// Makes the atlas and the lists for so many lights: those that light_constants makes of the
  /// scene, or none where nobody reads the maps.
  /// @errors those of the device; KA3041 more lights than an atlas has tiles for (4,096).
  static rtapi::Result<Lighting> create(const rtapi::Device& device, const Frame& frame,
                                        const GpuScene& scene, const rtapi::ShaderLibrary& library,
                                        std::uint32_t light_count);
  /// Lets the maps be drawn, from the next update on, with the shaders of
  /// light_map_draws_library(). Frame and scenes must stay.
  /// @errors those of LightMapDraws::create.
  rtapi::Status draw_maps(const rtapi::Device& device, const Frame& frame, const Scene& scene,
                          const GpuScene& gpu, const rtapi::ShaderLibrary& library);
  /// Looks at where instances and lights are now; for maps that are drawn, before each update.
  void see(const glm::dvec3& camera_position);

  /// Records what makes the lists and the maps for the frame's camera, with the barriers behind it.
  /// `with_maps`: false where nobody reads the maps; they are then not made.
  void update(rtapi::CommandList& list, const Frame& frame, bool with_maps = true) const;
  /// Binds them to a pass whose shaders include hit_lighting.hlsli: registers u16 to u18 of space3.
  /// @errors those of PassViews::set_unordered_access.
  rtapi::Status bind(PassViews& views) const;

  /// Bytes of the atlas and the lists.
  std::uint64_t bytes() const { return views_.bytes() + (draws_ ? draws_->bytes() : 0); }
  /// Shadow maps of all lights, kShadowTile texels on a side, kShadowTilesPerRow in a row, and
  /// right of them the sun's [AtlasLayout].
  const rtapi::Texture& atlas() const { return atlas_; }
  /// Lights of each cluster, a word each, x fastest; kClusterOverflow: more than fit, all count.
  const rtapi::Buffer& cluster_counts() const { return counts_; }
  /// kClusterCapacity indices of lights for each cluster, a word each.
  const rtapi::Buffer& cluster_lights() const { return indices_; }

 private:
  std::uint32_t light_count_ = 0;
  AtlasLayout layout_;
  rtapi::Texture atlas_;
  rtapi::Buffer counts_, indices_;
  ComputePass clusters_;
  RayPass shadow_maps_, sun_map_;
  std::optional<LightMapDraws> draws_;
  PassViews views_;
};

}  // namespace kaamos::effects
