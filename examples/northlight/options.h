// SPDX-License-Identifier: MIT
// northlight's command line.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/northlight/settings.h"

namespace northlight {

struct Options {
  std::string scene = "lounge";        // or runner, glass-stack, mirror-hall, a .gltf or .glb file
  std::vector<std::string> materials;  // overrides, NAME:KEY=VALUE[,KEY=VALUE...]
  std::string backend = "embree";
  std::string precision = "robust";  // of ray traversal: fast, robust, exact
  bool checked = false;              // print what checked mode reports
  std::uint32_t threads = 0;         // 0: all
  // The frame that is rendered. Its effects are the chosen ones.
  kaamos::effects::FrameSettings frame;
  // Every effect as the command line wants it, chosen or not: --measure and --split choose others.
  std::map<std::string, kaamos::effects::EffectSettings> effects;
  std::uint32_t piece_triangles = 0;  // split larger meshes; 0: split none
  bool measure_left_out = false;      // instead of writing files
  std::string out = "out/northlight";
  std::string write_glb;     // empty: none
  std::uint32_t frames = 0;  // of a sequence; 0: a still
  std::string camera_path;   // name or file; empty: the scene's own
  double frames_per_second = 30;
  bool watch = false;
  bool list_devices = false;
  std::string split;                        // settings side by side in one picture; empty: none
  std::uint32_t reference = 0;              // samples for the layers NAME_reference; 0: none
  std::uint32_t path_samples = 0;           // of a path-traced reference; 0: none
  std::optional<std::uint32_t> bounces;     // of its paths; none: unlimited
  std::optional<double> seconds;            // of it on the scene's clock; none: as loaded
  bool each_lamp = false;                   // it has a layer for each lamp
  bool half = false;                        // its file has half floats
  double save_seconds = 60;                 // between its saves
  bool resume = false;                      // goes on with the one in the folder
  bool claims = false;                      // measure what the sources say about costs
  std::string measure;                      // effect whose error to measure; empty: none
  std::uint32_t measure_reference = 16384;  // samples of its reference
  std::uint32_t measure_truth = 1024;       // samples of the path-traced truth; 0: none
  std::uint32_t repeats = 7;                // runs of each measured setting
  bool cpu_clock = false;                   // measure CPU time over threads
  bool study = false;                       // every technique of each family
  std::vector<std::string> families;        // of the study; empty: all
  bool quick = false;                       // three settings of each technique
  std::uint32_t seeds = 64;                 // for each denoiser
  std::optional<std::pair<std::uint32_t, std::uint32_t>>
      pixel;           // print it instead of writing files
  std::string tables;  // "text", "json": print the shader tables instead of rendering; empty: no
  std::optional<std::pair<std::uint32_t, std::uint32_t>> explain;  // print this pixel's tree
  bool json = false;                                               // for --explain
  std::vector<std::string> views;  // of what the frame is made from, by name [effects/views]
  std::string view_signal;         // of views that look at one; empty: the first
  std::string heatmap;             // "anyhit", ..., "overdraw": write that picture; empty: no
};

// Chooses these effects instead, with the settings of options.effects. "all": every one.
void choose(Options& options, const std::vector<std::string>& effects);

// Parses the command line. If the program should exit at once (--help, a wrong option), returns
// nothing and sets `exit_code`; everything to say has been printed.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace northlight
