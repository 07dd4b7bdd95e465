// SPDX-License-Identifier: MIT
//
// Checks draws and clears of targets, and graphics pipelines when they are made. targets.h and
// vertex_inputs.h check what a draw writes to and reads.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "runtime/backend/commands.h"
#include "runtime/backend/draw_observation.h"
#include "runtime/checks/arguments.h"
#include "runtime/checks/targets.h"

namespace kaamos::checks {

class Draws {
 public:
  Draws(const runtime::AddressMap& addresses, Reporter& reporter, TextureStates& states)
      : addresses_(addresses), reporter_(reporter), targets_(reporter, states) {}

  void begin_list();
  // Reports the pipelines of which nothing arrived in the whole list: single draws may be culled or
  // outside of the picture.
  void end_list();
  void created(const runtime::LinkedGraphics& pipeline);
  // Before the draw; counts it. `label` names the command.
  void check(const runtime::DrawCommand& command, const std::string& label);
  // Takes the draw's counts and reports what became of it, while it is the last one checked.
  void drawn(const runtime::DrawCommand& command, const runtime::DrawCounts& counts);
  // The arguments of an ExecuteIndirect that draws.
  void check(const runtime::ExecuteIndirectCommand& command);
  Targets& targets() { return targets_; }
  // "draw 3, pipeline \"gbuffer\"", of the draw that was checked last.
  const std::string& who() const { return who_; }

 private:
  void check_rectangles(const runtime::DrawCommand& command);
  void check_root_arguments(const runtime::DrawCommand& command,
                            const runtime::LinkedShader& shader);
  void report_positions(const runtime::DrawCounts& counts);
  void report_outputs(const runtime::DrawCommand& command, const runtime::DrawCounts& counts);
  void report_nothing_drawn(const runtime::DrawCommand& command, const runtime::DrawCounts& counts);
  // Once for each pipeline and cause, as it may be right.
  void report_once(Id id, const std::string& pipeline, const char* cause, const std::string& text);

  const runtime::AddressMap& addresses_;
  Reporter& reporter_;
  Targets targets_;
  uint64_t number_ = 0;  // of the next draw of the list
  std::string who_;
  bool draws_nothing_ = false;  // the draw's rectangles are empty, and it was said
  std::set<std::string> said_;

  // The outcome of a pipeline's draws of this list, by the pipeline's name.
  struct Drawn {
    bool arrived = false;
    uint64_t silent = 0;  // draws of which nothing arrived; the rest is of the first
    Id id = Id::kNothingDrawn;
    const char* cause = "";
    std::string text, label;
  };
  std::map<std::string, Drawn> drawn_;
  std::string label_;
};

}  // namespace kaamos::checks
