// SPDX-License-Identifier: MIT
// northlight's command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/measure/run/options.h"
#include "effects/measure/study/quality.h"

namespace northlight {

using namespace kaamos::measure;

// The frame, how it is measured, and what else the program does.
struct Options : kaamos::measure::Options {
  std::uint32_t piece_triangles = 0;  // split larger meshes; 0: split none
  bool measure_left_out = false;      // instead of writing files
  std::string write_glb;              // empty: none
  std::string probes = "found";       // or "camera": of environment maps
  std::uint32_t frames = 0;           // of a sequence; 0: a still
  bool watch = false;
  std::vector<std::string> layers;  // that are written; empty: those of named effects
  bool shows_profile = false;       // print where the time goes
  bool list_devices = false;
  bool claims = false;  // measure what the sources say about costs
  bool study = false;   // every technique of each family
  std::optional<std::pair<std::uint32_t, std::uint32_t>>
      pixel;           // print it instead of writing files
  std::string tables;  // "text", "json": print the shader tables instead of rendering; empty: no
  std::optional<std::pair<std::uint32_t, std::uint32_t>> explain;  // print this pixel's tree
  bool json = false;                                               // for --explain
  std::vector<std::string> views;   // of what the frame is made from, by name [effects/views]
  std::string view_signal;          // of views that look at one; empty: the first
  std::optional<QualityGoal> goal;  // techniques are chosen by what was measured
  std::string fronts;               // a study.json that they are chosen from; empty: none
  std::vector<std::pair<std::string, std::string>> settings;  // given one by one, which stay
  std::string heatmap;  // "anyhit", ..., "overdraw": write that picture; empty: no
};

// Parses the command line. If the program should exit at once (--help, a wrong option), returns
// nothing and sets `exit_code`; everything to say has been printed.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace northlight
