// SPDX-License-Identifier: MIT
// Mirror rays spread over frames, and the blur that knows no distance.
#include "effects/reflections/blurred/blurred_reflections.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/reflections/screen_space/screen_fixture.h"

namespace kaamos::effects {
namespace {

class BlurredReflections : public test::OnBackends {};

BlurredConstants with_sky() {
  BlurredConstants constants;
  constants.screen.fallback = ScreenFallback::kSky;
  constants.screen.length_jitter = 0;
  constants.fresh = 1;
  return constants;
}

std::unique_ptr<FrameRenderer> renderer_of(const std::string& backend, const Scene& scene,
                                           const BlurredConstants& constants, std::uint32_t width,
                                           std::uint32_t height) {
  return make_screen_renderer(
      backend, scene, "ssr-blurred", constants.screen,
      [&](EffectSettings& settings) { settings.set_constants(constants); }, width, height);
}

void render_frames(FrameRenderer& renderer, const Scene& scene, std::uint32_t first,
                   std::uint32_t count) {
  renderer.prepare().value();
  for (std::uint32_t i = first; i < first + count; ++i) {
    FrameMoment moment;
    moment.index = i;
    moment.camera = scene.cameras.front();
    renderer.begin_frame(moment).value();
    renderer.render().value();
  }
}

double floor_rmse(const FloatImage& ids, const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  int pixels = 0;
  for (std::uint32_t y = 0; y < ids.height; ++y) {
    for (std::uint32_t x = 0; x < ids.width; ++x) {
      if (ids.at(x, y, 0) != 1.0f) continue;
      sum += std::pow(a.at(x, y, 0) - b.at(x, y, 0), 2.0);
      ++pixels;
    }
  }
  return std::sqrt(sum / pixels);
}

// Each of 2 x 2 pixels has sent its ray once by then.
TEST_P(BlurredReflections, FourFramesMakeAMirrorWhole) {
  const Scene scene = make_screen_boxes();
  const BlurredConstants constants = with_sky();
  const auto march = make_screen_renderer(
      GetParam(), scene, "ssr", constants.screen,
      [&](EffectSettings& settings) { settings.set_constants(constants.screen); });
  march->render().value();
  const FloatImage whole = march->read("ssr").value();
  const auto renderer = renderer_of(GetParam(), scene, constants, kScreenWidth, kScreenHeight);
  render_frames(*renderer, scene, 0, 1);
  const FloatImage ids = renderer->read("ids").value();
  // Returns the error of the floor, which is a mirror.
  const auto error = [&] { return floor_rmse(ids, renderer->read("ssr_blurred").value(), whole); };
  const double at_first = error();
  render_frames(*renderer, scene, 1, 3);
  const double after_four = error();
  EXPECT_GT(at_first, 0.02);
  EXPECT_LT(after_four, 0.25 * at_first);
}

// Returns how many pixels it takes the wall's reflection to fade out at its side, in the row of the
// floor nearest to a place: from three quarters of its light to a quarter.
int fade_width(const FloatImage& seen, const FloatImage& position, double eye_z, double z) {
  std::uint32_t row = 0;
  double nearest = 1e30;
  const std::uint32_t middle = seen.width / 2;
  for (std::uint32_t y = 0; y < seen.height; ++y) {
    if (std::abs(position.at(middle, y, 1) + 1.5) > 0.01) continue;  // not the floor
    const double distance = std::abs(position.at(middle, y, 2) + eye_z - z);
    if (distance < nearest) nearest = distance, row = y;
  }
  const float inside = seen.at(middle, row, 0), outside = seen.at(middle / 4, row, 0);
  int width = 0;
  for (std::uint32_t x = middle / 4; x < middle; ++x) {
    const float part = (seen.at(x, row, 0) - outside) / (inside - outside);
    width += part > 0.25f && part < 0.75f ? 1 : 0;
  }
  return width;
}

// The width of the blur follows from roughness alone: there is no contact hardening. [survey 6.2]
TEST(BlurredReflectionsBlur, WhatTouchesTheFloorIsAsBlurredAsWhatIsFarFromIt) {
  Scene scene = make_mirror_floor();
  add_shining_box(scene, {1, 1, 0.2}, {0, 1, 0}, {4, 4, 4});
  scene.materials.front().constants.roughness = 0.5f;
  const BlurredConstants constants = with_sky();
  const auto renderer = renderer_of("embree", scene, constants, 160, 100);
  render_frames(*renderer, scene, 0, 4);
  renderer->run("reflections", 64).value();
  const FloatImage position = renderer->read("position").value();
  const FloatImage blurred = renderer->read("ssr_blurred").value();
  const FloatImage traced = renderer->read("reflection").value();
  const auto width = [&](const FloatImage& seen, double z) {
    return fade_width(seen, position, 6, z);
  };
  EXPECT_LT(2 * width(traced, 0.4), width(traced, 1.6)) << "rays harden at the contact";
  EXPECT_GT(2 * width(blurred, 0.4), width(blurred, 1.6)) << "the blur does not";
}

INSTANTIATE_TEST_SUITE_P(Backends, BlurredReflections, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
