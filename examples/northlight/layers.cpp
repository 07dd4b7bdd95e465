// SPDX-License-Identifier: MIT
#include "layers.h"

#include <algorithm>
#include <utility>

#include "effects/northlight/frame_layers.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr const char* kAll = "all";
constexpr const char* kNone = "none";

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Signals of the effects that somebody wants to look at.
std::vector<std::string> signals_to_look_at(const Options& options, const FrameRenderer& renderer) {
  std::vector<std::string> out;
  for (const Effect& effect : renderer.context().effects) {
    const auto chosen = renderer.context().settings.effects.find(effect.name);
    if (chosen == renderer.context().settings.effects.end()) continue;
    if (!chosen->second.named && options.reference == 0) continue;
    for (const EffectSignal& signal : effect.signals) {
      out.push_back(signal.name);
      out.push_back(denoised_layer(signal.name));
    }
  }
  return out;
}

}  // namespace

std::string check_layer_name(const std::string& name) {
  std::vector<std::string> known = possible_layers(northlight_effects());
  if (name == kAll || name == kNone || contains(known, name)) return {};
  std::string list;
  for (const std::string& each : known) list += each + ", ";
  return "\"" + name + "\" is no layer: there are " + list + "all and none";
}

rtapi::Result<WrittenLayers> WrittenLayers::choose(const Options& options,
                                                   const FrameRenderer& renderer) {
  const bool prints_counts = options.explain.has_value() || !options.heatmap.empty();
  WrittenLayers out;
  if (prints_counts || contains(options.layers, kNone)) return out;
  std::vector<std::string> there = renderer.layers();
  std::erase(there, "radiance");
  const bool is_left_out = options.layers.empty();
  if (contains(options.layers, kAll) || (is_left_out && options.pixel)) {
    out.names_ = std::move(there);
    return out;
  }
  for (const std::string& name :
       is_left_out ? signals_to_look_at(options, renderer) : options.layers) {
    if (contains(there, name)) {
      if (!out.has(name)) out.names_.push_back(name);
    } else if (const auto s = renderer.check_layer(name); !is_left_out && !s) {
      return s.error();
    }
  }
  return out;
}

bool WrittenLayers::has(const std::string& layer) const {
  return contains(names_, layer) || layer.ends_with("_reference");
}

LayerChoice WrittenLayers::reads() const {
  return [names = names_](const std::string& layer) {
    if (contains(names, layer)) return true;
    // Pictures of some layers look at others.
    if (layer == "ids") return contains(names, "normal") || contains(names, "shading_normal");
    return layer == "view_z" && contains(names, "depth");
  };
}

}  // namespace northlight
