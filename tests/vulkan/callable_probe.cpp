// SPDX-License-Identifier: MIT
//
// Tests how deep callable shaders nest on the driver itself, without anything of runtime/vulkan. A
// callable calls itself as often as the command line says, with 16 words of data per level, in a
// pipeline whose stack size is set large enough for all levels. Prints "levels: N" if all levels
// returned the right words, and otherwise what is wrong. Mesa 25.0 allocates scratch memory for 31
// levels of the callable shader that needs most of it, whatever the stack size
// (lvp_ray_tracing_pipeline.c: "We can not support dynamic stack sizes"); deeper levels overwrite
// other memory. `--frame WORDS` adds a callable shader that nobody calls and that needs so many
// words, so that 31 times as many are allocated. Usage: callable_probe LEVELS [--frame WORDS]
#include <volk.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

#include "tests/vulkan/raw_gpu.h"

namespace {

constexpr char kCommon[] = R"(#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(buffer_reference, scalar) buffer Block { uint levels; uint reached; uint words[16]; };
layout(push_constant) uniform Push { Block block; };
struct Data { uint level; uint words[16]; };
)";
constexpr char kRayGeneration[] = R"(
layout(location = 0) callableDataEXT Data data;
void main() {
  data.level = 0;
  for (uint i = 0; i < 16; ++i) data.words[i] = i;
  executeCallableEXT(0, 0);
  block.reached = data.level;
  for (uint i = 0; i < 16; ++i) block.words[i] = data.words[i];
})";
// Each level adds one to each word on the way in, and its own number on the way out.
constexpr char kNested[] = R"(
layout(location = 0) callableDataInEXT Data given;
layout(location = 1) callableDataEXT Data passed;
void main() {
  uint level = given.level + 1;
  passed.level = level;
  for (uint i = 0; i < 16; ++i) passed.words[i] = given.words[i] + 1;
  if (level < block.levels) executeCallableEXT(0, 1);
  given.level = passed.level;
  for (uint i = 0; i < 16; ++i) given.words[i] = passed.words[i] + level;
})";
constexpr char kFrame[] = R"(
struct Frame { uint words[FRAME_WORDS]; };
layout(location = 0) callableDataInEXT Data given;
layout(location = 1) callableDataEXT Frame frame;
void main() {
  frame.words[given.level % FRAME_WORDS] = 1;
  executeCallableEXT(given.level, 1);
  given.level = frame.words[(given.level + 1) % FRAME_WORDS];
})";

int probe(uint32_t levels, uint32_t frame_words) {
  raw::Gpu gpu;
  const auto general = [](int stage) { return raw::Group{stage, -1, -1, -1}; };
  const auto callable = VK_SHADER_STAGE_CALLABLE_BIT_KHR;
  const auto ray_generation =
      raw::compile(VK_SHADER_STAGE_RAYGEN_BIT_KHR, std::string(kCommon) + kRayGeneration);
  const auto nested = raw::compile(callable, std::string(kCommon) + kNested);
  std::vector<uint32_t> frame;
  std::vector<raw::Stage> stages = {{VK_SHADER_STAGE_RAYGEN_BIT_KHR, &ray_generation, {}},
                                    {callable, &nested, {}}};
  std::vector<raw::Group> groups = {general(0), general(1)};
  if (frame_words != 0) {
    std::string text = std::string(kCommon) + kFrame;
    text.insert(text.find('\n') + 1, "#define FRAME_WORDS " + std::to_string(frame_words) + "\n");
    frame = raw::compile(callable, text);
    stages.push_back({callable, &frame, {}});
    groups.push_back(general(2));
  }
  const raw::Pipeline pipeline = gpu.pipeline(stages, groups, 1, true);
  uint64_t stack = 0;
  for (uint32_t group = 0; group < 2; ++group) {
    stack += (group == 0 ? 1 : levels) *
             vkGetRayTracingShaderGroupStackSizeKHR(gpu.device(), pipeline.pipeline, group,
                                                    VK_SHADER_GROUP_SHADER_GENERAL_KHR);
  }
  const uint64_t stride = 64;
  raw::Buffer tables = gpu.buffer(2 * stride);
  for (uint32_t group = 0; group < 2; ++group) {
    std::memcpy(tables.data + group * stride, pipeline.handles.data() + group * gpu.handle_size(),
                gpu.handle_size());
  }
  raw::Buffer block = gpu.buffer(18 * 4);
  std::memset(block.data, 0, block.size_bytes);
  block.as<uint32_t>()[0] = levels;
  gpu.run([&](VkCommandBuffer list) {
    const VkStridedDeviceAddressRegionKHR none{};
    const VkStridedDeviceAddressRegionKHR first{tables.address, stride, stride};
    const VkStridedDeviceAddressRegionKHR second{tables.address + stride, stride, stride};
    vkCmdBindPipeline(list, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline.pipeline);
    vkCmdSetRayTracingPipelineStackSizeKHR(list, static_cast<uint32_t>(stack));
    vkCmdPushConstants(list, gpu.layout(), VK_SHADER_STAGE_ALL, 0, 8, &block.address);
    vkCmdTraceRaysKHR(list, &first, &none, &none, &second, 1, 1, 1);
  });
  const uint32_t reached = block.as<uint32_t>()[1];
  bool right = reached == levels;
  for (uint32_t i = 0; i < 16; ++i) {
    right = right && block.as<uint32_t>()[2 + i] == i + levels + levels * (levels + 1) / 2;
  }
  std::printf("%s\n%s: %u of %u\n", gpu.name().c_str(), right ? "levels" : "wrong words; levels",
              reached, levels);
  return right ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 && !(count == 4 && std::strcmp(arguments[2], "--frame") == 0)) {
    std::fprintf(stderr, "usage: callable_probe LEVELS [--frame WORDS]\n");
    return 2;
  }
  try {
    return probe(static_cast<uint32_t>(std::atoi(arguments[1])),
                 count == 4 ? static_cast<uint32_t>(std::atoi(arguments[3])) : 0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 77;
  }
}
