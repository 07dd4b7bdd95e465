// SPDX-License-Identifier: MIT
#include "effects/light/rows.h"

namespace kaamos::effects {

Effect local_lights_row() {
  return {
      .name = "local",
      .about = "local lights",
      .signals = {{.name = "local_lights",
                   .is_sum = false,
                   .is_light = true,
                   .part = &FrameParts::local_lights}},
      .needs = {.local_lights = true, .lights = true},
      .replaced_by = "lamp-visibility",
  };
}

}  // namespace kaamos::effects
