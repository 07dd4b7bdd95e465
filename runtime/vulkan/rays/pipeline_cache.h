// SPDX-License-Identifier: MIT
//
// Pipelines by what they are compiled from. lavapipe takes seconds for a large pipeline and keeps
// little of that on disk, so a device keeps the pipelines that it made last, also when nobody uses
// them: a state object that is made again costs nothing.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

class CompiledPipeline {
 public:
  CompiledPipeline(const Gpu& gpu, VkPipeline handle) : gpu_(gpu), handle_(handle) {}
  ~CompiledPipeline() { gpu_.vk().vkDestroyPipeline(gpu_.device(), handle_, nullptr); }
  CompiledPipeline(const CompiledPipeline&) = delete;
  CompiledPipeline& operator=(const CompiledPipeline&) = delete;
  VkPipeline handle() const { return handle_; }

 private:
  const Gpu& gpu_;
  VkPipeline handle_;
};

class PipelineCache {
 public:
  // More than a frame of all effects has.
  static constexpr size_t kKept = 32;

  using Make = std::function<rtapi::Result<VkResult>(VkPipeline*)>;
  // The pipeline of that text, which `make` makes if there is none. `what` is for the message of
  // its error. The pipeline must not outlive `gpu`.
  rtapi::Result<std::shared_ptr<const CompiledPipeline>> find_or_make(const Gpu& gpu,
                                                                      std::string text,
                                                                      const std::string& what,
                                                                      const Make& make);

 private:
  struct Entry {
    std::string text;
    std::shared_ptr<const CompiledPipeline> pipeline;
  };

  std::mutex mutex_;
  std::vector<Entry> entries_;  // the one that was asked for last stands last
};

}  // namespace kaamos::vulkan
