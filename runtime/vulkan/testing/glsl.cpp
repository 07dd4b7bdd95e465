// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/glsl.h"
#include "runtime/vulkan/spirv/shader_stage.h"

#include "kaamos/shader/spirv_interface.h"
#include "runtime/vulkan/testing/compile_glsl.h"

namespace kaamos::vulkan::testing {
namespace {

constexpr char kPreamble[] = R"(#version 460
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
layout(buffer_reference, scalar) buffer Words { uint w[]; };
layout(buffer_reference, scalar) buffer DispatchBlock {
  uint64_t view_heap_begin, view_heap_end, sampler_heap_begin, sampler_heap_end;
  uint64_t instances, top_levels, empty_top_level, status;
  uint top_level_mask, miss_count, callable_count, hit_group_count;
  uint dimensions[3];
  uint base[3];
  uint rows, reserved;
  uint64_t arguments[64];
};
layout(push_constant, scalar) uniform Push { DispatchBlock block; };
layout(constant_id = 0) const uint binding_source_0 = 0;
layout(constant_id = 1) const uint binding_offset_0 = 0;
layout(constant_id = 2000) const uint WORKAROUNDS = 0;
layout(constant_id = 2001) const uint MAX_TRACE_DEPTH = 0;
layout(constant_id = 2002) const uint MAX_CALLABLE_DEPTH = 0;
)";

constexpr char kRays[] = R"(#extension GL_EXT_ray_tracing : require
void remove_device(uint reason) { Words(block.status).w[0] = 1 + reason; }
struct TopLevelEntry { uint64_t address; uint64_t vulkan; uint64_t rest[2]; };
layout(buffer_reference, scalar) buffer TopLevels { TopLevelEntry e[]; };
uint64_t find_top_level(uint64_t address) {
  uint slot = (uint(address >> 8) * 0x9E3779B1u) >> 7;
  for (;; ++slot) {
    slot &= block.top_level_mask;
    TopLevelEntry entry = TopLevels(block.top_levels).e[slot];
    if (entry.address == address) return entry.vulkan;
    if (entry.address == 0) return block.empty_top_level;
  }
}
)";

constexpr char kRecord[] = R"(
layout(shaderRecordEXT, scalar) buffer Record { uint64_t local_arguments; } record;
)";

// glslang accepts constant ids only up to 2046, so 2000 and up stand for the larger ones of the
// interface.
void restore_constant_ids(std::vector<uint32_t>& words) {
  constexpr uint32_t kOpDecorate = 71;
  constexpr uint32_t kSpecId = 1;
  for (size_t i = 5; i < words.size() && words[i] >> 16 != 0; i += words[i] >> 16) {
    if ((words[i] & 0xFFFF) != kOpDecorate || words[i + 2] != kSpecId || words[i + 3] < 2000) {
      continue;
    }
    words[i + 3] += shader::spirv::kWorkaroundsConstant - 2000;
  }
}

}  // namespace

std::vector<uint32_t> compile_shader(shader::Stage stage, const std::string& body) {
  std::string text = kPreamble;
  if (stage != shader::Stage::kCompute) text += std::string(kRays) + kRecord;
  std::vector<uint32_t> words = compile_glsl(stage_of(stage), text + body);
  restore_constant_ids(words);
  return words;
}

}  // namespace kaamos::vulkan::testing
