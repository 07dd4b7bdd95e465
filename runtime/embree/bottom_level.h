// SPDX-License-Identifier: MIT
//
// A bottom level: one Embree scene over own copies of its inputs.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/embree/embree_shim.h"

namespace kaamos::embree {

using BuildFlags = rtapi::RaytracingAccelerationStructureBuildFlags;

struct BuildContext {
  RTCDevice device = nullptr;
  bool robust = true;  // RTC_SCENE_FLAG_ROBUST: DXR's open t interval is exact only with it
};

// What Embree's callbacks get as the user pointer of a geometry.
struct GeometryInfo {
  rtapi::RaytracingGeometryType type = rtapi::RaytracingGeometryType::kTriangles;
  rtapi::Format vertex_format = rtapi::Format::kUnknown;
  rtapi::Format index_format = rtapi::Format::kUnknown;
  uint32_t index = 0;  // GeometryIndex
  bool opaque = false;
  bool no_duplicate_any_hit = false;
  bool transformed = false;  // Transform3x4 is not null
  uint32_t vertices = 0;
  uint32_t primitives = 0;
  std::vector<rtapi::RaytracingAabb> boxes;  // procedural: own copy
};

class BottomLevel {
 public:
  // The inputs passed check_inputs. Errors: KA0792 Embree ran out of memory or refused.
  static rtapi::Result<std::shared_ptr<BottomLevel>> build(
      const BuildContext& context, std::span<const rtapi::RaytracingGeometryDesc> geometries,
      BuildFlags flags);
  ~BottomLevel();
  BottomLevel(const BottomLevel&) = delete;
  BottomLevel& operator=(const BottomLevel&) = delete;

  // Whether an update from this structure with these inputs keeps to DXR's rules: same geometries,
  // counts, formats and flags, the transform as null as it was. KA0793 says which rule is broken.
  // [DXR: Bottom-level acceleration structure updates]
  rtapi::Status check_update(std::span<const rtapi::RaytracingGeometryDesc> geometries,
                             BuildFlags flags) const;
  // Reads new vertices and boxes into this structure and refits it.
  rtapi::Status update(const BuildContext& context,
                       std::span<const rtapi::RaytracingGeometryDesc> geometries);
  // An updated copy; this one stays as it is. Indices are taken from the copy that was made when
  // this was built. [DXR: Acceleration structure update constraints]
  rtapi::Result<std::shared_ptr<BottomLevel>> updated_copy(
      const BuildContext& context, std::span<const rtapi::RaytracingGeometryDesc> geometries) const;

  RTCScene scene() const { return scene_; }
  bool procedural() const { return procedural_; }
  // Without an active primitive: a degenerate instance. [DXR: Degenerate primitives and instances]
  bool empty() const { return empty_; }
  const RTCBounds& bounds() const { return bounds_; }
  BuildFlags flags() const { return flags_; }
  const std::vector<std::unique_ptr<GeometryInfo>>& geometries() const { return geometries_; }
  uint64_t out_of_range_triangles() const { return out_of_range_triangles_; }

 private:
  BottomLevel() = default;
  rtapi::Status create_scene(const BuildContext& context);
  rtapi::Status add_triangles(const BuildContext& context,
                              const rtapi::RaytracingGeometryTrianglesDesc& desc,
                              std::unique_ptr<GeometryInfo> info, const uint32_t* indices);
  rtapi::Status add_boxes(const BuildContext& context,
                          const rtapi::RaytracingGeometryAabbsDesc& desc,
                          std::unique_ptr<GeometryInfo> info);
  rtapi::Status add_geometries(const BuildContext& context,
                               std::span<const rtapi::RaytracingGeometryDesc> geometries,
                               const BottomLevel* indices_of);
  rtapi::Status commit(const BuildContext& context);

  RTCScene scene_ = nullptr;
  BuildFlags flags_ = BuildFlags::kNone;
  bool procedural_ = false;
  bool empty_ = true;
  RTCBounds bounds_ = {};
  uint64_t out_of_range_triangles_ = 0;
  std::vector<std::unique_ptr<GeometryInfo>> geometries_;
};

// Callbacks of the traversal, which a build gives to its geometries. [any_hit.cpp,
// intersection.cpp]
void filter_triangle(const RTCFilterFunctionNArguments* arguments);        // of non-opaque ones
void filter_every_triangle(const RTCFilterFunctionNArguments* arguments);  // of a query
void intersect_procedural(const RTCIntersectFunctionNArguments* arguments);
void occlude_procedural(const RTCOccludedFunctionNArguments* arguments);

}  // namespace kaamos::embree
