// SPDX-License-Identifier: MIT
/// @file
/// The inputs of a bottom level: the geometries of a mesh, with their opacity micromaps.
#pragma once

#include <rtapi/rtapi.h>

#include <deque>
#include <vector>

#include "effects/engine/gpu_scene.h"

namespace kaamos::effects {

/// Geometries as builds and updates take them. Can be moved, but not copied: descs point to each
/// other.
class BottomLevelInputs {
 public:
  BottomLevelInputs() = default;
  BottomLevelInputs(BottomLevelInputs&&) = default;             ///< what it has, moves
  BottomLevelInputs& operator=(BottomLevelInputs&&) = default;  ///< likewise

  /// Adds a geometry. `gpu`: its record.
  void add(const Geometry& geometry, const GpuGeometry& gpu);
  /// The inputs; this object must stay while they are used.
  rtapi::BuildRaytracingAccelerationStructureInputs desc(
      rtapi::RaytracingAccelerationStructureBuildFlags flags) const;

 private:
  std::vector<rtapi::RaytracingGeometryDesc> geometries_;
  std::deque<rtapi::RaytracingGeometryTrianglesDesc> triangles_;  // of those with micromaps
  std::deque<rtapi::RaytracingGeometryOmmLinkageDesc> linkages_;  // likewise
};

}  // namespace kaamos::effects
