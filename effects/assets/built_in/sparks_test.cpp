// SPDX-License-Identifier: MIT
// Particles are in a reflection where it reads the finished picture of the frame before, and
// nowhere else. [survey 6.2]
#include "effects/assets/built_in/sparks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "effects/northlight/frame_renderer.h"
#include "effects/reflections/screen_space/screen_reflections.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 90;
constexpr double kWallRed = 0.02;

// Means over the pixels of the floor that mirror a part of the wall which the picture shows.
struct Mirrored {
  double red = 0;       // of the reflection
  double expected = 0;  // of the finished picture, where plane geometry says that it is mirrored
  double sparks = 0;    // part of the pixels whose reflection is far redder than the wall
};

// The reflection of the second frame; nothing moves.
Mirrored second_frame(const std::string& effect, const std::string& signal, ScreenSource source) {
  const Scene scene = make_sparks({});
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.effects = choose_effects({"particles", effect});
  if (effect == "ssr") {
    ScreenReflectionConstants constants = march_of_pixels();
    constants.source = source;
    constants.fallback = ScreenFallback::kNone;
    constants.edge_fade = 0;
    settings.effects[effect].set_constants(constants);
  }
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  settings.volume.given = std::make_shared<IndirectVolume>();
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  const Camera& camera = scene.cameras.front();
  for (std::uint32_t frame = 0; frame < 2; ++frame) {
    renderer->begin_frame({.index = frame, .camera = camera, .cut = frame == 0}).value();
    renderer->render().value();
  }
  const FloatImage mirrored = renderer->read(signal).value(), ids = renderer->read("ids").value();
  const FloatImage positions = renderer->read("position").value();
  const FloatImage finished = renderer->read("radiance").value();
  const glm::dmat3 to_camera = glm::transpose(glm::dmat3(camera.camera_to_world));
  const double half = camera.picture_half_height();
  Mirrored out;
  double pixels = 0;
  for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) {
    if (ids.values[2 * i] != 1) continue;
    const float* p = positions.values.data() + 4 * i;
    const glm::dvec3 seen(p[0], p[1], p[2]);
    const glm::dvec3 way(seen.x, -seen.y, seen.z);
    const double t = (-4 - (camera.position().z + seen.z)) / way.z;
    const glm::dvec3 on_wall = seen + t * way;
    const glm::dvec3 view = to_camera * on_wall;
    const double x = (view.x / -view.z / half * kHeight / kWidth * 0.5 + 0.5) * kWidth;
    const double y = (0.5 - 0.5 * view.y / -view.z / half) * kHeight;
    if (!(x >= 1 && y >= 1 && x < kWidth - 1 && y < kHeight - 1)) continue;
    const std::size_t at = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
    if (ids.values[2 * at] != 2) continue;
    ++pixels;
    out.red += mirrored.values[4 * i];
    out.expected += finished.values[4 * at];
    out.sparks += mirrored.values[4 * i] > 0.5f ? 1 : 0;
  }
  EXPECT_GT(pixels, 500);
  out.red /= pixels;
  out.expected /= pixels;
  out.sparks /= pixels;
  std::printf(
      "%s, source %d: red %.4f where the picture has %.4f; sparks in %.2f %% of the floor\n",
      effect.c_str(), static_cast<int>(source), out.red, out.expected, 100 * out.sparks);
  return out;
}

TEST(Sparks, OnlyTheFrameBeforeHasThemForReflections) {
  const Mirrored now = second_frame("ssr", "ssr", ScreenSource::kCurrentFrame);
  EXPECT_NEAR(now.red, kWallRed, 0.05 * kWallRed) << "the wall alone";
  EXPECT_EQ(now.sparks, 0);
  EXPECT_GT(now.expected, 2 * kWallRed) << "the picture has sparks before the wall";
  const Mirrored before = second_frame("ssr", "ssr", ScreenSource::kPreviousFrame);
  EXPECT_NEAR(before.red, before.expected, 0.05 * before.expected);
  EXPECT_GT(before.sparks, 0.005);
  const Mirrored traced = second_frame("reflections", "reflection", ScreenSource::kCurrentFrame);
  // The smoothest lobe is no perfect mirror: it loses some light.
  EXPECT_NEAR(traced.red, kWallRed, 5e-3 * kWallRed) << "no ray meets a particle";
}

}  // namespace
}  // namespace kaamos::effects
