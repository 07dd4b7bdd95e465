// SPDX-License-Identifier: MIT
// Acceleration structures, pipelines and the GLSL compiler of raw_gpu.h.
#include "tests/vulkan/raw_gpu.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <volk.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace raw {
namespace {

void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS) {
    throw std::runtime_error(std::string(call) + " gave VkResult " + std::to_string(result));
  }
}

VkAccelerationStructureBuildGeometryInfoKHR build_info(const AccelInput& input) {
  VkAccelerationStructureBuildGeometryInfoKHR info{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
  info.type = input.type;
  info.flags = input.flags;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<uint32_t>(input.geometries.size());
  info.pGeometries = input.geometries.data();
  return info;
}

VkShaderModule create_module(VkDevice device, const std::vector<uint32_t>& spirv) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = spirv.size() * 4;
  info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
  return module;
}

// The arrays that a VkSpecializationInfo points to.
struct Constants {
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<uint32_t> values;
  VkSpecializationInfo info{};
  explicit Constants(const Stage& stage) {
    for (const auto& [id, value] : stage.constants) {
      entries.push_back({id, static_cast<uint32_t>(values.size() * 4), 4});
      values.push_back(value);
    }
    info = {static_cast<uint32_t>(entries.size()), entries.data(), values.size() * 4,
            values.data()};
  }
};

uint32_t or_unused(int index) {
  return index < 0 ? VK_SHADER_UNUSED_KHR : static_cast<uint32_t>(index);
}

}  // namespace

Accel Gpu::accel(const AccelInput& input) {
  const VkAccelerationStructureBuildGeometryInfoKHR info = build_info(input);
  VkAccelerationStructureBuildSizesInfoKHR sizes{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
  vkGetAccelerationStructureBuildSizesKHR(device_, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR,
                                          &info, input.counts.data(), &sizes);
  Accel result;
  result.memory = buffer(sizes.accelerationStructureSize);
  result.scratch =
      buffer(std::max(sizes.buildScratchSize, sizes.updateScratchSize) + scratch_alignment_);
  VkAccelerationStructureCreateInfoKHR create{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
  create.buffer = result.memory.buffer;
  create.size = sizes.accelerationStructureSize;
  create.type = input.type;
  check(vkCreateAccelerationStructureKHR(device_, &create, nullptr, &result.handle),
        "vkCreateAccelerationStructureKHR");
  VkAccelerationStructureDeviceAddressInfoKHR address{
      VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
  address.accelerationStructure = result.handle;
  result.address = vkGetAccelerationStructureDeviceAddressKHR(device_, &address);
  return result;
}

void Gpu::build(VkCommandBuffer list, const Accel& accel, const AccelInput& input, bool update) {
  VkAccelerationStructureBuildGeometryInfoKHR info = build_info(input);
  if (update) {
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
    info.srcAccelerationStructure = accel.handle;
  }
  info.dstAccelerationStructure = accel.handle;
  info.scratchData.deviceAddress =
      (accel.scratch.address + scratch_alignment_ - 1) / scratch_alignment_ * scratch_alignment_;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
  for (const uint32_t count : input.counts) ranges.push_back({count, 0, 0, 0});
  const VkAccelerationStructureBuildRangeInfoKHR* pointer = ranges.data();
  vkCmdBuildAccelerationStructuresKHR(list, 1, &info, &pointer);
  VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  barrier.srcAccessMask = VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
  barrier.dstAccessMask = VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR |
                          VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
  vkCmdPipelineBarrier(list, VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                       VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR |
                           VK_PIPELINE_STAGE_RAY_TRACING_SHADER_BIT_KHR,
                       0, 1, &barrier, 0, nullptr, 0, nullptr);
}

void Gpu::free(Accel& accel) {
  vkDestroyAccelerationStructureKHR(device_, accel.handle, nullptr);
  free(accel.memory);
  free(accel.scratch);
  accel = {};
}

Pipeline Gpu::pipeline(const std::vector<Stage>& stages, const std::vector<Group>& groups,
                       uint32_t recursion, bool own_stack) {
  std::map<const std::vector<uint32_t>*, VkShaderModule> modules;
  std::vector<std::unique_ptr<Constants>> constants;
  std::vector<VkPipelineShaderStageCreateInfo> infos;
  for (const Stage& stage : stages) {
    VkShaderModule& module = modules[stage.spirv];
    if (!module) module = create_module(device_, *stage.spirv);
    constants.push_back(std::make_unique<Constants>(stage));
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage.stage;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = &constants.back()->info;
    infos.push_back(info);
  }
  std::vector<VkRayTracingShaderGroupCreateInfoKHR> group_infos;
  for (const Group& group : groups) {
    VkRayTracingShaderGroupCreateInfoKHR info{
        VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
    info.type = group.general >= 0 ? VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR
                : group.intersection >= 0
                    ? VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR
                    : VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
    info.generalShader = or_unused(group.general);
    info.closestHitShader = or_unused(group.closest_hit);
    info.anyHitShader = or_unused(group.any_hit);
    info.intersectionShader = or_unused(group.intersection);
    group_infos.push_back(info);
  }
  VkRayTracingPipelineCreateInfoKHR create{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
  create.stageCount = static_cast<uint32_t>(infos.size());
  create.pStages = infos.data();
  create.groupCount = static_cast<uint32_t>(group_infos.size());
  create.pGroups = group_infos.data();
  create.maxPipelineRayRecursionDepth = recursion;
  create.layout = layout_;
  const VkDynamicState stack_state = VK_DYNAMIC_STATE_RAY_TRACING_PIPELINE_STACK_SIZE_KHR;
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = 1;
  dynamic.pDynamicStates = &stack_state;
  if (own_stack) create.pDynamicState = &dynamic;
  Pipeline result;
  const VkResult created = vkCreateRayTracingPipelinesKHR(device_, VK_NULL_HANDLE, VK_NULL_HANDLE,
                                                          1, &create, nullptr, &result.pipeline);
  for (const auto& [spirv, module] : modules) vkDestroyShaderModule(device_, module, nullptr);
  check(created, "vkCreateRayTracingPipelinesKHR");
  result.handles.resize(groups.size() * handle_size_);
  check(vkGetRayTracingShaderGroupHandlesKHR(device_, result.pipeline, 0, create.groupCount,
                                             result.handles.size(), result.handles.data()),
        "vkGetRayTracingShaderGroupHandlesKHR");
  return result;
}

VkPipeline Gpu::compute(const Stage& stage) {
  const Constants constants(stage);
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = create_module(device_, *stage.spirv);
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &constants.info;
  info.layout = layout_;
  VkPipeline result = VK_NULL_HANDLE;
  const VkResult created =
      vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &result);
  vkDestroyShaderModule(device_, info.stage.module, nullptr);
  check(created, "vkCreateComputePipelines");
  return result;
}

void Gpu::free(VkPipeline pipeline) {
  vkDestroyPipeline(device_, pipeline, nullptr);
}

std::vector<uint32_t> compile(VkShaderStageFlagBits stage, const std::string& glsl) {
  static const bool initialized = glslang::InitializeProcess();
  if (!initialized) throw std::runtime_error("glslang does not start");
  const std::map<VkShaderStageFlagBits, EShLanguage> languages = {
      {VK_SHADER_STAGE_RAYGEN_BIT_KHR, EShLangRayGen},
      {VK_SHADER_STAGE_INTERSECTION_BIT_KHR, EShLangIntersect},
      {VK_SHADER_STAGE_ANY_HIT_BIT_KHR, EShLangAnyHit},
      {VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, EShLangClosestHit},
      {VK_SHADER_STAGE_MISS_BIT_KHR, EShLangMiss},
      {VK_SHADER_STAGE_CALLABLE_BIT_KHR, EShLangCallable},
      {VK_SHADER_STAGE_COMPUTE_BIT, EShLangCompute},
      {VK_SHADER_STAGE_VERTEX_BIT, EShLangVertex},
      {VK_SHADER_STAGE_FRAGMENT_BIT, EShLangFragment}};
  const EShLanguage language = languages.at(stage);
  glslang::TShader shader(language);
  const char* text = glsl.c_str();
  shader.setStrings(&text, 1);
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
  if (!shader.parse(GetDefaultResources(), 460, false, messages)) {
    throw std::runtime_error(std::string("GLSL: ") + shader.getInfoLog());
  }
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) {
    throw std::runtime_error(std::string("GLSL: ") + program.getInfoLog());
  }
  std::vector<uint32_t> spirv;
  glslang::GlslangToSpv(*program.getIntermediate(language), spirv);
  return spirv;
}

VkAccelerationStructureGeometryKHR triangles(uint64_t vertices, uint32_t vertex_count,
                                             uint64_t indices, VkGeometryFlagsKHR flags) {
  VkAccelerationStructureGeometryKHR result{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  result.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
  result.flags = flags;
  auto& data = result.geometry.triangles;
  data = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
  data.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
  data.vertexData.deviceAddress = vertices;
  data.vertexStride = 12;
  data.maxVertex = vertex_count == 0 ? 0 : vertex_count - 1;
  data.indexType = indices ? VK_INDEX_TYPE_UINT32 : VK_INDEX_TYPE_NONE_KHR;
  data.indexData.deviceAddress = indices;
  return result;
}

VkAccelerationStructureGeometryKHR boxes(uint64_t boxes, VkGeometryFlagsKHR flags) {
  VkAccelerationStructureGeometryKHR result{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  result.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
  result.flags = flags;
  auto& data = result.geometry.aabbs;
  data = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR};
  data.data.deviceAddress = boxes;
  data.stride = 24;
  return result;
}

VkAccelerationStructureGeometryKHR instances(uint64_t instances) {
  VkAccelerationStructureGeometryKHR result{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
  result.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  auto& data = result.geometry.instances;
  data = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
  data.data.deviceAddress = instances;
  return result;
}

}  // namespace raw
