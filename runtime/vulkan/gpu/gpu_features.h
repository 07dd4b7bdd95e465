// SPDX-License-Identifier: MIT
//
// The features that a device must support, and those that it may support. The same structures query
// a physical device and enable the features when the device is created.
#pragma once

#include <volk.h>

#include <string>
#include <vector>

#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

GpuProperties read_properties(VkPhysicalDevice device);

// The features and extensions to create a device with. Must not be moved, because its structures
// are chained.
class FeatureChain {
 public:
  explicit FeatureChain(VkPhysicalDevice device);
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;

  // Names what the device lacks, e.g. "VK_KHR_ray_tracing_pipeline"; "" if it lacks nothing.
  const std::string& missing() const { return missing_; }
  const VkPhysicalDeviceFeatures2& chain() const { return features_; }
  const std::vector<const char*>& extensions() const { return extensions_; }
  const GpuFeatures& optional() const { return optional_; }

 private:
  void query(VkPhysicalDevice device);
  void require(bool there, const char* name);
  // Notes what graphics pipelines need.
  void query_graphics();
  bool has(const char* extension) const;

  std::vector<VkExtensionProperties> available_;
  std::vector<const char*> extensions_;
  std::string missing_;
  GpuFeatures optional_;
  VkPhysicalDeviceFeatures2 features_ = {};
  VkPhysicalDeviceVulkan11Features vulkan11_ = {};
  VkPhysicalDeviceVulkan12Features vulkan12_ = {};
  VkPhysicalDeviceVulkan13Features vulkan13_ = {};
  VkPhysicalDeviceRayTracingPipelineFeaturesKHR ray_tracing_ = {};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration_structure_ = {};
  VkPhysicalDeviceRayQueryFeaturesKHR ray_query_ = {};
  VkPhysicalDeviceCustomBorderColorFeaturesEXT border_color_ = {};
  VkPhysicalDeviceImage2DViewOf3DFeaturesEXT view_of_3d_ = {};
  VkPhysicalDeviceImageViewMinLodFeaturesEXT min_lod_ = {};
  VkPhysicalDeviceRobustness2FeaturesEXT robustness2_ = {};
  VkPhysicalDeviceDepthClipEnableFeaturesEXT depth_clip_ = {};
  VkPhysicalDeviceVertexAttributeDivisorFeaturesEXT divisor_ = {};
  VkPhysicalDeviceLineRasterizationFeaturesEXT lines_ = {};
  VkPhysicalDeviceShaderAtomicFloatFeaturesEXT atomic_float_ = {};  // exchanges of texels
};

}  // namespace kaamos::vulkan
