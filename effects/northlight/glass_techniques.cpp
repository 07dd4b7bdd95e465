// SPDX-License-Identifier: MIT
#include "effects/drawn_glass/drawn_glass.h"
#include "effects/environment_map/environment_map.h"
#include "effects/northlight/techniques.h"

namespace kaamos::effects {

std::vector<Effect> glass_techniques() {
  return {
      {
          .name = "drawn-glass",
          .about = "glass by draws, the nearest layer with a traced mirror image",
          .library = {"transparent/transparent", transparent_library},
          .make = make_drawn_glass,
          .more_libraries = {{"drawn_glass/drawn_glass", drawn_glass_library},
                             {"environment_map/environment_bake", environment_bake_library}},
          .compose = "TransparentCompose",
          .signals = {{.name = "drawn_glass", .is_sum = false, .is_light = true},
                      {.name = "drawn_glass_transmittance", .output = 1, .is_sum = false}},
          .defaults = EffectSettings{}.set_constants(DrawnGlassConstants{}),
          .needs = {.glass = true, .lights = true, .volume = true},
          .alternative_to = "transparent",
          .misses = "reflections behind the first layer; the order of panes that cross",
      },
  };
}

}  // namespace kaamos::effects
