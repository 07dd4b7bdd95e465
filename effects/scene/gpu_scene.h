// SPDX-License-Identifier: MIT
// A scene on a device: its buffers and textures, one bottom level per mesh, one top level, and what
// the records of a hit group table hold.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "effects/scene/scene.h"

namespace kaamos::effects {

/// Ray types of every effect. A hit group table has a record per geometry and type:
/// record = geometry * kRayTypeCount + type. [Northlight deck: Shader Table]
enum RayType : std::uint32_t {
  kRayTypeSurface,     ///< wants to know what it hits
  kRayTypeVisibility,  ///< wants to know whether it hits
  kRayTypeCount
};

/// One geometry of one mesh: the arguments of its records.
struct GpuGeometry {
  rtapi::GpuVirtualAddress vertices = 0;
  rtapi::GpuVirtualAddress indices = 0;
  HitConstants constants;
  bool alpha_tested = false;  ///< any-hit shaders run: also of glass
};

struct GpuSceneStatistics {
  double bottom_level_ms = 0;
  double top_level_ms = 0;
  std::uint64_t bottom_level_bytes = 0;
  std::uint64_t top_level_bytes = 0;
  std::uint64_t unique_triangles = 0;
  std::uint64_t instanced_triangles = 0;
};

struct GpuScene {
  std::vector<rtapi::Buffer> vertices;       ///< one per mesh
  std::vector<rtapi::Buffer> indices;        ///< one per mesh
  std::vector<rtapi::Buffer> bottom_levels;  ///< one per mesh
  rtapi::Buffer instances;
  rtapi::Buffer top_level;
  rtapi::Buffer materials;               ///< MaterialConstants, one per material
  std::vector<rtapi::Texture> textures;  ///< one per image
  std::vector<GpuGeometry> geometries;   ///< of all meshes, in the order of their records
  GpuSceneStatistics statistics;
};

/// Uploads a valid scene and builds its acceleration structures. World positions become relative to
/// `origin` (the camera) before they are rounded to float: far from the world's origin a float has
/// too few digits left. [effects-spec B0.1]
rtapi::Result<GpuScene> create_gpu_scene(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                         const Scene& scene, const glm::dvec3& origin);

}  // namespace kaamos::effects
