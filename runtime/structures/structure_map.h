// SPDX-License-Identifier: MIT
//
// Keeps track of where acceleration structures are. A structure is a range of bytes in the
// application's memory. A small header in those bytes says that it is still there, so overwriting
// them ends it, and so does a later build or copy to any part of the range, or the end of the
// buffer. What it consists of belongs to the backend. [DXR: Data rules]
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>

#include "runtime/structures/opacity_micromap.h"

namespace kaamos::shader {
struct ClusterTriangle;  // kaamos/shader/triangle_positions.h
}

namespace kaamos::runtime {

using BuildFlags = rtapi::RaytracingAccelerationStructureBuildFlags;

struct Bounds {
  float lower[3] = {0, 0, 0};
  float upper[3] = {0, 0, 0};
};

// The shape of a geometry, which an update is checked against.
struct GeometryShape {
  rtapi::RaytracingGeometryType type = rtapi::RaytracingGeometryType::kTriangles;
  rtapi::Format vertex_format = rtapi::Format::kUnknown;
  rtapi::Format index_format = rtapi::Format::kUnknown;
  uint32_t index = 0;  // GeometryIndex
  bool opaque = false;
  bool no_duplicate_any_hit = false;
  bool transformed = false;  // Transform3x4 is not null
  bool linked = false;       // has opacity micromaps
  uint32_t vertices = 0;
  uint32_t primitives = 0;
};
GeometryShape shape_of(const rtapi::RaytracingGeometryDesc& desc, uint32_t index);

// A geometry as its build decoded it; the arrays belong to the bottom level, and are those of its
// last update. Serialized and decoded data are made from it.
struct GeometryContents {
  std::span<const float> xyz;         // transformed; empty if no triangle can be hit
  std::span<const uint32_t> indices;  // of every triangle; empty: 0, 1, 2, ...
  std::span<const rtapi::RaytracingAabb> boxes;
  const MicromapLinkage* linkage = nullptr;
};

// The facts that every backend knows about its bottom levels.
struct BottomLevelBase {
  virtual ~BottomLevelBase() = default;
  // Has no active primitive, so its instances are degenerate. [DXR: Degenerate primitives and
  // instances]
  virtual bool empty() const = 0;
  virtual Bounds object_bounds() const = 0;  // only if not empty
  virtual std::vector<GeometryShape> geometry_shapes() const = 0;
  virtual GeometryContents geometry_contents(uint32_t geometry) const = 0;
  // By triangle, in a bottom level of clusters; otherwise null. Such a level's geometries are in no
  // order, and several may have the same GeometryIndex.
  virtual const shader::ClusterTriangle* cluster_triangles(uint32_t) const { return nullptr; }
};
struct TopLevelBase {
  virtual ~TopLevelBase() = default;
};

struct PartitionedTopLevel;  // runtime/structures/partitioned_instances.h
struct Cluster;              // runtime/structures/cluster.h
struct ClusterTemplate;      // runtime/structures/cluster.h

// The structure at an address. Exactly one of the two levels, the micromaps, the cluster and the
// template is set.
struct AccelerationStructure {
  uint64_t address = 0;
  uint8_t* host = nullptr;       // the same address for the host
  uint64_t size_bytes = 0;       // CURRENT_SIZE: the prebuild size, or the compacted one
  uint64_t compacted_bytes = 0;  // COMPACTED_SIZE: what the backend's data take, at most size_bytes
  BuildFlags flags = BuildFlags::kNone;
  std::shared_ptr<BottomLevelBase> bottom_level;
  std::shared_ptr<const TopLevelBase> top_level;
  std::shared_ptr<const MicromapArray> micromaps;
  std::shared_ptr<const Cluster> cluster;
  std::shared_ptr<const ClusterTemplate> cluster_template;
  // Bottom levels: it was built from clusters; and where they were.
  bool of_clusters = false;
  std::shared_ptr<const std::vector<uint64_t>> clusters;
  // Bottom levels: by geometry, null for those without; empty if none has one. Clusters: theirs.
  std::vector<std::shared_ptr<MicromapLinkage>> linkages;
  uint32_t instance_count = 0;  // top levels: NumDescs
  // Top levels: the records as the build read them. Trees keep neither the addresses nor inactive
  // instances, which serialization and tools must return. 64 bytes an instance, shared by clones.
  std::shared_ptr<const std::vector<rtapi::RaytracingInstanceDesc>> instances;
  // Partitioned top levels: what their instances were set to; `instances` is null then.
  std::shared_ptr<const PartitionedTopLevel> partitioned;
  // What was deserialized before what it refers to: how many bottom levels of instances, or
  // clusters, were not at their addresses yet.
  uint32_t missing = 0;
  bool missing_reported = false;

  // It comes from an operation on clusters.
  bool is_cluster_object() const {
    return of_clusters || cluster != nullptr || cluster_template != nullptr;
  }
};

class StructureMap {
 public:
  // Ends whatever is in the structure's range, and writes its header there. Linkages and micromap
  // arrays find each other here, whichever comes first; one that has an array keeps it.
  void place(AccelerationStructure structure);
  // Ends every structure with bytes in the range.
  void evict(uint64_t address, uint64_t size_bytes);

  // The structure at exactly this address, if its header is intact.
  std::shared_ptr<const AccelerationStructure> find(uint64_t address) const;
  // Returns whether another structure, a clone, uses the same bottom level.
  bool is_shared(const BottomLevelBase* level) const;
  // Every top level whose header is intact.
  std::vector<std::shared_ptr<const AccelerationStructure>> top_levels() const;
  // Those that something is missing from; costs next to nothing while there are none.
  std::vector<std::shared_ptr<const AccelerationStructure>> incomplete() const;

 private:
  struct Placed {
    uint64_t id;
    std::shared_ptr<const AccelerationStructure> structure;
  };
  void evict_locked(uint64_t address, uint64_t size_bytes);
  void link_locked(const AccelerationStructure& placed);
  template <class Condition>
  std::vector<std::shared_ptr<const AccelerationStructure>> all_with(Condition condition) const;

  mutable std::shared_mutex mutex_;
  std::map<uint64_t, Placed> structures_;
  std::map<const BottomLevelBase*, uint32_t> owners_;
  uint64_t next_id_ = 1;
  std::atomic<uint32_t> incomplete_ = 0;
};

}  // namespace kaamos::runtime
