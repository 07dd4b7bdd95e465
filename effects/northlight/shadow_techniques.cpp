// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "effects/adaptive_shadow/adaptive_shadow.h"
#include "effects/northlight/techniques.h"
#include "effects/shadow_map/shadow_map.h"

namespace kaamos::effects {

namespace {

// A row whose signal is called `layer`.
Effect shadow_map_row(const char* name, const char* about, const char* layer,
                      const ShadowMapConstants& constants) {
  Effect row = {.name = name, .about = about};
  row.library = {"shadow_map/shadow_map", shadow_map_library};
  row.make = make_shadow_map;
  row.more_libraries = {{"shadow_map/shadow_draws", shadow_draws_library}};
  row.signals = {
      {.name = layer, .channels = 1, .is_sum = false, .part = &FrameParts::sun_visibility}};
  row.defaults.set_constants(constants);
  row.needs.sun = true;
  row.alternative_to = "sun";
  return row;
}

EffectStep step(const char* label, const ShadowMapConstants& constants) {
  return {label, EffectSettings().set_constants(constants)};
}

Effect sun_map_row() {
  Effect row = shadow_map_row("sun-map", "sun shadow by a depth map", "sun_map", {});
  row.steps = {step("1024 x 1024", {.size = 1024}), step("2048 x 2048", {.size = 2048}),
               step("4096 x 4096", {.size = 4096})};
  row.misses = "penumbras, what is thinner than a texel, and contact, where its bias opens a gap";
  return row;
}

std::vector<EffectStep> adaptive_steps() {
  std::vector<EffectStep> out;
  for (const std::uint32_t rays : {kAdaptiveStandardSamples, kAdaptiveHighSamples, 16u}) {
    out.push_back({fmt::format("{} rays at most", rays),
                   EffectSettings{.samples = rays}.set_constants(AdaptiveShadowConstants{})});
  }
  return out;
}

}  // namespace

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
          .steps = adaptive_steps(),
          .misses = "for up to four frames what moves, and thin shadows on calm ground",
      },
      sun_map_row(),
  };
}

}  // namespace kaamos::effects
