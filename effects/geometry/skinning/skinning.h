// SPDX-License-Identifier: MIT
/// @file
/// Deforms the vertices of morphed and skinned meshes by a compute shader. It leaves the indices
/// alone, so that acceleration structures can be updated.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <span>

#include "effects/assets/scene/animation.h"
#include "effects/assets/scene/mesh.h"

namespace kaamos::effects {

/// Vertices that the shader writes: a Vertex, its position one frame ago, 4 bytes unused; then,
/// where the mesh has more, a Mesh::More.
/// [effects/surfaces/gbuffer/store.hlsli]
///@{
inline constexpr std::uint32_t kSkinnedVertexStride = 64;
inline constexpr std::uint32_t kColoredSkinnedVertexStride = 80;
inline constexpr std::uint32_t kSkinnedColorOffset = 64;
inline constexpr std::uint32_t kPreviousPositionOffset = sizeof(Vertex);
///@}

/// State of deformed vertices outside of the skinning: builds, hit shaders and draws read them.
inline constexpr rtapi::ResourceStates kSkinnedVertexState =
    rtapi::ResourceStates::kNonPixelShaderResource |
    rtapi::ResourceStates::kVertexAndConstantBuffer;

/// Buffers of one deformed mesh.
struct SkinnedMesh {
  std::uint32_t vertex_count = 0;              ///< vertices of the mesh
  bool has_more = false;                       ///< [Mesh::has_more]
  rtapi::GpuVirtualAddress bind_vertices = 0;  ///< as upload_scene has them, bind pose
  rtapi::GpuVirtualAddress skin = 0;           ///< SkinVertex each
  rtapi::Buffer joints;                        ///< JointMatrix each, upload heap
  std::uint32_t morph_targets = 0;             ///< that move its vertices
  rtapi::GpuVirtualAddress morph = 0;          ///< MorphMoves, as Mesh::morph has them
  rtapi::Buffer weights;                       ///< a float for each target, upload heap
  rtapi::Buffer vertices;                      ///< kSkinnedVertexState outside of the skinning
};

/// The compute pass that deforms vertices. [glTF 2.0: Skins]
class SkinningPass {
 public:
  /// Makes the pass from the shaders that are built in.
  /// @errors KA0910, and those of rtapi::Device::CreateComputePipelineState.
  static rtapi::Result<SkinningPass> create(const rtapi::Device& device);
  /// Bytes from one deformed vertex of the mesh to the next.
  static std::uint32_t stride(const Mesh& mesh) {
    return mesh.has_more() ? kColoredSkinnedVertexStride : kSkinnedVertexStride;
  }
  /// Makes the buffers for `mesh`, whose bind pose and SkinVertices stand at the two addresses and
  /// must live as long, as `morph` does: those of its moves where it has any. A mesh that only
  /// morphs has one joint, which leaves it where it is.
  /// @errors those of rtapi::Device::CreateBuffer.
  static rtapi::Result<SkinnedMesh> create_mesh(const rtapi::Device& device, const Mesh& mesh,
                                                rtapi::GpuVirtualAddress bind_vertices,
                                                rtapi::GpuVirtualAddress skin,
                                                std::uint32_t joint_count,
                                                rtapi::GpuVirtualAddress morph = 0);
  /// Records the dispatches: begin() sets the pipeline, dispatch() deforms one mesh by the matrices
  /// in SkinnedMesh::joints. There are no barriers: the vertices must be in unordered-access state.
  /// `keep_history`: the buffer holds the frame before, whose positions are kept.
  ///@{
  void begin(rtapi::CommandList& list) const;
  void dispatch(rtapi::CommandList& list, const SkinnedMesh& mesh, bool keep_history) const;
  ///@}

 private:
  rtapi::RootSignature root_signature_;
  rtapi::PipelineState pipeline_;
};

}  // namespace kaamos::effects
