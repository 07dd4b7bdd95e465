// SPDX-License-Identifier: MIT
// A-SVGF: what is still has no gradients at all, what changes is forgotten at once. On both
// backends. [Schied et al. 2018]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "effects/denoise/stage_fixture.h"
#include "effects/denoise/temporal_gradients.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 36;

double mean(const FloatImage& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.values.size(); i += image.channels) sum += image.values[i];
  return sum * image.channels / static_cast<double>(image.values.size());
}

double largest(const FloatImage& image, std::uint32_t channels = 3) {
  double out = 0;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (i % image.channels < channels) out = std::max(out, double{image.values[i]});
  }
  return out;
}

class TemporalGradientsTest : public test::OnBackends {};

// Channels of the changes, in the order of the registry.
constexpr std::uint32_t kAo = 0, kSun = 1, kIndirect = 2;

// The same samples of the same scene are the same to the last bit. Where a light goes out, nothing
// is as it was. One body, because most of the time goes into the software driver's pipelines.
TEST_P(TemporalGradientsTest, OnlyWhatChangesHasGradients) {
  Scene scene = make_stage();
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, GetParam(), {"ao", "sun", "gi"}});
  for (int i = 0; i < 3; ++i) show.render();
  EXPECT_GT(mean(show.read("ao")), 0.1);
  EXPECT_GT(mean(show.read("sun")), 0.1);
  const FloatImage before = show.read("indirect");
  EXPECT_GT(mean(before), 0.01);
  EXPECT_EQ(largest(show.changes(), 4), 0.0) << "still";

  scene.lights[0].intensity = 0;
  scene.sun->irradiance = glm::vec3(0);
  show.render();
  const FloatImage changes = show.changes();
  ASSERT_LT(largest(show.read("indirect")), 1e-6);
  std::uint32_t whole = 0, lit = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      EXPECT_EQ(changes.at(x, y, kAo), 0.0f);
      EXPECT_EQ(changes.at(x, y, kSun), 0.0f) << "visibility is not light";
      const float change = changes.at(x, y, kIndirect);
      EXPECT_TRUE(change == 1.0f || change == 0.0f) << "all or nothing";
      if (change == 1.0f) ++whole;
      if (before.at(x, y) > 0) ++lit;
    }
  }
  EXPECT_GT(lit, 200u);
  EXPECT_GE(whole, lit) << "filtered, changes reach beyond what happened to be lit";

  // A camera that moves rounds positions differently; hardly any ray goes another way.
  for (int i = 0; i < 3; ++i) show.render(0, {0.03 * i, 0, 0.01 * i});
  EXPECT_LT(mean(show.changes()), 0.01);
}

// Returns how many frames after the change a signal needs for nine tenths of the way from `before`
// to `after`.
template <class Value>
int lag(Value value, double before, double after) {
  for (int frame = 1; frame <= 40; ++frame) {
    if (std::abs(value() - after) <= 0.1 * std::abs(before - after)) return frame;
  }
  return 41;
}

int lag_of_light(DenoiseMethod method) {
  Scene scene = make_stage();
  Show show(scene, {method, "embree", {"gi"}});
  for (int i = 0; i < 12; ++i) show.render();
  const double before = mean(show.read("indirect_denoised"));
  scene.lights[0].intensity = 0;
  scene.sun->irradiance = glm::vec3(0);
  const auto value = [&] {
    show.render();
    return mean(show.read("indirect_denoised"));
  };
  return lag(value, before, 0);
}

TEST(TemporalGradients, ALightGoesOutWithoutLag) {
  const int svgf = lag_of_light(DenoiseMethod::kSvgf);
  const int adaptive = lag_of_light(DenoiseMethod::kAdaptiveSvgf);
  std::printf("frames to nine tenths: svgf %d, a-svgf %d\n", svgf, adaptive);
  EXPECT_LE(adaptive, 2);
  EXPECT_GE(svgf, 8);
}

// The floor beside the board, in its shadow: the middle of the picture.
double mean_of_centre(const FloatImage& image) {
  double sum = 0, count = 0;
  for (std::uint32_t y = image.height * 5 / 12; y < image.height * 7 / 12; ++y) {
    for (std::uint32_t x = image.width * 5 / 12; x < image.width * 7 / 12; ++x, ++count) {
      sum += image.at(x, y);
    }
  }
  return sum / count;
}

// Both filters over the same frames, of a signal that has a place among the changes.
struct Lags {
  int svgf = 0, adaptive = 0;
};

Lags lags_of_occluder(const std::string& effect, std::uint32_t channel) {
  Scene scene = make_stage();
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, "embree", {effect}, 96, 72});
  show.render();
  FrameRenderer& renderer = show.renderer();
  const DenoiseLibraries libraries = denoise_libraries().value();
  const rtapi::Texture signal =
      renderer.frame()
          .create_picture(renderer.device(), "signal", rtapi::Format::kR32G32B32A32Float)
          .value();
  std::vector<Denoiser> denoisers;
  for (const DenoiseMethod method : {DenoiseMethod::kSvgf, DenoiseMethod::kAdaptiveSvgf}) {
    denoisers.push_back(
        Denoiser::create(renderer.device(), renderer.frame(), libraries,
                         {{"test",
                           signal,
                           false,
                           {renderer.effects().gradients().gradients()->changes(), channel}}},
                         default_denoise(method))
            .value());
    denoisers.back()
        .create_load(renderer.device(), renderer.frame(), libraries, renderer.effects().sum(effect))
        .value();
  }
  const auto render = [&](double seconds) {
    show.render(seconds);
    std::vector<double> out;
    for (Denoiser& denoiser : denoisers) {
      renderer.runner()
          .execute([&](rtapi::CommandList& list) {
            denoiser.load(list, renderer.frame(), 1);
            denoiser.dispatch(list, renderer.frame());
          })
          .value();
      out.push_back(mean_of_centre(renderer.read(denoiser.result()).value()));
    }
    return out;
  };
  std::vector<double> before, after;
  for (int i = 0; i < 16; ++i) before = render(0);
  std::vector<std::vector<double>> frames;
  for (int i = 0; i < 40; ++i) frames.push_back(render(3));
  const auto lag_of = [&](std::size_t i) {
    const double end = frames.back()[i];
    EXPECT_GT(std::abs(end - before[i]), 0.1);
    std::size_t frame = 0;
    return lag([&] { return frames.at(frame++)[i]; }, before[i], end);
  };
  return {lag_of(0), lag_of(1)};
}

TEST(TemporalGradients, AnOccluderLeavesWithoutLag) {
  const Lags sun = lags_of_occluder("sun", 0);
  std::printf("sun, frames to nine tenths: svgf %d, a-svgf %d\n", sun.svgf, sun.adaptive);
  EXPECT_LE(sun.adaptive, 2);
  EXPECT_GE(sun.svgf, 8);
  // A signal that changes in part is forgotten in part: only a sixth of the light is new.
  const Lags ao = lags_of_occluder("ao", 0);
  std::printf("ao, frames to nine tenths: svgf %d, a-svgf %d\n", ao.svgf, ao.adaptive);
  EXPECT_LE(ao.adaptive, ao.svgf);
}

// A change between two frames, and where its trace is looked for.
struct Event {
  std::string effect, layer;
  std::function<void(Scene&)> prepare, change;
  double second = 0;  // of the frames from the change on
  std::function<void(FrameSettings&)> settings = {};
  bool on_board = false;  // only there
};

// The part of the change that pictures still lack, over the pixels of one surface that change much:
// 1 before it, 0 where light has arrived.
class Trace {
 public:
  Trace(const FloatImage& before, const FloatImage& after, const std::vector<char>& may_count)
      : before_(before), after_(after), counts_(may_count) {
    float most = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) most = std::max(most, change(i));
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (change(i) < 0.25f * most) counts_[i] = 0;
    }
  }
  double left(const FloatImage& shown) const {
    double whole = 0, missing = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] == 0) continue;
      const double sign = value(before_, i) < value(after_, i) ? -1 : 1;
      whole += sign * (value(before_, i) - value(after_, i));
      missing += sign * (value(shown, i) - value(after_, i));
    }
    return missing / whole;
  }
  std::size_t pixels() const {
    return static_cast<std::size_t>(
        std::count_if(counts_.begin(), counts_.end(), [](char counts) { return counts != 0; }));
  }

 private:
  // Two visibilities are added up, of which one is 1.
  static float value(const FloatImage& image, std::size_t pixel) {
    return image.values[pixel * image.channels] + image.values[pixel * image.channels + 1];
  }
  float change(std::size_t pixel) const {
    return counts_[pixel] == 0 ? 0 : std::abs(value(before_, pixel) - value(after_, pixel));
  }

  FloatImage before_, after_;
  std::vector<char> counts_;
};

void add(const FloatImage& image, float weight, FloatImage& sum) {
  if (sum.values.empty()) sum = FloatImage(image.width, image.height, image.channels);
  for (std::size_t i = 0; i < image.values.size(); ++i) sum.values[i] += weight * image.values[i];
}

// Frames until nine tenths of a change are shown.
int lag_of(const Event& event, DenoiseMethod method) {
  constexpr int kBefore = 16, kAfter = 32;
  constexpr float kBoard = 3;  // instance + 1
  Scene scene = make_stage();
  event.prepare(scene);
  Show::Options options = {method, "embree", {event.effect}, 96, 72};
  options.change = event.settings;
  Show show(scene, options);
  FloatImage before, after;
  for (int i = 0; i < kBefore; ++i) {
    show.render();
    add(show.read(event.layer), 1.0f / kBefore, before);
  }
  const FloatImage ids = show.read("ids");
  event.change(scene);
  std::vector<FloatImage> shown;
  for (int i = 0; i < kAfter; ++i) {
    show.render(event.second);
    add(show.read(event.layer), 1.0f / kAfter, after);
    shown.push_back(show.read(event.layer + "_denoised"));
  }
  const FloatImage ids_after = show.read("ids");
  std::vector<char> counts;
  for (std::uint32_t y = 0; y < ids.height; ++y) {
    for (std::uint32_t x = 0; x < ids.width; ++x) {
      const float id = ids.at(x, y);
      counts.push_back(id != 0 && id == ids_after.at(x, y) && (id == kBoard) == event.on_board);
    }
  }
  const Trace trace(before, after, counts);
  EXPECT_GT(trace.pixels(), 40u);
  for (int i = 0; i < kAfter; ++i) {
    if (trace.left(shown[static_cast<std::size_t>(i)]) < 0.1) return i + 1;
  }
  return kAfter + 1;
}

Lags lags_of(const char* what, const Event& event) {
  const Lags out = {lag_of(event, DenoiseMethod::kSvgf),
                    lag_of(event, DenoiseMethod::kAdaptiveSvgf)};
  std::printf("%s, frames to nine tenths: svgf %d, a-svgf %d\n", what, out.svgf, out.adaptive);
  return out;
}

void make_glossy(Scene& scene) {
  scene.materials[0].constants.roughness = 0.4f;
  scene.materials[0].constants.metallic = 1;
}

void switch_off(Scene& scene) {
  for (Light& light : scene.lights) light.intensity = 0;
  if (scene.sun) scene.sun->irradiance = glm::vec3(0);
}

void nothing(Scene&) {}

TEST(TemporalGradients, ReflectionsOfALightThatGoesOutHaveNoLag) {
  const Lags lags =
      lags_of("reflected light goes out", {"reflections", "reflection", make_glossy, switch_off});
  EXPECT_LE(lags.adaptive, 2);
  EXPECT_GE(lags.svgf, 8);
}

// The board glows; the floor mirrors it until it leaves.
TEST(TemporalGradients, WhatIsReflectedLeavesWithoutLag) {
  const Lags lags =
      lags_of("what is reflected leaves", {"reflections", "reflection",
                                           [](Scene& scene) {
                                             make_glossy(scene);
                                             Material glow = scene.materials[0];
                                             glow.constants.emissive = glm::vec3(20);
                                             scene.materials.push_back(glow);
                                             for (Geometry& part : scene.meshes[2].geometries) {
                                               part.material = 1;
                                             }
                                           },
                                           nothing, 3});
  EXPECT_LE(lags.adaptive, 4);
  EXPECT_GE(lags.svgf, 8);
}

// The lamp moves, and with it the board's shadow; no occluder does, by which the filter of
// visibility would know. It lets go by itself where new samples contradict its history, and late
// where little does.
TEST(TemporalGradients, ContactShadowsFollowALampWithLessLag) {
  Event event = {"contact", "contact",
                 [](Scene& scene) {
                   scene.sun.reset();
                   scene.lights[0].radius = 0.05f;
                   scene.lights[0].position = {-0.3, 1.8, 0.3};
                 },
                 [](Scene& scene) { scene.lights[0].position.z = 0; }};
  float clip = VisibilityConstants().clip;
  event.settings = [&clip](FrameSettings& settings) {
    settings.effects.at("contact").set_constants(ContactShadowConstants{.length = 3});
    settings.denoise.visibility.clip = clip;
  };
  const Lags lags = lags_of("the lamp of a contact shadow moves", event);
  EXPECT_LT(lags.adaptive, lags.svgf);
  clip = 0;
  event.change = [](Scene& scene) { scene.lights[0].position.z = -0.5; };
  const Lags never = lags_of("the same, farther, and nothing else lets go", event);
  EXPECT_LE(2 * never.adaptive, never.svgf);
}

// The board goes on slowly all the time, so that its surface is found again in each frame; light
// goes out meanwhile.
TEST(TemporalGradients, LightThatGoesOutOnAMovingSurfaceHasNoLag) {
  const auto lag_on_board = [](DenoiseMethod method) {
    Scene scene = make_stage();
    Channel& way = scene.animations[0].channels[0];
    way.interpolation = Interpolation::kLinear;
    way.times = {0, 10};
    way.values = {{0.7f, 1, 0, 0}, {-0.3f, 1, 0.5f, 0}};
    Show show(scene, {method, "embree", {"gi"}, 96, 72});
    double seconds = 0;
    const auto light_on_board = [&] {
      show.render(seconds += 1.0 / 30);
      const FloatImage light = show.read("indirect_denoised"), ids = show.read("ids");
      double sum = 0, count = 0;
      for (std::uint32_t y = 0; y < ids.height; ++y) {
        for (std::uint32_t x = 0; x < ids.width; ++x) {
          if (ids.at(x, y) != 3) continue;
          sum += light.at(x, y);
          ++count;
        }
      }
      return sum / count;
    };
    double before = 0;
    for (int i = 0; i < 12; ++i) before = light_on_board();
    switch_off(scene);
    return lag(light_on_board, before, 0);
  };
  const int svgf = lag_on_board(DenoiseMethod::kSvgf);
  const int adaptive = lag_on_board(DenoiseMethod::kAdaptiveSvgf);
  std::printf("moving surface, frames to nine tenths: svgf %d, a-svgf %d\n", svgf, adaptive);
  EXPECT_LE(adaptive, 2);
  EXPECT_GE(svgf, 8);
}

// Turned about, a surface is lit otherwise; where light is the same from everywhere, it is not.
TEST(TemporalGradients, ASurfaceThatTurnsUnderAnEvenSkyDoesNotChange) {
  Scene scene = make_stage();
  make_glossy(scene);
  scene.lights.clear();
  scene.sun.reset();
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(1);
  scene.instances.resize(3);
  std::swap(scene.instances[0], scene.instances[2]);  // the board alone
  scene.instances.resize(1);
  Channel turn;
  turn.path = ChannelPath::kRotation;
  turn.interpolation = Interpolation::kLinear;
  turn.times = {0, 1};
  turn.values = {{0, 0, 0, 1}, {0.1736f, 0.1f, 0, 0.9797f}};
  scene.animations[0].channels[0].values[1] = scene.animations[0].channels[0].values[0];
  scene.animations[0].channels.push_back(turn);
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, "embree", {"ao", "reflections"}});
  for (int i = 0; i < 4; ++i) show.render(0.05 * i);
  EXPECT_GT(mean(show.read("reflection")), 0.01);
  EXPECT_LT(largest(show.changes(), 4), 0.02);
}

// At rest nothing is forgotten, so that there is no more noise than with as many passes of SVGF.
TEST(TemporalGradients, AStillSceneHasNoMoreNoiseThanSvgf) {
  const auto noise = [](DenoiseMethod method) {
    Scene scene = make_stage();
    make_glossy(scene);
    Show show(scene, {method, "embree", {"reflections", "contact", "gi"}});
    std::vector<double> out;
    std::vector<FloatImage> sums(3), squares(3);
    constexpr const char* kLayers[] = {"reflection_denoised", "contact_denoised",
                                       "indirect_denoised"};
    constexpr int kFrames = 24;
    for (int frame = 0; frame < 8 + kFrames; ++frame) {
      show.render();
      if (frame < 8) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        FloatImage image = show.read(kLayers[i]);
        add(image, 1.0f / kFrames, sums[i]);
        for (float& value : image.values) value *= value;
        add(image, 1.0f / kFrames, squares[i]);
      }
    }
    EXPECT_TRUE(method != DenoiseMethod::kAdaptiveSvgf ||
                (largest(show.changes(0), 4) == 0 && largest(show.changes(1), 4) == 0));
    for (std::size_t i = 0; i < 3; ++i) {
      double variance = 0;
      for (std::size_t k = 0; k < sums[i].values.size(); ++k) {
        if (k % 4 < 2) variance += squares[i].values[k] - sums[i].values[k] * sums[i].values[k];
      }
      out.push_back(std::sqrt(std::max(variance, 0.0)));
    }
    return out;
  };
  const auto svgf = noise(DenoiseMethod::kSvgf), adaptive = noise(DenoiseMethod::kAdaptiveSvgf);
  for (std::size_t i = 0; i < svgf.size(); ++i) {
    std::printf("noise: svgf %g, a-svgf %g\n", svgf[i], adaptive[i]);
    EXPECT_LE(adaptive[i], 1.01 * svgf[i]);
  }
}

// An average in which new frames weigh alpha keeps alpha / (2 - alpha) of the variance and shows
// nine tenths of a change after ln 0.1 / ln (1 - alpha) frames: 10.3 and 44.9 for 0.2 and
// 0.05. [Schied et al. 2017; Falcor]
TEST(ScalarAlpha, AmbientOcclusionIsCalmAndLagsLonger) {
  struct Found {
    double noise = 0;
    int lag = 0;
  };
  const auto look = [](float alpha) {
    Scene scene = make_stage();
    Show::Options options = {DenoiseMethod::kSvgf, "embree", {"ao"}};
    options.change = [alpha](FrameSettings& settings) {
      settings.denoise.constants.scalar_alpha = alpha;
      settings.denoise.constants.max_history = 255;
      settings.effects.at("ao").radius = 1;
    };
    Show show(scene, options);
    constexpr int kFrames = 40;
    FloatImage sum, squares;
    double before = 0;
    for (int frame = 0; frame < 2 * kFrames; ++frame) {
      show.render();
      if (frame < kFrames) continue;
      FloatImage image = show.read("ao_denoised");
      before = mean_of_centre(image);
      add(image, 1.0f / kFrames, sum);
      for (float& value : image.values) value *= value;
      add(image, 1.0f / kFrames, squares);
    }
    Found found;
    for (std::size_t i = 0; i < sum.values.size(); ++i) {
      found.noise += std::max(squares.values[i] - sum.values[i] * sum.values[i], 0.0f);
    }
    found.noise = std::sqrt(found.noise / static_cast<double>(sum.values.size()));
    std::vector<double> after;
    for (int frame = 0; frame < 100; ++frame) {
      show.render(3);  // the board is gone
      after.push_back(mean_of_centre(show.read("ao_denoised")));
    }
    EXPECT_GT(after.back(), before + 0.02);
    while (after.back() - after[static_cast<std::size_t>(found.lag)] >
           0.1 * (after.back() - before)) {
      ++found.lag;
    }
    ++found.lag;
    std::printf("alpha %g: noise %.5f, %d frames\n", static_cast<double>(alpha), found.noise,
                found.lag);
    return found;
  };
  const Found fifth = look(0.2f), twentieth = look(DenoiseConstants().scalar_alpha);
  EXPECT_LT(twentieth.noise, 0.65 * fifth.noise);
  EXPECT_NEAR(fifth.lag, 11, 3);
  EXPECT_NEAR(twentieth.lag, 45, 12);
}

TEST(TemporalGradients, MoreSignalsThanChannelsAreRefused) {
  Scene scene = make_stage();
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, "embree", {"ao"}});
  show.render();
  FrameRenderer& renderer = show.renderer();
  TemporalGradients gradients =
      TemporalGradients::create(renderer.device(), renderer.frame(), renderer.context().gpu,
                                denoise_libraries().value())
          .value();
  const rtapi::Texture sum = renderer.effects().sum("ao");
  for (std::size_t i = 0; i < kMostGradients; ++i) {
    EXPECT_EQ(gradients.add(renderer.device(), renderer.frame(), sum, sum).value(), i);
  }
  const auto refused = gradients.add(renderer.device(), renderer.frame(), sum, sum);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "KA3091 temporal gradients cannot be made: 9 signals whose samples are taken again: 8 "
            "are allowed");
}

INSTANTIATE_TEST_SUITE_P(Backends, TemporalGradientsTest, testing::Values("embree", "vulkan"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace kaamos::effects
