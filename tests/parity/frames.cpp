// SPDX-License-Identifier: MIT
#include "tests/parity/frames.h"

#include <memory>

#include "effects/northlight/frame_renderer.h"

namespace kaamos::parity {

using namespace effects;

namespace {

FrameSettings settings_of(const FrameRun& run, const std::vector<std::string>& effects) {
  FrameSettings settings;
  settings.width = run.width;
  settings.height = run.height;
  settings.seed = run.seed;
  settings.effects = choose_effects(effects);
  settings.whole_frame = need_whole_frame(settings.effects);
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  settings.volume.given = std::make_shared<IndirectVolume>();
  for (auto& [name, effect] : settings.effects) effect.samples = run.samples;
  return settings;
}

std::unique_ptr<FrameRenderer> rendered(const Scene& scene, const FrameRun& run,
                                        const FrameSettings& settings) {
  rtapi::DeviceDesc desc;
  desc.Backend = run.backend;
  auto renderer = FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene, settings).value();
  renderer->render().value();
  return renderer;
}

}  // namespace

RenderedFrame render_frame(const Scene& scene, const FrameRun& run) {
  const auto renderer = rendered(scene, run, settings_of(run, {"ao", "sun"}));
  RenderedFrame out;
  for (uint32_t i = 0; i < kFrameTextureCount; ++i) {
    const auto texture = static_cast<FrameTexture>(i);
    out.pictures[texture] = renderer->read(renderer->frame().texture(texture)).value();
  }
  for (const char* signal : {"ao", "sun"}) {
    const rtapi::Texture sum = renderer->effects().sum(signal);
    if (sum) out.sums[signal] = renderer->read(sum).value();
  }
  return out;
}

GlassRun render_glass(const Scene& scene, const FrameRun& run,
                      const TransparentConstants& constants) {
  FrameSettings settings = settings_of(run, {"sun", "transparent"});
  settings.effects.at("transparent").samples = 1;
  settings.effects.at("transparent").set_constants(constants);
  const auto renderer = rendered(scene, run, settings);
  return {renderer->read("ids").value(), renderer->read("radiance").value(),
          renderer->read("glass_transmittance").value()};
}

}  // namespace kaamos::parity
