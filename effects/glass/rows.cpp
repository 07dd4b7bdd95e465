// SPDX-License-Identifier: MIT
#include "effects/glass/rows.h"

#include "effects/glass/drawn_glass/drawn_glass.h"
#include "effects/glass/settings.h"
#include "effects/glass/transparent/transparent.h"
#include "effects/reflections/environment_map/environment_map.h"

namespace kaamos::effects {

Effect transparent_row() {
  return {
      // One ray a pixel and no noise: there is nothing to denoise.
      .name = "transparent",
      .about = "glass",
      .library = {"glass/transparent/transparent", transparent_library},
      .pass = transparent_pass,
      .compose = "TransparentCompose",
      .signals = {{.name = "glass", .is_sum = false, .is_light = true},
                  {.name = "glass_transmittance", .output = 1, .is_sum = false}},
      .defaults = EffectSettings().set_constants(TransparentConstants{}),
      .needs = {.glass = true, .lights = true, .volume = true},
      .constants = describe_constants(transparent_settings()),
  };
}

std::vector<Effect> glass_alternatives() {
  return {
      {
          .name = "drawn-glass",
          .about = "glass by draws, the nearest layer with a traced mirror image",
          .library = {"glass/transparent/transparent", transparent_library},
          .make = make_drawn_glass,
          .more_libraries = {{"glass/drawn_glass/drawn_glass", drawn_glass_library},
                             {"reflections/environment_map/environment_bake",
                              environment_bake_library}},
          .compose = "TransparentCompose",
          .signals = {{.name = "drawn_glass", .is_sum = false, .is_light = true},
                      {.name = "drawn_glass_transmittance", .output = 1, .is_sum = false}},
          .defaults = EffectSettings{}.set_constants(DrawnGlassConstants{}),
          .needs = {.glass = true, .lights = true, .volume = true},
          .alternative_to = "transparent",
          .constants = describe_constants(drawn_glass_settings()),
          .misses = "reflections behind the first layer; the order of panes that cross",
      },
  };
}

}  // namespace kaamos::effects
