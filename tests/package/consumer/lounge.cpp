// SPDX-License-Identifier: MIT
// Renders the built-in scene with every Northlight effect into lounge.png.
#include <effects/assets/built_in/lounge.h>
#include <effects/assets/image/png.h>
#include <effects/assets/image/tonemap.h>
#include <effects/northlight/frame_renderer.h>

#include <cstdio>
#include <stdexcept>

int main() try {
  using namespace kaamos::effects;
  const Scene lounge = make_lounge();
  FrameSettings settings;
  settings.width = 96;
  settings.height = 54;
  settings.effects = choose_effects({"all"});
  settings.volume.cell = 1.0f;  // metres; quick to bake
  settings.volume.samples = 4;
  const rtapi::Device device = rtapi::CreateDevice().value();
  const auto renderer = FrameRenderer::create(device, lounge, settings).value();
  renderer->render().value();
  const FloatImage radiance = renderer->read("radiance").value();
  const auto written = write_png("lounge.png", tonemap(radiance, lounge.exposure));
  if (!written.ok()) throw std::runtime_error(written.error().message);
  const float middle = radiance.at(radiance.width / 2, radiance.height / 2, 1);
  std::printf("wrote lounge.png; radiance in its middle: %.3g\n", middle);
  return middle > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
