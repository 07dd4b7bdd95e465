// SPDX-License-Identifier: MIT
// Adaptive shadows against the closed form of a penumbra, and against as many rays spread evenly.
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 64;
constexpr double kSheet = 1.0, kRadius = 0.2;
const char* const kName = "adaptive-sun";

// A sheet's edge in the sun, and a sequence of frames of it.
struct Sequence {
  Sequence(const std::string& backend, std::uint32_t most,
           const AdaptiveShadowConstants& constants = {}, std::uint32_t width = kWidth,
           std::uint32_t height = kHeight)
      : scene(make_penumbra_oracle(kSheet, kRadius)) {
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    FrameSettings settings;
    settings.width = width;
    settings.height = height;
    settings.effects = choose_effects({kName});
    settings.effects[kName].samples = most;
    settings.effects[kName].set_constants(constants);
    settings.denoise = default_denoise(DenoiseMethod::kNone);
    settings.moving = true;
    scene.sky = {};
    renderer = FrameRenderer::create(test::device_for(desc), scene, settings).value();
  }

  // Renders the next frame; returns its rays per pixel.
  double go(double aside = 0.0, bool cut = false) {
    FrameMoment moment;
    moment.index = frames++;
    moment.camera = scene.cameras.front();
    moment.camera.camera_to_world[3] += aside * moment.camera.camera_to_world[0];
    moment.cut = cut;
    camera = moment.camera;
    renderer->begin_frame(moment).value();
    renderer->render().value();
    const FloatImage taken = renderer->read("adaptive_sun_rays").value();
    double sum = 0;
    for (std::size_t i = 0; i < taken.values.size(); i += 4) sum += taken.values[i];
    return sum / (taken.values.size() / 4.0);
  }

  // Root mean square of the difference from the closed form, on the floor.
  double error() {
    const FloatImage visible = renderer->read("adaptive_sun").value();
    const FloatImage ids = renderer->read("ids").value();
    const FloatImage at = renderer->read("position").value();
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
      if (ids.values[2 * i] != 1) continue;
      const double x = at.values[4 * i] + camera.position().x;
      const double truth = penumbra_visibility(kSheet, kRadius, x);
      const double off = visible.values[4 * i] - truth;
      sum += off * off;
      ++count;
    }
    EXPECT_GT(count, 1000);
    return std::sqrt(sum / count);
  }

  Scene scene;
  Camera camera;
  std::unique_ptr<FrameRenderer> renderer;
  std::uint32_t frames = 0;
};

class AdaptiveShadow : public test::OnBackends {};

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

INSTANTIATE_TEST_SUITE_P(Backends, AdaptiveShadow, testing::Values("embree", "vulkan"),
                         backend_name);

// All pixels take the most rays in the first frame, as after a cut; then only those of the
// penumbra, and those around.
TEST_P(AdaptiveShadow, RaysGoToThePenumbra) {
  Sequence s(GetParam(), kAdaptiveStandardSamples, {}, 48, 32);
  const double first = s.go();
  double rays = 0;
  for (int i = 0; i < 11; ++i) rays = s.go();
  EXPECT_LT(rays, 0.5 * first);
  const FloatImage taken = s.renderer->read("adaptive_sun_rays").value();
  const FloatImage ids = s.renderer->read("ids").value();
  const FloatImage at = s.renderer->read("position").value();
  double inside = 0, outside = 0;
  int inside_count = 0, outside_count = 0;
  for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
    if (ids.values[2 * i] != 1) continue;
    const double x = at.values[4 * i] + s.camera.position().x;
    const double truth = penumbra_visibility(kSheet, kRadius, x);
    const bool penumbra = truth > 0.2 && truth < 0.8;
    if (!penumbra && truth > 0.0 && truth < 1.0) continue;
    (penumbra ? inside : outside) += taken.values[4 * i];
    (penumbra ? inside_count : outside_count) += 1;
  }
  ASSERT_GT(inside_count, 20);
  ASSERT_GT(outside_count, 100);
  EXPECT_GT(inside / inside_count, 3.0);
  EXPECT_LT(outside / outside_count, 0.5 * inside / inside_count);
  EXPECT_LT(s.error(), 0.04);
}

// At the rays that it took, spread evenly over all pixels and filtered in the same way, the error
// is larger.
TEST(AdaptiveShadowQuality, BeatsAsManyRaysSpreadEvenly) {
  Sequence adaptive("embree", kAdaptiveHighSamples);
  double rays = 0, adaptive_error = 0;
  for (int i = 0; i < 20; ++i) {
    const double taken = adaptive.go(0.01 * i);
    if (i < 12) continue;
    rays += taken / 8;
    adaptive_error += adaptive.error() / 8;
  }
  // The fewest whole samples that are at least as many rays.
  Sequence all("embree", 1, {.flags = kAdaptiveUniform});
  const double one = all.go();
  const auto samples = static_cast<std::uint32_t>(std::ceil(rays / one));
  Sequence uniform("embree", samples, {.flags = kAdaptiveUniform});
  double uniform_error = 0, uniform_rays = 0;
  for (int i = 0; i < 20; ++i) {
    const double taken = uniform.go(0.01 * i);
    if (i < 12) continue;
    uniform_rays += taken / 8;
    uniform_error += uniform.error() / 8;
  }
  EXPECT_GE(uniform_rays, rays);
  EXPECT_LT(adaptive_error, uniform_error);
  std::printf("rays a pixel %.3f adaptive, %.3f even; error %.4f, %.4f\n", rays, uniform_rays,
              adaptive_error, uniform_error);
}

// In every frame a quarter of the blocks of 8 x 8 pixels is forced, each once in four frames.
TEST(AdaptiveShadowMask, LooksAtAQuarterOfWhatIsCalm) {
  Sequence s("embree", 5, {}, 64, 64);
  // Straight down on lit floor, far from the sheet.
  s.scene.cameras.front().camera_to_world = look_at({40, 2, 0}, {40, 0, 0.001});
  for (int i = 0; i < 12; ++i) s.go();
  std::vector<int> times(64 * 64, 0);
  for (int frame = 0; frame < 4; ++frame) {
    EXPECT_DOUBLE_EQ(s.go(), 0.25);
    const FloatImage taken = s.renderer->read("adaptive_sun_rays").value();
    for (std::size_t i = 0; i < times.size(); ++i) {
      times[i] += static_cast<int>(taken.values[4 * i]);
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), 64 * 64);
}

// Counts go down from a mean variation on that the budget allows.
TEST(AdaptiveShadowBudget, LimitsWhatMuchPenumbraCosts) {
  // So low that the whole picture lies in the penumbra.
  const auto steady = [](float budget) {
    Sequence s("embree", 8, {.budget = budget}, 48, 32);
    s.scene.cameras.front().camera_to_world = look_at({0.02, 0.15, 0}, {0, 0, 0.001});
    double rays = 0;
    for (int i = 0; i < 12; ++i) rays = s.go();
    return rays;
  };
  const double free = steady(0.0f), limited = steady(0.05f);
  EXPECT_GT(free, 4.0);
  EXPECT_LT(limited, 0.75 * free);
}

// E3: the two readings of the history differ: the released one looks at this frame too, and so
// knows of a change one frame earlier. The released shift forgets all but the newest of the
// variations.
TEST(AdaptiveShadowHistory, ReadingsDiffer) {
  // Returns the variations of every pixel in the frames after the sun has moved.
  const auto variations = [](std::uint32_t flags) {
    Sequence s("embree", 5, {.flags = flags}, 48, 32);
    for (int i = 0; i < 12; ++i) s.go();
    s.scene.sun->direction_to_sun = glm::normalize(glm::vec3(0.35f, 1.0f, 0.0f));
    std::vector<float> out;
    for (int i = 0; i < 10; ++i) {
      s.go();
      const FloatImage taken = s.renderer->read("adaptive_sun_rays").value();
      for (std::size_t k = 0; k < taken.values.size(); k += 4) out.push_back(taken.values[k + 1]);
    }
    return out;
  };
  const auto text = variations(0);
  EXPECT_NE(text, variations(kAdaptiveReleasedHistory));
  EXPECT_NE(text, variations(kAdaptiveReleasedShift));
}

}  // namespace
}  // namespace kaamos::effects
