// SPDX-License-Identifier: MIT
//
// Acceleration structures as their builds read them, searched in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "kaamos/shader/abi.h"
#include "runtime/backend/backend.h"
#include "runtime/explain/bvh.h"
#include "runtime/structures/structure_map.h"
#include "runtime/structures/triangle_positions.h"

namespace kaamos::explain {

struct Candidate {
  double t = 0;      // for boxes: where the ray enters, at least 0
  double leave = 0;  // boxes only
  uint32_t instance = 0;
  uint32_t geometry = 0;
  uint32_t primitive = 0;
  uint32_t slot = 0;    // the geometry's place in its bottom level, and
  uint32_t number = 0;  // the primitive's there: what tells candidates in clusters apart
  const shader::ClusterTriangle* cluster = nullptr;  // null: in no cluster
  bool procedural = false;
  bool geometry_opaque = false;
  runtime::MicromapState micromap = runtime::MicromapState::kOfGeometry;
  bool clockwise = false;  // triangles only, as seen from the origin in object space
  float barycentrics[2] = {0, 0};
};

// A bottom level with a hierarchy to find its primitives.
class BottomLevel {
 public:
  BottomLevel(std::shared_ptr<const runtime::BottomLevelBase> source, runtime::BuildFlags flags);
  Box bounds() const { return bvh_.bounds(); }
  const shader::GeometryPositions* positions() const { return positions_.data(); }
  // Finds every triangle at t >= 0 along the object-space ray, and every box that it hits.
  void find(const Ray& ray, uint32_t instance, std::vector<Candidate>& out) const;

 private:
  struct Primitive {
    uint32_t geometry;
    uint32_t index;
  };
  struct Geometry {
    runtime::GeometryShape shape;
    runtime::GeometryContents contents;
    uint32_t slot = 0;
    const shader::ClusterTriangle* clustered = nullptr;  // by triangle
  };
  bool corners(const Geometry& geometry, uint32_t primitive, const float* (&out)[3]) const;
  Box box_of(const Geometry& geometry, uint32_t primitive) const;
  void test_triangle(const Ray& ray, const Geometry& geometry, uint32_t primitive,
                     uint32_t instance, std::vector<Candidate>& out) const;
  void test_box(const Ray& ray, const Geometry& geometry, uint32_t primitive, uint32_t instance,
                std::vector<Candidate>& out) const;

  std::shared_ptr<const runtime::BottomLevelBase> source_;  // owns what the contents refer to
  std::vector<Geometry> geometries_;
  std::vector<shader::GeometryPositions> positions_;
  std::vector<Primitive> primitives_;
  Bvh bvh_;
};

struct Instance {
  rtapi::RaytracingInstanceDesc desc;
  uint32_t id = 0;  // InstanceID
  std::array<float, 12> object_to_world = {};
  shader::InstanceTransform world_to_object = {};
  std::array<double, 12> inverse = {};              // of object_to_world
  std::shared_ptr<const BottomLevel> bottom_level;  // null: inactive
};

class TopLevel {
 public:
  const std::vector<Instance>& instances() const { return instances_; }
  // Finds all candidates at t >= 0, including masked ones, sorted by t, then by instance, slot and
  // number.
  void find(const shader::RayDesc& ray, std::vector<Candidate>& out) const;

 private:
  friend class Scenes;
  std::vector<Instance> instances_;
  Bvh bvh_;
};

// Structures by address, created when they are first needed.
class Scenes {
 public:
  explicit Scenes(const runtime::BackendDevice& backend) : backend_(backend) {}
  // Null if there is no top level.
  const TopLevel* find(uint64_t address);

 private:
  std::shared_ptr<const BottomLevel> bottom_level(uint64_t address);

  const runtime::BackendDevice& backend_;
  std::map<uint64_t, std::unique_ptr<TopLevel>> top_levels_;
  std::map<const runtime::BottomLevelBase*, std::shared_ptr<const BottomLevel>> bottom_levels_;
};

}  // namespace kaamos::explain
