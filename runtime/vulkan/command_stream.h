// SPDX-License-Identifier: MIT
//
// The GPU's part of a command list: recorded in order, and submitted when the host has to see or
// change what stands in GPU memory. One thread at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/vulkan/gpu.h"

namespace kaamos::vulkan {

class CommandStream {
 public:
  explicit CommandStream(std::shared_ptr<Gpu> gpu);
  ~CommandStream();
  CommandStream(const CommandStream&) = delete;
  CommandStream& operator=(const CommandStream&) = delete;

  // Commands that are recorded now. Each caller orders its work after earlier work itself:
  // everything(), where it has nothing better. Errors: as flush. `what` names the work where the
  // device is lost.
  rtapi::Result<VkCommandBuffer> record(const std::string& what);
  // Orders all that was recorded before against all that comes.
  void everything();
  // Keeps an object until the work recorded so far is done.
  void keep(std::shared_ptr<const void> object) { kept_.push_back(std::move(object)); }
  // Submits and waits; at once where nothing was recorded. Errors: KA0955, KA0990.
  rtapi::Status flush();

  Gpu& gpu() const { return *gpu_; }

 private:
  std::shared_ptr<Gpu> gpu_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  bool recording_ = false;
  std::string what_;
  std::vector<std::shared_ptr<const void>> kept_;
};

}  // namespace kaamos::vulkan
