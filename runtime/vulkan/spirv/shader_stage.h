// SPDX-License-Identifier: MIT
//
// Linked shaders as stages of a Vulkan pipeline: the module of the export, and the specialization
// constants that say where its bindings are (spirv_interface.h).
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/backend/linked_pipeline.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

struct StageOptions {
  uint32_t max_trace_depth = 0;
  uint32_t max_callable_depth = 0;
  bool count = false;               // for statistics
  uint32_t shader = 0;              // CheckEntry::shader
  uint32_t twin_payload_words = 0;  // kTwinPayloadConstant; 0: no shader uses hit objects
  bool allow_micromaps = false;
  uint64_t coverage = 0;  // kCoverageLowConstant and kCoverageHighConstant
};

// A specialization constant of a stage.
struct StageConstant {
  uint32_t id = 0;
  uint32_t value = 0;
};

VkShaderStageFlagBits stage_of(shader::Stage stage);

// Whether the device has the subgroup operations in that stage that wave intrinsics become
// (runtime/hlsl/glsl/waves.cpp). `what` is the kind of shader, for the message. Errors: KA0551.
rtapi::Status check_subgroups(const Gpu& gpu, VkShaderStageFlagBits stage, const char* what,
                              const std::string& name);

// The values of a stage's constants, as VkSpecializationInfo takes them.
struct StageConstants {
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<uint32_t> values;
};
StageConstants stage_constants(const runtime::LinkedShader& shader, uint32_t workaround_bits,
                               const StageOptions& options,
                               std::span<const StageConstant> more = {});

// The stages of one pipeline while it is being created. The code that is added must stay until
// then. Modules are destroyed with the list; pipelines do not need them.
class StageList {
 public:
  StageList(Gpu& gpu, const StageOptions& options) : gpu_(gpu), options_(options) {}
  ~StageList();
  StageList(const StageList&) = delete;
  StageList& operator=(const StageList&) = delete;

  // The index of the shader's stage; repeated calls share the stage unless `own`. Errors: KA0954
  // the shader has no SPIR-V, KA0952 it uses ray queries, which the device lacks.
  rtapi::Result<uint32_t> add(const runtime::LinkedShader& shader, bool own = false);
  // Adds a stage whose code was changed for this pipeline, with constants besides its own. Errors:
  // as above.
  rtapi::Result<uint32_t> add(const runtime::LinkedShader& shader, std::span<const uint32_t> code,
                              std::span<const StageConstant> more);
  // Adds the twin of a hit or miss shader, a callable shader (spirv_interface.h). Errors: KA0968 it
  // has none, and as above.
  rtapi::Result<uint32_t> add_twin(const runtime::LinkedShader& shader);
  // Adds one of the backend's own shaders, after all others.
  uint32_t add(std::span<const uint32_t> spirv, VkShaderStageFlagBits stage,
               std::span<const StageConstant> constants);
  // Appends all that the stages consist of, so that equal texts mean equal stages.
  void append_to(std::string& text) const;
  // Makes the modules of all stages; only then do stages() have them.
  rtapi::Status create_modules();
  const std::vector<VkPipelineShaderStageCreateInfo>& stages() const { return stages_; }
  // The shader of each stage, without the backend's own stages.
  const std::vector<const runtime::LinkedShader*>& shaders() const { return shaders_; }

 private:
  struct Code {
    std::span<const uint32_t> words;
    std::string name;  // for messages
  };

  rtapi::Status check_code(const runtime::LinkedShader& shader) const;
  size_t keep(std::span<const uint32_t> words, std::string name);
  uint32_t push(VkShaderStageFlagBits stage, size_t code, StageConstants constants);
  // Returns the options of the next stage that a shader gets.
  StageOptions next_options(const runtime::LinkedShader& shader);

  Gpu& gpu_;
  StageOptions options_;
  std::vector<VkPipelineShaderStageCreateInfo> stages_;
  std::vector<size_t> stage_codes_;  // of each stage
  std::vector<const runtime::LinkedShader*> shaders_;
  std::deque<StageConstants>
      constants_;  // of each stage; in a deque, because the infos point to them
  std::deque<VkSpecializationInfo> infos_;
  std::vector<Code> codes_;
  std::vector<VkShaderModule> modules_;  // of codes_, once they are made
  std::map<const shader::ExportDesc*, size_t> export_codes_;
  std::map<const runtime::LinkedShader*, uint32_t> indices_;
};

}  // namespace kaamos::vulkan
