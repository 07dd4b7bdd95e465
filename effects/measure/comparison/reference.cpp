// SPDX-License-Identifier: MIT
#include "effects/measure/comparison/reference.h"

#include <utility>

#include "effects/glass/transparent/transparent.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::measure {

using namespace kaamos::effects;

Options reference_options(const Options& options) {
  Options out = options;
  for (auto& [name, settings] : out.frame.effects) {
    if (!find_effect(northlight_effects(), name)->samples_option.empty()) {
      settings.samples = options.reference;
    }
    if (name == "reflections") {
      auto constants = settings.get_constants<ReflectionConstants>();
      constants.firefly_limit = 0;
      constants.fireflies = Fireflies::kKeep;
      settings.set_constants(constants);
    }
    if (name == "transparent") settings.set_constants(sorted_reference());
  }
  out.frame.denoise = default_denoise(DenoiseMethod::kNone);
  // More rays read cells that a frame's few do not ask for.
  out.frame.volume.whole = true;
  // Random numbers that the frame itself has not used.
  out.frame.seed = options.frame.seed ^ 0x5EED0000u;
  return out;
}

rtapi::Result<Outcome> add_reference(const Options& options, const Scene& scene,
                                     const Progress& progress, FrameResult& result) {
  auto renderer = create_renderer(reference_options(options), scene, options.say);
  if (!renderer) return renderer.error();
  const auto show = [&](const std::string& pass, double done) {
    return progress("reference " + pass, done);
  };
  FrameResult frame;
  const auto is_signal = [](const std::string& layer) {
    for (const Effect& effect : northlight_effects()) {
      for (const EffectSignal& signal : effect.signals) {
        if (signal.name == layer) return true;
      }
    }
    return false;
  };
  if (const auto s = render_frame(**renderer, show, frame, is_signal); !is_done(s)) return s;
  // Layers without noise, those of the G-buffer, have no reference of their own.
  for (const Effect& effect : northlight_effects()) {
    for (const EffectSignal& signal : effect.signals) {
      const auto layer = frame.layers.find(signal.name);
      if (layer == frame.layers.end()) continue;
      result.layers[signal.name + "_reference"] = std::move(layer->second);
    }
  }
  result.layers["radiance_reference"] = std::move(frame.radiance);
  return Outcome::kDone;
}

}  // namespace kaamos::measure
