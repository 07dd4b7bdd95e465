// SPDX-License-Identifier: MIT
// Hybrid shadows against the closed form of penumbras, and against hard rays and soft maps alone.
#include "effects/shadows/hybrid_shadow/hybrid_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "effects/assets/scene/staging.h"
#include "effects/shadows/shadow_map/map_fixture.h"

namespace kaamos::effects {
namespace {

constexpr PeterPanningDesc kWideSun = {.angular_radius = 0.04};
constexpr ShadowMapConstants kPcss = {.method = kShadowMapPcss,
                                      .flags = kShadowMapReceiverPlane,
                                      .size = 1024,
                                      .constant_bias = 0.5f,
                                      .slope_bias = 0.0f,
                                      .radius = 0.3f,
                                      .taps = 64,
                                      .blocker_taps = 36};

MapFrame::Change with(float soft_from, std::uint32_t more_flags = 0, std::uint32_t size = 1024) {
  return [=](const std::string& name, EffectSettings& settings) {
    HybridShadowConstants constants = {kPcss, soft_from};
    constants.map.size = size;
    constants.map.flags |= more_flags;
    if (name == "sun-hybrid") settings.set_constants(constants);
    if (name == "sun-pcss") settings.set_constants(constants.map);
  };
}

// Sees the floor below a sheet 1 m (part 2) or 0.25 m (part 0) above it, where its shadow ends.
Scene sheets(int part, const PeterPanningDesc& desc = kWideSun) {
  Scene scene = make_peter_panning(desc);
  scene.instances[0].transform[0] *= 0.1;
  scene.instances[0].transform[2] *= 0.1;
  const double z = kSheetPartZ[part];
  scene.cameras.front().camera_to_world =
      look_at({kSheetShadowX, 0.7, z}, {kSheetShadowX, 0, z}, {0, 0, -1});
  return scene;
}

double error_of(MapFrame& frame, int part, const std::string& layer) {
  const FloatImage said = frame.read(layer);
  double sum = 0;
  int count = 0;
  for (const std::size_t i : frame.floor()) {
    const glm::dvec3 p = frame.position(i);
    if (std::abs(p.z - kSheetPartZ[part]) > 0.1 || std::abs(p.x - kSheetShadowX) > 0.25) continue;
    const double off = said.values[said.channels * i] - sheet_visibility(kWideSun, part, p.x);
    sum += off * off;
    ++count;
  }
  EXPECT_GT(count, 200);
  return std::sqrt(sum / count);
}

class HybridShadows : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, HybridShadows, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// From the distance on where it is to be soft it says what PCSS says; everywhere, if that is far
// enough away, what a ray says.
TEST_P(HybridShadows, GoFromTheRayToTheMap) {
  const std::vector<std::string> names = {"sun", "sun-pcss", "sun-hybrid"};
  PeterPanningDesc point_sun = kWideSun;
  point_sun.angular_radius = 0;
  MapFrame soft(sheets(2), names, with(0.5f), 1, 64, 36, GetParam());
  EXPECT_EQ(soft.read("sun_hybrid").values, soft.read("sun_pcss").values)
      << "the sheet is more than 0.5 m away";
  MapFrame hard(sheets(2), {"sun-hybrid"}, with(1e9f), 1, 64, 36, GetParam());
  MapFrame rays(sheets(2, point_sun), {"sun"}, with(0), 1, 64, 36, GetParam());
  const FloatImage hybrid = hard.read("sun_hybrid"), ray = rays.read("sun");
  for (const std::size_t i : hard.floor()) {
    ASSERT_NEAR(hybrid.values[hybrid.channels * i], ray.values[ray.channels * i], 1e-6) << i;
  }
}

// Below a sheet in 1 m it is what the map is. Of legs, seats and what touches the floor it is
// better than a map with wide texels, and than a map or rays alone.
TEST(HybridShadow, IsGoodNearAndFar) {
  MapFrame far(sheets(2), {"sun-pcss", "sun-hybrid"}, with(0.5f), 1, 64, 36, "embree");
  EXPECT_LT(error_of(far, 2, "sun_hybrid"), 0.05);
  EXPECT_NEAR(error_of(far, 2, "sun_hybrid"), error_of(far, 2, "sun_pcss"), 1e-6);

  Scene scene = make_peter_panning({});
  scene.instances[0].transform[0] *= 0.1;
  scene.instances[0].transform[2] *= 0.1;
  const std::vector<std::string> names = {"sun", "sun-pcss", "sun-hybrid"};
  const auto errors = [&](float soft_from, std::uint32_t size) {
    MapFrame frame(scene, names, with(soft_from, 0, size), 64, 64, 36, "embree");
    return std::array<double, 2>{frame.difference("sun", "sun_pcss"),
                                 frame.difference("sun", "sun_hybrid")};
  };
  const auto rough = errors(2, 256), fine = errors(2, 1024), rays = errors(1e9f, 1024);
  EXPECT_LT(rough[1], 0.6 * rough[0]);
  EXPECT_LT(fine[1], 0.9 * fine[0]);
  EXPECT_LT(fine[1], 0.9 * rays[1]);
}

// Soft shadows that reach farther than hard ones put a halo around these, except with the inner
// penumbra.
TEST(HybridShadow, InnerPenumbraStaysInTheRaysShadow) {
  PeterPanningDesc point_sun = kWideSun;
  point_sun.angular_radius = 0;
  MapFrame rays(sheets(2, point_sun), {"sun"}, with(0), 1, 64, 36, "embree");
  const FloatImage ray = rays.read("sun");
  int outside[2] = {}, inside[2] = {};
  for (const std::uint32_t flags : {0u, std::uint32_t{kShadowMapInnerPenumbra}}) {
    MapFrame frame(sheets(2), {"sun-hybrid"}, with(0.5f, flags), 1, 64, 36, "embree");
    const FloatImage said = frame.read("sun_hybrid");
    for (const std::size_t i : frame.floor()) {
      const float value = said.values[said.channels * i];
      if (!(value > 0) || value == 1) continue;
      ++(ray.values[ray.channels * i] == 1 ? outside : inside)[flags != 0];
    }
  }
  EXPECT_GT(outside[0], 20);
  EXPECT_EQ(outside[1], 0);
  EXPECT_GT(inside[1], 20);
}

TEST(HybridShadow, ExtremesAreHardOrRefused) {
  PeterPanningDesc point_sun = kWideSun;
  point_sun.angular_radius = 0;
  MapFrame frame(sheets(0, point_sun), {"sun", "sun-hybrid"}, with(0), 1, 64, 36, "embree");
  EXPECT_LT(frame.difference("sun", "sun_hybrid"), 1e-6) << "a sun that is a point";

  const Scene scene = sheets(0);
  FrameSettings settings;
  settings.width = settings.height = 8;
  settings.effects = choose_effects({"sun-hybrid"});
  settings.effects["sun-hybrid"].set_constants(HybridShadowConstants{kPcss, -1.0f});
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  const auto refused = renderer->render();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("soft_from is -1"), std::string::npos)
      << refused.error().message;
}

}  // namespace
}  // namespace kaamos::effects
