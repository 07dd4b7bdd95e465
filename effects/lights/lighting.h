// SPDX-License-Identifier: MIT
// The local lights of a frame: light lists per cluster and an atlas of shadow maps. Both are made
// anew each frame and bound to every pass whose shaders include hit_lighting.hlsli.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/frame/compute_pass.h"
#include "effects/frame/frame.h"
#include "effects/frame/ray_pass.h"
#include "effects/lights/light_constants.h"

namespace kaamos::effects {

// Mirrors hit_lighting.hlsli, as kShadowTile does.
inline constexpr std::uint32_t kClusterCells = 32;
inline constexpr std::uint32_t kClusterCount = kClusterCells * kClusterCells * kClusterCells;
inline constexpr std::uint32_t kClusterCapacity = 64;
inline constexpr std::uint32_t kClusterOverflow = 0xFFFFFFFFu;
inline constexpr std::uint32_t kShadowTilesPerRow = 32;

rtapi::Result<rtapi::ShaderLibrary> lighting_library();

class Lighting {
 public:
  /// Room for the lights that the scene has now. Errors: those of the device; more lights than an
  /// atlas has tiles for (4,096).
  static rtapi::Result<Lighting> create(const rtapi::Device& device, const Frame& frame,
                                        const GpuScene& scene, const rtapi::ShaderLibrary& library,
                                        std::uint32_t light_count);

  /// Records the lists and the maps for the frame's camera.
  void update(rtapi::CommandList& list, const Frame& frame) const;
  /// Binds them to a pass: registers u16 to u18 of space3.
  rtapi::Status bind(PassViews& views) const;

  /// Of the atlas and the lists.
  std::uint64_t bytes() const { return views_.bytes(); }
  const rtapi::Texture& atlas() const { return atlas_; }
  const rtapi::Buffer& cluster_counts() const { return counts_; }
  const rtapi::Buffer& cluster_lights() const { return indices_; }

 private:
  std::uint32_t light_count_ = 0;
  rtapi::Texture atlas_;
  rtapi::Buffer counts_, indices_;
  ComputePass clusters_;
  RayPass shadow_maps_;
  PassViews views_;
};

}  // namespace kaamos::effects
