// SPDX-License-Identifier: MIT
/// @file
/// The acceleration structures of a scene that moves, frame by frame: skinning, bottom levels, top
/// level. [Northlight deck: Build Flags]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "effects/assets/scene/animation.h"
#include "effects/assets/scene/scene.h"
#include "effects/engine/bottom_level_inputs.h"
#include "effects/engine/gpu_scene.h"
#include "effects/geometry/skinning/skinning.h"

namespace kaamos::effects {

/// Options for keeping structures that move.
struct StructureOptions {
  /// Structures of a class are built anew once in so many frames and updated in between, because
  /// updates make them slower to trace; they take turns, so that no frame rebuilds two while there
  /// are fewer of them than frames. 1: always built. 0: only updated.
  ///@{
  std::uint32_t deformable_period = 8;
  std::uint32_t hero_period = 30;
  ///@}
  bool compact = true;  ///< static structures are compacted
  /// Levels of detail by which rays see an instance coarser than draws do, as far as it has any.
  /// 0: both see the same one. More shows what comes of it.
  std::uint32_t coarser_rays = 0;
  /// States of the opacity micromaps of alpha-tested geometries: 2, 4, or 0: there are none.
  /// [build_micromaps]
  std::uint32_t opacity_micromaps = 0;
};

/// The cost of the scene and its last frame.
struct StructureStatistics {
  std::uint32_t static_structures = 0;               ///< bottom levels that never change
  std::uint32_t skinned_structures = 0;              ///< instances in the same pose share one
  std::uint64_t static_bytes = 0;                    ///< of them
  std::uint64_t static_bytes_before_compaction = 0;  ///< the same as they were built
  std::uint64_t skinned_bytes = 0;                   ///< of the skinned structures
  std::uint64_t vertex_bytes = 0;                    ///< of deformed vertices
  std::uint64_t scratch_bytes = 0;                   ///< of all builds and updates
  std::uint64_t top_level_bytes = 0;                 ///< of the top level
  double create_ms = 0;                              ///< that create() took
  std::uint32_t frame = 0;                           ///< frames recorded before this one
  std::uint32_t skinned = 0;           ///< dispatches of this frame, as all that follows
  std::uint64_t skinned_vertices = 0;  ///< of these dispatches
  std::uint32_t updated = 0;           ///< structures that were refitted
  std::uint32_t rebuilt = 0;           ///< structures that were built; the first build counts too
  std::uint32_t skipped = 0;           ///< structures of which no joint moved
  std::uint32_t moved_instances = 0;   ///< with another transform or shape than before
  std::uint32_t changed_levels = 0;    ///< instances that show another level of detail than before
  std::uint32_t barriers = 0;          ///< batches of them
  /// Time of the frame's stages, each with its barrier; only by execute().
  ///@{
  double skinning_ms = 0;
  double bottom_level_ms = 0;
  double top_level_ms = 0;
  ///@}
};

/// Keeps the acceleration structures of a scene that moves, and what its hit records and passes
/// read. One frame at a time.
class StructureManager {
 public:
  /// Uploads a valid scene and builds the static structures. There is no top level before the first
  /// frame.
  /// @errors those of the device, among them KA0990 no memory and KA0547 no micromaps.
  static rtapi::Result<StructureManager> create(const rtapi::Device& device,
                                                rtapi::CommandQueue& queue, const Scene& scene,
                                                const StructureOptions& options = {});

  /// Records all that has to happen before the rays of a frame: skinning, one barrier, bottom
  /// levels, one barrier, top level, one barrier; what has nothing to do is left out together with
  /// its barrier. Positions become relative to `origin`, the camera. The list of the frame before
  /// must have finished: what the device reads is written now.
  /// @errors KA3042 another number of states than instances, or of matrices than joints; a mesh
  /// that is no level of its instance.
  rtapi::Status record(rtapi::CommandList& list, std::span<const InstanceState> states,
                       const glm::dvec3& origin);
  /// The same, executed stage by stage and measured.
  /// @errors those of record, and of rtapi::CommandQueue::ExecuteAndWait.
  rtapi::Status execute(const rtapi::Device& device, rtapi::CommandQueue& queue,
                        std::span<const InstanceState> states, const glm::dvec3& origin);

  /// Changes StructureOptions::coarser_rays from the next frame on; only where it was not 0 at
  /// first.
  void set_coarser_rays(std::uint32_t levels) { options_.coarser_rays = levels; }

  /// The scene for passes and Frame; its resources stay the same over all frames.
  const GpuScene& scene() const { return gpu_; }
  /// The cost of the scene and its last frame.
  const StructureStatistics& statistics() const { return statistics_; }
  /// The deformed vertices of an instance, kSkinnedVertexStride bytes apart. Empty where it has no
  /// skin.
  rtapi::Buffer skinned_vertices(std::uint32_t instance) const;

 private:
  // Skinned and morphed instances in the same pose share a body: deformed vertices and their
  // structure.
  struct Body {
    std::uint32_t mesh = 0;
    Motion motion;
    BuildClass build_class = BuildClass::kDeformable;
    std::uint32_t rank = 0;  // within its build class
    std::uint32_t joint_count = 0;
    std::size_t first_record = 0;
    SkinnedMesh skinned;
    BottomLevelInputs geometries;
    rtapi::Buffer structure;
    rtapi::Buffer scratch;
    std::vector<JointMatrix> joints;  // in the last frame
    std::vector<float> weights;       // likewise
    bool has_pose = false;            // there was a last frame
    std::uint32_t updates = 0;        // since it was built
    bool moved = false;
    bool has_history = false;  // the vertices hold the previous positions
  };
  struct MeshRecords {
    std::size_t first = 0;
    bool opaque = true;  // no geometry is alpha-tested
  };
  struct Placement {
    std::int32_t body = kNoIndex;
    glm::dmat4 transform{1.0};  // in the last frame
    std::uint32_t mesh = 0;     // shown in the last frame
  };

  rtapi::Status build_static(const rtapi::Device& device, rtapi::CommandQueue& queue,
                             const Scene& scene);
  rtapi::Status compact(const rtapi::Device& device, rtapi::CommandQueue& queue,
                        const rtapi::Buffer& sizes, const std::vector<std::uint32_t>& built);
  rtapi::Status add_instances(const rtapi::Device& device, const Scene& scene);
  rtapi::Result<std::int32_t> add_body(const rtapi::Device& device, const Scene& scene,
                                       const Instance& instance);
  rtapi::Status create_top_level(const rtapi::Device& device);
  rtapi::Status begin_frame(std::span<const InstanceState> states);
  void record_skinning(rtapi::CommandList& list);
  void record_bottom_levels(rtapi::CommandList& list);
  void record_top_level(rtapi::CommandList& list, std::span<const InstanceState> states,
                        const glm::dvec3& origin);
  std::uint32_t mesh_of(std::size_t instance, const InstanceState& state) const;
  // The level that rays see of an instance of which `drawn` is drawn.
  std::uint32_t traced_mesh(std::size_t instance, std::uint32_t drawn) const;
  rtapi::RaytracingInstanceDesc instance_desc(std::size_t i, const Instance& now,
                                              const glm::dvec3& origin) const;
  void write_instances(std::span<const InstanceState> states, const glm::dvec3& origin);
  bool must_rebuild(const Body& body) const;
  rtapi::BuildRaytracingAccelerationStructureInputs inputs(const Body& body) const;
  void barrier(rtapi::CommandList& list);

  StructureOptions options_;
  GpuScene gpu_;
  std::vector<Instance> instances_;
  std::vector<MeshRecords> meshes_;
  std::vector<Placement> placements_;
  std::vector<Body> bodies_;
  std::optional<SkinningPass> skinning_;
  std::vector<rtapi::Buffer> bind_skins_;  // per mesh; empty handles for meshes without bodies
  std::vector<rtapi::Buffer> morphs_;      // per mesh; empty handles for those without targets
  rtapi::Buffer top_scratch_;
  glm::dvec3 previous_origin_{0.0};
  std::uint32_t frame_ = 0;
  StructureStatistics statistics_;
};

}  // namespace kaamos::effects
