// SPDX-License-Identifier: MIT
#include "effects/engine/effect.h"

#include <algorithm>

namespace kaamos::effects {

const Effect* find_effect(const std::vector<Effect>& effects, const std::string& name) {
  const auto found = std::find_if(effects.begin(), effects.end(),
                                  [&](const Effect& effect) { return effect.name == name; });
  return found == effects.end() ? nullptr : &*found;
}

std::string effect_names(const std::vector<Effect>& effects) {
  std::string out;
  for (const Effect& effect : effects) out += (out.empty() ? "" : ", ") + effect.name;
  return out;
}

}  // namespace kaamos::effects
