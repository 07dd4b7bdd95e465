// SPDX-License-Identifier: MIT
#include "hand_vulkan.h"

#include <volk.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/vulkan/structures/sort.h"
#include "tests/vulkan/raw_gpu.h"

namespace kaamos::bench {
namespace {

constexpr const char* kCommon = R"(#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
struct Ray { vec3 origin; float t_min; vec3 direction; float t_max; };
struct Closest { float t; uint primitive; };
layout(buffer_reference, scalar) buffer Rays { Ray v[]; };
layout(buffer_reference, scalar) buffer ClosestResults { Closest v[]; };
layout(buffer_reference, scalar) buffer VisibleResults { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Block {
  uint64_t top_level, rays, results;
};
layout(push_constant, scalar) uniform Push { Block block; };
)";

// Launch rows alternate between the picture's halves, each of which the driver gives to one thread.
constexpr const char* kIndex = R"(
uint ray_index() {
  uint rows = gl_LaunchSizeEXT.y, half_rows = (rows + 1) / 2, y = gl_LaunchIDEXT.y;
  uint row = y < half_rows ? 2 * y : 2 * (y - half_rows) + 1;
  return row * gl_LaunchSizeEXT.x + gl_LaunchIDEXT.x;
}
)";

constexpr const char* kClosestRays = R"(
layout(location = 0) rayPayloadEXT Closest payload;
void main() {
  uint index = ray_index();
  Ray ray = Rays(block.rays).v[index];
  payload = Closest(-1.0, 0xFFFFFFFFu);
  traceRayEXT(accelerationStructureEXT(block.top_level), 0, 0xFF, 0, 0, 0, ray.origin, ray.t_min,
              ray.direction, ray.t_max, 0);
  ClosestResults(block.results).v[index] = payload;
}
)";

constexpr const char* kClosestHit = R"(
layout(location = 0) rayPayloadInEXT Closest payload;
void main() { payload = Closest(gl_HitTEXT, gl_PrimitiveID); }
)";

constexpr const char* kClosestMiss = "void main() {}";

constexpr const char* kVisibleRays = R"(
layout(location = 0) rayPayloadEXT uint payload;
void main() {
  uint index = ray_index();
  Ray ray = Rays(block.rays).v[index];
  payload = 0;
  traceRayEXT(accelerationStructureEXT(block.top_level),
              gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xFF, 0, 0, 0,
              ray.origin, ray.t_min, ray.direction, ray.t_max, 0);
  VisibleResults(block.results).v[index] = payload;
}
)";

constexpr const char* kVisibleMiss = R"(
layout(location = 0) rayPayloadInEXT uint payload;
void main() { payload = 1; }
)";

struct Block {
  uint64_t top_level, rays, results;
};

// Ray generation, miss and, for closest hits, a hit group, each in a table with one record.
struct Program {
  raw::Pipeline pipeline;
  raw::Buffer table;
  VkStridedDeviceAddressRegionKHR regions[3] = {};

  Program(raw::Gpu& gpu, const char* raygen, const char* miss, const char* hit) {
    const std::string common = kCommon;
    const auto raygen_code = raw::compile(VK_SHADER_STAGE_RAYGEN_BIT_KHR, common + kIndex + raygen);
    const auto miss_code = raw::compile(VK_SHADER_STAGE_MISS_BIT_KHR, common + miss);
    std::vector<raw::Stage> stages = {{VK_SHADER_STAGE_RAYGEN_BIT_KHR, &raygen_code, {}},
                                      {VK_SHADER_STAGE_MISS_BIT_KHR, &miss_code, {}}};
    std::vector<raw::Group> groups = {{0, -1, -1, -1}, {1, -1, -1, -1}, {-1, -1, -1, -1}};
    std::vector<uint32_t> hit_code;
    if (hit != nullptr) {
      hit_code = raw::compile(VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, common + hit);
      groups[2].closest_hit = 2;
      stages.push_back({VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, &hit_code, {}});
    }
    pipeline = gpu.pipeline(stages, groups, 1);
    table = gpu.buffer(3 * 64);
    for (uint32_t i = 0; i < 3; ++i) {
      std::memcpy(table.data + i * 64, pipeline.handles.data() + i * gpu.handle_size(),
                  gpu.handle_size());
      regions[i] = {table.address + i * 64, 64, 64};
    }
  }
};

}  // namespace

struct HandVulkan::State {
  raw::Gpu gpu;
  std::vector<raw::Buffer> buffers;
  std::vector<raw::Accel> bottom_levels;
  raw::Accel top_level;
  Program closest{gpu, kClosestRays, kClosestMiss, kClosestHit};
  Program visible{gpu, kVisibleRays, kVisibleMiss, nullptr};
  raw::Buffer block = gpu.buffer(sizeof(Block));
  raw::Buffer rays, results;
  uint32_t width = 0, height = 0;

  template <class T>
  const raw::Buffer& upload(const std::vector<T>& values) {
    buffers.push_back(gpu.buffer(std::max<size_t>(values.size() * sizeof(T), 16)));
    std::memcpy(buffers.back().data, values.data(), values.size() * sizeof(T));
    return buffers.back();
  }

  void build_mesh(const HandMesh& mesh) {
    const uint64_t vertices = upload(mesh.positions).address;
    raw::AccelInput input;
    for (const std::vector<uint32_t>& indices : mesh.geometries) {
      input.geometries.push_back(
          raw::triangles(vertices, static_cast<uint32_t>(mesh.positions.size() / 3),
                         upload(indices).address, VK_GEOMETRY_OPAQUE_BIT_KHR));
      input.counts.push_back(static_cast<uint32_t>(indices.size() / 3));
    }
    bottom_levels.push_back(gpu.accel(input));
    gpu.run([&](VkCommandBuffer list) { gpu.build(list, bottom_levels.back(), input); });
  }

  void build_top(const std::vector<InstanceData>& instances) {
    std::vector<VkAccelerationStructureInstanceKHR> records(instances.size());
    for (size_t i = 0; i < instances.size(); ++i) {
      std::memcpy(&records[i].transform, instances[i].transform.data(), 48);
      records[i].mask = 0xFF;
      records[i].accelerationStructureReference = bottom_levels[instances[i].mesh].address;
    }
    raw::AccelInput input;
    input.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
    input.geometries = {raw::instances(upload(records).address)};
    input.counts = {static_cast<uint32_t>(records.size())};
    top_level = gpu.accel(input);
    gpu.run([&](VkCommandBuffer list) { gpu.build(list, top_level, input); });
  }

  void run(const Program& program) {
    gpu.run([&](VkCommandBuffer list) {
      const VkStridedDeviceAddressRegionKHR none{};
      vkCmdBindPipeline(list, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, program.pipeline.pipeline);
      vkCmdPushConstants(list, gpu.layout(), VK_SHADER_STAGE_ALL, 0, 8, &block.address);
      vkCmdTraceRaysKHR(list, &program.regions[0], &program.regions[1], &program.regions[2], &none,
                        width, height, 1);
    });
  }

  ~State() {
    for (raw::Accel& accel : bottom_levels) gpu.free(accel);
    if (top_level.handle != VK_NULL_HANDLE) gpu.free(top_level);
    for (raw::Buffer* buffer : {&closest.table, &visible.table, &block, &rays, &results}) {
      if (buffer->buffer != VK_NULL_HANDLE) gpu.free(*buffer);
    }
    for (raw::Buffer& buffer : buffers) gpu.free(buffer);
    gpu.free(closest.pipeline.pipeline);
    gpu.free(visible.pipeline.pipeline);
  }
};

void sort_for_driver(HandMesh& mesh) {
  std::vector<vulkan::SortItem> items;
  std::vector<uint32_t> begins;
  for (const std::vector<uint32_t>& indices : mesh.geometries) {
    begins.push_back(static_cast<uint32_t>(items.size()));
    for (uint32_t i = 0; i < indices.size() / 3; ++i) {
      vulkan::SortItem item;
      item.primitive = i;
      for (int axis = 0; axis < 3; ++axis) {
        float low = INFINITY;
        float high = -INFINITY;
        for (uint32_t corner = 0; corner < 3; ++corner) {
          const float at =
              mesh.positions[indices[i * 3 + corner] * 3 + static_cast<uint32_t>(axis)];
          low = std::min(low, at);
          high = std::max(high, at);
        }
        item.centre[axis] = 0.5f * (low + high);
      }
      items.push_back(item);
    }
  }
  vulkan::sort_for_halving(items, begins);
  size_t next = 0;
  for (std::vector<uint32_t>& indices : mesh.geometries) {
    const std::vector<uint32_t> unsorted = indices;
    for (size_t i = 0; i < indices.size(); i += 3, ++next) {
      std::copy_n(unsorted.begin() + 3 * items[next].primitive, 3, indices.begin() + i);
    }
  }
}

std::vector<HandMesh> hand_meshes(const SceneData& data, bool sorted) {
  std::vector<HandMesh> meshes;
  for (const MeshData& from : data.meshes) {
    HandMesh& mesh = meshes.emplace_back();
    for (const effects::Vertex& vertex : *from.vertices) {
      for (int i = 0; i < 3; ++i) mesh.positions.push_back(vertex.position[i]);
    }
    for (const GeometryData& geometry : from.geometries) {
      std::vector<uint32_t>& indices = mesh.geometries.emplace_back();
      for (uint32_t i = 0; i < 3 * geometry.triangle_count; ++i) {
        indices.push_back(geometry.first_vertex + from.indices[geometry.first_index + i]);
      }
    }
    if (sorted) sort_for_driver(mesh);
  }
  return meshes;
}

HandVulkan::HandVulkan(const std::vector<HandMesh>& meshes,
                       const std::vector<InstanceData>& instances)
    : state_(std::make_unique<State>()) {
  for (const HandMesh& mesh : meshes) state_->build_mesh(mesh);
  state_->build_top(instances);
}

HandVulkan::~HandVulkan() = default;

void HandVulkan::set_rays(const RayGrid& grid) {
  State& s = *state_;
  for (raw::Buffer* buffer : {&s.rays, &s.results}) {
    if (buffer->buffer != VK_NULL_HANDLE) s.gpu.free(*buffer);
  }
  s.width = grid.width;
  s.height = grid.height;
  s.rays = s.gpu.buffer(grid.rays.size() * sizeof(Ray));
  std::memcpy(s.rays.data, grid.rays.data(), grid.rays.size() * sizeof(Ray));
  s.results = s.gpu.buffer(grid.rays.size() * sizeof(ClosestResult));
  const Block block{s.top_level.address, s.rays.address, s.results.address};
  std::memcpy(s.block.data, &block, sizeof block);
}

void HandVulkan::closest() {
  state_->run(state_->closest);
}

void HandVulkan::visible() {
  state_->run(state_->visible);
}

std::vector<ClosestResult> HandVulkan::closest_results() const {
  const auto* begin = state_->results.as<ClosestResult>();
  return {begin, begin + size_t{state_->width} * state_->height};
}

std::vector<uint32_t> HandVulkan::visible_results() const {
  const auto* begin = state_->results.as<uint32_t>();
  return {begin, begin + size_t{state_->width} * state_->height};
}

}  // namespace kaamos::bench
