// SPDX-License-Identifier: MIT
/// @file
/// The opacity micromaps of a scene on a device: where they say that a leaf is opaque or has a
/// hole, no any-hit shader has to look at its texture. [DXR: Opacity micromaps]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

struct GpuScene;

/// What the micromaps of a scene are made of, and what they cost.
struct MicromapStatistics {
  std::uint32_t states = 0;      ///< 2 or 4
  std::uint32_t geometries = 0;  ///< that have them
  std::uint64_t triangles = 0;   ///< of these
  std::uint64_t micromaps = 0;   ///< triangles with the same texture coordinates share one
  std::uint64_t bytes = 0;       ///< of the array
  double bake_ms = 0;            ///< of the texture's alpha into states, and the array's build
  /// Parts of the triangles by state: transparent, opaque, unknown-transparent, unknown-opaque.
  /// Every triangle counts the same.
  std::array<double, 4> shares{};
};

/// Micromaps that bottom levels are linked to; rays read them.
struct SceneMicromaps {
  rtapi::Buffer array;            ///< no handle where whole triangles have one state each
  rtapi::Buffer indices;          ///< that builds and updates read
  MicromapStatistics statistics;  ///< of them
};

/// Bakes micromaps of `states` states, 2 or 4, for every alpha-tested geometry in gpu.geometries,
/// and sets its GpuGeometry::linkage. Glass keeps its any-hit shaders, which do more than test, and
/// so does what has vertices that are not opaque. With four states rays hit what they hit without
/// micromaps; with two, what a micro-triangle mostly is.
/// @errors those of the device, among them KA0547 the backend has no micromaps.
rtapi::Result<SceneMicromaps> build_micromaps(const rtapi::Device& device,
                                              rtapi::CommandQueue& queue, const Scene& scene,
                                              std::uint32_t states, GpuScene& gpu);

}  // namespace kaamos::effects
