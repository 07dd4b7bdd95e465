// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <rtapi/descriptor.h>
#include <rtapi/result.h>

#include "runtime/vulkan/textures/descriptor_set.h"

namespace kaamos::vulkan {

// The samplers of a device, in its bindless set. They live as long as the device, and equal ones
// are shared.
class SamplerPool {
 public:
  SamplerPool(std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors)
      : gpu_(std::move(gpu)), descriptors_(std::move(descriptors)) {}
  ~SamplerPool();
  SamplerPool(const SamplerPool&) = delete;
  SamplerPool& operator=(const SamplerPool&) = delete;

  // Thread-safe. Errors: KA0956 too many, KA0962 the device does not support it.
  rtapi::Result<uint64_t> sampler(const rtapi::SamplerDesc& desc);

 private:
  struct Known {
    rtapi::SamplerDesc desc;
    VkSampler sampler;
    uint32_t index;
  };
  std::shared_ptr<Gpu> gpu_;
  std::shared_ptr<DescriptorSet> descriptors_;
  std::mutex mutex_;
  std::vector<Known> known_;
};

}  // namespace kaamos::vulkan
