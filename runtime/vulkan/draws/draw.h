// SPDX-License-Identifier: MIT
//
// Draws and clears of targets. They are recorded, and run when something else comes; then what
// their shaders reported is read.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "runtime/backend/draw_commands.h"
#include "runtime/vulkan/draws/graphics_pipeline.h"
#include "runtime/vulkan/draws/index_source.h"
#include "runtime/vulkan/draws/render_pass.h"
#include "runtime/vulkan/rays/dispatch.h"

namespace kaamos::vulkan {

// Memory for the blocks of draws that have not run. [spirv_interface.h: DispatchBlock]
class DrawBlocks {
 public:
  // A status and a block behind it.
  struct Place {
    uint8_t* host = nullptr;
    uint64_t address = 0;
  };
  rtapi::Result<Place> next(Gpu& gpu);
  // 16 bytes of zeros, for what is not bound.
  rtapi::Result<const GpuBuffer*> zeros(Gpu& gpu);
  // All are free again.
  void reset() { used_ = 0; }

 private:
  std::vector<std::unique_ptr<GpuBuffer>> buffers_;
  uint64_t used_ = 0;  // blocks
  std::unique_ptr<GpuBuffer> zeros_;
};

// One for the commands of a list. Everything else than its own commands must call flush() first.
class DrawPass {
 public:
  DrawPass(const DispatchEnvironment& environment, DrawBlocks& blocks)
      : environment_(environment), blocks_(blocks), pass_(*environment.stream) {}

  // `label` names the draw in messages. Errors: KA0952, KA0990, and those of flush().
  CountedOutcome draw(const runtime::DrawCommand& command, const std::string& label);
  rtapi::Status clear(const runtime::ClearTargetCommand& command) { return pass_.clear(command); }
  // From now on, draws are counted like this. Nothing waits.
  void count_work(const runtime::WorkToCount& what) { pass_.count_work(what); }
  const runtime::WorkCounts& counted() const { return counted_; }
  // Orders everything before it against everything after it.
  void barrier();
  // Returns whether there is anything that flush() would run or check.
  bool waits() const { return !waiting_.empty() || pass_.waits(); }
  // Runs what waits. An error removes the device: KA0890, KA0892, KA0893, KA0955.
  CountedOutcome flush();

 private:
  struct Waiting {
    std::string label;
    const uint8_t* status = nullptr;
  };

  rtapi::Status record(const runtime::DrawCommand& command, const std::string& label);
  rtapi::Result<VkPipeline> pipeline_of(const runtime::DrawCommand& command) const;
  rtapi::Result<uint64_t> write_block(const runtime::DrawCommand& command,
                                      const std::string& label);
  rtapi::Status set_state(VkCommandBuffer commands, const runtime::DrawCommand& command,
                          bool restarts);
  rtapi::Status bind_vertices(VkCommandBuffer commands, const runtime::DrawCommand& command);
  bool is_checked() const;

  DispatchEnvironment environment_;
  DrawBlocks& blocks_;
  RenderPass pass_;
  IndexMemory index_memory_;
  std::deque<Waiting> waiting_;
  bool has_scene_ = false;
  SceneTables scene_;  // if has_scene_
  uint64_t checks_ = 0;
  // The state that the open rendering has set. Pipelines and states live as long as the list.
  uint64_t set_in_ = 0;  // RenderPass::number()
  VkPipeline set_pipeline_ = VK_NULL_HANDLE;
  std::shared_ptr<const runtime::DrawState> set_state_;
  bool set_restart_ = false;
  runtime::WorkCounts counted_;
};

}  // namespace kaamos::vulkan
