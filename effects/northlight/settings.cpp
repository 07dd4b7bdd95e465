// SPDX-License-Identifier: MIT
// Decides which effects a frame has, by what was chosen and by what its scene offers.
#include "effects/northlight/settings.h"

#include <algorithm>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/light_constants.h"

namespace kaamos::effects {

namespace {

bool is_glossy(const Material& material) {
  const MaterialConstants& constants = material.constants;
  if (constants.flags & kMaterialUnlit) return false;
  return constants.metallic > 0.0f || constants.roughness < kMatteRoughness ||
         constants.image[kMetallicRoughnessTexture] != kNoTexture;
}

// Looks only at what is shown; glass reflects by itself.
bool has_glossy(const Scene& scene) {
  const auto shows_glossy = [&](std::uint32_t mesh) {
    const auto& geometries = scene.meshes[mesh].geometries;
    return std::any_of(geometries.begin(), geometries.end(), [&](const Geometry& geometry) {
      return is_glossy(scene.materials[geometry.material]);
    });
  };
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
    return shows_glossy(instance.mesh) ||
           std::any_of(instance.levels.begin(), instance.levels.end(),
                       [&](const Level& level) { return shows_glossy(level.mesh); });
  });
}

bool is_of_use(const Scene& scene, const FrameSettings& settings,
               const std::vector<Effect>& effects, const Effect& effect,
               const EffectSettings& chosen) {
  if (chosen.keep) return true;
  if (!chosen.named && what_replaces(settings, effects, effect) != nullptr) return false;
  EffectNeeds needs = effect.needs;
  if (chosen.named) needs.glossy = false;
  return scene_offers(scene, needs) && (!needs.motion || settings.moving);
}

}  // namespace

void add_included(std::map<std::string, EffectSettings>& chosen,
                  const std::vector<Effect>& effects) {
  for (const Effect& effect : effects) {
    if (effect.includes.empty() || chosen.count(effect.name) == 0) continue;
    const Effect* included = find_effect(effects, effect.includes);
    if (included == nullptr) continue;
    EffectSettings& own = chosen.try_emplace(included->name, included->defaults).first->second;
    own.named = own.named || chosen.at(effect.name).named;
  }
}

std::map<std::string, EffectSettings> choose_effects(const std::vector<std::string>& names,
                                                     const std::vector<Effect>& effects) {
  std::map<std::string, EffectSettings> out;
  for (const std::string& name : names) {
    const Effect* effect = find_effect(effects, name);
    if (effect != nullptr) {
      out[name] = effect->defaults;
      out[name].named = true;
    } else if (name == "all") {
      for (const Effect& each : effects) {
        if (each.on_request || !each.alternative_to.empty()) continue;
        out.try_emplace(each.name, each.defaults);
      }
    } else {
      out[name] = {};
    }
  }
  add_included(out, effects);
  return out;
}

// Every other pixel lies across, so that after two frames each pixel has one with rays beside it.
std::uint32_t rotating_offset(std::uint32_t index) {
  constexpr std::uint32_t kTurns[] = {0, 3, 1, 2};
  return kTurns[index % 4];
}

std::uint32_t pixel_offset(const EffectSettings& settings, std::uint32_t index) {
  return settings.pixel_step == 2 && settings.rotates ? rotating_offset(index) : 0;
}

std::uint32_t first_sample(const EffectSettings& settings, std::uint32_t index) {
  const bool takes_turns = settings.pixel_step == 2 && settings.rotates;
  return (takes_turns ? index / 4 : index) * settings.samples;
}

std::uint32_t count_local_lights(const Scene& scene) {
  const glm::dvec3 origin = scene.cameras.front().position();
  return static_cast<std::uint32_t>(light_constants(scene, origin).size());
}

bool has_glass(const Scene& scene) {
  return std::any_of(scene.instances.begin(), scene.instances.end(), [](const Instance& instance) {
    return (instance.mask & kMaskTransparent) != 0;
  });
}

bool scene_offers(const Scene& scene, const EffectNeeds& needs) {
  return (!needs.sun || scene.sun) && (!(needs.glass || needs.panes) || has_glass(scene)) &&
         (!needs.glossy || has_glossy(scene)) && (!needs.particles || !scene.particles.empty()) &&
         (!needs.local_lights || count_local_lights(scene) > 0);
}

bool need_whole_frame(const std::map<std::string, EffectSettings>& chosen,
                      const std::vector<Effect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [&](const Effect& effect) {
    return chosen.count(effect.name) != 0 && !effect.is_plain;
  });
}

const Effect* what_replaces(const FrameSettings& settings, const std::vector<Effect>& effects,
                            const Effect& effect) {
  for (const Effect& other : effects) {
    if (settings.effects.count(other.name) == 0) continue;
    if (other.name == effect.replaced_by || other.alternative_to == effect.name) return &other;
  }
  return nullptr;
}

bool is_rendered(const Scene& scene, const FrameSettings& settings,
                 const std::vector<Effect>& effects, const std::string& name) {
  const Effect* row = find_effect(effects, name);
  const auto chosen = settings.effects.find(name);
  return row != nullptr && chosen != settings.effects.end() &&
         is_of_use(scene, settings, effects, *row, chosen->second);
}

bool is_matte(const Scene& scene, const FrameSettings& settings,
              const std::vector<Effect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [&](const Effect& effect) {
    return effect.needs.glossy && settings.effects.count(effect.name) != 0 &&
           !is_rendered(scene, settings, effects, effect.name) &&
           what_replaces(settings, effects, effect) == nullptr;
  });
}

rtapi::Status check_settings(const FrameSettings& settings, const std::vector<Effect>& effects) {
  if (settings.sun_map > kMaxSunMap) {
    return make_error(ErrorId::kFrameRenderer,
                      "a map of the sun of " + std::to_string(settings.sun_map) +
                          " texels a side; 0 to " + std::to_string(kMaxSunMap) + " are allowed");
  }
  if (!(settings.enlarge >= 1.0f && settings.enlarge <= 4.0f)) {
    return make_error(
        ErrorId::kFrameRenderer,
        "FrameSettings::enlarge is " + std::to_string(settings.enlarge) + "; choose 1 to 4");
  }
  for (const auto& [name, ignored] : settings.effects) {
    const Effect* effect = find_effect(effects, name);
    if (effect == nullptr) {
      return make_error(ErrorId::kFrameRenderer,
                        "there is no effect \"" + name + "\" but " + effect_names(effects));
    }
    if (!settings.whole_frame && !effect->is_plain) {
      return make_error(
          ErrorId::kFrameRenderer,
          "effect \"" + name +
              "\" is no part of a frame that is not whole: set FrameSettings::whole_frame");
    }
  }
  return {};
}

rtapi::Status check_camera(const Camera& camera, const FrameSettings& settings,
                           const std::vector<Effect>& effects) {
  if (!camera.is_orthographic()) return {};
  for (const Effect& effect : effects) {
    if (!effect.needs.perspective || settings.effects.count(effect.name) == 0) continue;
    return make_error(ErrorId::kFrameRenderer,
                      "effect \"" + effect.name + "\" needs a perspective camera, and \"" +
                          camera.name + "\" is orthographic: take " +
                          (effect.alternative_to.empty() ? std::string("another effect")
                                                         : "\"" + effect.alternative_to + "\"") +
                          " in its place");
  }
  return {};
}

}  // namespace kaamos::effects
