// SPDX-License-Identifier: MIT
// Short shadows from the depth picture, as effects of a frame.
#include <string>
#include <vector>

#include "effects/shadows/rows.h"
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"
#include "effects/shadows/settings.h"

namespace kaamos::effects {

namespace {

// A row whose signal is called `layer`.
Effect screen_shadow_row(const char* name, const char* about, const char* layer,
                         const ScreenSpaceShadowConstants& constants) {
  Effect row = {.name = name, .about = about};
  row.library = {"shadows/screen_space_shadow/screen_space_shadow", screen_space_shadow_library};
  row.make = make_screen_space_shadow;
  row.signals = {{.name = layer, .channels = 2, .output = 1, .is_sum = false}};
  set_constants(row, constants, screen_space_shadow_settings());
  row.needs = {.local_lights = true, .strongest_lights = true};
  row.alternative_to = "contact";
  row.includes = "local";
  for (const std::uint32_t steps : {8u, 16u, 32u, 64u}) {
    ScreenSpaceShadowConstants own = constants;
    own.steps = steps;
    row.steps.push_back({std::to_string(steps) + " steps", EffectSettings().set_constants(own)});
  }
  row.misses =
      "what the picture does not show, and thin things between two steps; everything casts "
      "shadows as if it were equally thick";
  return row;
}

Effect screen_sun_row() {
  ScreenSpaceShadowConstants constants = multisampled_shadow();
  constants.toward_sun = 1;
  Effect row = screen_shadow_row("screen-sun", "screen-space sun shadows", "screen_sun", constants);
  row.signals.front().channels = 1;
  row.signals.front().part = &FrameParts::sun_visibility;
  row.needs = {.sun = true};
  row.alternative_to = "sun";
  row.includes = {};
  row.misses =
      "all that stands farther away than the march is long, and what contact shadows from "
      "the depth picture miss";
  return row;
}

}  // namespace

std::vector<Effect> screen_shadow_rows() {
  return {
      screen_shadow_row("screen-contact", "screen-space contact shadows", "screen_contact", {}),
      screen_shadow_row("screen-contact-multisampled",
                        "screen-space contact shadows, several pixels a step",
                        "screen_contact_multisampled", multisampled_shadow()),
      screen_shadow_row("screen-contact-multipass", "screen-space contact shadows, several marches",
                        "screen_contact_multipass", multipass_shadow()),
      screen_sun_row()};
}

}  // namespace kaamos::effects
