// SPDX-License-Identifier: MIT
#include "effects/reflections/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "effects/reflections/blurred/blurred_reflections.h"
#include "effects/reflections/environment_map/environment_map.h"
#include "effects/reflections/hybrid/hybrid_reflections.h"
#include "effects/reflections/planar/planar_reflections.h"
#include "effects/reflections/screen_space/screen_mask.h"
#include "effects/reflections/screen_space/screen_reflections.h"
#include "effects/reflections/settings.h"
#include "effects/reflections/stochastic/stochastic_reflections.h"
#include "effects/reflections/tiled/tiled_reflections.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::effects {

namespace {

// Makes what all rows share: the signal, its place in the composition, and what it replaces.
Effect row(std::string name, std::string about, const std::string& signal, bool is_sum) {
  Effect effect;
  effect.name = std::move(name);
  effect.about = std::move(about);
  effect.signals = {{.name = signal,
                     .is_sum = is_sum,
                     .of_lobe = is_sum,
                     .is_light = true,
                     .part = &FrameParts::reflection}};
  effect.more_libraries = {
      {"reflections/environment_map/environment_bake", environment_bake_library}};
  // By its environment map alone, unless it shades what rays hit.
  effect.needs = {.lights = true, .volume = true, .lights_once = true};
  effect.alternative_to = "reflections";
  if (is_sum) effect.samples_option = effect.name + "-samples";
  return effect;
}

template <class Constants>
EffectStep step(std::string label, std::uint32_t rays, const Constants& constants) {
  EffectSettings settings;
  settings.samples = rays;
  return {std::move(label) + (rays == 1 ? ", 1 ray" : fmt::format(", {} rays", rays)),
          settings.set_constants(constants)};
}

// The same marches with more and more rays, the first ones coarser.
template <class Constants>
std::vector<EffectStep> steps_of_rays(const std::string& coarse_label, const Constants& coarse,
                                      const std::string& label, const Constants& constants) {
  std::vector<EffectStep> out = {step(coarse_label, 1, coarse)};
  for (const std::uint32_t rays : {1u, 4u, 16u}) out.push_back(step(label, rays, constants));
  return out;
}

// Every fourth pixel, then every pixel.
template <class Constants>
std::vector<EffectStep> steps_of_pixels(const Constants& constants) {
  Constants coarse = constants;
  coarse.screen.stride = 4;
  return steps_of_rays("every fourth pixel", coarse, "every pixel", constants);
}

// One that finds hits in the picture, and says where.
Effect screen_row(std::string name, std::string about, const std::string& signal) {
  Effect effect = row(std::move(name), std::move(about), signal, true);
  effect.needs.perspective = true;
  effect.signals.push_back({.name = signal + "_hits", .channels = 4, .output = 1, .is_sum = false});
  effect.needs.radiance = true;
  effect.misses = "what is outside of the picture, behind something or seen from behind";
  return effect;
}

// Three marches that differ by their constants alone.
Effect march_row(std::string name, std::string about, const std::string& signal,
                 const ScreenReflectionConstants& constants) {
  Effect effect = screen_row(std::move(name), std::move(about), signal);
  effect.library = {"reflections/screen_space/screen_reflections", screen_reflections_library};
  effect.make = make_screen_reflections;
  set_constants(effect, constants, screen_reflection_settings());
  ScreenReflectionConstants coarse = constants;
  if (constants.march == ScreenMarch::kPixels) {
    coarse.stride = 4;
    effect.steps = steps_of_rays("every fourth pixel", coarse, "every pixel", constants);
  } else {
    coarse.steps = std::max(constants.steps / 4, 1u);
    effect.steps = steps_of_rays(fmt::format("{} samples", coarse.steps), coarse,
                                 fmt::format("{} samples", constants.steps), constants);
  }
  return effect;
}

Effect masked_row() {
  Effect effect =
      screen_row("ssr-masked", "screen-space reflections, for pixels alone that may find something",
                 "ssr_masked");
  effect.library = {"reflections/screen_space/screen_mask", screen_mask_library};
  effect.make = make_masked_reflections;
  set_constants(effect, ScreenMaskConstants{}, screen_mask_settings());
  effect.steps = steps_of_pixels(ScreenMaskConstants{});
  effect.may_equal = "its mask leaves out only pixels whose rays find nothing, so that it is ssr";
  return effect;
}

Effect half_masked_row() {
  Effect effect = masked_row();
  effect.name = "ssr-half-masked";
  effect.about = "screen-space reflections, for pixels about one of four that finds something";
  effect.signals[0].name = "ssr_half_masked";
  effect.signals[1].name = "ssr_half_masked_hits";
  effect.samples_option = "ssr-half-masked-samples";
  ScreenMaskConstants constants;
  constants.half_mask = 1;
  set_constants(effect, constants, screen_mask_settings());
  effect.steps.clear();
  for (const std::uint32_t dilation : {0u, 2u, 8u}) {
    constants.dilation = dilation;
    effect.steps.push_back(
        step(fmt::format("marks as wide as {}", 2 * dilation + 1), 1, constants));
  }
  effect.may_equal = "its marks leave out only pixels whose rays find nothing, so that it is ssr";
  effect.misses = "what ssr misses, and some of what its marks miss";
  return effect;
}

Effect stochastic_row() {
  Effect effect = row("ssr-stochastic", "screen-space reflections, rays shared by neighbours",
                      "ssr_stochastic", true);
  effect.needs.perspective = true;
  effect.library = {"reflections/stochastic/stochastic_reflections",
                    stochastic_reflections_library};
  effect.make = make_stochastic_reflections;
  effect.misses = "what ssr misses; light leaks about corners, where neighbours see something else";
  set_constants(effect, StochasticConstants{}, stochastic_settings());
  const StochasticConstants alone{.neighbours = 1};
  effect.steps =
      steps_of_rays("rays of 1 neighbour", alone, "rays of 9 neighbours", StochasticConstants{});
  effect.needs.radiance = true;
  return effect;
}

Effect blurred_row() {
  Effect effect =
      row("ssr-blurred", "screen-space mirrors, blurred by roughness", "ssr_blurred", false);
  effect.needs.perspective = true;
  effect.library = {"reflections/blurred/blurred_reflections", blurred_reflections_library};
  effect.make = make_blurred_reflections;
  effect.has_history = true;
  effect.misses = "what ssr misses; what touches a rough surface is as blurred as what is far away";
  set_constants(effect, BlurredConstants{}, blurred_settings());
  for (const float fresh : {1.0f, 0.5f, 0.125f}) {
    effect.steps.push_back(
        {fresh == 1 ? "no frames before" : fmt::format("new rays weigh {}", fresh),
         EffectSettings().set_constants(BlurredConstants{.fresh = fresh})});
  }
  effect.needs.radiance = true;
  return effect;
}

Effect hybrid_row() {
  Effect effect =
      screen_row("hybrid-reflections",
                 "reflections from the picture where it leaves no doubt, else by rays", "hybrid");
  effect.library = {"reflections/hybrid/hybrid_reflections", hybrid_reflections_library};
  effect.more_libraries.clear();
  effect.make = make_hybrid_reflections;
  effect.needs.lights_once = false;
  set_constants(effect, default_hybrid_constants(), hybrid_settings());
  effect.steps = steps_of_pixels(default_hybrid_constants());
  effect.samples_option = "hybrid-samples";
  effect.misses = "highlights of what is reflected are those that the camera sees";
  return effect;
}

Effect tiled_row() {
  Effect effect =
      screen_row("tiled-reflections",
                 "reflections of tiles: by an environment map, the picture or rays", "tiled");
  effect.library = {"reflections/tiled/tiled_reflections", tiled_reflections_library};
  effect.make = make_tiled_reflections;
  effect.needs.lights_once = false;
  effect.signals.push_back({.name = "tiled_classes", .channels = 2, .output = 2, .is_sum = false});
  set_constants(effect, default_tiled_constants(), tiled_settings());
  for (const float roughest : {0.2f, 0.4f, 0.6f, 1.0f}) {
    TiledConstants constants = default_tiled_constants();
    constants.roughest_traced = roughest;
    effect.steps.push_back({fmt::format("rays up to roughness {}", roughest),
                            EffectSettings().set_constants(constants)});
  }
  effect.samples_option = "tiled-samples";
  effect.may_equal = "no surface's roughness lies between the two limits";
  effect.misses = "what hybrid-reflections misses; what moves beside rough surfaces";
  return effect;
}

Effect environment_row() {
  Effect effect = row("env-map", "reflections from an environment map", "env_map", false);
  effect.library = {"reflections/environment_map/environment_reflections",
                    environment_reflections_library};
  effect.make = make_environment_reflections;
  set_constants(effect, EnvironmentConstants{}, environment_settings());
  effect.misses = "what moves; everything is seen as from the map's place";
  return effect;
}

Effect planar_row() {
  Effect effect =
      row("planar", "reflections of flat surfaces, from the mirrored scene", "planar", false);
  effect.library = {"reflections/planar/planar_reflections", planar_reflections_library};
  effect.make = make_planar_reflections;
  effect.needs.lights_once = false;
  effect.may_equal =
      "without a flat surface in view that mirrors it is env-map; draws show what rays show";
  effect.misses = "what is not flat shows an environment map";
  set_constants(effect, PlanarConstants{}, planar_settings());
  const auto add = [&](const char* label, const PlanarConstants& constants) {
    effect.steps.push_back({label, EffectSettings().set_constants(constants)});
  };
  add("hits without the sun", {.sun_at_hits = SunAtHits::kNone});
  add("hits with the sun", {});
  add("by draws", {.source = PlanarSource::kDraws});
  return effect;
}

}  // namespace

Effect reflections_row() {
  return {
      .name = "reflections",
      .about = "opaque reflections",
      .library = {"reflections/traced/reflections", reflections_library},
      .pass = reflections_pass,
      .trace = reflections_trace_pass,
      .signals = {{.name = "reflection",
                   .of_lobe = true,
                   .is_light = true,
                   .part = &FrameParts::reflection}},
      .defaults = EffectSettings().set_constants(ReflectionConstants{}),
      .needs = {.glossy = true, .lights = true, .volume = true},
      .constants = describe_constants(reflection_settings()),
      .samples_option = "reflection-samples",
      .repeats = true,
      .may_equal = "all that mirrors is smooth, so that one ray is all there is",
  };
}

std::vector<Effect> reflection_alternatives() {
  return {
      march_row("ssr", "screen-space reflections, every pixel of a ray", "ssr", march_of_pixels()),
      march_row("ssr-metres", "screen-space reflections, points along a ray", "ssr_metres",
                march_of_metres()),
      march_row("ssr-line", "screen-space reflections, a few samples up to the picture's edge",
                "ssr_line", march_of_line()),
      masked_row(),
      half_masked_row(),
      stochastic_row(),
      blurred_row(),
      hybrid_row(),
      tiled_row(),
      environment_row(),
      planar_row(),
  };
}

}  // namespace kaamos::effects
