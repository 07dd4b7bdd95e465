// SPDX-License-Identifier: MIT
// The options that say what is measured, and how: a program fills them in.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/engine/profile.h"
#include "effects/northlight/settings.h"

namespace kaamos::measure {

// Tells a person something, a line each time.
using Say = std::function<void(const std::string& text)>;

// The frame that is measured, the machine, and the work. Names of options are northlight's.
struct Options {
  std::string scene = "lounge";        // or runner, glass-stack, mirror-hall, a .gltf or .glb file
  std::vector<std::string> materials;  // overrides, NAME:KEY=VALUE[,KEY=VALUE...]
  // Where the sun stands instead of where the scene has it, or has none: degrees from +Z towards
  // +X, and above the horizon.
  std::optional<std::pair<float, float>> sun;
  std::string backend = "embree";
  std::string precision = "robust";  // of ray traversal: fast, robust, exact
  bool checked = false;              // say what checked mode reports
  std::uint32_t threads = 0;         // 0: all
  // The frame that is rendered. Its effects are the chosen ones.
  kaamos::effects::FrameSettings frame;
  // Every effect as the program wants it, chosen or not: what is measured may choose others.
  std::map<std::string, kaamos::effects::EffectSettings> effects;
  std::string camera_path;               // name or file; empty: the scene's own
  double frames_per_second = 30;         // of sequences
  std::string out = "out/northlight";    // the folder of results
  Say say = [](const std::string&) {};   // takes what devices have to say
  effects::Profile* profile = nullptr;   // gets the steps of the run; null: nobody asks
  std::string split;                     // settings side by side in one picture; empty: none
  std::uint32_t reference = 0;           // samples for the layers NAME_reference; 0: none
  std::uint32_t path_samples = 0;        // of a path-traced reference; 0: none
  std::optional<std::uint32_t> bounces;  // of its paths; none: unlimited
  std::optional<double> seconds;         // of it on the scene's clock; none: as loaded
  bool each_lamp = false;                // it has a layer for each lamp
  bool glass_shadows = false;            // glass tints the light that passes it, in truth too
  bool half = false;                     // its file has half floats
  double save_seconds = 60;              // between its saves
  bool resume = false;                   // goes on with the one in the folder
  std::string committed;      // folder of references that are taken as truth; empty: none
  std::string fronts_folder;  // of measured fronts of scenes; empty: none
  std::string measure;        // effect whose error to measure; empty: none
  std::uint32_t measure_reference = 16384;  // samples of its reference
  std::uint32_t measure_truth = 1024;       // samples of the path-traced truth; 0: none
  std::uint32_t repeats = 7;                // runs of each measured setting
  bool cpu_clock = false;                   // measure CPU time over threads
  std::vector<std::string> families;        // of the study; empty: all
  std::vector<std::string> rows;            // of them, "EFFECT/SETTING"; empty: all
  std::string command;                      // what was typed, but for --families, --rows and --out
  std::string commit;                       // of the source tree; empty: unknown
  bool quick = false;                       // three settings of each technique
  std::uint32_t seeds = 64;                 // for each denoiser
};

// Every effect as its row of the registry has it; none is chosen.
Options default_options();
// Chooses these effects instead, with the settings of options.effects. "all": every one.
void choose(Options& options, const std::vector<std::string>& effects);
// Chooses these effects in the frame that they are used in. One that reads the frame's radiance
// [EffectNeeds::radiance] stands among all effects of a plain frame but glass, which are denoised;
// others need nothing beside them.
void choose_in_frame(Options& options, const std::vector<std::string>& effects);

}  // namespace kaamos::measure
