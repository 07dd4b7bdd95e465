// SPDX-License-Identifier: MIT
#include "effects/northlight/described_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "effects/assets/scene/light_constants.h"
#include "effects/composition/settings.h"
#include "effects/denoise/settings.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kMostSamples = 65536;

// Functions that name every member of a struct: one with a new member does not compile before
// somebody has described it below, or left it out here.
SettingTable<StructureOptions> structures_settings() {
  const StructureOptions options;
  const auto& [deformable_period, hero_period, compact, coarser_rays, opacity_micromaps] = options;
  static_cast<void>(
      std::tie(deformable_period, hero_period, compact, coarser_rays, opacity_micromaps));
  using C = StructureOptions;
  return {
      count_setting("deformable-period", &C::deformable_period, {0, 65536}, "frames",
                    "after which structures that deform are built anew; 0: only updated"),
      count_setting("hero-period", &C::hero_period, {0, 65536}, "frames", "the same for heroes"),
      switch_setting("compact", &C::compact, "structures that stand still are compacted"),
      count_setting("coarser-rays", &C::coarser_rays, {0, 16}, "levels",
                    "of detail by which rays see coarser instances than draws do; a fault, shown "
                    "with --primary raster"),
      choice_setting("opacity-micromaps", &C::opacity_micromaps, {"0", "2", "4"},
                     "states of the micromaps that say where leaves and fences have holes; 4: the "
                     "picture stays the same; 0: there are none, any-hit shaders look")};
}

// A member that may be absent.
template <class T>
SettingOf<VolumeSettings> optional_setting(SettingText text,
                                           std::optional<T> VolumeSettings::*member) {
  using Held = std::conditional_t<std::is_integral_v<T>, std::int64_t, double>;
  return {text,
          [member, absent = text.absent](const VolumeSettings& of) -> SettingValue {
            const std::optional<T>& value = of.*member;
            if (!value) return absent;
            if constexpr (std::is_integral_v<T>) return static_cast<std::int64_t>(*value);
            return as_decimal(static_cast<float>(*value));
          },
          [member](VolumeSettings& of, const SettingValue& value) {
            const Held* held = std::get_if<Held>(&value);
            of.*member = held != nullptr ? std::optional<T>(static_cast<T>(*held)) : std::nullopt;
          }};
}

SettingTable<VolumeSettings> volume_settings() {
  const VolumeSettings volume;
  const auto& [whole, cell, samples, error, bounces, lights, seed, file, given] = volume;
  static_cast<void>(std::tie(whole, cell, samples, error, bounces, lights, seed));
  static_cast<void>(std::tie(file, given));  // where it comes from, not what it is
  using C = VolumeSettings;
  return {switch_setting("whole", &C::whole,
                         "every cell is baked before the first picture; else those that rays read"),
          optional_setting({.name = "cell",
                            .type = SettingType::kNumber,
                            .range = {1e-3, 1e3},
                            .unit = "m",
                            .about = "its finest cells; auto: 0.25, larger in large scenes",
                            .absent = "auto"},
                           &C::cell),
          count_setting("samples", &C::samples, {1, kMostSamples}, "",
                        "paths of a cell at most; 64 where those are baked that rays read"),
          number_setting("error", &C::error, {0, 1}, "",
                         "relative standard error that is enough for a cell; 0: all paths"),
          count_setting("bounces", &C::bounces, {0, 65536}, "", "after the first hit, at most"),
          bits_setting("sun", &C::lights, kBakeSun, "it holds the sun's light"),
          bits_setting("sky", &C::lights, kBakeSky, "the sky's"),
          bits_setting("local", &C::lights, kBakeLocal, "that of local lights"),
          bits_setting("emissive", &C::lights, kBakeEmissive, "that of materials that shine"),
          optional_setting({.name = "seed",
                            .type = SettingType::kCount,
                            .range = {0, 4294967295.0},
                            .about = "of its paths; auto: the frame's",
                            .absent = "auto"},
                           &C::seed)};
}

SettingOf<FrameSettings> sun_angle_setting() {
  return {{.name = "sun-angular-radius",
           .type = SettingType::kNumber,
           .range = {0, 0.7854},
           .unit = "rad",
           .about = "of the sun; auto: the scene's",
           .absent = "auto"},
          [](const FrameSettings& of) -> SettingValue {
            if (of.sun_angular_radius < 0) return std::string("auto");
            return as_decimal(of.sun_angular_radius);
          },
          [](FrameSettings& of, const SettingValue& value) {
            const auto* radius = std::get_if<double>(&value);
            of.sun_angular_radius = radius == nullptr ? -1.0f : static_cast<float>(*radius);
          }};
}

struct FrameTopic {
  SettingTopic topic;
  SettingTable<FrameSettings> settings;
};

std::vector<FrameTopic> frame_topics() {
  const FrameSettings frame;
  // Not described: what no technique has a part in.
  const auto& [width, height, seed, effects, whole_frame, denoise, volume, light_culling,
               light_maps, contact, taa, taa_constants, enlarge, enlarge_constants, moving,
               structures, order, primary, ray_cones, curvature_to_roughness, sun_angular_radius,
               sun_map, max_pass_views, rows] = frame;
  static_cast<void>(
      std::tie(width, height, seed, effects, whole_frame, taa, enlarge, moving, max_pass_views));
  static_cast<void>(std::tie(denoise, volume, taa_constants, enlarge_constants, structures));
  static_cast<void>(std::tie(light_culling, light_maps, contact, order, primary, ray_cones,
                             curvature_to_roughness, sun_angular_radius, sun_map, rows));
  using F = FrameSettings;
  return {
      {{"surfaces", "what pixels show, and the order of rays"},
       {word_setting("primary", &F::primary, {"rays", "raster"},
                     "what finds the surfaces that pixels show"),
        switch_setting("ray-cones", &F::ray_cones,
                       "level of detail of textures by ray cones; off: always 0"),
        switch_setting("curvature-to-roughness", &F::curvature_to_roughness,
                       "surfaces are rougher where their normals vary from pixel to pixel"),
        word_setting("order", &F::order, {"pixels", "direction", "origin", "termination"},
                     "of rays: by pixel, direction, origin, or origin and where they are thought "
                     "to end; the picture stays the same"),
        count_setting("rows", &F::rows, {0, 16384}, "pixels",
                      "of a dispatch; 0: as many as take a quarter of a second")}},
      {{"lights", "local lights and the sun"},
       {word_setting("culling", &F::light_culling, {"clusters", "frustum"},
                     "local lights that a pixel looks at: its cluster's, or all that reach into "
                     "the picture; the picture stays the same"),
        word_setting("maps", &F::light_maps, {"traced", "drawn"},
                     "shadow maps of local lights, and the sun's: a ray for each texel, or draws"),
        word_setting("contact-combination", &F::contact, {"product", "min"},
                     "a light's shadow map and contact shadow: their product, or the darker",
                     "Control"),
        sun_angle_setting(),
        count_setting("sun-map", &F::sun_map, {0, double{kMaxSunMap}}, "texels",
                      "along the side of the sun's map at rays' hits; 0: 2048 where one is read")}},
      {{"denoise", "the denoiser of the whole frame"},
       settings_within(&F::denoise, denoise_settings())},
      {{"visibility", "the denoiser of signals that say how sharp their shadows are"},
       settings_within(&F::denoise,
                       settings_within(&DenoiseDesc::visibility, visibility_settings()))},
      {{"volume", "the volume of indirect light"}, settings_within(&F::volume, volume_settings())},
      {{"taa", "antialiasing over frames"}, settings_within(&F::taa_constants, taa_settings())},
      {{"enlarge", "the kernels of a frame that is enlarged"},
       settings_within(&F::enlarge_constants, enlarge_settings())},
      {{"structures", "acceleration structures, and those of what moves"},
       settings_within(&F::structures, structures_settings())},
  };
}

// Those that effects have beside their constants.
SettingTable<EffectSettings> common_settings(const Effect& effect) {
  using E = EffectSettings;
  SettingTable<E> out;
  if (!effect.samples_option.empty()) {
    out.push_back(count_setting("samples", &E::samples, {1, kMostSamples}, "rays", "of a pixel"));
    SettingOf<E> half = switch_setting("half-resolution", &E::pixel_step,
                                       "a quarter of a whole frame's pixels is traced");
    half.get = [](const E& of) { return SettingValue(of.pixel_step == 2); };
    half.set = [](E& of, const SettingValue& value) {
      of.pixel_step = std::get<bool>(value) ? 2 : 1;
    };
    out.push_back(std::move(half));
    out.push_back(switch_setting("rotate-pixels", &E::rotates,
                                 "with it, the traced pixel of 2 x 2 takes turns over frames"));
  }
  if (effect.defaults.radius > 0) {
    // Rays may be as long as they like; in the picture a radius has an end.
    const double most = effect.make ? 1e6 : std::numeric_limits<double>::infinity();
    out.push_back(
        number_setting("radius", &E::radius, {1e-6, most}, "m", "how far away something occludes"));
  }
  return out;
}

SettingTable<EffectSettings> settings_of(const Effect& effect) {
  SettingTable<EffectSettings> out;
  for (SettingOf<EffectSettings>& setting :
       join_settings(common_settings(effect), effect.constants)) {
    if (setting.is_open()) out.push_back(setting);
  }
  return out;
}

DescribedSetting of_effect(const Effect& effect, const SettingOf<EffectSettings>& setting) {
  return {effect.name, setting.text,
          [name = effect.name, defaults = effect.defaults, get = setting.get](
              const FrameSettings&, const SettingsOfEffects& effects) {
            const auto found = effects.find(name);
            return get(found == effects.end() ? defaults : found->second);
          },
          [name = effect.name, defaults = effect.defaults, set = setting.set](
              FrameSettings&, SettingsOfEffects& effects, const SettingValue& value) {
            set(effects.try_emplace(name, defaults).first->second, value);
          }};
}

DescribedSetting of_frame(const std::string& topic, const SettingOf<FrameSettings>& setting) {
  return {topic, setting.text,
          [get = setting.get](const FrameSettings& frame, const SettingsOfEffects&) {
            return get(frame);
          },
          [set = setting.set](FrameSettings& frame, SettingsOfEffects&, const SettingValue& value) {
            set(frame, value);
          }};
}

// A table's cell: "|" would end it.
std::string cell(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  return text;
}

}  // namespace

std::vector<SettingTopic> setting_topics(const std::vector<Effect>& effects) {
  std::vector<SettingTopic> out;
  for (const FrameTopic& each : frame_topics()) out.push_back(each.topic);
  for (const Effect& effect : effects) {
    if (!settings_of(effect).empty()) out.push_back({effect.name, effect.about});
  }
  return out;
}

std::vector<DescribedSetting> describe_settings(const std::vector<Effect>& effects) {
  std::vector<DescribedSetting> out;
  for (const FrameTopic& each : frame_topics()) {
    for (const SettingOf<FrameSettings>& setting : each.settings) {
      if (setting.is_open()) out.push_back(of_frame(each.topic.name, setting));
    }
  }
  for (const Effect& effect : effects) {
    for (const SettingOf<EffectSettings>& setting : settings_of(effect)) {
      out.push_back(of_effect(effect, setting));
    }
  }
  return out;
}

std::string settings_page(const std::vector<Effect>& effects) {
  std::string out =
      "# Settings of northlight\n\n"
      "Every number, switch and word of every technique: `--TOPIC-NAME VALUE` on the command "
      "line, or `\"TOPIC\": {\"NAME\": VALUE}` in a file for `--settings`; `--print-settings` "
      "prints such a file, `--help=TOPIC` a topic of this page. The page is made from the "
      "descriptions beside each technique, and a test compares the two. Without a source the "
      "default is this project's.\n";
  const std::vector<DescribedSetting> all = describe_settings(effects);
  for (const SettingTopic& topic : setting_topics(effects)) {
    out += fmt::format("\n## {}\n\n{}\n\n", topic.name, topic.about);
    out += "| setting | values | default | what | source |\n|---|---|---|---|---|\n";
    for (const DescribedSetting& setting : all) {
      if (setting.topic != topic.name) continue;
      const SettingText& text = setting.text;
      out +=
          fmt::format("| `--{}` | {} | {} | {} | {} |\n", setting.full_name(), allowed_text(text),
                      value_text(setting.default_value()), cell(text.about), text.source);
    }
  }
  return out;
}

}  // namespace kaamos::effects
