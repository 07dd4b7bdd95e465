// SPDX-License-Identifier: MIT
//
// Vertex and pixel shaders of a pass of draws, on the device's threads.
#pragma once

#include <atomic>
#include <deque>
#include <string>
#include <vector>

#include "runtime/backend/draw_commands.h"
#include "runtime/embree/dispatch.h"
#include "runtime/raster/workers.h"

namespace kaamos::embree {

// A draw of the pass, as its shaders see it.
struct RunningDraw {
  RunningDispatch
      dispatch;  // what a draw shares with a dispatch: arguments, heaps, what went wrong
  runtime::DrawCommand command;  // keeps what it refers to
  std::string label;             // "DrawInstanced, command 3"
  uint32_t number = 0;           // of a runtime::DrawObservation
  const GraphicsPipeline& pipeline() const {
    return static_cast<const GraphicsPipeline&>(*command.pipeline);
  }
  // The resources that the shaders have bound; empty unless they read them.
  std::vector<shader::BoundResource> vertex_bound;
  std::vector<shader::BoundResource> geometry_bound;
  std::vector<shader::BoundResource> pixel_bound;
};

// Looks up what the shaders have bound. `command` and `label` are set.
void begin_draw(const DispatchEnvironment& environment, RunningDraw& draw);

class DrawWorkers final : public raster::Workers {
 public:
  DrawWorkers(const DispatchEnvironment& environment, std::deque<RunningDraw>& draws)
      : environment_(environment), draws_(draws) {}

  void run(uint32_t count, Task task, const void* context) override;
  using raster::Workers::run;

  // True if a shader failed; then the pass ends as soon as it can.
  bool failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  const DispatchEnvironment& environment_;
  std::deque<RunningDraw>& draws_;
  std::atomic<bool> failed_ = false;
};

}  // namespace kaamos::embree
