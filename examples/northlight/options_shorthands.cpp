// SPDX-License-Identifier: MIT
#include "options_shorthands.h"

#include <cstdlib>
#include <limits>

#include "effects/glass/transparent/transparent.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/northlight/settings_file.h"
#include "options_measure.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

std::uint32_t baked_lights(const std::vector<std::string>& names) {
  std::uint32_t lights = 0;
  for (const std::string& name : names) {
    lights |= name == "sun"     ? kBakeSun
              : name == "sky"   ? kBakeSky
              : name == "local" ? kBakeLocal
                                : kBakeEmissive;
  }
  return lights;
}

std::string parse_radius(const std::string& text, std::optional<float>& out) {
  float radius = std::numeric_limits<float>::infinity();
  if (text != "inf") {
    char* end = nullptr;
    radius = std::strtof(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !(radius > 0)) {
      return "\"" + text + "\" is not a radius: give metres greater than 0, or inf";
    }
  }
  out = radius;
  return {};
}

// Effects that take samples, and "all".
std::vector<std::string> sampled_effects() {
  std::vector<std::string> out;
  for (const Effect& effect : northlight_effects()) {
    if (!effect.samples_option.empty()) out.push_back(effect.name);
  }
  out.push_back("all");
  return out;
}

}  // namespace

void add_shorthands(CLI::App& app, Options& options, Shorthands& words) {
  app.add_option("--ao-radius", words.radius,
                 "how far away something occludes, in metres, or inf, of ao and its alternatives "
                 "(4; on the screen 0.5)")
      ->check(CLI::Validator(
          [&words](std::string& text) { return parse_radius(text, words.ao_radius); }, ""));
  app.add_option("--sun-angle", words.sun_angle,
                 "angular size of the sun, in degrees (the real one: 0.53); default: the scene's")
      ->check(CLI::Range(0.0f, 90.0f));
  app.add_option("--denoise-passes", words.denoise_passes,
                 "passes of svgf's wavelet filter, each twice as wide as the one before "
                 "(5; 3 once a sequence has four frames of history)")
      ->check(CLI::Range(0u, 8u));
  app.add_option(
         "--half-resolution", words.half_resolution,
         "effects of the whole frame that trace a quarter of the pixels, comma-separated: " +
             join(sampled_effects()))
      ->delimiter(',')
      ->check(CLI::IsMember(sampled_effects()));
  app.add_flag("--rotate-pixels", words.rotate_pixels,
               "with --half-resolution, the pixel of each 2 x 2 that is traced takes turns from "
               "frame to frame: four frames of a sequence trace all of them");
  app.add_option("--texture-lod", words.texture_lod,
                 "level of detail of textures: by ray cones (cone), or always 0 (zero)")
      ->check(CLI::IsMember({"cone", "zero"}));
  app.add_option(
         "--sun-at-hits", words.sun_at_hits,
         "the sun where rays of reflections and indirect light hit: ray (a shadow ray), map "
         "(a shadow map of the whole scene), none")
      ->check(CLI::IsMember({"ray", "map", "none"}));
  app.add_option("--gi-bake-lights", words.bake_lights,
                 "lights that the volume holds, comma-separated: sun, sky, local, emissive (all)")
      ->delimiter(',')
      ->check(CLI::IsMember({"sun", "sky", "local", "emissive"}));
  app.add_option("--gi-volume", options.frame.volume.file,
                 "file of the volume: read if it exists, otherwise baked and written");
  app.add_option("--opacity-micromaps", words.opacity_micromaps,
                 "states of opacity micromaps, which say where leaves and fences have holes, so "
                 "that any-hit shaders need not look: 4 (the picture stays the same), 2 (edges "
                 "are those of the micromaps)")
      ->check(CLI::IsMember({2u, 4u}));
  app.add_flag("--curvature-roughness", words.curvature_roughness,
               "surfaces are rougher where their normals vary from pixel to pixel");
  app.add_option("--glass-layers", words.glass_layers,
                 "nearest layers of glass that reflect (1); those behind are blended without an "
                 "order")
      ->check(CLI::Range(0u, kMaxSortedLayers));
}

void apply_shorthands(const Shorthands& words, Options& options) {
  FrameSettings& frame = options.frame;
  for (const Effect& effect : northlight_effects()) {
    EffectSettings& settings = options.effects.at(effect.name);
    const bool occludes = effect.name == "ao" || effect.alternative_to == "ao";
    if (occludes && words.ao_radius) settings.radius = *words.ao_radius;
    for (const std::string& name : words.half_resolution) {
      if (effect.samples_option.empty() || (name != effect.name && name != "all")) continue;
      settings.pixel_step = 2;
      settings.rotates = words.rotate_pixels;
    }
  }
  if (words.sun_angle) frame.sun_angular_radius = *words.sun_angle * 3.14159265f / 360.0f;
  if (!words.texture_lod.empty()) frame.ray_cones = words.texture_lod == "cone";
  if (!words.bake_lights.empty()) frame.volume.lights = baked_lights(words.bake_lights);
  if (words.opacity_micromaps) frame.structures.opacity_micromaps = *words.opacity_micromaps;
  if (words.curvature_roughness) frame.curvature_to_roughness = true;
  if (words.glass_layers) {
    TransparentConstants glass =
        options.effects.at("transparent").get_constants<TransparentConstants>();
    glass.reflecting_layers = glass.sorted_layers = *words.glass_layers;
    options.effects.at("transparent").set_constants(glass);
  }
  if (words.sun_at_hits.empty()) return;
  const std::vector<DescribedSetting> settings = describe_settings();
  for (const char* name : {"gi-sun-at-hits", "reflections-sun-at-hits"}) {
    // The word has been checked.
    static_cast<void>(set_setting(settings, name, words.sun_at_hits, frame, options.effects));
  }
}

void apply_passes(const Shorthands& words, Options& options) {
  if (!words.denoise_passes) return;
  DenoiseDesc& denoise = options.frame.denoise;
  denoise.iterations = denoise.iterations_with_history = *words.denoise_passes;
}

}  // namespace northlight
