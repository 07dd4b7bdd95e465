// SPDX-License-Identifier: MIT
#include "effects/adaptive_shadow/adaptive_shadow.h"
#include "effects/northlight/techniques.h"

namespace kaamos::effects {

std::vector<Effect> shadow_techniques() {
  return {
      {
          .name = "adaptive-sun",
          .about = "sun shadow with rays where it varies",
          .library = {"adaptive_shadow/adaptive_shadow", adaptive_shadow_library},
          .make = AdaptiveShadowPass::create,
          .signals = {{.name = "adaptive_sun",
                       .channels = 1,
                       .is_sum = false,
                       .part = &FrameParts::sun_visibility},
                      {.name = "adaptive_sun_rays", .output = 1, .is_sum = false}},
          .defaults = EffectSettings{.samples = kAdaptiveStandardSamples}.set_constants(
              AdaptiveShadowConstants{}),
          .needs = {.sun = true},
          .alternative_to = "sun",
          .samples_option = "adaptive-sun-samples",
          .misses = "for up to four frames what moves, and thin shadows on calm ground",
      },
  };
}

}  // namespace kaamos::effects
