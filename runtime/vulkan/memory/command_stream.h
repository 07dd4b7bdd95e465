// SPDX-License-Identifier: MIT
//
// The GPU's part of a command list: recorded in order, and submitted when the host has to see or
// change what is in GPU memory. For one thread at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

class CommandStream {
 public:
  explicit CommandStream(std::shared_ptr<Gpu> gpu);
  ~CommandStream();
  CommandStream(const CommandStream&) = delete;
  CommandStream& operator=(const CommandStream&) = delete;

  // The command buffer to record into now. Callers order their work after earlier work themselves,
  // with everything() if nothing more specific will do. Errors: as flush. `what` names the work in
  // case the device is lost.
  rtapi::Result<VkCommandBuffer> record(const std::string& what);
  // Orders everything recorded so far before everything that follows.
  void everything();
  // Keeps an object alive until the work recorded so far is done.
  void keep(std::shared_ptr<const void> object) { kept_.push_back(std::move(object)); }
  // Submits and waits; returns at once if nothing was recorded. Errors: KA0955, KA0990.
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
