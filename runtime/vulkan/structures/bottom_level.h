// SPDX-License-Identifier: MIT
//
// A bottom level: a Vulkan acceleration structure, with a copy of its decoded inputs on the host.
// One of clusters consists of others, its parts.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/structures/clustered_geometry.h"
#include "runtime/structures/structure_map.h"
#include "runtime/vulkan/structures/vulkan_structure.h"

namespace kaamos::vulkan {

// What a triangle of a part is to the application.
struct ClusterNumbers {
  uint32_t primitive_index = 0;
  uint32_t cluster_id = 0;
};

class BottomLevel final : public runtime::BottomLevelBase {
 public:
  // `geometries` must have passed check_inputs, and have host addresses. With `update_of`, the
  // indices are those of its build. [DXR: Acceleration structure update constraints] `shapes`, if
  // given (for a deserialized structure), are what updates are checked against. `linkages`: by
  // geometry, null for those without micromaps; empty if none has any. Errors: KA0794 too many
  // primitives or geometries, KA0990 out of memory.
  static rtapi::Result<std::shared_ptr<BottomLevel>> build(
      const std::shared_ptr<Gpu>& gpu, std::span<const rtapi::RaytracingGeometryDesc> geometries,
      runtime::BuildFlags flags,
      std::span<const std::shared_ptr<runtime::MicromapLinkage>> linkages,
      const BottomLevel* update_of = nullptr, std::span<const runtime::GeometryShape> shapes = {});

  // EXPERIMENTAL: from clusters. A driver's number of a geometry decides its hit record, and the
  // geometry's flags are those of all of its triangles. So each combination of flags makes a part,
  // in which the driver's numbers are the application's, with empty geometries in between. Shaders
  // find micromaps by PrimitiveIndex, so triangles with micromaps and equal numbers make parts,
  // too. Errors: as above, and KA0794 also a geometry index beyond kMaxGeometryIndex, or more than
  // kMaxParts parts.
  static rtapi::Result<std::shared_ptr<BottomLevel>> build_clustered(
      const std::shared_ptr<Gpu>& gpu, std::vector<runtime::ClusteredGeometry> geometries,
      runtime::BuildFlags flags);
  static constexpr uint32_t kMaxGeometryIndex = 0xFFFF;
  static constexpr uint32_t kMaxParts = 256;
  bool clustered() const { return !clusters_.empty(); }
  // What instances of a level of clusters are instances of.
  std::span<const std::shared_ptr<BottomLevel>> parts() const { return parts_; }
  const shader::ClusterTriangle* cluster_triangles(uint32_t geometry) const override {
    return clusters_.of(geometry);
  }

  bool empty() const override { return empty_; }
  runtime::Bounds object_bounds() const override { return bounds_; }
  std::vector<runtime::GeometryShape> geometry_shapes() const override { return shapes_; }
  runtime::GeometryContents geometry_contents(uint32_t geometry) const override {
    const Inputs& inputs = inputs_[geometry];
    return {inputs.xyz, inputs.indices, inputs.boxes, linkage(geometry)};
  }
  // Whether a geometry has opacity micromaps.
  bool has_micromaps() const { return micromap_indices_ != nullptr; }
  // Null for a geometry without.
  const runtime::MicromapLinkage* linkage(size_t geometry) const {
    return linkages_.empty() ? nullptr : linkages_[geometry].get();
  }
  // The array of a geometry's micromaps; null as long as there is none.
  std::shared_ptr<const runtime::MicromapArray> micromap_array(size_t geometry) const;
  // spirv::GeometryMicromaps::indices
  uint64_t micromap_indices(size_t geometry) const;

  uint64_t address() const { return structure_->address(); }
  uint64_t primitive_remap() const { return remap_; }  // spirv::InstanceEntry::primitive_remap
  // spirv::kPositionsNotKept, spirv::kClusterTable
  uint64_t position_table() const { return position_table_; }
  uint64_t held_bytes() const { return held_bytes_; }
  uint64_t out_of_range_triangles() const { return out_of_range_triangles_; }
  std::span<const runtime::GeometryShape> shapes() const { return shapes_; }
  runtime::BuildFlags flags() const { return flags_; }
  const VulkanStructure& structure() const { return *structure_; }

 private:
  friend class BottomLevelBuilder;
  BottomLevel() = default;
  static rtapi::Result<std::shared_ptr<BottomLevel>> build_part(
      const std::shared_ptr<Gpu>& gpu, std::vector<runtime::ClusteredGeometry> geometries,
      std::shared_ptr<const runtime::MicromapLinkage> linked_by, runtime::BuildFlags flags);
  void keep_clusters(std::vector<runtime::ClusteredGeometry> geometries);

  std::unique_ptr<VulkanStructure> structure_;
  uint64_t remap_ = 0;
  uint64_t position_table_ = 0;
  uint64_t held_bytes_ = 0;
  uint64_t out_of_range_triangles_ = 0;
  bool empty_ = true;
  runtime::Bounds bounds_;
  runtime::BuildFlags flags_ = runtime::BuildFlags::kNone;
  std::vector<runtime::GeometryShape> shapes_;
  // A driver's tree is opaque and cannot be decoded, and DXR does not say before a build whether
  // the structure will be serialized, so this is kept for every bottom level. It takes 12 bytes per
  // vertex, 12 per indexed triangle and 24 per box, besides the 104 for each in lavapipe's tree.
  // Updates take the indices from it, too.
  struct Inputs {
    std::vector<float> xyz;
    std::vector<uint32_t> indices;  // empty: 0, 1, 2, ...
    std::vector<rtapi::RaytracingAabb> boxes;
  };
  std::vector<Inputs> inputs_;                                             // one per geometry
  std::vector<std::shared_ptr<const runtime::MicromapLinkage>> linkages_;  // likewise, or empty
  std::unique_ptr<GpuBuffer> micromap_indices_;  // of all linked geometries; null: there are none
  // Parts: by geometry, the linkage that learns of the array.
  std::vector<std::shared_ptr<const runtime::MicromapLinkage>> linked_by_;
  // Only in a level of clusters:
  std::vector<std::shared_ptr<BottomLevel>> parts_;
  runtime::ClusterTriangles clusters_;
  std::vector<shader::GeometryPositions> positions_;  // what clusters_ refers to
};

}  // namespace kaamos::vulkan
