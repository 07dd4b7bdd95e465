// SPDX-License-Identifier: MIT
//
// Reads and writes texels of the bindless set with compute shaders, as rtapi's shaders do.
#pragma once

#include <memory>
#include <vector>

#include "runtime/shader/texture/format_codec.h"
#include "runtime/vulkan/textures/descriptor_set.h"

namespace kaamos::vulkan::testing {

class TexelKernel {
 public:
  TexelKernel(std::shared_ptr<Gpu> gpu, const DescriptorSet& descriptors);
  ~TexelKernel();
  TexelKernel(const TexelKernel&) = delete;
  TexelKernel& operator=(const TexelKernel&) = delete;

  // Reads mip 0 of a sampled 2-D view, row by row.
  std::vector<shader::Texel> read(uint64_t index, shader::NumberClass number, uint32_t width,
                                  uint32_t height);
  // Writes the same value to each texel of a storage view.
  void write(uint64_t index, shader::NumberClass number, uint32_t width, uint32_t height,
             const shader::Texel& value);

 private:
  VkPipeline create(const char* prefix, const char* to_bits, const char* from_bits, bool writes);
  void run(VkPipeline pipeline, uint64_t index, uint64_t address, uint32_t width, uint32_t height);

  std::shared_ptr<Gpu> gpu_;
  VkDescriptorSet set_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::vector<VkShaderModule> modules_;
  VkPipeline pipelines_[6] = {};  // reads of float, uint, sint, then writes
};

}  // namespace kaamos::vulkan::testing
