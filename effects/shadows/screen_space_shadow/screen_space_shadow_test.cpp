// SPDX-License-Identifier: MIT
// Screen-space contact shadows against rays of the same length, and how they fail.
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr float kLength = 0.4f;
constexpr std::uint32_t kWidth = 128, kHeight = 72;
const char* const kScreenName = "screen-contact";

// A floor and a lamp to the right of it that casts hard shadows to the left.
Scene floor_scene(const glm::dvec3& lamp = {1.5, 0.8, 0.1}) {
  Scene scene = start_scene("contact");
  add_paint(scene, "paint", glm::vec3(0.7f));
  add_floor(scene, "floor", {-6, -6}, {6, 6}, 0, 0);
  add_lamp(scene, "lamp", lamp, 5, 0);
  add_view(scene, "camera", {0, 0.9, 1.3}, {0, 0.05, 0}, 0.7);
  return scene;
}

// Posts some two pixels wide, and sheets that are thinner than a step of the march.
Scene thin_scene() {
  Scene scene = floor_scene();
  for (int i = 0; i < 7; ++i) {
    add_thing(scene, "post", post(0.011, 0.12 + 0.03 * i, 12), 0,
              translate(glm::dvec3(-0.4 + 0.15 * i, 0, (i % 3) * 0.16 - 0.15)));
  }
  add_box(scene, "sheet", {0.25, 0, 0.15}, {0.26, 0.1, 0.4}, 0);
  add_box(scene, "rail", {-0.5, 0.08, 0.35}, {0.2, 0.1, 0.37}, 0);
  return scene;
}

struct Found {
  int truth = 0, said = 0, both = 0;  // pixels in shadow
  double recall() const { return static_cast<double>(both) / std::max(truth, 1); }
  double precision() const { return static_cast<double>(both) / std::max(said, 1); }
  int wrong() const { return said - both; }
};

class ContactFrame {
 public:
  explicit ContactFrame(const Scene& scene, const std::string& backend = "embree",
                        std::uint32_t width = kWidth, std::uint32_t height = kHeight,
                        const std::vector<std::string>& names = {"contact", kScreenName})
      : scene_(scene) {
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
    FrameSettings settings;
    settings.width = width;
    settings.height = height;
    settings.effects = choose_effects(names);
    if (settings.effects.count("contact") != 0) {
      settings.effects.at("contact").set_constants(ContactShadowConstants{kLength});
    }
    settings.denoise = default_denoise(DenoiseMethod::kNone);
    renderer = FrameRenderer::create(test::device_for(desc), scene_, settings).value();
    renderer->render().value();
  }

  FloatImage read(const std::string& layer) { return renderer->read(layer).value(); }
  // The picture of one technique with constants of its own.
  FloatImage march(const ScreenSpaceShadowConstants& constants) {
    renderer->run(kScreenName, EffectSettings().set_constants(constants)).value();
    return read("screen_contact");
  }
  Found find(const ScreenSpaceShadowConstants& constants) {
    const FloatImage truth = read("contact"), said = march(constants);
    const FloatImage ids = read("ids");
    Found out;
    for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
      if (ids.values[2 * i] != 1) continue;  // the floor
      const bool dark = truth.values[truth.channels * i] < 0.5f;
      const bool said_dark = said.values[said.channels * i] < 0.5f;
      out.truth += dark;
      out.said += said_dark;
      out.both += dark && said_dark;
    }
    return out;
  }

  std::unique_ptr<FrameRenderer> renderer;

 private:
  Scene scene_;
};

ScreenSpaceShadowConstants with_steps(ScreenSpaceShadowConstants constants, std::uint32_t steps) {
  constants.steps = steps;
  constants.length = kLength;
  constants.border = 0;
  return constants;
}

class ScreenSpaceShadows : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, ScreenSpaceShadows, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// More pixels at a step, and more marches, find more of the thin shadows. [Seibert & Radicke 2017]
TEST_P(ScreenSpaceShadows, MultisamplingAndMultipassFindMoreOfThinShadows) {
  ContactFrame frame(thin_scene(), GetParam());
  const auto show = [&](const char* name, const ScreenSpaceShadowConstants& constants) {
    const Found found = frame.find(constants);
    std::printf("%s: recall %.3f precision %.3f of %d\n", name, found.recall(), found.precision(),
                found.truth);
    return found;
  };
  const Found plain = show("plain", with_steps({}, 8));
  const Found beside = show("multisampled", with_steps(multisampled_shadow(), 8));
  const Found several = show("multipass", with_steps(multipass_shadow(), 8));
  show("plain, 16", with_steps({}, 16));
  show("plain, 64", with_steps({}, 64));
  EXPECT_GT(plain.truth, 200);
  EXPECT_GT(beside.recall(), plain.recall() + 0.1);
  EXPECT_GT(several.recall(), plain.recall() + 0.1);
}

// A post that is thinner than a step: every other piece of its shadow is missing, unless the pixels
// beside each point count too.
TEST(ScreenSpaceShadow, StepsOverWhatIsThin) {
  Scene scene = floor_scene();
  add_thing(scene, "post", post(0.008, 0.3, 12), 0, translate(glm::dvec3(0.1, 0, 0)));
  scene.cameras.front().camera_to_world = look_at({-0.1, 0.5, 0.6}, {-0.1, 0.05, 0});
  ContactFrame frame(scene);
  ScreenSpaceShadowConstants plain = with_steps({}, 8),
                             beside = with_steps(multisampled_shadow(), 8);
  plain.noise = beside.noise = 0;
  beside.spread = 2;
  const Found missed = frame.find(plain), found = frame.find(beside);
  std::printf("post: plain %.3f, multisampled %.3f of %d pixels\n", missed.recall(), found.recall(),
              found.truth);
  EXPECT_GT(missed.truth, 30);
  EXPECT_LT(missed.recall(), 0.6);
  EXPECT_GT(found.recall(), missed.recall() + 0.25);
}

// Rays that pass behind a thin board are taken to hit it: the more, the thicker things are taken to
// be.
TEST(ScreenSpaceShadow, ThicknessIsAHaloBehindThings) {
  Scene scene = floor_scene();
  add_box(scene, "board", {-0.2, 0, 0}, {0.2, 0.25, 0.004}, 0);
  ContactFrame frame(scene);
  ScreenSpaceShadowConstants thin = with_steps({}, 64), thick = thin;
  thin.thickness = 0.01f;
  thick.thickness = 0.3f;
  const int few = frame.find(thin).wrong(), many = frame.find(thick).wrong();
  std::printf("wrong: %d with 1 cm, %d with 30 cm\n", few, many);
  EXPECT_LT(few, 20);
  EXPECT_GT(many, 5 * few + 100);
}

// The box that casts the shadow stands beside the picture.
TEST(ScreenSpaceShadow, MissesWhatIsNotInThePicture) {
  Scene scene = floor_scene();
  add_box(scene, "box", {0.75, 0, -0.3}, {0.85, 0.3, 0.3}, 0);
  scene.cameras.front().vertical_fov = 0.45;
  ContactFrame frame(scene);
  const Found found = frame.find(with_steps({}, 32));
  EXPECT_GT(found.truth, 50);
  EXPECT_EQ(found.said, 0);
}

// Seen along itself and lit along itself, a plane does not shadow itself, because nothing of it
// stands above it. Without that rule it does.
TEST(ScreenSpaceShadow, APlaneAlongTheViewDoesNotShadowItself) {
  Scene scene = floor_scene({2.5, 0.12, 0.4});
  scene.cameras.front().camera_to_world = look_at({0, 0.06, 1.5}, {0.1, 0, 0});
  ContactFrame frame(scene);
  for (const ScreenSpaceShadowConstants& constants :
       {with_steps({}, 16), with_steps(multisampled_shadow(), 32),
        with_steps(multipass_shadow(), 16)}) {
    EXPECT_EQ(frame.find(constants).said, 0);
  }
  ScreenSpaceShadowConstants without = with_steps({}, 16);
  without.bias = -1;
  EXPECT_GT(frame.find(without).said, 200);
}

TEST(ScreenSpaceShadow, TakesExtremes) {
  Scene scene = thin_scene();
  scene.cameras.front().camera_to_world = look_at({0, 0.2, 1}, {0, 0.3, 0});  // the sky too
  constexpr float kNoEnd = std::numeric_limits<float>::infinity();
  ContactFrame frame(scene, "embree", 32, 18);
  const FloatImage ids = frame.read("ids");
  for (const ScreenSpaceShadowConstants& constants :
       {ScreenSpaceShadowConstants{.length = 0}, ScreenSpaceShadowConstants{.thickness = 0},
        ScreenSpaceShadowConstants{.length = kNoEnd, .thickness = kNoEnd, .steps = 64},
        ScreenSpaceShadowConstants{.steps = 1, .spread = 16},
        ScreenSpaceShadowConstants{.border = 1, .marches = 4, .threshold = 4}}) {
    const FloatImage picture = frame.march(constants);
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
      const float v = picture.values[i];
      if (i % 4 >= 2) continue;
      ASSERT_TRUE(v >= 0 && v <= 1) << v;
      if (constants.length == 0 || ids.values[i / 4 * 2] == 0) {
        ASSERT_EQ(v, 1);
      }
    }
  }
  // Nothing is thinner than nothing: only what faces away from the lamp is dark.
  EXPECT_EQ(frame.find({.thickness = 0}).said, 0);
  ContactFrame one(scene, "embree", 1, 1);
  const float v = one.march({}).values[0];
  EXPECT_TRUE(v >= 0 && v <= 1) << v;
}

// Rays and march are both there where both are named, and the march's visibility is composed, the
// same as without the rays.
TEST(ScreenSpaceShadow, TakesThePlaceOfContactShadows) {
  const Scene scene = thin_scene();
  const auto light = [&](const std::vector<std::string>& names) {
    ContactFrame frame(scene, "embree", 64, 36, names);
    EXPECT_EQ(frame.renderer->read("screen_contact").ok(), names.back() == kScreenName);
    return frame.read("local_lights").values;
  };
  const auto march = light({kScreenName}), both = light({"contact", kScreenName});
  EXPECT_EQ(both, march);
  EXPECT_NE(light({"contact"}), march);
  FrameSettings settings;
  settings.width = settings.height = 8;
  settings.effects = choose_effects({kScreenName});
  settings.effects["contact"] = find_effect(northlight_effects(), "contact")->defaults;
  const auto unnamed =
      FrameRenderer::create(rtapi::CreateDevice({}).value(), scene, settings).value();
  unnamed->render().value();
  EXPECT_FALSE(unnamed->read("contact").ok());
}

// Towards the sun, where all shadows are shorter than the march.
TEST(ScreenSpaceShadow, FindsShortShadowsOfTheSun) {
  Scene scene = floor_scene();
  scene.sun = Sun{glm::normalize(glm::vec3(1, 0.8f, 0.1f)), glm::vec3(3), 0};
  for (int i = 0; i < 4; ++i) {
    add_box(scene, "box", {-0.4 + 0.2 * i, 0, -0.1 * i}, {-0.35 + 0.2 * i, 0.15, -0.1 * i + 0.1},
            0);
  }
  ContactFrame frame(scene, "embree", kWidth, kHeight, {"sun", "screen-sun"});
  const FloatImage truth = frame.read("sun"), said = frame.read("screen_sun");
  const FloatImage ids = frame.read("ids");
  Found found;
  for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
    if (ids.values[2 * i] != 1) continue;
    const bool dark = truth.values[truth.channels * i] < 0.5f;
    const bool said_dark = said.values[said.channels * i] < 0.5f;
    found.truth += dark;
    found.said += said_dark;
    found.both += dark && said_dark;
  }
  std::printf("sun: recall %.3f precision %.3f of %d\n", found.recall(), found.precision(),
              found.truth);
  EXPECT_GT(found.truth, 100);
  EXPECT_GT(found.recall(), 0.6);
  // A pixel on each side of every shadow, because its neighbours count too.
  EXPECT_GT(found.precision(), 0.65);
}

TEST(ScreenSpaceShadow, RefusesWhatIsOutOfRange) {
  const Scene scene = floor_scene();
  const auto message = [&](const ScreenSpaceShadowConstants& constants) {
    FrameSettings settings;
    settings.width = settings.height = 8;
    settings.effects = choose_effects({kScreenName});
    settings.effects[kScreenName].set_constants(constants);
    const auto renderer =
        FrameRenderer::create(rtapi::CreateDevice({}).value(), scene, settings).value();
    const auto rendered = renderer->render();
    return rendered ? std::string() : rendered.error().message;
  };
  for (const auto& [constants, id, text] :
       {std::tuple(ScreenSpaceShadowConstants{.length = NAN}, "KA3085", "length is nan"),
        std::tuple(ScreenSpaceShadowConstants{.thickness = -1}, "KA3085", "choose 0.0"),
        std::tuple(ScreenSpaceShadowConstants{.steps = 0}, "KA3086", "choose 1 to 1024"),
        std::tuple(ScreenSpaceShadowConstants{.marches = 5}, "KA3087", "choose 1 to 4"),
        std::tuple(ScreenSpaceShadowConstants{.marches = 2, .threshold = 3}, "KA3087",
                   "threshold is 3; choose 1 to 2")}) {
    const std::string said = message(constants);
    EXPECT_NE(said.find(id), std::string::npos) << said;
    EXPECT_NE(said.find(text), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace kaamos::effects
