// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/glsl.h"

#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <gtest/gtest.h>

#include <mutex>

#include "kaamos/shader/spirv_interface.h"

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
)";

constexpr char kRecord[] = R"(
layout(shaderRecordEXT, scalar) buffer Record { uint64_t local_arguments; } record;
)";

EShLanguage language_of(shader::Stage stage) {
  switch (stage) {
    case shader::Stage::kRayGeneration:
      return EShLangRayGen;
    case shader::Stage::kIntersection:
      return EShLangIntersect;
    case shader::Stage::kAnyHit:
      return EShLangAnyHit;
    case shader::Stage::kClosestHit:
      return EShLangClosestHit;
    case shader::Stage::kMiss:
      return EShLangMiss;
    case shader::Stage::kCallable:
      return EShLangCallable;
    default:
      return EShLangCompute;
  }
}

// glslang takes constant ids up to 2046: those of the interface that are larger stand for 2000 on.
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

std::vector<uint32_t> compile_glsl(shader::Stage stage, const std::string& body) {
  static const bool started = glslang::InitializeProcess();
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (!started) return {};
  std::string text = kPreamble;
  if (stage != shader::Stage::kCompute) text += std::string(kRays) + kRecord;
  text += body;
  const EShLanguage language = language_of(stage);
  const char* const strings[] = {text.c_str()};
  glslang::TShader shader(language);
  shader.setStrings(strings, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  const TBuiltInResource limits = [] {
    TBuiltInResource r = {};
    r.maxComputeWorkGroupCountX = r.maxComputeWorkGroupCountY = r.maxComputeWorkGroupCountZ = 65535;
    r.maxComputeWorkGroupSizeX = r.maxComputeWorkGroupSizeY = 1024;
    r.maxComputeWorkGroupSizeZ = 64;
    r.limits.generalUniformIndexing = r.limits.generalVariableIndexing = true;
    return r;
  }();
  glslang::TProgram program;
  bool ok = shader.parse(&limits, 460, false, messages);
  program.addShader(&shader);
  ok = ok && program.link(messages);
  if (!ok) {
    ADD_FAILURE() << shader.getInfoLog() << program.getInfoLog() << body;
    return {};
  }
  std::vector<uint32_t> words;
  glslang::GlslangToSpv(*program.getIntermediate(language), words);
  restore_constant_ids(words);
  return words;
}

}  // namespace kaamos::vulkan::testing
