// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/callable_frame.h"

#include <algorithm>

#include "runtime/vulkan/rays/pipeline_stack.h"

namespace kaamos::vulkan {
namespace {

// Mesa: lvp_compile_ray_tracing_pipeline.
constexpr uint64_t kDriversLevels = 31;
constexpr uint64_t kLanes = 8;

// The SPIR-V that "glslangValidator --target-env vulkan1.3 -g0" makes of this GLSL:
//   #version 460
//   #extension GL_EXT_ray_tracing : require
//   layout(constant_id = 0) const uint kWords = 64;
//   struct Frame { uint words[kWords]; };
//   layout(location = 0) callableDataInEXT uint given;
//   layout(location = 1) callableDataEXT Frame frame;
//   void main() {
//     frame.words[given % kWords] = 1;
//     executeCallableEXT(given, 1);
//     given = frame.words[(given + 1) % kWords];
//   }
constexpr uint32_t kSpirv[] = {
    0x07230203, 0x00010600, 0x0008000b, 0x0000001c, 0x00000000, 0x00020011, 0x0000117f, 0x0006000a,
    0x5f565053, 0x5f52484b, 0x5f796172, 0x63617274, 0x00676e69, 0x0006000b, 0x00000001, 0x4c534c47,
    0x6474732e, 0x3035342e, 0x00000000, 0x0003000e, 0x00000000, 0x00000001, 0x0007000f, 0x000014c6,
    0x00000004, 0x6e69616d, 0x00000000, 0x0000000b, 0x0000000f, 0x00040047, 0x00000007, 0x00000001,
    0x00000000, 0x00020013, 0x00000002, 0x00030021, 0x00000003, 0x00000002, 0x00040015, 0x00000006,
    0x00000020, 0x00000000, 0x00040032, 0x00000006, 0x00000007, 0x00000040, 0x0004001c, 0x00000008,
    0x00000006, 0x00000007, 0x0003001e, 0x00000009, 0x00000008, 0x00040020, 0x0000000a, 0x000014d0,
    0x00000009, 0x0004003b, 0x0000000a, 0x0000000b, 0x000014d0, 0x00040015, 0x0000000c, 0x00000020,
    0x00000001, 0x0004002b, 0x0000000c, 0x0000000d, 0x00000000, 0x00040020, 0x0000000e, 0x000014d1,
    0x00000006, 0x0004003b, 0x0000000e, 0x0000000f, 0x000014d1, 0x0004002b, 0x00000006, 0x00000012,
    0x00000001, 0x00040020, 0x00000013, 0x000014d0, 0x00000006, 0x0004002b, 0x0000000c, 0x00000016,
    0x00000001, 0x00050036, 0x00000002, 0x00000004, 0x00000000, 0x00000003, 0x000200f8, 0x00000005,
    0x0004003d, 0x00000006, 0x00000010, 0x0000000f, 0x00050089, 0x00000006, 0x00000011, 0x00000010,
    0x00000007, 0x00060041, 0x00000013, 0x00000014, 0x0000000b, 0x0000000d, 0x00000011, 0x0003003e,
    0x00000014, 0x00000012, 0x0004003d, 0x00000006, 0x00000015, 0x0000000f, 0x0003115e, 0x00000015,
    0x0000000b, 0x0004003d, 0x00000006, 0x00000017, 0x0000000f, 0x00050080, 0x00000006, 0x00000018,
    0x00000017, 0x00000012, 0x00050089, 0x00000006, 0x00000019, 0x00000018, 0x00000007, 0x00060041,
    0x00000013, 0x0000001a, 0x0000000b, 0x0000000d, 0x00000019, 0x0004003d, 0x00000006, 0x0000001b,
    0x0000001a, 0x0003003e, 0x0000000f, 0x0000001b, 0x000100fd, 0x00010038,
};

uint64_t bytes_of_level(const runtime::LinkedShader& shader) {
  constexpr uint64_t kHeaderBytes = 16;
  const shader::ExportDesc& code = *shader.code;
  // Its variables, the parameter it gets and the parameter it passes on.
  return code.stack_bytes + 2 * (code.callable_data_bytes + kHeaderBytes) +
         code.payload_storage_bytes;
}

uint64_t bytes_of_twin(const runtime::LinkedShader& shader, const TwinLevels& twins) {
  constexpr uint64_t kHeaderBytes = 16;
  constexpr uint64_t kQueryBytes = 512;
  return shader.code->stack_bytes + kQueryBytes +
         2 * (kHeaderBytes + sizeof(shader::HitObject) + uint64_t{twins.payload_words} * 4);
}

}  // namespace

CallableFrame callable_frame(const runtime::LinkedPipeline& pipeline, uint32_t depth,
                             uint64_t stack_bytes, const TwinLevels& twins) {
  const bool nests = needs_own_stack(pipeline);
  if (twins.count == 0 && !nests) return {depth, 0};
  depth = (nests ? depth : 1) + twins.count;
  if (depth <= kDriversLevels) return {depth, 0};
  uint64_t level = 0;
  for (const auto& record : pipeline.records) {
    if (record->kind != runtime::RecordKind::kCallable || record->shader == nullptr) continue;
    level = std::max(level, bytes_of_level(*record->shader));
  }
  if (twins.count != 0) {
    for (const auto& shader : pipeline.shaders) {
      level = std::max(level, bytes_of_twin(*shader, twins));
    }
  }
  // A quarter of the stack, which is what nested_payload_limit() leaves.
  const uint64_t most = stack_bytes / 4 / kLanes / kDriversLevels;
  const uint64_t levels = std::min<uint64_t>(depth, most * kDriversLevels / level);
  if (levels <= kDriversLevels) return {static_cast<uint32_t>(kDriversLevels), 0};
  const uint64_t bytes = (levels * level + kDriversLevels - 1) / kDriversLevels;
  return {static_cast<uint32_t>(levels), static_cast<uint32_t>((bytes + 3) / 4)};
}

std::span<const uint32_t> callable_frame_spirv() {
  return kSpirv;
}

}  // namespace kaamos::vulkan
