// SPDX-License-Identifier: MIT
//
// Draws on the CPU. Draws that follow each other on the same targets are one pass of the rasterizer
// (runtime/raster), which runs when anything else comes.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "runtime/backend/draw_commands.h"
#include "runtime/embree/draw_shaders.h"
#include "runtime/raster/rasterizer.h"

namespace kaamos::embree {

class DrawPass {
 public:
  DrawPass(const DispatchEnvironment& environment, raster::Rasterizer& rasterizer)
      : environment_(environment), rasterizer_(rasterizer) {}

  // Takes a draw into the pass, after a flush if its targets are others. `label` names it in
  // messages.
  CountedOutcome draw(const runtime::DrawCommand& command, const std::string& label);
  // Runs what waits. An error removes the device: KA0892, KA0893, KA0897.
  CountedOutcome flush();

 private:
  // More would hold too much state for too little.
  static constexpr size_t kMostDraws = 4096;

  DispatchEnvironment environment_;
  raster::Rasterizer& rasterizer_;
  std::deque<RunningDraw> running_;
  std::vector<raster::Draw> draws_;
};

// Texels of a target's view.
raster::Surface surface_of(const runtime::TargetView& view);

}  // namespace kaamos::embree
