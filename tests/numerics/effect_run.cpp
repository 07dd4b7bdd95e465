// SPDX-License-Identifier: MIT
#include "effect_run.h"

#include "effects/northlight/frame_renderer.h"

namespace kaamos::test {

using namespace effects;

EffectResult run_effect(const Scene& scene, const EffectRun& run) {
  rtapi::DeviceDesc device_desc;
  device_desc.Threads = run.threads;
  const rtapi::Device device = rtapi::CreateDevice(device_desc).value();
  const std::string name = run.effect == Effect::kAmbientOcclusion ? "ao" : "sun";
  FrameSettings settings;
  settings.width = run.width;
  settings.height = run.height;
  settings.seed = run.seed;
  settings.whole_frame = false;
  settings.effects = choose_effects({name});
  EffectSettings& effect = settings.effects.at(name);
  effect.samples = run.samples;
  effect.radius = run.radius;
  effect.keep = true;
  const auto renderer = FrameRenderer::create(device, scene, settings).value();
  renderer->accumulate(name, effect, {}).value();
  return {renderer->read(name).value(), renderer->read("position").value(),
          renderer->read("ids").value()};
}

}  // namespace kaamos::test
