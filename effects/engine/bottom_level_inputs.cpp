// SPDX-License-Identifier: MIT
#include "effects/engine/bottom_level_inputs.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

RaytracingGeometryFlags geometry_flags(const Geometry& geometry, bool glass) {
  // Any-hit shaders count layers of glass, so each hit must invoke them only once.
  if (glass) return RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
  return geometry.alpha_tested ? RaytracingGeometryFlags::kNone : RaytracingGeometryFlags::kOpaque;
}

}  // namespace

void BottomLevelInputs::add(const Geometry& geometry, const GpuGeometry& gpu) {
  RaytracingGeometryTrianglesDesc triangles = {};
  triangles.VertexFormat = Format::kR32G32B32Float;
  triangles.VertexCount = geometry.vertex_count;
  triangles.VertexBuffer = {gpu.vertices, gpu.constants.vertex_stride};
  triangles.IndexFormat = geometry.index_size_bytes == 2 ? Format::kR16Uint : Format::kR32Uint;
  triangles.IndexCount = geometry.index_count;
  triangles.IndexBuffer = gpu.indices;
  RaytracingGeometryDesc desc;
  desc.Flags = geometry_flags(geometry, gpu.glass);
  if (gpu.linkage) {
    desc.Type = RaytracingGeometryType::kOmmTriangles;
    desc.OmmTriangles = {&triangles_.emplace_back(triangles),
                         &linkages_.emplace_back(*gpu.linkage)};
  } else {
    desc.Type = RaytracingGeometryType::kTriangles;
    desc.Triangles = triangles;
  }
  geometries_.push_back(desc);
}

BuildRaytracingAccelerationStructureInputs BottomLevelInputs::desc(
    RaytracingAccelerationStructureBuildFlags flags) const {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = static_cast<std::uint32_t>(geometries_.size());
  inputs.pGeometryDescs = geometries_.data();
  return inputs;
}

}  // namespace kaamos::effects
