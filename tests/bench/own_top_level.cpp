// SPDX-License-Identifier: MIT
#include "own_top_level.h"

#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "runtime/embree/ray_state.h"
#include "tiles.h"

namespace kaamos::bench {
namespace {

using embree::RayState;
namespace shim = embree::shim;

constexpr uint8_t kEveryClass[3] = {embree::kAllClasses, embree::kAllClasses, embree::kAllClasses};

// What does not change from ray to ray.
RayState make_state(const embree::TopLevel& top_level) {
  RayState state = {};
  shim::init(state.query);
  state.top_level = &top_level;
  state.inclusion_mask = 0xFF;
  state.classes = kEveryClass;
  state.committed_t = std::numeric_limits<float>::infinity();
  return state;
}

void begin_ray(const Ray& in, RayState& state, RTCRay& ray) {
  state.t_near = embree::next_above(in.t_min);
  state.t_far = embree::next_below(in.t_max);
  _mm_store_ps(&ray.org_x, _mm_setr_ps(in.origin[0], in.origin[1], in.origin[2], state.t_near));
  _mm_store_ps(&ray.dir_x, _mm_setr_ps(in.direction[0], in.direction[1], in.direction[2], 0));
  ray.tfar = state.t_far;
  ray.mask = embree::kAllClasses;
  ray.id = 0;
  ray.flags = 0;
}

std::vector<rtapi::RaytracingGeometryDesc> describe(const MeshData& mesh) {
  std::vector<rtapi::RaytracingGeometryDesc> out;
  const auto vertices = reinterpret_cast<uint64_t>(mesh.vertices->data());
  const auto indices = reinterpret_cast<uint64_t>(mesh.indices.data());
  for (const GeometryData& geometry : mesh.geometries) {
    rtapi::RaytracingGeometryDesc& desc = out.emplace_back();
    desc.Flags = rtapi::RaytracingGeometryFlags::kOpaque;
    desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
    desc.Triangles.IndexFormat = rtapi::Format::kR32Uint;
    desc.Triangles.IndexCount = 3 * geometry.triangle_count;
    desc.Triangles.IndexBuffer = indices + uint64_t{geometry.first_index} * 4;
    desc.Triangles.VertexCount = geometry.vertex_count;
    desc.Triangles.VertexBuffer = {
        vertices + uint64_t{geometry.first_vertex} * effects::kVertexStride,
        effects::kVertexStride};
  }
  return out;
}

// Addresses of bottom levels are their indices, from 1.
std::shared_ptr<const embree::BottomLevel> find_mesh(const void* self, uint64_t address) {
  using Meshes = std::vector<std::shared_ptr<const embree::BottomLevel>>;
  return (*static_cast<const Meshes*>(self))[address - 1];
}

}  // namespace

OwnTopLevel::OwnTopLevel(const SceneData& data) : device_(new_embree_device()) {
  const embree::BuildContext context = {device_, true};
  for (const MeshData& mesh : data.meshes) {
    const auto geometries = describe(mesh);
    meshes_.push_back(
        embree::BottomLevel::build(context, geometries, embree::BuildFlags::kNone).value());
  }
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (const InstanceData& instance : data.instances) {
    rtapi::RaytracingInstanceDesc& desc = instances.emplace_back();
    std::memcpy(desc.Transform, instance.transform.data(), sizeof(desc.Transform));
    desc.AccelerationStructure = instance.mesh + 1;
  }
  std::vector<std::string> notes;
  top_level_ = embree::TopLevel::build(context, instances, find_mesh, &meshes_, notes).value();
}

OwnTopLevel::~OwnTopLevel() {
  top_level_.reset();
  meshes_.clear();
  rtcReleaseDevice(device_);
}

void OwnTopLevel::closest(tbb::task_arena& arena, const RayGrid& grid,
                          std::vector<ClosestResult>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    return [this, &grid, &results, state = make_state(*top_level_)](uint32_t index) mutable {
      RTCRayHit hit;
      begin_ray(grid.rays[index], state, hit.ray);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      shim::intersect(top_level_->scene(), state.query, &hit);
      const bool missed = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID;
      results[index] = {missed ? -1.0f : hit.ray.tfar, missed ? ~0u : hit.hit.primID};
    };
  });
}

void OwnTopLevel::visible(tbb::task_arena& arena, const RayGrid& grid,
                          std::vector<uint32_t>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    return [this, &grid, &results, state = make_state(*top_level_)](uint32_t index) mutable {
      RTCRay ray;
      begin_ray(grid.rays[index], state, ray);
      shim::occluded(top_level_->scene(), state.query, &ray);
      results[index] = ray.tfar >= 0 ? 1 : 0;
    };
  });
}

}  // namespace kaamos::bench
