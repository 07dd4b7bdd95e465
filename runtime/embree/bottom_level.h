// SPDX-License-Identifier: MIT
//
// A bottom level: one Embree scene over its own copies of the inputs.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/embree/embree_shim.h"
#include "runtime/embree/exact.h"
#include "runtime/embree/padded_box.h"
#include "runtime/structures/clustered_geometry.h"
#include "runtime/structures/structure_map.h"
#include "runtime/structures/triangle_positions.h"

namespace kaamos::embree {

using runtime::BuildFlags;

// By geometry, null for those without micromaps; empty if none has any.
using Linkages = std::span<const std::shared_ptr<runtime::MicromapLinkage>>;

struct BuildContext {
  RTCDevice device = nullptr;
  bool robust = true;  // RTC_SCENE_FLAG_ROBUST: only with it is DXR's open t interval exact
  // The bottom levels whose triangles are tested by our own code: exact.h.
  enum class Exact : uint8_t { kNone, kNonOpaque, kAll } exact = Exact::kNone;
  PackFilter pack_filter = nullptr;  // for exact
  bool is_exact(std::span<const rtapi::RaytracingGeometryDesc> geometries, Linkages linkages) const;
  bool is_exact(std::span<const runtime::ClusteredGeometry> geometries) const;
};

// The user pointer that Embree's callbacks get for a geometry.
struct GeometryInfo : runtime::GeometryShape {
  uint32_t slot = 0;  // Embree's number of it: its place in the level, and `index` but in clusters
  std::vector<rtapi::RaytracingAabb> boxes;  // procedural: own copy
  std::vector<PaddedBox> padded;             // the same as rays meet them
  bool tested_by_embree = false;             // each box, before its callback
  std::unique_ptr<ExactTriangles> exact;     // triangles in exact precision: own copy
  std::shared_ptr<const runtime::MicromapLinkage> linkage;  // null: no micromaps
};

class BottomLevel final : public runtime::BottomLevelBase {
 public:
  // The inputs must have passed check_inputs. `shapes`, if given (for a deserialized structure),
  // are what updates are checked against. Errors: KA0792: Embree ran out of memory or refused.
  static rtapi::Result<std::shared_ptr<BottomLevel>> build(
      const BuildContext& context, std::span<const rtapi::RaytracingGeometryDesc> geometries,
      BuildFlags flags, Linkages linkages, std::span<const runtime::GeometryShape> shapes = {});
  // EXPERIMENTAL: from clusters. Cannot be updated. Errors: KA0792, as
  // above.
  static rtapi::Result<std::shared_ptr<BottomLevel>> build_clustered(
      const BuildContext& context, std::vector<runtime::ClusteredGeometry> geometries,
      BuildFlags flags);
  ~BottomLevel() override;
  BottomLevel(const BottomLevel&) = delete;
  BottomLevel& operator=(const BottomLevel&) = delete;

  // As runtime::check_update.
  rtapi::Status check_update(std::span<const rtapi::RaytracingGeometryDesc> geometries,
                             BuildFlags flags, const std::vector<bool>& linked) const;
  // Reads new vertices and boxes into this structure, takes the linkages, then refits it.
  rtapi::Status update(const BuildContext& context,
                       std::span<const rtapi::RaytracingGeometryDesc> geometries,
                       Linkages linkages);
  // Returns an updated copy and leaves this one unchanged. Indices come from the copy made when
  // this was built. [DXR: Acceleration structure update constraints]
  rtapi::Result<std::shared_ptr<BottomLevel>> updated_copy(
      const BuildContext& context, std::span<const rtapi::RaytracingGeometryDesc> geometries,
      Linkages linkages) const;

  RTCScene scene() const { return scene_; }
  bool procedural() const { return procedural_; }
  bool exact() const { return exact_ && !procedural_; }
  const ExactFrame& exact_frame() const { return exact_frame_; }
  // An exact level of the same triangles, for rays and instances that make them non-opaque. Made
  // when it is first asked for; null if Embree has no memory for it.
  std::shared_ptr<const BottomLevel> exact_twin(const BuildContext& context) const;
  bool empty() const override { return empty_; }
  runtime::Bounds object_bounds() const override;
  std::vector<runtime::GeometryShape> geometry_shapes() const override;
  // The same buffers that are traced, so serialization costs no memory here.
  runtime::GeometryContents geometry_contents(uint32_t geometry) const override;
  const shader::ClusterTriangle* cluster_triangles(uint32_t geometry) const override {
    return clusters_.of(geometry);
  }
  bool clustered() const { return !clusters_.empty(); }
  BuildFlags flags() const { return flags_; }
  const std::vector<std::unique_ptr<GeometryInfo>>& geometries() const { return geometries_; }
  uint64_t out_of_range_triangles() const { return out_of_range_triangles_; }
  // By slot, for shaders.
  const shader::GeometryPositions* positions() const { return positions_.data(); }

 private:
  BottomLevel() = default;
  rtapi::Status create_scene(const BuildContext& context);
  rtapi::Status add_triangles(const BuildContext& context,
                              const rtapi::RaytracingGeometryTrianglesDesc& desc,
                              std::unique_ptr<GeometryInfo> info, const uint32_t* indices);
  void attach_triangles(RTCGeometry geometry, GeometryInfo& info);
  rtapi::Status add_clusters(const BuildContext& context, runtime::ClusteredGeometry& geometry);
  void keep_positions();
  void add_exact_triangles(const rtapi::RaytracingGeometryTrianglesDesc& desc, GeometryInfo* user,
                           const std::vector<uint32_t>* indices);
  rtapi::Status add_boxes(const BuildContext& context,
                          const rtapi::RaytracingGeometryAabbsDesc& desc,
                          std::unique_ptr<GeometryInfo> info);
  rtapi::Status add_geometries(const BuildContext& context,
                               std::span<const rtapi::RaytracingGeometryDesc> geometries,
                               Linkages linkages, const BottomLevel* indices_of);
  rtapi::Status commit(const BuildContext& context);
  bool tests_each_box() const;
  rtapi::Status pack_exact_triangles(const BuildContext& context);
  rtapi::Status attach_packs(const BuildContext& context, GeometryInfo& info);

  RTCScene scene_ = nullptr;
  BuildFlags flags_ = BuildFlags::kNone;
  bool procedural_ = false;
  bool exact_ = false;
  bool empty_ = true;
  RTCBounds bounds_ = {};
  ExactFrame exact_frame_;
  uint64_t out_of_range_triangles_ = 0;
  std::vector<std::unique_ptr<GeometryInfo>> geometries_;
  std::vector<shader::GeometryPositions> positions_;
  runtime::ClusterTriangles clusters_;  // empty: it was not built from clusters
  mutable std::mutex twin_mutex_;
  mutable std::shared_ptr<const BottomLevel> twin_;
};

// Callbacks of the traversal, which a build gives to its geometries. [any_hit.cpp,
// intersection.cpp]
void filter_triangle(const RTCFilterFunctionNArguments* arguments);        // for non-opaque ones
void filter_every_triangle(const RTCFilterFunctionNArguments* arguments);  // for a query
void intersect_procedural(const RTCIntersectFunctionNArguments* arguments);
void occlude_procedural(const RTCOccludedFunctionNArguments* arguments);

}  // namespace kaamos::embree
