// SPDX-License-Identifier: MIT
#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

rtapi::Status EffectPass::begin_frame(const Camera& /*camera*/) {
  return {};
}

}  // namespace kaamos::effects
