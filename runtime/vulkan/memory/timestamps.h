// SPDX-License-Identifier: MIT
//
// Timestamps of the Vulkan backend: a query pool.
#pragma once

#include <memory>

#include "runtime/backend/backend.h"
#include "runtime/vulkan/memory/command_stream.h"

namespace kaamos::vulkan {

class Timestamps final : public runtime::BackendQueryHeap {
 public:
  // Errors: KA0958 the device's queue has no timestamps, KA0952, KA0990.
  static rtapi::Result<std::shared_ptr<runtime::BackendQueryHeap>> create(std::shared_ptr<Gpu> gpu,
                                                                          uint32_t count);
  ~Timestamps() override;

  // Both are recorded outside of rendering, after everything earlier.
  static rtapi::Status write(CommandStream& stream, const runtime::TimestampCommand& command);
  static rtapi::Status resolve(CommandStream& stream,
                               const runtime::ResolveQueriesCommand& command);

 private:
  Timestamps(std::shared_ptr<Gpu> gpu, uint32_t count)
      : BackendQueryHeap(count), gpu_(std::move(gpu)) {}

  std::shared_ptr<Gpu> gpu_;
  VkQueryPool pool_ = VK_NULL_HANDLE;
};

// Ticks per second, rounded.
uint64_t timestamp_frequency(const Gpu& gpu);

}  // namespace kaamos::vulkan
