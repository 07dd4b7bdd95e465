// SPDX-License-Identifier: MIT
//
// Opacity micromaps of alpha-tested materials: the frame is the same, and any-hit shaders run less.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/assets/built_in/foliage.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

using namespace effects;

struct Frame {
  std::map<std::string, FloatImage> layers;
  std::uint64_t any_hit_calls = 0;
  MicromapStatistics micromaps;
};

Frame render(const Scene& scene, const std::vector<std::string>& effects, std::uint32_t states,
             bool moving = false, const std::string& backend = "embree") {
  rtapi::DeviceDesc device;
  device.Backend = backend;
  device.CollectStatistics = true;
  device.Checked = backend != "vulkan";  // lavapipe takes long to compile what is checked
  device.OnMessage = [](const rtapi::Message& message) { ADD_FAILURE() << message.Text; };
  FrameSettings settings;
  settings.width = 64;
  settings.height = 36;
  settings.effects = choose_effects(effects);
  settings.whole_frame = need_whole_frame(settings.effects);
  settings.structures.opacity_micromaps = states;
  settings.moving = moving;
  auto renderer =
      FrameRenderer::create(rtapi::CreateDevice(device).value(), scene, settings).value();
  renderer->render().value();
  Frame out;
  for (const std::string& layer : renderer->layers()) {
    out.layers[layer] = renderer->read(layer).value();
  }
  for (const PassStatistics& pass : renderer->runner().passes()) {
    out.any_hit_calls += pass.rays.AnyHitInvocations;
  }
  if (const auto& micromaps = renderer->context().gpu.micromaps) {
    out.micromaps = micromaps->statistics;
  }
  return out;
}

void expect_equal(const Frame& with, const Frame& without) {
  for (const auto& [name, image] : without.layers) {
    EXPECT_EQ(with.layers.at(name).values, image.values) << name;
  }
}

// Each any-hit call that is left is one that there was before, too.
void expect_the_hedge_as_it_is(const std::string& backend) {
  const Scene scene = make_foliage({.twigs = 12});
  const Frame without = render(scene, {"ao", "sun"}, 0, false, backend);
  ASSERT_GT(without.any_hit_calls, 1000u);
  for (const bool moving : {false, true}) {
    const Frame with = render(scene, {"ao", "sun"}, 4, moving, backend);
    expect_equal(with, without);
    EXPECT_LT(with.any_hit_calls, without.any_hit_calls / 2);
    EXPECT_EQ(with.micromaps.geometries, 1u);
    EXPECT_EQ(with.micromaps.triangles, 2u * kLeavesOfTwig);
    EXPECT_EQ(with.micromaps.micromaps, 2u);  // all cards show the whole leaf
  }
}

// With two states no any-hit shader runs, and only the leaves' edges are elsewhere.
void expect_no_any_hit_shaders(const std::string& backend) {
  const Scene scene = make_foliage({.twigs = 12});
  const Frame without = render(scene, {"sun"}, 0, false, backend);
  const Frame with = render(scene, {"sun"}, 2, false, backend);
  EXPECT_EQ(with.any_hit_calls, 0u);
  const std::vector<float>& a = with.layers.at("view_z").values;
  const std::vector<float>& b = without.layers.at("view_z").values;
  std::size_t others = 0;
  for (std::size_t i = 0; i < a.size(); ++i) others += a[i] != b[i] ? 1 : 0;
  EXPECT_GT(others, 0u);
  EXPECT_LT(others, a.size() / 20);
}

TEST(Micromaps, FourStatesLeaveTheHedgeAsItIs) {
  expect_the_hedge_as_it_is("embree");
}

TEST(VulkanMicromaps, FourStatesLeaveTheHedgeAsItIs) {
  KAAMOS_NEED_VULKAN();
  expect_the_hedge_as_it_is("vulkan");
}

TEST(Micromaps, TwoStatesNeedNoAnyHitShaders) {
  expect_no_any_hit_shaders("embree");
}

TEST(VulkanMicromaps, TwoStatesNeedNoAnyHitShaders) {
  KAAMOS_NEED_VULKAN();
  expect_no_any_hit_shaders("vulkan");
}

// Every effect of the registry that a frame has, glass among them, which keeps its any-hit shaders.
TEST(Micromaps, FourStatesLeaveTheLoungeAsItIs) {
  const Scene scene = make_lounge();
  const Frame without = render(scene, {"all"}, 0), with = render(scene, {"all"}, 4);
  expect_equal(with, without);
  EXPECT_LT(with.any_hit_calls, without.any_hit_calls);
}

}  // namespace
}  // namespace kaamos::test
