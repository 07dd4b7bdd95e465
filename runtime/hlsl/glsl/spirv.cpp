// SPDX-License-Identifier: MIT
#include "runtime/hlsl/glsl/spirv.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include "kaamos/shader/spirv_interface.h"

namespace kaamos::hlsl {
namespace {

EShLanguage language(uint32_t stage) {
  switch (stage) {
    case ir::kStageRayGeneration:
      return EShLangRayGen;
    case ir::kStageIntersection:
      return EShLangIntersect;
    case ir::kStageAnyHit:
      return EShLangAnyHit;
    case ir::kStageClosestHit:
      return EShLangClosestHit;
    case ir::kStageMiss:
      return EShLangMiss;
    case ir::kStageCallable:
      return EShLangCallable;
    case ir::kStageVertex:
      return EShLangVertex;
    case ir::kStageGeometry:
      return EShLangGeometry;
    case ir::kStagePixel:
      return EShLangFragment;
    default:
      return EShLangCompute;
  }
}

// D3D12 allows larger groups, and more of them, than glslang's defaults; the device sets the actual
// limit.
TBuiltInResource limits() {
  TBuiltInResource out = *GetDefaultResources();
  out.maxComputeWorkGroupSizeX = 1024;
  out.maxComputeWorkGroupSizeY = 1024;
  out.maxComputeWorkGroupSizeZ = 64;
  return out;
}

// Done once per process; glslang needs it before anything else.
void initialise() {
  static const bool done = glslang::InitializeProcess();
  static_cast<void>(done);
}

}  // namespace

SpirvModule compile_spirv(const GlslShader& shader, const std::string& name) {
  initialise();
  static const TBuiltInResource kLimits = limits();
  SpirvModule out;
  // glslang has 11 bits for a constant's number, and a binding takes four constants.
  constexpr size_t kMostConstants = 2047;
  if (shader.constants.size() > kMostConstants) {
    out.error.id = kSpirvBindings;
    out.error.text = "'" + name + "' reaches " + std::to_string(shader.constants.size() / 4) +
                     " bindings, and a shader with SPIR-V can have 511: use arrays of resources or "
                     "ResourceDescriptorHeap, or go without SPIR-V (-no-spirv, "
                     "ShaderCompileOptions::Spirv = false)";
    return out;
  }
  const auto fail = [&](const char* log) {
    out.error.id = kSpirvFailed;
    out.error.text =
        "internal error: the SPIR-V of '" + name +
        "' cannot be made (-no-spirv, ShaderCompileOptions::Spirv = false go without it), "
        "please report it with its HLSL: " +
        log;
    return out;
  };
  const EShLanguage stage = language(shader.stage);
  glslang::TShader unit(stage);
  const char* text = shader.text.c_str();
  unit.setStrings(&text, 1);
  unit.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
  unit.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  unit.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  if (!unit.parse(&kLimits, 460, false, kMessages)) {
    return fail(unit.getInfoLog());
  }
  glslang::TProgram program;
  program.addShader(&unit);
  if (!program.link(kMessages)) {
    return fail(program.getInfoLog());
  }
  std::vector<uint32_t> words;
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  spv::SpvBuildLogger log;
  glslang::GlslangToSpv(*program.getIntermediate(stage), words, &log, &options);
  if (words.empty() || !log.getAllMessages().empty()) {
    return fail(log.getAllMessages().c_str());
  }
  out.words = finish_spirv(words, shader.constants);
  return out;
}

std::string spirv_version() {
  constexpr int kRevision = 2;  // of finish_spirv, and of what goes with a module
  return std::to_string(GLSLANG_VERSION_MAJOR) + "." + std::to_string(GLSLANG_VERSION_MINOR) + "." +
         std::to_string(GLSLANG_VERSION_PATCH) + " " + std::to_string(kRevision);
}

SpirvLibrary compile_spirv(const ir::Module& module) {
  SpirvLibrary out;
  for (const ir::EntryPoint& entry : module.entry_points) {
    SpirvModule spirv = compile_spirv(emit_glsl(module, entry), entry.name);
    if (spirv.error) {
      out.error = std::move(spirv.error);
      break;
    }
    if (has_twin(module, entry)) {
      SpirvModule twin = compile_spirv(emit_glsl_twin(module, entry), entry.name);
      if (twin.error) {
        out.error = std::move(twin.error);
        break;
      }
      const auto count = static_cast<uint32_t>(twin.words.size());
      spirv.words.insert(spirv.words.end(), twin.words.begin(), twin.words.end());
      spirv.words.insert(spirv.words.end(), {count, shader::spirv::kTwinMark});
    }
    out.modules.push_back(std::move(spirv.words));
  }
  return out;
}

}  // namespace kaamos::hlsl
