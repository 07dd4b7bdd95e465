// SPDX-License-Identifier: MIT
//
// Renderings: draws that follow each other on the same targets share one, which stays open until
// something else comes. Clears of whole views wait, because the next rendering can begin with them.
#pragma once

#include <string>
#include <vector>

#include "runtime/backend/draw_commands.h"
#include "runtime/vulkan/draws/draw_queries.h"
#include "runtime/vulkan/memory/command_stream.h"

namespace kaamos::vulkan {

// The extent that is common to all targets of a rendering.
struct RenderArea {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t layers = 1;
};

// `wanted`: what draws need of it if there are no targets.
RenderArea area_of(const runtime::DrawTargets& targets, const RenderArea& wanted);

class RenderPass {
 public:
  explicit RenderPass(CommandStream& stream) : stream_(stream), counting_(stream.gpu()) {}
  ~RenderPass();
  RenderPass(const RenderPass&) = delete;
  RenderPass& operator=(const RenderPass&) = delete;

  // Opens a rendering on these targets, unless it is open; what was recorded before happens before
  // it. `label` names the first draw. Errors: KA0952, KA0990.
  rtapi::Result<VkCommandBuffer> open(const runtime::DrawTargets& targets, const RenderArea& wanted,
                                      const std::string& label);
  // Returns whether finish() has anything to do.
  bool waits() const { return open_ || !waiting_.empty(); }
  // Goes up whenever a rendering is opened, which has no state of the one before.
  uint64_t number() const { return number_; }
  const RenderArea& area() const { return area_; }
  // From now on, writes to memory by pixel shaders of this rendering are not lost. [RASUAV]
  rtapi::Status keep_memory_writes();

  rtapi::Status clear(const runtime::ClearTargetCommand& command);
  // Draws of renderings from now on are counted like this. None is open.
  void count_work(const runtime::WorkToCount& what) { counting_.set(what); }
  // Adds what draws that have run counted.
  rtapi::Status read_counts(runtime::WorkCounts& sums) { return counting_.read(sums); }
  // Ends the rendering and orders it before what follows.
  void end();
  // And makes the clears that wait.
  rtapi::Status finish();

 private:
  // The place of a view among the attachments of the open rendering.
  struct Place {
    bool found = false;
    uint32_t attachment = 0;
  };

  Place place_of(const runtime::ClearTargetCommand& command) const;
  void clear_inside(const runtime::ClearTargetCommand& command, uint32_t attachment);
  rtapi::Status clear_alone(const runtime::ClearTargetCommand& command);
  rtapi::Status clear_waiting();
  rtapi::Status begin(const runtime::DrawTargets& targets, const RenderArea& area,
                      const std::string& label, bool take_clears);
  // Draws in the rendering that was just opened are counted, if any are.
  void begin_counting();
  // The clear of the view that waits; null if none does.
  const runtime::ClearTargetCommand* waiting_for(const runtime::TargetView& view,
                                                 const RenderArea& area) const;

  CommandStream& stream_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  bool open_ = false;
  bool query_open_ = false;
  bool counts_open_ = false;  // queries of `counting_`
  uint64_t number_ = 0;
  runtime::DrawTargets targets_;
  RenderArea area_;
  std::vector<runtime::ClearTargetCommand> waiting_;  // all of whole views, each view once
  VkQueryPool queries_ = VK_NULL_HANDLE;              // one occlusion query
  DrawQueries counting_;
};

}  // namespace kaamos::vulkan
