// SPDX-License-Identifier: MIT
#include "runtime/vulkan/memory/command_stream.h"

#include <utility>

namespace kaamos::vulkan {

CommandStream::CommandStream(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)) {}

CommandStream::~CommandStream() {
  gpu_->vk().vkDestroyFence(gpu_->device(), fence_, nullptr);
  gpu_->vk().vkDestroyCommandPool(gpu_->device(), pool_, nullptr);
}

rtapi::Result<VkCommandBuffer> CommandStream::record(const std::string& what) {
  if (!recording_) {
    const VolkDeviceTable& vk = gpu_->vk();
    VkResult r = VK_SUCCESS;
    if (pool_ == VK_NULL_HANDLE) r = gpu_->create_command_buffer(&pool_, &commands_, &fence_);
    if (r == VK_SUCCESS) r = vk.vkResetCommandPool(gpu_->device(), pool_, 0);
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (r == VK_SUCCESS) r = vk.vkBeginCommandBuffer(commands_, &begin);
    if (r != VK_SUCCESS) return gpu_->error(r, what);
    recording_ = true;
    what_.clear();
  }
  if (what_.empty()) {
    what_ = what;
  } else if (what_.size() < 200) {
    what_ += "; " + what;
  }
  return commands_;
}

void CommandStream::everything() {
  if (!recording_) return;
  VkMemoryBarrier barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  gpu_->vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                  VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &barrier, 0, nullptr, 0,
                                  nullptr);
}

rtapi::Status CommandStream::flush() {
  if (!recording_) return {};
  recording_ = false;
  rtapi::Status status = gpu_->submit(commands_, fence_, what_);
  kept_.clear();
  return status;
}

}  // namespace kaamos::vulkan
