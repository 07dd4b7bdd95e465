// SPDX-License-Identifier: MIT
//
// The stack of a ray tracing pipeline. By default Vulkan reserves two levels of callable shaders;
// ours may nest up to kMaxCallableDepth.
#pragma once

#include <vector>

#include "runtime/backend/linked_pipeline.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

// Returns whether callable shaders of the pipeline call others. If so, its stack size is dynamic
// state, to be set to pipeline_stack_bytes.
bool needs_own_stack(const runtime::LinkedPipeline& pipeline);

// `groups` in the order of creation: those of the records, then `twins` callables that stand for
// hit and miss shaders.
uint32_t pipeline_stack_bytes(const Gpu& gpu, VkPipeline pipeline,
                              const std::vector<VkRayTracingShaderGroupCreateInfoKHR>& groups,
                              const std::vector<const runtime::LinkedRecord*>& records,
                              size_t twins, uint32_t trace_depth, uint32_t callable_depth);

// Returns how many traces lavapipe can nest with a payload of this size (PAYLOAD). It keeps the
// payloads of all 8 lanes on its thread's stack, and for each level both the shader's own payload
// and the one that is passed on.
uint32_t nested_payload_limit(uint32_t payload_bytes, uint64_t stack_bytes);
// The stack of a thread for which nobody set a size: the process's limit, usually 8 MiB.
uint64_t default_thread_stack_bytes();
// The largest payload of any shader in the pipeline, as it is stored.
uint32_t largest_payload(const runtime::LinkedPipeline& pipeline);
// The largest parameter of any callable shader in the pipeline.
uint32_t largest_callable_data(const runtime::LinkedPipeline& pipeline);

}  // namespace kaamos::vulkan
