// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/pipeline_stack.h"

#include <pthread.h>

#include <algorithm>

namespace kaamos::vulkan {

bool needs_own_stack(const runtime::LinkedPipeline& pipeline) {
  return std::any_of(pipeline.records.begin(), pipeline.records.end(), [](const auto& record) {
    return record->kind == runtime::RecordKind::kCallable && record->shader != nullptr &&
           (record->shader->code->flags & shader::kExportCalls) != 0;
  });
}

uint32_t pipeline_stack_bytes(const Gpu& gpu, VkPipeline pipeline,
                              const std::vector<VkRayTracingShaderGroupCreateInfoKHR>& groups,
                              const std::vector<const runtime::LinkedRecord*>& records,
                              size_t twins, uint32_t trace_depth, uint32_t callable_depth) {
  uint64_t ray_generation = 0;
  uint64_t shading = 0;    // closest-hit and miss shaders, which may trace
  uint64_t traversal = 0;  // intersection shaders plus the any-hit shaders that they call
  uint64_t callable = 0;
  for (size_t i = 0; i < twins; ++i) {
    callable = std::max<uint64_t>(
        callable, gpu.vk().vkGetRayTracingShaderGroupStackSizeKHR(
                      gpu.device(), pipeline, static_cast<uint32_t>(records.size() + i),
                      VK_SHADER_GROUP_SHADER_GENERAL_KHR));
  }
  for (uint32_t i = 0; i < records.size(); ++i) {
    const auto bytes = [&](uint32_t used, VkShaderGroupShaderKHR shader) -> uint64_t {
      if (used == VK_SHADER_UNUSED_KHR) return 0;
      return gpu.vk().vkGetRayTracingShaderGroupStackSizeKHR(gpu.device(), pipeline, i, shader);
    };
    const uint64_t general = bytes(groups[i].generalShader, VK_SHADER_GROUP_SHADER_GENERAL_KHR);
    switch (records[i]->kind) {
      case runtime::RecordKind::kRayGeneration:
        ray_generation = std::max(ray_generation, general);
        break;
      case runtime::RecordKind::kMiss:
        shading = std::max(shading, general);
        break;
      case runtime::RecordKind::kCallable:
        callable = std::max(callable, general);
        break;
      case runtime::RecordKind::kHitGroup:
        shading = std::max(
            shading, bytes(groups[i].closestHitShader, VK_SHADER_GROUP_SHADER_CLOSEST_HIT_KHR));
        traversal = std::max(
            traversal,
            bytes(groups[i].anyHitShader, VK_SHADER_GROUP_SHADER_ANY_HIT_KHR) +
                bytes(groups[i].intersectionShader, VK_SHADER_GROUP_SHADER_INTERSECTION_KHR));
        break;
      case runtime::RecordKind::kNone:
        break;
    }
  }
  // The default as the Vulkan specification computes it, but with more levels of callables.
  uint64_t total = ray_generation + callable_depth * callable;
  if (trace_depth > 0) total += std::max(shading, traversal) + (trace_depth - 1) * shading;
  return static_cast<uint32_t>(std::min<uint64_t>(total, UINT32_MAX));
}

uint32_t nested_payload_limit(uint32_t payload_bytes, uint64_t stack_bytes) {
  constexpr uint64_t kLanes = 8;
  constexpr uint64_t kHeaderBytes = 16;
  const uint64_t for_payloads = stack_bytes / 4 * 3;  // the rest is for everything else
  return static_cast<uint32_t>(for_payloads / (2 * kLanes * (payload_bytes + kHeaderBytes)));
}

uint64_t default_thread_stack_bytes() {
  constexpr uint64_t kUsual = 8u << 20;
  pthread_attr_t attributes;
  if (pthread_getattr_default_np(&attributes) != 0) return kUsual;
  size_t bytes = 0;
  const bool known = pthread_attr_getstacksize(&attributes, &bytes) == 0;
  pthread_attr_destroy(&attributes);
  return known ? bytes : kUsual;
}

uint32_t largest_callable_data(const runtime::LinkedPipeline& pipeline) {
  uint32_t largest = 0;
  for (const auto& shader : pipeline.shaders) {
    largest = std::max(largest, shader->code->callable_data_bytes);
  }
  return largest;
}

uint32_t largest_payload(const runtime::LinkedPipeline& pipeline) {
  uint32_t largest = 0;
  for (const auto& shader : pipeline.shaders) {
    largest = std::max(largest, shader->code->payload_storage_bytes);
  }
  return largest;
}

}  // namespace kaamos::vulkan
