// SPDX-License-Identifier: MIT
//
// The indices of a draw as Vulkan can read them: from the application's buffer, or rewritten where
// D3D12 and Vulkan differ.
#pragma once

#include <memory>
#include <vector>

#include "runtime/backend/draw_commands.h"
#include "runtime/vulkan/memory/memory.h"

namespace kaamos::vulkan {

// Memory for rewritten indices of draws that have not run.
class IndexMemory {
 public:
  rtapi::Result<const GpuBuffer*> get(Gpu& gpu, uint64_t size_bytes);
  void reset() { buffers_.clear(); }

 private:
  std::vector<std::unique_ptr<GpuBuffer>> buffers_;
};

struct IndexSource {
  VkBuffer buffer = VK_NULL_HANDLE;
  uint64_t offset = 0;
  VkIndexType type = VK_INDEX_TYPE_UINT16;
  uint32_t first = 0;  // index
  bool restarts = false;
};

// Returns whether the host has to read the indices, so that everything that may write them must be
// done: a draw that reads beyond its view, where indices are 0, or one whose cut value is not the
// largest number of the indices' format. [RAS-05, RAS-07]
bool needs_rewriting(const runtime::DrawCommand& command);

rtapi::Result<IndexSource> index_source(Gpu& gpu, const Memory& memory,
                                        const runtime::DrawCommand& command,
                                        IndexMemory& rewritten);

}  // namespace kaamos::vulkan
