// SPDX-License-Identifier: MIT
//
// For tests: one frame with glass by rays and by draws.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/glass/drawn_glass/drawn_glass.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {

// One frame with traced and drawn glass, each over the black picture.
class GlassFrame {
 public:
  explicit GlassFrame(const Scene& scene, const std::string& backend = "embree",
                      std::uint32_t width = 48, std::uint32_t height = 27,
                      DrawnGlassFallback fallback = DrawnGlassFallback::kEnvironment)
      : scene_(scene) {
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
    FrameSettings settings;
    settings.width = width;
    settings.height = height;
    settings.effects = choose_effects({"transparent", "drawn-glass"});
    settings.effects["drawn-glass"].set_constants(DrawnGlassConstants{.fallback = fallback});
    for (auto& [name, effect] : settings.effects) effect.keep = true;  // scenes without glass too
    settings.volume.given = std::make_shared<IndirectVolume>();
    renderer = FrameRenderer::create(test::device_for(desc), scene_, settings).value();
    renderer->render().value();
  }

  // Radiance and depth of the first layer.
  FloatImage traced(TransparentConstants constants) {
    renderer->run("transparent", EffectSettings().set_constants(constants)).value();
    return renderer->read("glass").value();
  }
  FloatImage traced(std::uint32_t reflecting_layers) {
    TransparentConstants constants = sorted_reference();
    constants.reflecting_layers = reflecting_layers;
    return traced(constants);
  }
  FloatImage drawn(const DrawnGlassConstants& constants) {
    renderer->run("drawn-glass", EffectSettings().set_constants(constants)).value();
    return renderer->read("drawn_glass").value();
  }
  FloatImage drawn(DrawnGlassFallback fallback, float tolerance = 1e-4f) {
    return drawn({.tolerance = tolerance, .fallback = fallback});
  }

  std::unique_ptr<FrameRenderer> renderer;

 private:
  Scene scene_;
};

// Root mean square over pixels, relative to the mean of `a`.
inline double difference(const FloatImage& a, const FloatImage& b) {
  double sum = 0, mean = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (i % 4 == 3) continue;
    sum += std::pow(static_cast<double>(a.values[i]) - b.values[i], 2);
    mean += a.values[i];
  }
  const auto count = static_cast<double>(a.values.size()) * 0.75;
  return std::sqrt(sum / count) / (mean / count);
}

}  // namespace kaamos::effects
