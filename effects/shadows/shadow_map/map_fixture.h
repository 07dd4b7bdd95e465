// SPDX-License-Identifier: MIT
//
// A small frame with shadow maps, and what their tests ask of it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "effects/assets/built_in/peter_panning.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/shadows/shadow_map/shadow_map.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {

class MapFrame {
 public:
  static constexpr std::uint32_t kWidth = 64, kHeight = 36;

  // Changes the constants of the effect of that name.
  using Change = std::function<void(const std::string& name, EffectSettings& settings)>;

  // Renders the effects. Those of `names` that are shadow maps have these constants in place of
  // their own.
  MapFrame(const Scene& scene, const std::vector<std::string>& names,
           const ShadowMapConstants* constants = nullptr, std::uint32_t sun_samples = 1,
           std::uint32_t width = kWidth, std::uint32_t height = kHeight,
           const std::string& backend = "embree")
      : MapFrame(
            scene, names,
            [=](const std::string& name, EffectSettings& settings) {
              if (name.rfind("sun-", 0) == 0 && constants != nullptr) {
                settings.set_constants(*constants);
              }
            },
            sun_samples, width, height, backend) {}

  MapFrame(const Scene& scene, const std::vector<std::string>& names, const Change& change,
           std::uint32_t sun_samples, std::uint32_t width, std::uint32_t height,
           const std::string& backend)
      : scene_(scene) {
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
    FrameSettings settings;
    settings.width = width;
    settings.height = height;
    settings.effects = choose_effects(names);
    for (auto& [name, effect] : settings.effects) {
      if (name == "sun") effect.samples = sun_samples;
      change(name, effect);
    }
    settings.denoise = default_denoise(DenoiseMethod::kNone);
    renderer = FrameRenderer::create(test::device_for(desc), scene_, settings).value();
    renderer->render().value();
    ids_ = read("ids");
    at_ = read("position");
  }

  FloatImage read(const std::string& layer) { return renderer->read(layer).value(); }
  // Pixels that show a surface.
  std::vector<std::size_t> surfaces() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < ids_.values.size() / 2; ++i) {
      if (ids_.values[2 * i] != 0) out.push_back(i);
    }
    return out;
  }
  // Pixels that show instance 0, the floor of most scenes.
  std::vector<std::size_t> floor() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < ids_.values.size() / 2; ++i) {
      if (ids_.values[2 * i] == 1) out.push_back(i);
    }
    return out;
  }
  glm::dvec3 position(std::size_t i) const {
    const float* p = at_.values.data() + 4 * i;
    return scene_.cameras.front().position() + glm::dvec3(p[0], p[1], p[2]);
  }
  // Root mean square of the difference of two layers, over surfaces.
  double difference(const std::string& layer, const std::string& other) {
    const FloatImage a = read(layer), b = read(other);
    double sum = 0;
    const auto pixels = surfaces();
    for (const std::size_t i : pixels) {
      const double off = a.values[a.channels * i] - b.values[b.channels * i];
      sum += off * off;
    }
    return std::sqrt(sum / std::max<std::size_t>(pixels.size(), 1));
  }

  // Over surfaces.
  double mean(const std::string& layer) {
    const FloatImage picture = read(layer);
    double sum = 0;
    const auto pixels = surfaces();
    for (const std::size_t i : pixels) sum += picture.values[picture.channels * i];
    return sum / std::max<std::size_t>(pixels.size(), 1);
  }

  std::unique_ptr<FrameRenderer> renderer;

 private:
  Scene scene_;
  FloatImage ids_, at_;
};

}  // namespace kaamos::effects
