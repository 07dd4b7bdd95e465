// SPDX-License-Identifier: MIT
// A scene on a device: its buffers and textures, one bottom level per mesh, one top level, and the
// contents of the hit group table's records.
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
  bool glass = false;
};

/// Where an instance was one frame ago; t4 of the frame, mirrored in effects/shaders/frame.hlsli.
struct PreviousInstance {
  glm::mat3x4 object_to_world{0.0f};  ///< then, relative to the camera of then
  std::uint32_t flags = 0;            ///< PreviousInstanceFlags; 0: nothing moved
  std::uint32_t padding[3] = {};
};
static_assert(sizeof(PreviousInstance) == 64);

enum PreviousInstanceFlags : std::uint32_t {
  kPreviousMoved = 1,     ///< its transform or its shape changed
  kPreviousDeformed = 2,  ///< its shape did: vertices hold their previous positions
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
  rtapi::Buffer previous_instances;      ///< PreviousInstance, one per instance, at least one
  rtapi::Buffer materials;               ///< MaterialConstants, one per material
  std::vector<rtapi::Texture> textures;  ///< one per image
  std::vector<GpuGeometry> geometries;   ///< of all meshes, in the order of their records
  GpuSceneStatistics statistics;
};

/// Buffers and textures of a valid scene, and the arguments of its meshes' records; no acceleration
/// structures, nor what depends on them.
rtapi::Result<GpuScene> upload_scene(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                     const Scene& scene);
/// Input of a bottom level build. `gpu`: the record of `geometry`.
rtapi::RaytracingGeometryDesc geometry_desc(const Geometry& geometry, const GpuGeometry& gpu);
/// A buffer that an acceleration structure of at most `bytes` may be built in.
rtapi::Result<rtapi::Buffer> create_structure_buffer(const rtapi::Device& device,
                                                     std::uint64_t bytes, std::string name);
rtapi::Result<rtapi::Buffer> create_scratch_buffer(const rtapi::Device& device, std::uint64_t bytes,
                                                   std::string name);

/// Uploads a valid scene and builds its acceleration structures. World positions become relative to
/// `origin` (the camera) before they are rounded to float: far from the world's origin a float has
/// too few digits left. [effects-spec B0.1] Skinned meshes stay in their bind pose: scenes that
/// move take a StructureManager. [effects/structures]
rtapi::Result<GpuScene> create_gpu_scene(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                         const Scene& scene, const glm::dvec3& origin);

}  // namespace kaamos::effects
