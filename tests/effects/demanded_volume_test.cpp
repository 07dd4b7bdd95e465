// SPDX-License-Identifier: MIT
// Tests of frames whose volume of indirect light is baked where it is read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "effects/northlight/frame_renderer.h"
#include "tests/effects/room.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

using namespace effects;

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

rtapi::Device device_of(const std::string& backend, std::uint32_t threads = 0) {
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  desc.Threads = threads;
  return device_for(desc);
}

class DemandedVolumeFrames : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, DemandedVolumeFrames, testing::Values("embree", "vulkan"),
                         backend_name);

FrameSettings settings_of(bool is_whole) {
  FrameSettings settings;
  settings.width = 48;
  settings.height = 27;
  settings.effects = choose_effects({"gi"});
  settings.effects.at("gi").samples = 16;
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  settings.moving = true;
  settings.volume.whole = is_whole;
  settings.volume.samples = 64;
  settings.volume.error = 0;
  settings.volume.lights = kBakeLocal;  // these move in the camera's space
  return settings;
}

Camera camera_at(const Scene& scene, const glm::dvec3& from, const glm::dvec3& to) {
  Camera camera = scene.cameras.front();
  camera.camera_to_world = look_at(from, to);
  return camera;
}

// Light at the end of a walk from one corner of the room to another one.
FloatImage indirect_after_walk(const rtapi::Device& device, const Scene& scene, bool is_whole,
                               std::uint64_t& first_cells, std::uint64_t& last_cells) {
  const auto renderer = FrameRenderer::create(device, scene, settings_of(is_whole)).value();
  const Camera cameras[] = {camera_at(scene, {-1.5, 2.25, 1.5}, {-1.5, 0, -1.75}),
                            camera_at(scene, {1.5, 0.75, 1.5}, {1, 2.5, -1.75}),
                            camera_at(scene, {1.5, 0.75, 1.5}, {1, 2.5, -1.75})};
  for (std::uint32_t i = 0; i < 3; ++i) {
    renderer->begin_frame({i, i / 30.0, cameras[i]}).value();
    renderer->render().value();
    last_cells = renderer->lights().bake().value().cells;
    if (i == 0) first_cells = last_cells;
    const auto& passes = renderer->runner().passes();
    const bool bakes = std::any_of(passes.begin(), passes.end(), [](const PassStatistics& pass) {
      return pass.name == "indirect light bake";
    });
    // Each frame bakes what the one before has read: the first one's rays read more than the few
    // that were traced to ask, the second one's read from another place.
    EXPECT_EQ(bakes, !is_whole && i > 0) << i;
  }
  return renderer->read("indirect").value();
}

double mean(const FloatImage& image) {
  const double sum = std::accumulate(image.values.begin(), image.values.end(), 0.0);
  return sum / static_cast<double>(image.values.size());
}

// What a camera sees after a walk is lit as by a volume that was baked whole, by far fewer cells.
TEST_P(DemandedVolumeFrames, FollowTheCamera) {
  const Scene scene = make_room();
  std::uint64_t first = 0, last = 0, all = 0, still_all = 0;
  const FloatImage demanded = indirect_after_walk(device_of(GetParam()), scene, false, first, last);
  const FloatImage whole = indirect_after_walk(device_of(GetParam()), scene, true, all, still_all);
  EXPECT_EQ(all, still_all);
  EXPECT_GT(last, first) << "the second view reads other cells";
  EXPECT_LT(last, all);
  EXPECT_GT(mean(whole), 0.01);
  EXPECT_NEAR(mean(demanded), mean(whole), 0.05 * mean(whole));
}

TEST(DemandedVolumes, AreTheSameForAnyNumberOfThreads) {
  const Scene scene = make_room();
  std::uint64_t first = 0, last = 0;
  const FloatImage one = indirect_after_walk(device_of("embree", 1), scene, false, first, last);
  const FloatImage four = indirect_after_walk(device_of("embree", 4), scene, false, first, last);
  EXPECT_TRUE(one.values == four.values);
}

}  // namespace
}  // namespace kaamos::test
