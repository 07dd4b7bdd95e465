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

namespace {

// A row by draws, whose signal is called `layer`.
Effect draws_row(const char* name, const char* about, const char* layer,
                 const char* transmittance) {
  Effect row = {.name = name, .about = about};
  row.library = {"glass/transparent/transparent", transparent_library};
  row.make = make_drawn_glass;
  row.more_libraries = {{"glass/drawn_glass/drawn_glass", drawn_glass_library},
                        {"reflections/environment_map/environment_bake", environment_bake_library}};
  row.compose = "TransparentCompose";
  row.signals = {{.name = layer, .is_sum = false, .is_light = true},
                 {.name = transmittance, .output = 1, .is_sum = false}};
  row.needs = {.glass = true, .lights = true, .volume = true};
  row.alternative_to = "transparent";
  return row;
}

Effect drawn_glass_row() {
  Effect row =
      draws_row("drawn-glass", "glass by draws, the nearest layer with a traced mirror image",
                "drawn_glass", "drawn_glass_transmittance");
  set_constants(row, DrawnGlassConstants{}, drawn_glass_settings());
  row.misses = "reflections behind the first layer; the order of panes that cross";
  return row;
}

Effect blended_glass_row() {
  Effect row = draws_row("blended-glass", "glass by draws, sorted by object", "blended_glass",
                         "blended_glass_transmittance");
  set_constants(row, DrawnGlassConstants{.tolerance = -1.0f}, drawn_glass_settings());
  row.misses = "reflections of what moves and of glass; the order of panes that cross";
  return row;
}

}  // namespace

std::vector<Effect> glass_alternatives() {
  return {drawn_glass_row(), blended_glass_row()};
}

}  // namespace kaamos::effects
