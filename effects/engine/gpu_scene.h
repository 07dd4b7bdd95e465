// SPDX-License-Identifier: MIT
/// @file
/// A scene on a device: its buffers and textures, one bottom level per mesh, one top level, and the
/// contents of the hit group table's records.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/engine/profile.h"
#include "effects/engine/scene_micromaps.h"

namespace kaamos::effects {

/// Ray types of every effect. A hit group table has a record per geometry and type:
/// record = geometry * kRayTypeCount + type. [Northlight deck: Shader Table]
enum RayType : std::uint32_t {
  kRayTypeSurface,     ///< wants to know what it hits
  kRayTypeVisibility,  ///< wants to know whether it hits
  kRayTypeCount
};

/// A part of a buffer.
struct GpuRange {
  rtapi::Buffer buffer;            ///< what it is a part of
  std::uint64_t offset_bytes = 0;  ///< a multiple of 16
  std::uint64_t size_bytes = 0;    ///< may be 0
};

/// One geometry of one mesh: the arguments of its records, and of draws.
struct GpuGeometry {
  rtapi::GpuVirtualAddress vertices = 0;  ///< of its first vertex: root SRV t0, space2
  rtapi::GpuVirtualAddress indices = 0;   ///< of its first index: root SRV t1, space2
  HitConstants constants;                 ///< root constants b0, space2
  rtapi::Buffer vertex_buffer;            ///< that `vertices` lies in
  rtapi::Buffer index_buffer;             ///< that `indices` lies in
  std::uint32_t mesh = 0;                 ///< in Scene::meshes
  std::uint32_t vertex_count = 0;         ///< from `vertices` on
  std::uint32_t index_count = 0;          ///< from `indices` on, a multiple of 3
  bool alpha_tested = false;              ///< any-hit shaders run: also of glass
  bool glass = false;                     ///< its material is see-through
  /// Its opacity micromaps, if it has some. [build_micromaps]
  std::optional<rtapi::RaytracingGeometryOmmLinkageDesc> linkage;

  /// Its vertices, with all their attributes.
  GpuRange vertex_range() const {
    return {vertex_buffer, vertices - vertex_buffer.GetGPUVirtualAddress(),
            std::uint64_t{vertex_count} * constants.vertex_stride};
  }
  /// Its indices.
  GpuRange index_range() const {
    return {index_buffer, indices - index_buffer.GetGPUVirtualAddress(),
            std::uint64_t{index_count} * constants.index_size_bytes};
  }
};

/// The place of an instance one frame ago; t4 of the frame, mirrored in
/// effects/shaders/frame.hlsli.
struct PreviousInstance {
  glm::mat3x4 object_to_world{0.0f};  ///< then, relative to the camera of then
  std::uint32_t flags = 0;            ///< PreviousInstanceFlags; 0: nothing moved
  std::uint32_t padding[3] = {};      ///< to 64 bytes
};
static_assert(sizeof(PreviousInstance) == 64);

/// Bits of PreviousInstance::flags.
enum PreviousInstanceFlags : std::uint32_t {
  kPreviousMoved = 1,     ///< its transform or its shape changed
  kPreviousDeformed = 2,  ///< its shape did: vertices hold their previous positions
};

/// The time and memory that making a scene took, and its triangles.
struct GpuSceneStatistics {
  double bottom_level_ms = 0;             ///< builds of all bottom levels
  double top_level_ms = 0;                ///< build of the top level
  std::uint64_t bottom_level_bytes = 0;   ///< of all bottom levels
  std::uint64_t top_level_bytes = 0;      ///< of the top level
  std::uint64_t unique_triangles = 0;     ///< of the meshes
  std::uint64_t instanced_triangles = 0;  ///< of the instances
};

/// A scene on a device. It keeps all of it alive; a copy names the same objects.
struct GpuScene {
  std::vector<rtapi::Buffer> vertices;       ///< one per mesh
  std::vector<rtapi::Buffer> indices;        ///< one per mesh
  std::vector<rtapi::Buffer> bottom_levels;  ///< one per mesh
  rtapi::Buffer instances;                   ///< RaytracingInstanceDesc, one per instance
  /// The same as draws take them, where rays see other levels of detail than draws; else empty.
  /// [StructureOptions::coarser_rays]
  rtapi::Buffer drawn_instances;
  rtapi::Buffer top_level;               ///< what rays are traced against
  rtapi::Buffer previous_instances;      ///< PreviousInstance, one per instance, at least one
  rtapi::Buffer materials;               ///< MaterialConstants, one per material
  std::vector<rtapi::Texture> textures;  ///< one per image
  std::vector<GpuGeometry> geometries;   ///< of all meshes, in the order of their records
  GpuSceneStatistics statistics;         ///< of create_gpu_scene
  /// Opacity micromaps, if there are to be some: pipelines must allow them then.
  std::optional<SceneMicromaps> micromaps;
};

/// Buffers and textures of a valid scene, the arguments of its meshes' records, and opacity
/// micromaps of so many states, 2 or 4, or none: 0; no other acceleration structures, nor what
/// depends on them.
/// @errors those of the device, among them KA0990 no memory and KA0547 no micromaps.
rtapi::Result<GpuScene> upload_scene(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                     const Scene& scene, std::uint32_t micromap_states = 0);
/// A buffer that an acceleration structure of at most `bytes` may be built in.
/// @errors those of rtapi::Device::CreateBuffer.
rtapi::Result<rtapi::Buffer> create_structure_buffer(const rtapi::Device& device,
                                                     std::uint64_t bytes, std::string name);
/// A buffer for the scratch memory of builds, `bytes` long.
/// @errors those of rtapi::Device::CreateBuffer.
rtapi::Result<rtapi::Buffer> create_scratch_buffer(const rtapi::Device& device, std::uint64_t bytes,
                                                   std::string name);

/// Uploads a valid scene and builds its acceleration structures. World positions become relative to
/// `origin` (the camera) before they are rounded to float: far from the world's origin a float has
/// too few digits left. Skinned meshes stay in their bind pose: scenes that move take a
/// StructureManager. [effects/geometry/structures]
/// `profile` gets its steps; null: nobody asks. `micromap_states`: as for upload_scene.
/// @errors those of the device, among them KA0990 no memory, KA0709 too many triangles and KA0547
/// no micromaps.
rtapi::Result<GpuScene> create_gpu_scene(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                         const Scene& scene, const glm::dvec3& origin,
                                         Profile* profile = nullptr,
                                         std::uint32_t micromap_states = 0);

}  // namespace kaamos::effects
