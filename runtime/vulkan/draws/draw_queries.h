// SPDX-License-Identifier: MIT
//
// The queries of renderings whose work is counted: one of each kind for a rendering, since a GPU
// runs one at a time. The sums over them are taken on the host.
#pragma once

#include <vector>

#include "runtime/backend/queries.h"
#include "runtime/vulkan/gpu/gpu.h"

namespace kaamos::vulkan {

class DrawQueries {
 public:
  explicit DrawQueries(Gpu& gpu) : gpu_(gpu) {}
  ~DrawQueries();
  DrawQueries(const DrawQueries&) = delete;
  DrawQueries& operator=(const DrawQueries&) = delete;

  // What is counted from the next begin() on. Nothing is between begin() and end().
  void set(const runtime::WorkToCount& what) { what_ = what; }
  const runtime::WorkToCount& what() const { return what_; }
  // Before a rendering, so that begin() can be called in it. Errors: KA0952, KA0990.
  rtapi::Status prepare(VkCommandBuffer commands);
  void begin(VkCommandBuffer commands);
  void end(VkCommandBuffer commands);
  // Adds what the queries found, all of which have run, to `sums`, and frees them.
  rtapi::Status read(runtime::WorkCounts& sums);

 private:
  static constexpr uint32_t kQueries = 64;  // of a pool
  struct Pools {
    VkQueryPool samples = VK_NULL_HANDLE;
    VkQueryPool statistics = VK_NULL_HANDLE;
  };

  rtapi::Status create_pools();
  rtapi::Status read(uint32_t query, runtime::WorkCounts& sums) const;

  Gpu& gpu_;
  runtime::WorkToCount what_;
  std::vector<Pools> pools_;
  // What each query counts; the last one may be running.
  std::vector<runtime::WorkToCount> queries_;
};

}  // namespace kaamos::vulkan
