// SPDX-License-Identifier: MIT
#include "runtime/vulkan/spirv/shader_stage.h"

#include <utility>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/backend/errors.h"
#include "runtime/vulkan/spirv/coverage_words.h"

namespace kaamos::vulkan {
namespace {

class Constants {
 public:
  void add(uint32_t id, uint32_t value) {
    result.entries.push_back(
        {id, static_cast<uint32_t>(result.values.size() * sizeof(uint32_t)), sizeof(uint32_t)});
    result.values.push_back(value);
  }
  StageConstants result;
};

uint32_t count_of(const shader::BindingSlot& slot) {
  switch (slot.source) {
    case shader::SlotSource::kDescriptorTable:
      return slot.descriptor_count;
    case shader::SlotSource::kRootConstants:
      return slot.size_bytes;
    case shader::SlotSource::kRootDescriptor:
      return slot.stride_bytes;
    default:
      return 0;
  }
}

void add_slot(uint32_t binding, const shader::BindingSlot& slot, Constants& constants) {
  using namespace shader::spirv;
  if (slot.source == shader::SlotSource::kUnbound) return;
  const uint32_t first = binding * kConstantsPerBinding;
  const bool sampler = slot.source == shader::SlotSource::kStaticSampler;
  constants.add(first + kBindingSource, static_cast<uint32_t>(slot.source) |
                                            static_cast<uint32_t>(slot.local) << 8 |
                                            static_cast<uint32_t>(slot.kind) << 16 |
                                            static_cast<uint32_t>(slot.access) << 24);
  constants.add(first + kBindingOffset, sampler
                                            ? static_cast<uint32_t>(slot.static_sampler->address)
                                            : slot.argument_offset);
  constants.add(first + kBindingIndex, slot.descriptor_index);
  constants.add(first + kBindingCount, count_of(slot));
}

constexpr VkSubgroupFeatureFlags kWaveOperations =
    VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT |
    VK_SUBGROUP_FEATURE_ARITHMETIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT |
    VK_SUBGROUP_FEATURE_SHUFFLE_BIT;

}  // namespace

rtapi::Status check_subgroups(const Gpu& gpu, VkShaderStageFlagBits stage, const char* what,
                              const std::string& name) {
  const VkPhysicalDeviceVulkan11Properties& core = gpu.properties().vulkan11;
  const bool works = (core.subgroupSupportedOperations & kWaveOperations) == kWaveOperations &&
                     (core.subgroupSupportedStages & static_cast<VkFlags>(stage)) != 0;
  if (works) return {};
  return runtime::make_error(runtime::Id::kNoSubgroups,
                             std::string(what) + " shader \"" + name +
                                 "\" has wave intrinsics, which need vote, arithmetic, ballot and "
                                 "shuffle operations of subgroups in " +
                                 what + " shaders.");
}

VkShaderStageFlagBits stage_of(shader::Stage stage) {
  switch (stage) {
    case shader::Stage::kRayGeneration:
      return VK_SHADER_STAGE_RAYGEN_BIT_KHR;
    case shader::Stage::kIntersection:
      return VK_SHADER_STAGE_INTERSECTION_BIT_KHR;
    case shader::Stage::kAnyHit:
      return VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
    case shader::Stage::kClosestHit:
      return VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
    case shader::Stage::kMiss:
      return VK_SHADER_STAGE_MISS_BIT_KHR;
    case shader::Stage::kCallable:
      return VK_SHADER_STAGE_CALLABLE_BIT_KHR;
    case shader::Stage::kPixel:
      return VK_SHADER_STAGE_FRAGMENT_BIT;
    case shader::Stage::kVertex:
      return VK_SHADER_STAGE_VERTEX_BIT;
    case shader::Stage::kGeometry:
      return VK_SHADER_STAGE_GEOMETRY_BIT;
    case shader::Stage::kCompute:
    case shader::Stage::kLibrary:
      break;
  }
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

StageConstants stage_constants(const runtime::LinkedShader& shader, uint32_t workaround_bits,
                               const StageOptions& options, std::span<const StageConstant> more) {
  Constants constants;
  for (size_t i = 0; i < shader.slots.size(); ++i) {
    add_slot(static_cast<uint32_t>(i), shader.slots[i], constants);
  }
  constants.add(shader::spirv::kWorkaroundsConstant, workaround_bits);
  constants.add(shader::spirv::kMaxTraceDepthConstant, options.max_trace_depth);
  constants.add(shader::spirv::kMaxCallableDepthConstant, options.max_callable_depth);
  constants.add(shader::spirv::kShaderConstant, options.shader);
  if (options.count) constants.add(shader::spirv::kCountConstant, 1);
  if (options.twin_payload_words != 0) {
    constants.add(shader::spirv::kTwinPayloadConstant, options.twin_payload_words);
  }
  if (options.allow_micromaps) constants.add(shader::spirv::kAllowMicromapsConstant, 1);
  if (options.coverage != 0) {
    constants.add(shader::spirv::kCoverageLowConstant, static_cast<uint32_t>(options.coverage));
    constants.add(shader::spirv::kCoverageHighConstant,
                  static_cast<uint32_t>(options.coverage >> 32));
  }
  for (const StageConstant& constant : more) constants.add(constant.id, constant.value);
  return std::move(constants.result);
}

StageList::~StageList() {
  for (const VkShaderModule module : modules_) {
    gpu_.vk().vkDestroyShaderModule(gpu_.device(), module, nullptr);
  }
}

rtapi::Status StageList::check_code(const runtime::LinkedShader& shader) const {
  if (shader.code->spirv == nullptr) {
    return runtime::make_error(
        runtime::Id::kNoSpirv,
        "shader \"" + shader.name + "\" of " + shader.library->name +
            " has no code for Vulkan, because its library was compiled without SPIR-V; compile it "
            "again with kaamos-hlsl -spirv.");
  }
  constexpr uint32_t kByQuery = shader::kExportUsesRayQuery | shader::kExportUsesHitObject;
  if ((shader.code->flags & kByQuery) != 0 && !gpu_.features().ray_query) {
    const bool query = (shader.code->flags & shader::kExportUsesRayQuery) != 0;
    return runtime::make_error(runtime::Id::kNoRayQuery,
                               "shader \"" + shader.name + "\" of " + shader.library->name +
                                   " uses " + (query ? "RayQuery" : "dx::HitObject") +
                                   ", but the device has no VK_KHR_ray_query; use another device "
                                   "(KAAMOS_VULKAN_DEVICE), the Embree backend, or TraceRay.");
  }
  return gpu_.coverage() == nullptr ? rtapi::Status() : gpu_.coverage()->provide(*shader.library);
}

size_t StageList::keep(std::span<const uint32_t> words, std::string name) {
  codes_.push_back({words, std::move(name)});
  return codes_.size() - 1;
}

StageOptions StageList::next_options(const runtime::LinkedShader& shader) {
  StageOptions options = options_;
  options.shader = static_cast<uint32_t>(stages_.size() + 1);
  if (gpu_.coverage() != nullptr) options.coverage = gpu_.coverage()->address_of(*shader.library);
  shaders_.push_back(&shader);
  return options;
}

uint32_t StageList::push(VkShaderStageFlagBits stage, size_t code, StageConstants constants) {
  const StageConstants& kept = constants_.emplace_back(std::move(constants));
  infos_.push_back({static_cast<uint32_t>(kept.entries.size()), kept.entries.data(),
                    kept.values.size() * sizeof(uint32_t), kept.values.data()});
  VkPipelineShaderStageCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = stage;
  info.pName = "main";
  info.pSpecializationInfo = &infos_.back();
  stages_.push_back(info);
  stage_codes_.push_back(code);
  return static_cast<uint32_t>(stages_.size() - 1);
}

rtapi::Result<uint32_t> StageList::add(const runtime::LinkedShader& shader, bool own) {
  if (!own) {
    if (const auto it = indices_.find(&shader); it != indices_.end()) return it->second;
  }
  auto code = export_codes_.find(shader.code);
  if (code == export_codes_.end()) {
    if (auto s = check_code(shader); !s) return s.error();
    const shader::spirv::SpirvPair pair = shader::spirv::spirv_pair(*shader.code);
    code = export_codes_
               .emplace(shader.code, keep({pair.words, pair.count},
                                          "the module of shader \"" + shader.name + "\""))
               .first;
  }
  const StageOptions options = next_options(shader);
  const uint32_t index = push(stage_of(shader.code->stage), code->second,
                              stage_constants(shader, gpu_.workarounds().shader_bits(), options));
  if (!own) indices_[&shader] = index;
  return index;
}

rtapi::Result<uint32_t> StageList::add(const runtime::LinkedShader& shader,
                                       std::span<const uint32_t> code,
                                       std::span<const StageConstant> more) {
  if (auto s = check_code(shader); !s) return s.error();
  const size_t kept = keep(code, "the module of shader \"" + shader.name + "\"");
  const StageOptions options = next_options(shader);
  return push(stage_of(shader.code->stage), kept,
              stage_constants(shader, gpu_.workarounds().shader_bits(), options, more));
}

rtapi::Result<uint32_t> StageList::add_twin(const runtime::LinkedShader& shader) {
  if (auto s = check_code(shader); !s) return s.error();
  const shader::spirv::SpirvPair pair = shader::spirv::spirv_pair(*shader.code);
  if (pair.twin == nullptr) {
    return runtime::make_error(
        runtime::Id::kNoHitObject,
        "a shader of the pipeline uses dx::HitObject, but shader \"" + shader.name + "\" of " +
            shader.library->name +
            " cannot be run by it on Vulkan, because it was not compiled for Shader Model 6.9; "
            "compile it with -T lib_6_9.");
  }
  const size_t kept = keep({pair.twin, pair.twin_count}, "the twin of \"" + shader.name + "\"");
  const StageOptions options = next_options(shader);
  return push(VK_SHADER_STAGE_CALLABLE_BIT_KHR, kept,
              stage_constants(shader, gpu_.workarounds().shader_bits(), options));
}

uint32_t StageList::add(std::span<const uint32_t> spirv, VkShaderStageFlagBits stage,
                        std::span<const StageConstant> given) {
  Constants constants;
  for (const StageConstant& constant : given) constants.add(constant.id, constant.value);
  return push(stage, keep(spirv, "a module of the backend's own"), std::move(constants.result));
}

void StageList::append_to(std::string& text) const {
  const auto append = [&](const void* bytes, size_t size) {
    text.append(reinterpret_cast<const char*>(&size), sizeof(size));
    text.append(static_cast<const char*>(bytes), size);
  };
  append(stage_codes_.data(), stage_codes_.size() * sizeof(size_t));
  for (const Code& code : codes_) append(code.words.data(), code.words.size_bytes());
  for (size_t i = 0; i < stages_.size(); ++i) {
    const StageConstants& constants = constants_[i];
    append(&stages_[i].stage, sizeof(stages_[i].stage));
    append(constants.values.data(), constants.values.size() * sizeof(uint32_t));
    for (const VkSpecializationMapEntry& entry : constants.entries) {
      append(&entry.constantID, sizeof(entry.constantID));
    }
  }
}

rtapi::Status StageList::create_modules() {
  for (const Code& code : codes_) {
    VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.words.size_bytes();
    info.pCode = code.words.data();
    VkShaderModule made = VK_NULL_HANDLE;
    const VkResult r = gpu_.vk().vkCreateShaderModule(gpu_.device(), &info, nullptr, &made);
    if (r != VK_SUCCESS) return gpu_.error(r, code.name);
    modules_.push_back(made);
  }
  for (size_t i = 0; i < stages_.size(); ++i) stages_[i].module = modules_[stage_codes_[i]];
  return {};
}

}  // namespace kaamos::vulkan
