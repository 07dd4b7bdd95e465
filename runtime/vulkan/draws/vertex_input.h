// SPDX-License-Identifier: MIT
//
// Assigns vertex buffers to the inputs of a vertex shader, in Vulkan's terms.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/backend/linked_graphics.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

// A slot, and how its elements advance: elements of one slot may have different step rates.
struct VertexBinding {
  uint32_t slot = 0;
  bool per_instance = false;
  uint32_t step_rate = 0;
  uint32_t extent_bytes = 0;  // up to the end of the last element of a vertex

  // Returns whether Vulkan takes the stride with the buffer. Strides that let elements overlap must
  // be part of the pipeline. [VUID-vkCmdBindVertexBuffers2-pStrides-06210]
  bool takes(uint32_t stride_bytes) const {
    return stride_bytes == 0 || stride_bytes >= extent_bytes;
  }
};

struct VertexInput {
  std::vector<VertexBinding> bindings;
  std::vector<VkVertexInputAttributeDescription> attributes;
  // By attribute: four 32-bit components of its class, to read zeros as.
  std::vector<VkFormat> zero_formats;
};

// Errors: KA0966 the device has no vertices in a format.
rtapi::Result<VertexInput> vertex_input(const Gpu& gpu, const runtime::LinkedGraphics& linked);

}  // namespace kaamos::vulkan
