// SPDX-License-Identifier: MIT
//
// Scratch memory for callable shaders that nest deeper than lavapipe expects. It gives a pipeline
// memory for 31 levels of the callable shader that takes most, whatever the pipeline's stack size
// is, and deeper levels overwrite other memory. An extra callable shader that nobody calls, but
// that takes more memory than all others, makes these 31 levels large enough.
// [tests/vulkan/callable_probe.cpp]
#pragma once

#include <cstdint>
#include <span>

#include "runtime/backend/linked_pipeline.h"

namespace kaamos::vulkan {

struct CallableFrame {
  uint32_t depth = 0;  // number of levels that there is memory for, with those of twins
  uint32_t words = 0;  // size of the extra shader; 0: none is needed
};
// Twins of hit and miss shaders (spirv_interface.h), which nest below and above callables.
struct TwinLevels {
  uint32_t count = 0;
  uint32_t payload_words = 0;
};
// For callables that should nest `depth` deep, besides the twins. stack_bytes is the stack of a
// driver thread, which holds that memory for 8 lanes at once; at most a quarter of it is used.
CallableFrame callable_frame(const runtime::LinkedPipeline& pipeline, uint32_t depth,
                             uint64_t stack_bytes, const TwinLevels& twins = {});

// The module of the extra shader; specialization constant 0 is the number of words.
std::span<const uint32_t> callable_frame_spirv();

}  // namespace kaamos::vulkan
