// SPDX-License-Identifier: MIT
//
// The stack of a ray tracing pipeline. What Vulkan reserves by default holds two levels of callable
// shaders; ours may nest to kMaxCallableDepth.
#pragma once

#include <vector>

#include "runtime/backend/linked_pipeline.h"
#include "runtime/vulkan/gpu.h"

namespace kaamos::vulkan {

// Whether callable shaders of the pipeline call others: then its stack is a dynamic state, to be
// set to pipeline_stack_bytes.
bool needs_own_stack(const runtime::LinkedPipeline& pipeline);

// `groups` as created, in order.
uint32_t pipeline_stack_bytes(const Gpu& gpu, VkPipeline pipeline,
                              const std::vector<VkRayTracingShaderGroupCreateInfoKHR>& groups,
                              const std::vector<const runtime::LinkedRecord*>& records,
                              uint32_t trace_depth, uint32_t callable_depth);

// Traces that lavapipe can nest with a payload of so many bytes (PAYLOAD). It keeps the payloads of
// all 8 lanes on its thread's stack, and for each level both the shader's own and the one that
// travels.
uint32_t nested_payload_limit(uint32_t payload_bytes, uint64_t stack_bytes);
// What a thread gets that nobody gave a size: as a process's limit says, 8 MiB as a rule.
uint64_t default_thread_stack_bytes();
// The largest payload that a shader of the pipeline takes, as it is stored.
uint32_t largest_payload(const runtime::LinkedPipeline& pipeline);
// The largest parameter of a callable shader of the pipeline.
uint32_t largest_callable_data(const runtime::LinkedPipeline& pipeline);

}  // namespace kaamos::vulkan
