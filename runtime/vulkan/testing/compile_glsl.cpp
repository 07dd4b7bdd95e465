// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/compile_glsl.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <gtest/gtest.h>

namespace kaamos::vulkan::testing {
namespace {

EShLanguage language_of(VkShaderStageFlagBits stage) {
  switch (stage) {
    case VK_SHADER_STAGE_RAYGEN_BIT_KHR:
      return EShLangRayGen;
    case VK_SHADER_STAGE_CALLABLE_BIT_KHR:
      return EShLangCallable;
    case VK_SHADER_STAGE_MISS_BIT_KHR:
      return EShLangMiss;
    case VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR:
      return EShLangClosestHit;
    case VK_SHADER_STAGE_ANY_HIT_BIT_KHR:
      return EShLangAnyHit;
    case VK_SHADER_STAGE_INTERSECTION_BIT_KHR:
      return EShLangIntersect;
    default:
      return EShLangCompute;
  }
}

struct Process {
  Process() { glslang::InitializeProcess(); }
  ~Process() { glslang::FinalizeProcess(); }
};

}  // namespace

std::vector<uint32_t> compile_glsl(VkShaderStageFlagBits stage, const std::string& source) {
  static const Process process;
  const EShLanguage language = language_of(stage);
  glslang::TShader shader(language);
  const char* text = source.c_str();
  shader.setStrings(&text, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  std::vector<uint32_t> words;
  if (!shader.parse(GetDefaultResources(), 460, false, messages)) {
    ADD_FAILURE() << shader.getInfoLog();
    return words;
  }
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) {
    ADD_FAILURE() << program.getInfoLog();
    return words;
  }
  glslang::GlslangToSpv(*program.getIntermediate(language), words);
  return words;
}

}  // namespace kaamos::vulkan::testing
