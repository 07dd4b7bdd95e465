// SPDX-License-Identifier: MIT
// northlight --split: settings side by side in one picture, as the talk shows them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/assets/image/image.h"
#include "effects/assets/scene/scene.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// A comparison that can be made, by the name of --split.
struct Split {
  std::string name;
  std::string about;  // what stands side by side, from left to right
  std::string look;   // at what, to see the difference
  std::string scene;  // where it shows, unless another one is chosen
  // Middle of what every part shows of the picture, in its width; none: each shows its own strip.
  std::optional<double> middle;
};
// All of them, in the order of --help.
const std::vector<Split>& splits();
std::vector<std::string> split_names();
// Null: there is none of that name.
const Split* find_split(const std::string& name);

// Strips of equal width from pictures of equal size, with a thin line between: strip i from picture
// i; with `middle`, about which all of them lie, the same strip of each.
effects::ByteImage side_by_side(const std::vector<effects::ByteImage>& pictures,
                                std::optional<double> middle = {});

// Renders what options.split names and writes split-NAME.png into options.out; `said` becomes what
// the picture shows.
rtapi::Result<Outcome> run_split(const Options& options, const effects::Scene& scene,
                                 const Progress& progress, std::string& said);

}  // namespace kaamos::measure
