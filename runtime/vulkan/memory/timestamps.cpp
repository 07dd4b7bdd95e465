// SPDX-License-Identifier: MIT
#include "runtime/vulkan/memory/timestamps.h"

#include <cmath>
#include <utility>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/memory/memory.h"

namespace kaamos::vulkan {

rtapi::Result<std::shared_ptr<runtime::BackendQueryHeap>> Timestamps::create(
    std::shared_ptr<Gpu> gpu, uint32_t count) {
  if (gpu->timestamp_bits() == 0) {
    return runtime::make_error(runtime::Id::kNoQueries, gpu->info().Name + " has no timestamps");
  }
  auto heap = std::shared_ptr<Timestamps>(new Timestamps(gpu, count));
  VkQueryPoolCreateInfo info = {VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = count;
  const VkResult result = gpu->vk().vkCreateQueryPool(gpu->device(), &info, nullptr, &heap->pool_);
  if (result != VK_SUCCESS) return gpu->error(result, "creating a query heap");
  return std::shared_ptr<runtime::BackendQueryHeap>(std::move(heap));
}

Timestamps::~Timestamps() {
  gpu_->vk().vkDestroyQueryPool(gpu_->device(), pool_, nullptr);
}

rtapi::Status Timestamps::write(CommandStream& stream, const runtime::TimestampCommand& command) {
  const auto& heap = static_cast<const Timestamps&>(*command.heap);
  stream.everything();
  auto commands = stream.record("EndQuery");
  if (!commands) return commands.error();
  const auto& vk = heap.gpu_->vk();
  vk.vkCmdResetQueryPool(*commands, heap.pool_, command.index, 1);
  vk.vkCmdWriteTimestamp(*commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, heap.pool_,
                         command.index);
  stream.keep(command.heap);
  return {};
}

rtapi::Status Timestamps::resolve(CommandStream& stream,
                                  const runtime::ResolveQueriesCommand& command) {
  const auto& heap = static_cast<const Timestamps&>(*command.heap);
  const GpuBuffer& dest = gpu_buffer_of(*command.dest);
  stream.everything();
  auto commands = stream.record("ResolveQueryData");
  if (!commands) return commands.error();
  const auto& vk = heap.gpu_->vk();
  // A pool's query that was never written must not be copied, so runs of written ones are.
  for (uint32_t i = 0; i < command.count;) {
    const bool written = heap.written(command.first + i);
    uint32_t end = i + 1;
    while (end < command.count && heap.written(command.first + end) == written) ++end;
    const VkDeviceSize offset = dest.offset() + command.dest_offset + i * sizeof(uint64_t);
    if (written) {
      vk.vkCmdCopyQueryPoolResults(*commands, heap.pool_, command.first + i, end - i, dest.handle(),
                                   offset, sizeof(uint64_t),
                                   VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    } else {
      vk.vkCmdFillBuffer(*commands, dest.handle(), offset, (end - i) * sizeof(uint64_t), 0);
    }
    i = end;
  }
  stream.keep(command.heap);
  return {};
}

uint64_t timestamp_frequency(const Gpu& gpu) {
  const double period_ns = gpu.properties().core.limits.timestampPeriod;
  return period_ns > 0 ? static_cast<uint64_t>(std::llround(1e9 / period_ns)) : 0;
}

}  // namespace kaamos::vulkan
