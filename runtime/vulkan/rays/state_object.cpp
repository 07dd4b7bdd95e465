// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/state_object.h"

#include <kaamos/shader/spirv_interface.h>
#include <shaders/micromap_any_hit.h>

#include <algorithm>
#include <utility>

#include "runtime/backend/compute_limits.h"
#include "runtime/backend/errors.h"
#include "runtime/vulkan/rays/callable_frame.h"
#include "runtime/vulkan/rays/pipeline_stack.h"
#include "runtime/vulkan/spirv/shader_stage.h"
#include "runtime/vulkan/structures/acceleration_structure.h"

namespace kaamos::vulkan {
namespace {

constexpr VkShaderStageFlags kAllStages =
    VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR |
    VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR |
    VK_SHADER_STAGE_INTERSECTION_BIT_KHR | VK_SHADER_STAGE_CALLABLE_BIT_KHR |
    VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_ALL_GRAPHICS;

// Groups of the pipeline. The first ones belong to the records, in order.
struct Groups {
  std::vector<VkRayTracingShaderGroupCreateInfoKHR> infos;
  std::vector<const runtime::LinkedRecord*> records;
};

// Adds the stage of a shader, which may be absent.
rtapi::Status add_stage(StageList& stages, const runtime::LinkedShader* shader, bool own,
                        uint32_t* index) {
  *index = VK_SHADER_UNUSED_KHR;
  if (shader == nullptr) return {};
  auto added = stages.add(*shader, own);
  if (!added) return added.error();
  *index = *added;
  return {};
}

VkRayTracingShaderGroupCreateInfoKHR general_group(uint32_t stage) {
  VkRayTracingShaderGroupCreateInfoKHR info = {
      VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
  info.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
  info.generalShader = stage;
  info.closestHitShader = info.anyHitShader = info.intersectionShader = VK_SHADER_UNUSED_KHR;
  return info;
}

rtapi::Status add_group(const runtime::LinkedRecord& record, bool own_intersection,
                        StageList& stages, Groups& groups) {
  const bool procedural = record.kind == runtime::RecordKind::kHitGroup &&
                          record.hit_group_type == rtapi::HitGroupType::kProceduralPrimitive;
  // Vulkan has no procedural group without an intersection shader. Nothing is ever hit through such
  // a group, so a null record serves as well.
  if (procedural && record.intersection == nullptr) return {};
  VkRayTracingShaderGroupCreateInfoKHR info = general_group(VK_SHADER_UNUSED_KHR);
  if (record.kind != runtime::RecordKind::kHitGroup) {
    if (auto s = add_stage(stages, record.shader, false, &info.generalShader); !s) return s;
    if (info.generalShader == VK_SHADER_UNUSED_KHR) return {};
  } else {
    info.type = procedural ? VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR
                           : VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
    if (auto s = add_stage(stages, record.closest_hit, false, &info.closestHitShader); !s) return s;
    if (auto s = add_stage(stages, record.any_hit, false, &info.anyHitShader); !s) return s;
    if (procedural) {
      auto s = add_stage(stages, record.intersection, own_intersection, &info.intersectionShader);
      if (!s) return s;
    }
  }
  groups.infos.push_back(info);
  groups.records.push_back(&record);
  return {};
}

// Adds a group for the twin of each hit or miss shader of the records; returns the shaders.
rtapi::Result<std::vector<const runtime::LinkedShader*>> add_twins(
    const runtime::LinkedPipeline& linked, StageList& stages, Groups& groups) {
  std::vector<const runtime::LinkedShader*> twins;
  for (const auto& record : linked.records) {
    const bool miss = record->kind == runtime::RecordKind::kMiss;
    for (const runtime::LinkedShader* shader :
         {record->any_hit, record->intersection, record->closest_hit,
          miss ? record->shader : nullptr}) {
      if (shader == nullptr || std::find(twins.begin(), twins.end(), shader) != twins.end()) {
        continue;
      }
      auto stage = stages.add_twin(*shader);
      if (!stage) return stage.error();
      groups.infos.push_back(general_group(*stage));
      twins.push_back(shader);
    }
  }
  return twins;
}

// Where micromaps are allowed, gives hit groups of triangles without an any-hit shader one that
// lets them decide.
void add_micromap_any_hit(const Gpu& gpu, StageList& stages, Groups& groups) {
  const auto lacks_one = [](const VkRayTracingShaderGroupCreateInfoKHR& info) {
    return info.type == VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR &&
           info.anyHitShader == VK_SHADER_UNUSED_KHR;
  };
  if (std::none_of(groups.infos.begin(), groups.infos.end(), lacks_one)) return;
  const auto code = shader::spirv::spirv_pair(kaamos_shaders_micromap_any_hit()->exports[0]);
  const StageConstant constants[] = {
      {shader::spirv::kWorkaroundsConstant, gpu.workarounds().shader_bits()},
      {shader::spirv::kAllowMicromapsConstant, 1}};
  const uint32_t stage =
      stages.add({code.words, code.count}, VK_SHADER_STAGE_ANY_HIT_BIT_KHR, constants);
  for (auto& info : groups.infos) {
    if (lacks_one(info)) info.anyHitShader = stage;
  }
}

bool uses_hit_objects(const runtime::LinkedPipeline& linked) {
  return std::any_of(linked.shaders.begin(), linked.shaders.end(), [](const auto& shader) {
    return (shader->code->flags & shader::kExportUsesHitObject) != 0;
  });
}

// In words, the largest payload that a shader of the pipeline may have.
uint32_t payload_words(const runtime::LinkedPipeline& linked) {
  uint32_t bytes = std::max(linked.max_payload_bytes, 4u);
  for (const auto& shader : linked.shaders) bytes = std::max(bytes, shader->code->payload_bytes);
  return (bytes + 3) / 4;
}

VkPipelineCreateFlags create_flags(rtapi::RaytracingPipelineFlags flags) {
  const auto bits = static_cast<uint32_t>(flags);
  VkPipelineCreateFlags result = 0;
  if (bits & static_cast<uint32_t>(rtapi::RaytracingPipelineFlags::kSkipTriangles)) {
    result |= VK_PIPELINE_CREATE_RAY_TRACING_SKIP_TRIANGLES_BIT_KHR;
  }
  if (bits & static_cast<uint32_t>(rtapi::RaytracingPipelineFlags::kSkipProceduralPrimitives)) {
    result |= VK_PIPELINE_CREATE_RAY_TRACING_SKIP_AABBS_BIT_KHR;
  }
  return result;
}

template <typename T>
void append_value(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

// All that a pipeline is compiled from.
std::string text_of(const StageList& stages, const Groups& groups,
                    const VkRayTracingPipelineCreateInfoKHR& info) {
  std::string text = "rays";
  append_value(text, info.flags);
  append_value(text, info.maxPipelineRayRecursionDepth);
  append_value(text, info.pDynamicState != nullptr);
  append_value(text, groups.infos.size());
  for (const auto& group : groups.infos) {
    append_value(text, group.type);
    append_value(text, group.generalShader);
    append_value(text, group.closestHitShader);
    append_value(text, group.anyHitShader);
    append_value(text, group.intersectionShader);
  }
  stages.append_to(text);
  return text;
}

}  // namespace

rtapi::Result<std::shared_ptr<PipelineLayout>> PipelineLayout::create(
    std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors, bool collect_statistics) {
  std::shared_ptr<PipelineLayout> layout(
      new PipelineLayout(std::move(gpu), std::move(descriptors)));
  layout->collect_statistics_ = collect_statistics;
  const VkPushConstantRange range = {kAllStages, 0, sizeof(uint64_t)};
  const VkDescriptorSetLayout set = layout->descriptors_->layout();
  VkPipelineLayoutCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  const Gpu& g = *layout->gpu_;
  const VkResult r = g.vk().vkCreatePipelineLayout(g.device(), &info, nullptr, &layout->handle_);
  if (r != VK_SUCCESS) return g.error(r, "the pipeline layout");
  return layout;
}

PipelineLayout::~PipelineLayout() {
  gpu_->vk().vkDestroyPipelineLayout(gpu_->device(), handle_, nullptr);
}

void PipelineLayout::bind(VkCommandBuffer commands, VkPipelineBindPoint point,
                          VkPipeline pipeline) const {
  const VkDescriptorSet set = descriptors_->handle();
  gpu_->vk().vkCmdBindPipeline(commands, point, pipeline);
  gpu_->vk().vkCmdBindDescriptorSets(commands, point, handle_, 0, 1, &set, 0, nullptr);
}

void PipelineLayout::push(VkCommandBuffer commands, uint64_t block_address) const {
  gpu_->vk().vkCmdPushConstants(commands, handle_, kAllStages, 0, sizeof(block_address),
                                &block_address);
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> RaytracingPipeline::create(
    std::shared_ptr<PipelineLayout> layout, std::shared_ptr<const runtime::LinkedPipeline> linked) {
  std::shared_ptr<RaytracingPipeline> pipeline(
      new RaytracingPipeline(std::move(layout), std::move(linked)));
  if (auto s = pipeline->start(); !s) return s.error();
  return std::shared_ptr<runtime::BackendPipeline>(std::move(pipeline));
}

rtapi::Status RaytracingPipeline::start() {
  Gpu& gpu = layout_->gpu();
  max_trace_depth_ =
      std::min(linked_->max_recursion_depth, gpu.properties().ray_tracing.maxRayRecursionDepth);
  uint32_t max_callable_depth = kMaxCallableDepth;
  has_twins_ = uses_hit_objects(*linked_);
  TwinLevels twins;
  if (has_twins_) twins.payload_words = payload_words(*linked_);
  if (gpu.workarounds().has(Workaround::kBoundPayloads)) {
    const uint64_t stack = default_thread_stack_bytes();
    max_trace_depth_ = std::min(
        max_trace_depth_,
        nested_payload_limit(
            largest_payload(*linked_) + (has_twins_ ? sizeof(shader::HitObject) : 0), stack));
    max_callable_depth =
        std::min(max_callable_depth, nested_payload_limit(largest_callable_data(*linked_), stack));
  }
  // A level for each Invoke, then an intersection and an any-hit shader.
  if (has_twins_) twins.count = max_trace_depth_ + 2;
  CallableFrame frame = {max_callable_depth + twins.count};
  if (gpu.workarounds().has(Workaround::kReserveCallables)) {
    frame = callable_frame(*linked_, max_callable_depth, default_thread_stack_bytes(), twins);
  } else if (gpu.is_lavapipe()) {
    frame.depth = std::min(frame.depth, kMaxBareCallableDepth);
  }
  if (has_twins_) {
    max_trace_depth_ = std::min(max_trace_depth_, std::max(frame.depth, 4u) - 3);
    twins.count = max_trace_depth_ + 2;
  }
  max_callable_depth = std::min(max_callable_depth, frame.depth - twins.count);
  groups_ = GroupHandles(gpu.properties().ray_tracing.shaderGroupHandleSize);
  const bool allow_micromaps =
      has_micromaps(gpu) &&
      HasAny(linked_->flags, rtapi::RaytracingPipelineFlags::kAllowOpacityMicromaps);
  StageList stages(gpu, {max_trace_depth_, max_callable_depth, layout_->collect_statistics(), 0,
                         twins.payload_words, allow_micromaps});
  const bool own_intersection = gpu.workarounds().has(Workaround::kOwnIntersectionStages);
  Groups groups;
  bool runs = false;
  for (const auto& record : linked_->records) {
    if (auto s = add_group(*record, own_intersection, stages, groups); !s) return s;
    runs |= record->kind == runtime::RecordKind::kRayGeneration;
  }
  std::vector<const runtime::LinkedShader*> twin_shaders;
  if (has_twins_) {
    auto added = add_twins(*linked_, stages, groups);
    if (!added) return added.error();
    twin_shaders = std::move(*added);
  }
  if (frame.words != 0) {
    const StageConstant words = {0, frame.words};
    groups.infos.push_back(general_group(stages.add(
        callable_frame_spirv(), VK_SHADER_STAGE_CALLABLE_BIT_KHR, std::span(&words, 1))));
  }
  if (allow_micromaps) add_micromap_any_hit(gpu, stages, groups);
  stage_shaders_ = stages.shaders();
  if (!runs) return {};
  VkRayTracingPipelineCreateInfoKHR info = {VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
  info.flags = create_flags(linked_->flags);
  info.groupCount = static_cast<uint32_t>(groups.infos.size());
  info.pGroups = groups.infos.data();
  info.maxPipelineRayRecursionDepth = max_trace_depth_;
  info.layout = layout_->handle();
  const VkDynamicState stack_state = VK_DYNAMIC_STATE_RAY_TRACING_PIPELINE_STACK_SIZE_KHR;
  VkPipelineDynamicStateCreateInfo dynamic = {VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = 1;
  dynamic.pDynamicStates = &stack_state;
  const bool own_stack = has_twins_ || needs_own_stack(*linked_);
  if (own_stack) info.pDynamicState = &dynamic;
  auto compiled = layout_->pipelines().find_or_make(
      gpu, text_of(stages, groups, info), "ray tracing pipeline \"" + linked_->name + "\"",
      [&](VkPipeline* handle) -> rtapi::Result<VkResult> {
        if (auto s = stages.create_modules(); !s) return s.error();
        info.stageCount = static_cast<uint32_t>(stages.stages().size());
        info.pStages = stages.stages().data();
        return gpu.vk().vkCreateRayTracingPipelinesKHR(gpu.device(), VK_NULL_HANDLE, VK_NULL_HANDLE,
                                                       1, &info, nullptr, handle);
      });
  if (!compiled) return compiled.error();
  compiled_ = std::move(*compiled);
  if (own_stack) {
    stack_bytes_ =
        pipeline_stack_bytes(gpu, handle(), groups.infos, groups.records, twin_shaders.size(),
                             max_trace_depth_, max_callable_depth + twins.count);
  }
  return read_handles(groups.records, twin_shaders);
}

void RaytracingPipeline::bind(VkCommandBuffer commands) const {
  layout_->bind(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, handle());
  if (stack_bytes_ != 0) {
    layout_->gpu().vk().vkCmdSetRayTracingPipelineStackSizeKHR(commands, stack_bytes_);
  }
}

rtapi::Status RaytracingPipeline::read_handles(
    const std::vector<const runtime::LinkedRecord*>& records,
    const std::vector<const runtime::LinkedShader*>& twins) {
  const Gpu& gpu = layout_->gpu();
  const size_t size = gpu.properties().ray_tracing.shaderGroupHandleSize;
  const size_t count = records.size() + twins.size();
  std::vector<uint8_t> bytes(size * count);
  const VkResult r = gpu.vk().vkGetRayTracingShaderGroupHandlesKHR(
      gpu.device(), handle(), 0, static_cast<uint32_t>(count), bytes.size(), bytes.data());
  if (r != VK_SUCCESS) return gpu.error(r, "reading shader group handles");
  for (size_t i = 0; i < records.size(); ++i) groups_.add(records[i], bytes.data() + i * size);
  for (size_t i = 0; i < twins.size(); ++i) {
    groups_.add_twin(twins[i], bytes.data() + (records.size() + i) * size);
  }
  return {};
}

namespace {

rtapi::Status check_waves(const Gpu& gpu, const runtime::LinkedCompute& linked) {
  const VkPhysicalDeviceVulkan11Properties& core = gpu.properties().vulkan11;
  const VkPhysicalDeviceVulkan13Properties& sizes = gpu.properties().vulkan13;
  if (linked.shader.code->compute->has_waves) {
    auto s = check_subgroups(gpu, VK_SHADER_STAGE_COMPUTE_BIT, "compute", linked.shader.name);
    if (!s) return s;
  }
  const bool chooses = (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  const uint32_t least = chooses ? sizes.minSubgroupSize : core.subgroupSize;
  const uint32_t most = chooses ? sizes.maxSubgroupSize : core.subgroupSize;
  return runtime::check_wave_size(
      linked, least, most,
      "those of this device have " + std::to_string(least) + " to " + std::to_string(most) + ".");
}

}  // namespace

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> ComputePipeline::create(
    std::shared_ptr<PipelineLayout> layout, std::shared_ptr<const runtime::LinkedCompute> linked) {
  std::shared_ptr<ComputePipeline> pipeline(
      new ComputePipeline(std::move(layout), std::move(linked)));
  Gpu& gpu = pipeline->layout_->gpu();
  const runtime::LinkedShader& shader = pipeline->linked_->shader;
  if (auto s = check_waves(gpu, *pipeline->linked_); !s) return s.error();
  const uint64_t most_bytes = gpu.properties().core.limits.maxComputeSharedMemorySize;
  if (auto s = runtime::check_groupshared(*pipeline->linked_, most_bytes); !s) return s.error();
  StageList stages(gpu, {});
  if (auto added = stages.add(shader); !added) return added.error();
  VkComputePipelineCreateInfo info = {VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  VkPipelineShaderStageRequiredSubgroupSizeCreateInfo size = {
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
  const VkPhysicalDeviceVulkan13Properties& sizes = gpu.properties().vulkan13;
  const bool chooses = (sizes.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
  if (const uint32_t least = shader.code->compute->least_wave_lanes; least != 0 && chooses) {
    size.requiredSubgroupSize = std::max(least, sizes.minSubgroupSize);
  }
  info.layout = pipeline->layout_->handle();
  std::string text = "compute";
  append_value(text, size.requiredSubgroupSize);
  stages.append_to(text);
  auto compiled = pipeline->layout_->pipelines().find_or_make(
      gpu, std::move(text), "compute pipeline \"" + shader.name + "\"",
      [&](VkPipeline* handle) -> rtapi::Result<VkResult> {
        if (auto s = stages.create_modules(); !s) return s.error();
        info.stage = stages.stages()[0];
        if (size.requiredSubgroupSize != 0) {
          size.pNext = const_cast<void*>(info.stage.pNext);
          info.stage.pNext = &size;
        }
        return gpu.vk().vkCreateComputePipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr,
                                                 handle);
      });
  if (!compiled) return compiled.error();
  pipeline->compiled_ = std::move(*compiled);
  return std::shared_ptr<runtime::BackendPipeline>(std::move(pipeline));
}

}  // namespace kaamos::vulkan
