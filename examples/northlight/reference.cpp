// SPDX-License-Identifier: MIT
#include "reference.h"

#include <algorithm>

#include "effects/transparent/transparent.h"

namespace northlight {

namespace {

// Layers without noise, those of the G-buffer, have no reference of their own.
constexpr const char* kSignals[] = {"ao",         "sun",          "contact", "indirect",
                                    "reflection", "local_lights", "glass",   "glass_transmittance"};

}  // namespace

Options reference_options(const Options& options) {
  Options out = options;
  out.ao_samples = out.sun_samples = out.contact_samples = out.gi_samples = out.reflection_samples =
      options.reference;
  out.denoise = "none";
  out.firefly_limit = 0;
  out.glass_layers = kaamos::effects::kMaxSortedLayers;
  // Random numbers that the frame itself has not used.
  out.seed = options.seed ^ 0x5EED0000u;
  return out;
}

rtapi::Status add_reference(const Options& options, const kaamos::effects::Scene& scene,
                            const ShaderLibraries& libraries, const Progress& progress,
                            const std::atomic<bool>& stop,
                            const std::function<void(const std::string&)>& message,
                            FrameResult& result) {
  auto renderer = Renderer::create(reference_options(options), scene, message);
  if (!renderer) return renderer.error();
  const auto show = [&](const std::string& pass, double done) {
    progress("reference " + pass, done);
  };
  auto frame = (*renderer)->render(libraries, show, stop);
  if (!frame) return frame.error();
  for (const char* name : kSignals) {
    const auto layer = frame->layers.find(name);
    if (layer == frame->layers.end()) continue;
    result.layers[std::string(name) + "_reference"] = std::move(layer->second);
  }
  result.layers["radiance_reference"] = std::move(frame->radiance);
  return {};
}

}  // namespace northlight
