// SPDX-License-Identifier: MIT
// The registry: a row for each of Northlight's effects.
#include <algorithm>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/contact_shadow/contact_shadow.h"
#include "effects/indirect_diffuse/indirect_diffuse.h"
#include "effects/northlight/effect.h"
#include "effects/northlight/techniques.h"
#include "effects/reflections/reflections.h"
#include "effects/sun_shadow/sun_shadow.h"
#include "effects/transparent/transparent.h"

namespace kaamos::effects {

namespace {

template <class T>
EffectSettings with_constants(const T& constants) {
  return EffectSettings().set_constants(constants);
}

std::vector<Effect> ray_traced_effects() {
  return {
      {
          .name = "ao",
          .about = "ambient occlusion",
          .library = {"ambient_occlusion/ambient_occlusion", ambient_occlusion_library},
          .pass = ambient_occlusion_pass,
          .signals = {{.name = "ao",
                       .channels = 1,
                       .picture = kAmbientOcclusionSum,
                       .part = &FrameParts::ambient}},
          .defaults = {.samples = kDefaultAmbientOcclusionSamples,
                       .radius = kDefaultAmbientOcclusionRadius},
          .replaced_by = "gi",
          .samples_option = "ao-samples",
          .repeats = true,
      },
      {
          .name = "sun",
          .about = "sun shadow",
          .library = {"sun_shadow/sun_shadow", sun_shadow_library},
          .pass = sun_shadow_pass,
          .signals = {{.name = "sun",
                       .channels = 1,
                       .picture = kSunVisibilitySum,
                       .is_visibility = true,
                       .sharpness_picture = kSunSharpnessSum,
                       .part = &FrameParts::sun_visibility}},
          .defaults = {.samples = kDefaultSunSamples},
          .needs = {.sun = true},
          .samples_option = "sun-samples",
          .repeats = true,
      },
      {
          .name = "local",
          .about = "local lights",
          .signals = {{.name = "local_lights",
                       .is_sum = false,
                       .is_light = true,
                       .part = &FrameParts::local_lights}},
          .needs = {.local_lights = true, .lights = true},
      },
      {
          .name = "contact",
          .about = "contact shadows of local lights",
          .library = {"contact_shadow/contact_shadow", contact_shadow_library},
          .pass = contact_shadow_pass,
          .signals = {{.name = "contact",
                       .channels = 2,
                       .output = 1,
                       .is_visibility = true,
                       .sharpness_output = 2}},
          .defaults = with_constants(kContactAsNeeded),
          .needs = {.local_lights = true, .strongest_lights = true},
          .includes = "local",
          .samples_option = "contact-samples",
      },
      {
          .name = "gi",
          .about = "indirect diffuse light",
          .library = {"indirect_diffuse/indirect_diffuse", indirect_diffuse_library},
          .pass = indirect_diffuse_pass,
          .trace = indirect_diffuse_pass,
          .signals = {{.name = "indirect", .is_light = true, .part = &FrameParts::indirect}},
          .defaults = with_constants(IndirectConstants{}),
          .needs = {.lights = true, .volume = true},
          .samples_option = "gi-samples",
          .repeats = true,
      },
      {
          .name = "reflections",
          .about = "opaque reflections",
          .library = {"reflections/reflections", reflections_library},
          .pass = reflections_pass,
          .trace = reflections_trace_pass,
          .signals = {{.name = "reflection",
                       .of_lobe = true,
                       .is_light = true,
                       .part = &FrameParts::reflection}},
          .defaults = with_constants(ReflectionConstants{}),
          .needs = {.glossy = true, .lights = true, .volume = true},
          .samples_option = "reflection-samples",
      },
      {
          // One ray a pixel and no noise: there is nothing to denoise.
          .name = "transparent",
          .about = "glass",
          .library = {"transparent/transparent", transparent_library},
          .pass = transparent_pass,
          .compose = "TransparentCompose",
          .signals = {{.name = "glass", .is_sum = false, .is_light = true},
                      {.name = "glass_transmittance", .output = 1, .is_sum = false}},
          .defaults = with_constants(TransparentConstants{}),
          .needs = {.glass = true, .lights = true, .volume = true},
      },
  };
}

std::vector<Effect> make_effects() {
  std::vector<Effect> out = ray_traced_effects();
  for (const auto rows : {shadow_techniques, filtered_shadow_techniques, screen_shadow_techniques,
                          ambient_occlusion_techniques, indirect_techniques, reflection_techniques,
                          glass_techniques}) {
    for (Effect& row : rows()) out.push_back(std::move(row));
  }
  return out;
}

}  // namespace

const std::vector<Effect>& northlight_effects() {
  static const std::vector<Effect> effects = make_effects();
  return effects;
}

const Effect* find_effect(const std::vector<Effect>& effects, const std::string& name) {
  const auto found = std::find_if(effects.begin(), effects.end(),
                                  [&](const Effect& effect) { return effect.name == name; });
  return found == effects.end() ? nullptr : &*found;
}

bool has_own_pictures(const Effect& effect) {
  return std::any_of(effect.signals.begin(), effect.signals.end(),
                     [](const EffectSignal& signal) { return !signal.picture; });
}

std::string effect_names(const std::vector<Effect>& effects) {
  std::string out;
  for (const Effect& effect : effects) out += (out.empty() ? "" : ", ") + effect.name;
  return out;
}

}  // namespace kaamos::effects
