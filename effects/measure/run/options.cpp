// SPDX-License-Identifier: MIT
#include "effects/measure/run/options.h"

namespace kaamos::measure {

using namespace kaamos::effects;

void choose(Options& options, const std::vector<std::string>& effects) {
  FrameSettings& frame = options.frame;
  frame.effects = choose_effects(effects);
  for (auto& [name, settings] : frame.effects) {
    const bool named = settings.named;
    settings = options.effects.at(name);
    settings.named = named;
  }
  frame.whole_frame = need_whole_frame(frame.effects);
}

}  // namespace kaamos::measure
