// SPDX-License-Identifier: MIT
#include "effects/northlight/techniques.h"

namespace kaamos::effects {

std::vector<Effect> ambient_occlusion_techniques() {
  return {};
}

}  // namespace kaamos::effects
