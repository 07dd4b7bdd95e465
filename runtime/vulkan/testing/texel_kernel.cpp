// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/texel_kernel.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <utility>

#include "runtime/vulkan/testing/compile_glsl.h"

namespace kaamos::vulkan::testing {
namespace {

constexpr char kHeader[] = R"(#version 460
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_image_load_formatted : require
layout(local_size_x = 1) in;
layout(buffer_reference, scalar) buffer Texels { uvec4 of[]; };
layout(push_constant, scalar) uniform Parameters { uint64_t texels; uint index; uint width; };
)";

struct Parameters {
  uint64_t texels;
  uint32_t index;
  uint32_t width;
};

}  // namespace

TexelKernel::TexelKernel(std::shared_ptr<Gpu> gpu, const DescriptorSet& descriptors)
    : gpu_(std::move(gpu)), set_(descriptors.handle()) {
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Parameters)};
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  VkPipelineLayoutCreateInfo layout = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  EXPECT_EQ(gpu_->vk().vkCreatePipelineLayout(gpu_->device(), &layout, nullptr, &layout_),
            VK_SUCCESS);
  for (int writes = 0; writes < 2; ++writes) {
    pipelines_[3 * writes] = create("", "floatBitsToUint", "uintBitsToFloat", writes != 0);
    pipelines_[3 * writes + 1] = create("u", "uvec4", "uvec4", writes != 0);
    pipelines_[3 * writes + 2] = create("i", "uvec4", "ivec4", writes != 0);
  }
}

TexelKernel::~TexelKernel() {
  const VolkDeviceTable& vk = gpu_->vk();
  for (VkPipeline pipeline : pipelines_) vk.vkDestroyPipeline(gpu_->device(), pipeline, nullptr);
  for (VkShaderModule module : modules_) vk.vkDestroyShaderModule(gpu_->device(), module, nullptr);
  vk.vkDestroyPipelineLayout(gpu_->device(), layout_, nullptr);
}

VkPipeline TexelKernel::create(const char* prefix, const char* to_bits, const char* from_bits,
                               bool writes) {
  const std::string p = prefix;
  std::string text = kHeader;
  if (writes) {
    text += "layout(set = 0, binding = 1) uniform " + p + "image2D images[];\nvoid main() {\n" +
            "  imageStore(images[index], ivec2(gl_GlobalInvocationID.xy), " + from_bits +
            "(Texels(texels).of[0]));\n}\n";
  } else {
    text += "layout(set = 0, binding = 0) uniform " + p + "texture2D textures[];\n" +
            "void main() {\n  ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n" +
            "  Texels(texels).of[at.y * width + at.x] = " + to_bits +
            "(texelFetch(textures[index], at, 0));\n}\n";
  }
  const auto words = compile_glsl(VK_SHADER_STAGE_COMPUTE_BIT, text);
  VkShaderModuleCreateInfo module = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  module.codeSize = words.size() * 4;
  module.pCode = words.data();
  modules_.push_back(VK_NULL_HANDLE);
  EXPECT_EQ(gpu_->vk().vkCreateShaderModule(gpu_->device(), &module, nullptr, &modules_.back()),
            VK_SUCCESS);
  VkComputePipelineCreateInfo info = {VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = modules_.back();
  info.stage.pName = "main";
  info.layout = layout_;
  VkPipeline pipeline = VK_NULL_HANDLE;
  EXPECT_EQ(gpu_->vk().vkCreateComputePipelines(gpu_->device(), VK_NULL_HANDLE, 1, &info, nullptr,
                                                &pipeline),
            VK_SUCCESS);
  return pipeline;
}

void TexelKernel::run(VkPipeline pipeline, uint64_t index, uint64_t address, uint32_t width,
                      uint32_t height) {
  const Parameters parameters = {address, static_cast<uint32_t>(index), width};
  const auto status = gpu_->run(
      [&](VkCommandBuffer commands) {
        const VolkDeviceTable& vk = gpu_->vk();
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_,
                                   0, nullptr);
        vk.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(parameters),
                              &parameters);
        vk.vkCmdDispatch(commands, width, height, 1);
      },
      "texel kernel");
  EXPECT_TRUE(status);
}

std::vector<shader::Texel> TexelKernel::read(uint64_t index, shader::NumberClass number,
                                             uint32_t width, uint32_t height) {
  std::vector<shader::Texel> texels(size_t{width} * height);
  auto out = gpu_->create_buffer(texels.size() * sizeof(shader::Texel), "texels");
  EXPECT_TRUE(out);
  run(pipelines_[static_cast<int>(number)], index, (*out)->address(), width, height);
  std::memcpy(texels.data(), (*out)->host(), texels.size() * sizeof(shader::Texel));
  return texels;
}

void TexelKernel::write(uint64_t index, shader::NumberClass number, uint32_t width, uint32_t height,
                        const shader::Texel& value) {
  auto in = gpu_->create_buffer(sizeof(value), "texel");
  EXPECT_TRUE(in);
  std::memcpy((*in)->host(), &value, sizeof(value));
  run(pipelines_[3 + static_cast<int>(number)], index, (*in)->address(), width, height);
}

}  // namespace kaamos::vulkan::testing
