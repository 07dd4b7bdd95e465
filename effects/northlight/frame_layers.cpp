// SPDX-License-Identifier: MIT
#include "effects/northlight/frame_layers.h"

#include <algorithm>
#include <utility>

namespace kaamos::effects {

namespace {

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

std::vector<FrameLayer> find_layers(const FrameContext& context, const LightStage& lights,
                                    const EffectStage& effects, const FilterStage& filters) {
  constexpr std::pair<const char*, FrameTexture> kSurfaces[] = {
      {"depth", kDepth},          {"view_z", kViewZ},
      {"normal", kNormal},        {"shading_normal", kShadingNormal},
      {"base_color", kBaseColor}, {"emissive", kEmissive},
      {"material", kMaterial},    {"ids", kIds},
      {"position", kPosition}};
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
        out.push_back({name + "_denoised", filters.signals().denoised(*filtered)});
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
