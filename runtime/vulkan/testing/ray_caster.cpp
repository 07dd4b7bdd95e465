// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/ray_caster.h"

#include <algorithm>
#include <chrono>
#include <string>

#include "runtime/vulkan/testing/compile_glsl.h"

namespace kaamos::vulkan::testing {
namespace {

constexpr char kCommon[] = R"(#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
struct Ray { vec3 origin; float t_min; vec3 direction; float t_max; };
struct Hit { float t; uint instance, instance_id, geometry, primitive, kind; };
struct Entry {
  uint64_t primitive_remap;
  uint instance_id, instance_index;
  uint64_t micromaps;
  uint flags, reserved;
};
layout(buffer_reference, scalar) buffer Rays { Ray of[]; };
layout(buffer_reference, scalar) buffer Hits { Hit of[]; };
layout(buffer_reference, scalar) buffer Entries { Entry of[]; };
layout(buffer_reference, scalar) buffer Words { uint of[]; };
layout(push_constant, scalar) uniform Parameters {
  uint64_t top_level; uint64_t rays; uint64_t hits; uint64_t entries;
  uint64_t top_levels; uint64_t empty_top_level; uint top_level_mask;
};
)";
constexpr char kPrimitive[] = R"(
uint primitive() {
  uint64_t remap = Entries(entries).of[gl_InstanceCustomIndexEXT].primitive_remap;
  if (remap == 0) return gl_PrimitiveID;
  return Words(remap).of[Words(remap).of[gl_GeometryIndexEXT] + gl_PrimitiveID];
}
)";
constexpr char kRayGeneration[] = R"(
layout(location = 0) rayPayloadEXT Hit hit;
struct TopLevel { uint64_t address, vulkan, rest[2]; };
layout(buffer_reference, scalar) buffer TopLevels { TopLevel of[]; };
uint64_t find_top_level() {
  uint slot = (uint(top_level >> 8) * 0x9E3779B1u >> 7) & top_level_mask;
  while (true) {
    TopLevel entry = TopLevels(top_levels).of[slot];
    if (entry.address == top_level) return entry.vulkan;
    if (entry.address == 0) return empty_top_level;
    slot = (slot + 1) & top_level_mask;
  }
}
void main() {
  uint i = gl_LaunchIDEXT.x;
  Ray ray = Rays(rays).of[i];
  hit.t = -2;
  traceRayEXT(accelerationStructureEXT(find_top_level()), 0, 0xFF, 0, 0, 0, ray.origin, ray.t_min,
              ray.direction, ray.t_max, 0);
  Hits(hits).of[i] = hit;
}
)";
constexpr char kMiss[] = R"(
layout(location = 0) rayPayloadInEXT Hit hit;
void main() { hit = Hit(-1, 0, 0, 0, 0, 0); }
)";
constexpr char kClosestHit[] = R"(
layout(location = 0) rayPayloadInEXT Hit hit;
void main() {
  Entry entry = Entries(entries).of[gl_InstanceCustomIndexEXT];
  hit = Hit(gl_HitTEXT, entry.instance_index, entry.instance_id, gl_GeometryIndexEXT,
            primitive(), gl_HitKindEXT);
}
)";
constexpr char kIntersection[] = R"(
void main() { reportIntersectionEXT(1.0 + float(primitive()), 7); }
)";

struct Parameters {
  uint64_t top_level;
  uint64_t rays;
  uint64_t hits;
  uint64_t entries;
  uint64_t top_levels;
  uint64_t empty_top_level;
  uint32_t top_level_mask;
};

}  // namespace

RayCaster::RayCaster(SceneHarness& scene) : scene_(scene) {
  create_pipeline();
}

RayCaster::~RayCaster() {
  const VolkDeviceTable& vk = scene_.gpu().vk();
  VkDevice device = scene_.gpu().device();
  vk.vkDestroyPipeline(device, pipeline_, nullptr);
  vk.vkDestroyPipelineLayout(device, layout_, nullptr);
  for (VkShaderModule module : modules_) vk.vkDestroyShaderModule(device, module, nullptr);
}

void RayCaster::create_pipeline() {
  Gpu& gpu = scene_.gpu();
  const VkPushConstantRange range = {VK_SHADER_STAGE_ALL, 0, sizeof(Parameters)};
  VkPipelineLayoutCreateInfo layout = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  ASSERT_EQ(gpu.vk().vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &layout_), VK_SUCCESS);
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  const auto stage = [&](VkShaderStageFlagBits bit, const std::string& text) {
    const auto words = compile_glsl(bit, kCommon + text);
    VkShaderModuleCreateInfo module = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module.codeSize = words.size() * 4;
    module.pCode = words.data();
    modules_.push_back(VK_NULL_HANDLE);
    EXPECT_EQ(gpu.vk().vkCreateShaderModule(gpu.device(), &module, nullptr, &modules_.back()),
              VK_SUCCESS);
    VkPipelineShaderStageCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = bit;
    info.module = modules_.back();
    info.pName = "main";
    stages.push_back(info);
  };
  stage(VK_SHADER_STAGE_RAYGEN_BIT_KHR, kRayGeneration);
  stage(VK_SHADER_STAGE_MISS_BIT_KHR, kMiss);
  stage(VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, std::string(kPrimitive) + kClosestHit);
  stage(VK_SHADER_STAGE_INTERSECTION_BIT_KHR, std::string(kPrimitive) + kIntersection);
  VkRayTracingShaderGroupCreateInfoKHR none = {
      VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
  none.generalShader = none.closestHitShader = VK_SHADER_UNUSED_KHR;
  none.anyHitShader = none.intersectionShader = VK_SHADER_UNUSED_KHR;
  VkRayTracingShaderGroupCreateInfoKHR groups[4] = {none, none, none, none};
  groups[0].generalShader = 0;
  groups[1].generalShader = 1;
  groups[2].type = VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
  groups[2].closestHitShader = 2;
  groups[3].type = VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR;
  groups[3].closestHitShader = 2;
  groups[3].intersectionShader = 3;
  VkRayTracingPipelineCreateInfoKHR info = {VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.groupCount = 4;
  info.pGroups = groups;
  info.maxPipelineRayRecursionDepth = 1;
  info.layout = layout_;
  ASSERT_EQ(gpu.vk().vkCreateRayTracingPipelinesKHR(gpu.device(), VK_NULL_HANDLE, VK_NULL_HANDLE, 1,
                                                    &info, nullptr, &pipeline_),
            VK_SUCCESS);
  const auto& limits = gpu.properties().ray_tracing;
  record_bytes_ = std::max(limits.shaderGroupBaseAlignment, limits.shaderGroupHandleSize);
  const uint32_t handle = limits.shaderGroupHandleSize;
  handles_.resize(4 * handle);
  ASSERT_EQ(gpu.vk().vkGetRayTracingShaderGroupHandlesKHR(gpu.device(), pipeline_, 0, 4,
                                                          handles_.size(), handles_.data()),
            VK_SUCCESS);
}

// The driver reads whatever hit record the scene asks for, so there must be null records up to the
// last one.
void RayCaster::provide_table(uint64_t hit_records) {
  const uint64_t records = 2 + std::max<uint64_t>(hit_records, 2);
  if (table_ != nullptr && table_->size_bytes() >= records * record_bytes_) return;
  auto table = scene_.gpu().create_buffer(records * record_bytes_, "shader table");
  ASSERT_TRUE(table);
  table_ = std::move(*table);
  const size_t handle = handles_.size() / 4;
  for (size_t i = 0; i < 4; ++i) {
    std::memcpy(table_->host() + i * record_bytes_, &handles_[i * handle], handle);
  }
}

std::vector<CastHit> RayCaster::cast(uint64_t top_level, const std::vector<CastRay>& rays) {
  Gpu& gpu = scene_.gpu();
  auto tables = scene_.structures().tables();
  EXPECT_TRUE(tables);
  const uint64_t hit_records = tables->max_hit_record + 1;
  provide_table(hit_records);
  auto out = scene_.buffer(rays.size() * sizeof(CastHit));
  const Parameters parameters = {
      top_level,          scene_.upload(rays),     out->address(),        tables->instances,
      tables->top_levels, tables->empty_top_level, tables->top_level_mask};
  const auto region = [&](uint64_t first, uint64_t count) {
    return VkStridedDeviceAddressRegionKHR{table_->address() + first * record_bytes_, record_bytes_,
                                           count * record_bytes_};
  };
  const auto ray_generation = region(0, 1);
  const auto miss = region(1, 1);
  const auto hit = region(2, hit_records);
  const VkStridedDeviceAddressRegionKHR callable = {};
  const auto start = std::chrono::steady_clock::now();
  const auto status = gpu.run(
      [&](VkCommandBuffer commands) {
        gpu.vk().vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_);
        gpu.vk().vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_ALL, 0, sizeof(parameters),
                                    &parameters);
        gpu.vk().vkCmdTraceRaysKHR(commands, &ray_generation, &miss, &hit, &callable,
                                   static_cast<uint32_t>(rays.size()), 1, 1);
      },
      "cast rays");
  last_ms_ =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(status);
  std::vector<CastHit> hits(rays.size());
  std::memcpy(hits.data(), out->host(), rays.size() * sizeof(CastHit));
  return hits;
}

CastHit RayCaster::cast_along_z(uint64_t top_level, float x, float y) {
  CastRay ray;
  ray.origin[0] = x;
  ray.origin[1] = y;
  return cast(top_level, ray);
}

}  // namespace kaamos::vulkan::testing
