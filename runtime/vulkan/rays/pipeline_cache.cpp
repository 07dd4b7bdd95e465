// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/pipeline_cache.h"

#include <algorithm>
#include <utility>

namespace kaamos::vulkan {

rtapi::Result<std::shared_ptr<const CompiledPipeline>> PipelineCache::find_or_make(
    const Gpu& gpu, std::string text, const std::string& what, const Make& make) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.text == text; });
    if (found != entries_.end()) {
      std::rotate(found, found + 1, entries_.end());
      return entries_.back().pipeline;
    }
  }
  // Without the lock, so that several threads compile at a time.
  VkPipeline handle = VK_NULL_HANDLE;
  const auto made = make(&handle);
  if (!made) return made.error();
  if (*made != VK_SUCCESS) return gpu.error(*made, what);
  auto pipeline = std::make_shared<const CompiledPipeline>(gpu, handle);
  const std::lock_guard lock(mutex_);
  if (entries_.size() == kKept) entries_.erase(entries_.begin());
  entries_.push_back({std::move(text), pipeline});
  return pipeline;
}

}  // namespace kaamos::vulkan
