// SPDX-License-Identifier: MIT
//
// Scratch memory for callable shaders nested deeper than lavapipe counts on. It gives a pipeline
// memory for 31 levels of the callable shader that takes most, whatever the pipeline's stack size
// is, and deeper ones write over other memory. A callable shader that nobody calls, and that takes
// more than all others, makes these 31 levels large enough. [tests/vulkan/callable_probe.cpp]
#pragma once

#include <cstdint>
#include <span>

#include "runtime/backend/linked_pipeline.h"

namespace kaamos::vulkan {

struct CallableFrame {
  uint32_t depth = 0;  // levels that there is memory for
  uint32_t words = 0;  // of the shader that nobody calls; 0: none is needed
};
// For callables that are to nest `depth` deep. stack_bytes: of a thread of the driver, where the
// memory lies for 8 lanes at once; a quarter of it is taken at most.
CallableFrame callable_frame(const runtime::LinkedPipeline& pipeline, uint32_t depth,
                             uint64_t stack_bytes);

// The module of that shader; specialization constant 0 is the number of words.
std::span<const uint32_t> callable_frame_spirv();

}  // namespace kaamos::vulkan
