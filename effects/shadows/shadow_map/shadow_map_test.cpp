// SPDX-License-Identifier: MIT
// Shadow maps against ray traced shadows and closed forms, and how each fails.
#include "effects/shadows/shadow_map/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "effects/assets/built_in/foliage.h"
#include "effects/shadows/shadow_map/map_fixture.h"

namespace kaamos::effects {
namespace {

// The floor is smaller than the scene's, so that a texel of 1024 is some 6 mm.
Scene small_floor(const PeterPanningDesc& desc) {
  Scene scene = make_peter_panning(desc);
  scene.instances[0].transform[0] *= 0.1;
  scene.instances[0].transform[2] *= 0.1;
  return scene;
}

constexpr PeterPanningDesc kHardSun = {.angular_radius = 0};

class ShadowMaps : public test::OnBackends {};

std::string map_backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

INSTANTIATE_TEST_SUITE_P(Backends, ShadowMaps, testing::Values("embree", "vulkan"),
                         map_backend_name);

// Only along the edges of shadows, about a texel wide, a map says something else than rays. That is
// also E10: depth is linear, and lit is what is not farther away than the map says. As the survey
// puts it, with the reversed depth of the frame, shadows are lit, and rounding decides which of the
// lit places are.
TEST_P(ShadowMaps, SayWhatRaysSay) {
  const ShadowMapConstants fine = {.size = 2048};
  MapFrame right(small_floor(kHardSun), {"sun", "sun-map"}, &fine, 1, 64, 36, GetParam());
  EXPECT_LT(right.difference("sun", "sun_map"), 0.12);
  const ShadowMapConstants survey = {.flags = kShadowMapSurveyRule, .size = 2048};
  MapFrame wrong(small_floor(kHardSun), {"sun", "sun-map"}, &survey, 1, 64, 36, GetParam());
  EXPECT_GT(wrong.difference("sun", "sun_map"), std::sqrt(0.5));
}

// Cascades with the penumbra's search and filter, and with backprojection: rendered twice the same,
// and on Vulkan but for rounding at the edges of texels.
TEST_P(ShadowMaps, SoftCascadesAreTheSame) {
  const auto soft = [](const std::string& name, EffectSettings& settings) {
    ShadowMapConstants constants = {.method = kShadowMapPcss,
                                    .flags = kShadowMapReceiverPlane,
                                    .size = 256,
                                    .cascades = 3,
                                    .constant_bias = 0.5f,
                                    .slope_bias = 0,
                                    .radius = 0.25f};
    if (name == "sun-backprojection") constants.method = kShadowMapBackprojection;
    settings.set_constants(constants);
  };
  FloatImage said[2][2];
  for (int i = 0; i < 2; ++i) {
    MapFrame frame(make_peter_panning({}), {"sun-cascades", "sun-backprojection"}, soft, 1, 64, 36,
                   i == 0 ? "embree" : GetParam());
    said[0][i] = frame.read("sun_cascades");
    said[1][i] = frame.read("sun_backprojection");
  }
  for (const auto& [one, two] : said) {
    std::size_t other = 0, partly = 0;
    for (std::size_t i = 0; i < one.values.size(); i += one.channels) {
      other += std::abs(one.values[i] - two.values[i]) > 1e-4;
      partly += one.values[i] > 0 && one.values[i] < 1;
    }
    EXPECT_LE(other, GetParam() == "embree" ? 0u : 64u * 36 / 50) << other;
    EXPECT_GT(partly, 10u);
  }
}

// Leaves have holes in their texture, and their shadows have them, too: without them the mean would
// be 0.06 less.
TEST(ShadowMap, SeesHolesInMaterials) {
  const ShadowMapConstants fine = {.size = 2048};
  MapFrame frame(make_foliage({}), {"sun", "sun-map"}, &fine, 16);
  EXPECT_NEAR(frame.mean("sun_map"), frame.mean("sun"), 0.02);
}

struct BiasErrors {
  double acne = 0;  // share of lit floor that is dark
  double gap = 0;   // share of shadow that is lit
};

BiasErrors bias_errors(ShadowMapConstants constants) {
  Scene scene = small_floor(kHardSun);
  scene.cameras.front().camera_to_world = look_at({-0.5, 0.15, 1.35}, {0.05, 0, 1.35});
  constants.size = 1024;
  MapFrame frame(scene, {"sun-map"}, &constants);
  const FloatImage map = frame.read("sun_map");
  int lit = 0, dark = 0, shadow = 0, bright = 0;
  for (const std::size_t i : frame.floor()) {
    const glm::dvec3 p = frame.position(i);
    const FloorLight light = floor_light(kHardSun, {p.x, p.z}, 0.015);
    lit += light == FloorLight::kLit;
    dark += light == FloorLight::kLit && map.values[4 * i] == 0;
    shadow += light == FloorLight::kShadow;
    bright += light == FloorLight::kShadow && map.values[4 * i] == 1;
  }
  EXPECT_GT(lit, 200);
  EXPECT_GT(shadow, 50);
  return {static_cast<double>(dark) / lit, static_cast<double>(bright) / shadow};
}

// Too little of each bias speckles the lit floor, too much of it lets the shadow of the sole come
// loose. The plane of the surface at each texel needs next to none. [survey 5.1.1]
TEST(ShadowMap, EveryBiasFailsBothWays) {
  const BiasErrors none = bias_errors({.constant_bias = 0, .slope_bias = 0});
  EXPECT_GT(none.acne, 0.25);
  const ShadowMapConstants little[] = {
      {.constant_bias = 0.3f, .slope_bias = 0},
      {.constant_bias = 0, .slope_bias = 0.15f},
      {.constant_bias = 0, .slope_bias = 0, .normal_offset = 0.3f},
  };
  const ShadowMapConstants much[] = {
      {.constant_bias = 30, .slope_bias = 0, .most_bias = 100},
      {.constant_bias = 0, .slope_bias = 15, .most_bias = 100},
      {.constant_bias = 0, .slope_bias = 0, .normal_offset = 20},
  };
  for (int i = 0; i < 3; ++i) {
    const BiasErrors few = bias_errors(little[i]), many = bias_errors(much[i]);
    EXPECT_GT(few.acne, 0.02) << i;
    EXPECT_EQ(many.acne, 0.0) << i;
    EXPECT_GT(many.gap, 0.5) << i;
    EXPECT_LT(few.gap, 0.1) << i;
  }
  const BiasErrors plane =
      bias_errors({.flags = kShadowMapReceiverPlane, .constant_bias = 0.1f, .slope_bias = 0});
  EXPECT_EQ(plane.acne, 0.0);
  EXPECT_LT(plane.gap, 0.1);
}

TEST(ShadowMap, TakesExtremes) {
  Scene scene = small_floor(kHardSun);
  // Hardly over the horizon.
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(1, 0.0017f, 0));
  for (const ShadowMapConstants& constants :
       {ShadowMapConstants{.size = 4}, ShadowMapConstants{.constant_bias = 0, .slope_bias = 0},
        ShadowMapConstants{.constant_bias = 1e9f, .most_bias = 1e9f},
        ShadowMapConstants{.normal_offset = 1e9f},
        ShadowMapConstants{.cascades = 4, .reach = 0.01f}}) {
    MapFrame frame(scene, {"sun-map"}, &constants, 1, 16, 9);
    for (const float value : frame.read("sun_map").values) {
      EXPECT_TRUE(value == 0.0f || value == 1.0f);
    }
  }
  const ShadowMapConstants tiny = {.size = 16};
  MapFrame one(scene, {"sun-map"}, &tiny, 1, 1, 1);
  EXPECT_TRUE(std::isfinite(one.read("sun_map").values[0]));
}

TEST(ShadowMap, RefusesWhatIsOutOfRange) {
  const auto message = [](const ShadowMapConstants& constants) {
    FrameSettings settings;
    settings.width = settings.height = 8;
    settings.effects = choose_effects({"sun-map"});
    settings.effects["sun-map"].set_constants(constants);
    const Scene scene = small_floor({});
    const auto renderer =
        FrameRenderer::create(rtapi::CreateDevice({}).value(), scene, settings).value();
    const auto rendered = renderer->render();
    return rendered ? std::string() : rendered.error().message;
  };
  for (const auto& [constants, text] :
       {std::pair(ShadowMapConstants{.size = 3}, "size is 3; choose 4 to 16384"),
        std::pair(ShadowMapConstants{.cascades = 5}, "cascades is 5; choose 0 to 4"),
        std::pair(ShadowMapConstants{.taps = 65}, "taps is 65; choose 1 to 64"),
        std::pair(ShadowMapConstants{.blend = NAN}, "blend is nan; choose 0.0")}) {
    const std::string said = message(constants);
    EXPECT_NE(said.find(text), std::string::npos) << said;
    EXPECT_NE(said.find("KA3060"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace kaamos::effects
