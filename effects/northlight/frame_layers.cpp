// SPDX-License-Identifier: MIT
#include "effects/northlight/frame_layers.h"

#include <algorithm>
#include <utility>

namespace kaamos::effects {

namespace {

constexpr std::pair<const char*, FrameTexture> kSurfaces[] = {
    {"depth", kDepth},          {"view_z", kViewZ},
    {"normal", kNormal},        {"shading_normal", kShadingNormal},
    {"base_color", kBaseColor}, {"emissive", kEmissive},
    {"material", kMaterial},    {"ids", kIds},
    {"position", kPosition}};

std::vector<std::string> surface_names() {
  std::vector<std::string> out;
  for (const auto& [name, ignored] : kSurfaces) out.emplace_back(name);
  return out;
}

bool has_passes(const Effect& effect) {
  return effect.pass || effect.make;
}

FrameLayer raw_layer(const ActiveEffect& effect, std::size_t index,
                     const SignalFilters::Signal* filtered) {
  const EffectSignal& signal = effect.row().signals[index];
  if (!signal.is_sum) return {signal.name, effect.pictures().signals[index]};
  // A sum of every other pixel has holes, which the denoiser's input has not. Plain effects show
  // them.
  if (filtered != nullptr && !effect.row().is_plain && filtered->pixel_step != 1) {
    return {signal.name, filtered->mean};
  }
  return {signal.name, effect.pictures().signals[index],
          1.0f / static_cast<float>(std::max(effect.samples(), 1u))};
}

}  // namespace

std::string denoised_layer(const std::string& signal) {
  return signal + "_denoised";
}

std::vector<std::string> possible_layers(const std::vector<Effect>& effects) {
  std::vector<std::string> out = surface_names();
  const auto add = [&](const std::string& name) {
    if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  };
  for (const Effect& effect : effects) {
    for (const EffectSignal& signal : effect.signals) {
      add(signal.name);
      if (has_passes(effect) && signal.is_sum) add(denoised_layer(signal.name));
    }
  }
  return out;
}

std::vector<std::string> layer_names(const FrameContext& context) {
  std::vector<std::string> out = surface_names();
  for (const Effect& effect : context.effects) {
    if (!is_rendered(context.scene, context.settings, context.effects, effect.name)) continue;
    for (const EffectSignal& signal : effect.signals) {
      out.push_back(signal.name);
      const bool is_filtered = context.settings.whole_frame && has_passes(effect) && signal.is_sum;
      if (is_filtered) out.push_back(denoised_layer(signal.name));
    }
  }
  return out;
}

std::vector<FrameLayer> find_layers(const FrameContext& context, const LightStage& lights,
                                    const EffectStage& effects, const FilterStage& filters) {
  std::vector<FrameLayer> out;
  for (const auto& [name, texture] : kSurfaces) {
    out.push_back({name, context.frame.texture(texture), 1, texture == kBaseColor});
  }
  for (const auto& effect : effects.active()) {
    for (std::size_t i = 0; i < effect->row().signals.size(); ++i) {
      const std::string& name = effect->row().signals[i].name;
      if (!effect->has_passes()) {
        if (lights.main() != nullptr) out.push_back({name, lights.picture()});
        continue;
      }
      const SignalFilters::Signal* filtered = filters.signals().find(name);
      out.push_back(raw_layer(*effect, i, filtered));
      if (filtered != nullptr) {
        out.push_back({denoised_layer(name), filters.signals().denoised(*filtered)});
      }
    }
  }
  return out;
}

void decode_layer(const FrameLayer& layer, FloatImage& image) {
  if (layer.scale != 1) {
    for (float& value : image.values) value *= layer.scale;
  }
  // Alpha is 1.
  if (layer.is_encoded_color) {
    for (float& value : image.values) value *= value;
  }
}

}  // namespace kaamos::effects
