// SPDX-License-Identifier: MIT
#include "effects/measure/run/options.h"

#include <algorithm>

namespace kaamos::measure {

using namespace kaamos::effects;

Options default_options() {
  Options out;
  for (const Effect& effect : northlight_effects()) out.effects[effect.name] = effect.defaults;
  return out;
}

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

void choose_in_frame(Options& options, const std::vector<std::string>& effects) {
  const auto reads_radiance = [](const std::string& name) {
    const Effect* effect = find_effect(northlight_effects(), name);
    return effect != nullptr && effect->needs.radiance;
  };
  if (std::none_of(effects.begin(), effects.end(), reads_radiance)) {
    choose(options, effects);
    options.frame.denoise = default_denoise(DenoiseMethod::kNone);
    return;
  }
  std::vector<std::string> chosen = effects;
  chosen.push_back("all");
  choose(options, chosen);
  for (const Effect& effect : northlight_effects()) {
    const bool is_wanted = std::count(effects.begin(), effects.end(), effect.name) != 0;
    if (effect.needs.glass && !is_wanted) options.frame.effects.erase(effect.name);
  }
}

}  // namespace kaamos::measure
