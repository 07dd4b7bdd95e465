// SPDX-License-Identifier: MIT
#include "runtime/vulkan/gpu/gpu_features.h"

#include <algorithm>
#include <cstring>

namespace kaamos::vulkan {
namespace {

template <typename T>
void chain_to(void*& head, T& structure, VkStructureType type) {
  structure = {};
  structure.sType = type;
  structure.pNext = head;
  head = &structure;
}

}  // namespace

GpuProperties read_properties(VkPhysicalDevice device) {
  GpuProperties result;
  void* head = nullptr;
  chain_to(head, result.driver, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
  chain_to(head, result.ray_tracing,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR);
  chain_to(head, result.acceleration_structure,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR);
  chain_to(head, result.vulkan11, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES);
  chain_to(head, result.vulkan12, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES);
  chain_to(head, result.vulkan13, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES);
  VkPhysicalDeviceProperties2 properties = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  properties.pNext = head;
  vkGetPhysicalDeviceProperties2(device, &properties);
  result.core = properties.properties;
  result.driver.pNext = result.ray_tracing.pNext = nullptr;
  result.acceleration_structure.pNext = nullptr;
  result.vulkan11.pNext = result.vulkan12.pNext = result.vulkan13.pNext = nullptr;
  vkGetPhysicalDeviceMemoryProperties(device, &result.memory);
  return result;
}

bool FeatureChain::has(const char* extension) const {
  return std::any_of(available_.begin(), available_.end(), [&](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, extension) == 0;
  });
}

void FeatureChain::require(bool there, const char* name) {
  if (there) return;
  if (!missing_.empty()) missing_ += ", ";
  missing_ += name;
}

void FeatureChain::query(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  available_.resize(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, available_.data());
  void* head = nullptr;
  chain_to(head, vulkan11_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
  chain_to(head, vulkan12_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  chain_to(head, vulkan13_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  const auto optional = [&](const char* extension, auto& structure, VkStructureType type) {
    if (!has(extension)) return;
    extensions_.push_back(extension);
    chain_to(head, structure, type);
  };
  for (const char* extension :
       {VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
        VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME}) {
    require(has(extension), extension);
  }
  if (missing_.empty()) {
    extensions_.push_back(VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME);
    optional(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, acceleration_structure_,
             VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
    optional(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, ray_tracing_,
             VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR);
    optional(VK_KHR_RAY_QUERY_EXTENSION_NAME, ray_query_,
             VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);
  }
  optional(VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME, border_color_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT);
  optional(VK_EXT_IMAGE_2D_VIEW_OF_3D_EXTENSION_NAME, view_of_3d_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_2D_VIEW_OF_3D_FEATURES_EXT);
  optional(VK_EXT_IMAGE_VIEW_MIN_LOD_EXTENSION_NAME, min_lod_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_VIEW_MIN_LOD_FEATURES_EXT);
  optional(VK_EXT_ROBUSTNESS_2_EXTENSION_NAME, robustness2_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ROBUSTNESS_2_FEATURES_EXT);
  optional(VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME, depth_clip_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT);
  optional(VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME, divisor_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_FEATURES_EXT);
  optional(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME, lines_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT);
  optional(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME, atomic_float_,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_FEATURES_EXT);
  features_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features_.pNext = head;
  vkGetPhysicalDeviceFeatures2(device, &features_);
}

FeatureChain::FeatureChain(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_3) {
    missing_ = "Vulkan 1.3";
    return;
  }
  query(device);
  const VkPhysicalDeviceFeatures& core = features_.features;
  require(ray_tracing_.rayTracingPipeline, "rayTracingPipeline");
  require(acceleration_structure_.accelerationStructure, "accelerationStructure");
  require(vulkan12_.bufferDeviceAddress, "bufferDeviceAddress");
  require(vulkan12_.scalarBlockLayout, "scalarBlockLayout");
  require(vulkan12_.runtimeDescriptorArray, "runtimeDescriptorArray");
  require(vulkan12_.descriptorBindingPartiallyBound, "descriptorBindingPartiallyBound");
  require(vulkan12_.descriptorBindingSampledImageUpdateAfterBind,
          "descriptorBindingSampledImageUpdateAfterBind");
  require(vulkan12_.descriptorBindingStorageImageUpdateAfterBind,
          "descriptorBindingStorageImageUpdateAfterBind");
  require(vulkan12_.shaderSampledImageArrayNonUniformIndexing,
          "shaderSampledImageArrayNonUniformIndexing");
  require(vulkan12_.shaderStorageImageArrayNonUniformIndexing,
          "shaderStorageImageArrayNonUniformIndexing");
  require(core.shaderInt64, "shaderInt64");
  require(core.shaderStorageImageReadWithoutFormat, "shaderStorageImageReadWithoutFormat");
  require(core.shaderStorageImageWriteWithoutFormat, "shaderStorageImageWriteWithoutFormat");

  // Not wanted: they cost speed, or need special care. Robust buffers are wanted for vertices and
  // indices; shaders access buffers by address, where it does not matter.
  vulkan11_.protectedMemory = VK_FALSE;
  vulkan12_.bufferDeviceAddressCaptureReplay = VK_FALSE;
  vulkan12_.bufferDeviceAddressMultiDevice = VK_FALSE;
  vulkan13_.robustImageAccess = VK_FALSE;
  robustness2_.robustImageAccess2 = VK_FALSE;
  acceleration_structure_.accelerationStructureCaptureReplay = VK_FALSE;
  acceleration_structure_.accelerationStructureHostCommands = VK_FALSE;
  ray_tracing_.rayTracingPipelineShaderGroupHandleCaptureReplay = VK_FALSE;
  ray_tracing_.rayTracingPipelineShaderGroupHandleCaptureReplayMixed = VK_FALSE;

  optional_.ray_query = ray_query_.rayQuery;
  optional_.float64 = core.shaderFloat64;
  optional_.int16 = core.shaderInt16;
  optional_.float16 = vulkan12_.shaderFloat16;
  optional_.int8 = vulkan12_.shaderInt8;
  optional_.storage16 = vulkan11_.storageBuffer16BitAccess;
  optional_.storage8 = vulkan12_.storageBuffer8BitAccess;
  optional_.int64_atomics = vulkan12_.shaderBufferInt64Atomics;
  optional_.sample_shading = core.sampleRateShading;
  optional_.image_cube_array = core.imageCubeArray;
  optional_.sampler_anisotropy = core.samplerAnisotropy;
  optional_.image_gather_extended = core.shaderImageGatherExtended;
  optional_.custom_border_color =
      border_color_.customBorderColors && border_color_.customBorderColorWithoutFormat;
  optional_.image_2d_view_of_3d = view_of_3d_.image2DViewOf3D;
  optional_.image_view_min_lod = min_lod_.minLod;
  optional_.null_descriptor = robustness2_.nullDescriptor;
  optional_.sampler_filter_minmax = vulkan12_.samplerFilterMinmax;
  optional_.external_memory_host = has(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
  if (optional_.external_memory_host) {
    extensions_.push_back(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
  }
  optional_.pipeline_statistics = core.pipelineStatisticsQuery;
  optional_.mirror_clamp_to_edge = vulkan12_.samplerMirrorClampToEdge;
  query_graphics();
}

void FeatureChain::query_graphics() {
  std::string& lacks = optional_.graphics_lacks;
  const auto need = [&](VkBool32 there, const char* name) {
    if (!there) lacks += (lacks.empty() ? "" : ", ") + std::string(name);
  };
  const VkPhysicalDeviceFeatures& core = features_.features;
  need(core.robustBufferAccess && robustness2_.robustBufferAccess2, "robustBufferAccess2");
  need(robustness2_.nullDescriptor, "nullDescriptor");
  need(core.fullDrawIndexUint32, "fullDrawIndexUint32");
  need(core.independentBlend, "independentBlend");
  need(core.dualSrcBlend, "dualSrcBlend");
  need(core.logicOp, "logicOp");
  need(core.fillModeNonSolid, "fillModeNonSolid");
  need(core.wideLines, "wideLines");
  need(lines_.bresenhamLines && lines_.rectangularLines, VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
  need(core.depthClamp, "depthClamp");
  need(core.depthBiasClamp, "depthBiasClamp");
  need(core.multiViewport, "multiViewport");
  need(core.geometryShader, "geometryShader");
  need(core.shaderClipDistance, "shaderClipDistance");
  need(core.shaderCullDistance, "shaderCullDistance");
  need(core.vertexPipelineStoresAndAtomics, "vertexPipelineStoresAndAtomics");
  need(core.fragmentStoresAndAtomics, "fragmentStoresAndAtomics");
  need(core.occlusionQueryPrecise, "occlusionQueryPrecise");
  need(vulkan11_.shaderDrawParameters, "shaderDrawParameters");
  need(vulkan12_.shaderOutputLayer, "shaderOutputLayer");
  need(vulkan12_.shaderOutputViewportIndex, "shaderOutputViewportIndex");
  need(vulkan13_.dynamicRendering, "dynamicRendering");
  need(vulkan13_.shaderDemoteToHelperInvocation, "shaderDemoteToHelperInvocation");
  need(depth_clip_.depthClipEnable, VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME);
  need(divisor_.vertexAttributeInstanceRateDivisor &&
           divisor_.vertexAttributeInstanceRateZeroDivisor,
       VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME);
}

}  // namespace kaamos::vulkan
