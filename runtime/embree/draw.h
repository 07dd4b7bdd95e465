// SPDX-License-Identifier: MIT
//
// Draws on the CPU. Draws that follow each other on the same targets are one pass of the rasterizer
// (runtime/raster), which runs when anything else comes.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "runtime/backend/draw_commands.h"
#include "runtime/backend/queries.h"
#include "runtime/embree/draw_shaders.h"
#include "runtime/raster/observer.h"
#include "runtime/raster/rasterizer.h"

namespace kaamos::embree {

class DrawPass {
 public:
  // `observation` is null if nobody asks for it.
  DrawPass(const DispatchEnvironment& environment, raster::Rasterizer& rasterizer,
           runtime::DrawObservation* observation)
      : environment_(environment), rasterizer_(rasterizer), observation_(observation) {}

  // Takes a draw into the pass, after a flush if its targets are others. `label` names it in
  // messages.
  CountedOutcome draw(const runtime::DrawCommand& command, const std::string& label);
  // Clears when the pass before has run: at once, or as part of the next pass if it draws to the
  // same view.
  CountedOutcome clear(const runtime::ClearTargetCommand& command);
  // Draws from now on are counted, or not. Nothing waits.
  void count_work(bool on) { counts_work_ = on; }
  const runtime::WorkCounts& counted() const { return counted_; }
  // Runs what waits. An error removes the device: KA0892, KA0893, KA0897.
  CountedOutcome flush();

 private:
  // More would hold too much state for too little.
  static constexpr size_t kMostDraws = 4096;

  void clear_now();
  void begin_pass(const runtime::DrawTargets& views, uint32_t samples);
  // Tells raster::Observation what to note, and others what was.
  void begin_observation(raster::Observation& noted);
  void end_observation(const raster::Observation& noted);

  DispatchEnvironment environment_;
  raster::Rasterizer& rasterizer_;
  runtime::DrawObservation* observation_;
  std::deque<RunningDraw> running_;
  std::vector<raster::Draw> draws_;
  raster::Targets targets_;                          // of the draws
  std::vector<runtime::ClearTargetCommand> clears_;  // that wait for a pass
  bool counts_work_ = false;
  runtime::WorkCounts counted_;
};

// Texels of a target's view.
raster::Surface surface_of(const runtime::TargetView& view);

}  // namespace kaamos::embree
