// SPDX-License-Identifier: MIT
// Where probes of environment maps are put.
#include "effects/reflections/environment_map/probe_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "effects/reflections/environment_map/environment_map.h"
#include "effects/reflections/screen_space/screen_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

class ProbePlaces : public test::OnBackends {};

std::unique_ptr<FrameRenderer> make_renderer(const std::string& backend, const Scene& scene) {
  FrameSettings settings;
  settings.width = 48;
  settings.height = 32;
  settings.moving = true;
  settings.effects = choose_effects({"env-map", "reflections"});
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = backend;
  return FrameRenderer::create(test::device_for(device), scene, settings).value();
}

std::vector<EnvironmentProbe> find(const std::string& backend, const Scene& scene,
                                   std::uint32_t most = 4) {
  const auto renderer = make_renderer(backend, scene);
  const auto library = environment_bake_library().value();
  PassViews views = renderer->frame().create_pass_views(renderer->device()).value();
  const EffectSettings settings;
  SharedParts shared;
  const EffectScope scope{
      renderer->device(),
      renderer->queue(),
      renderer->frame(),
      scene,
      renderer->context().gpu,
      [&](const std::string&) -> const rtapi::ShaderLibrary& { return library; },
      views,
      settings,
      shared};
  return find_environment_probes(scope, most).value();
}

// Two rooms of 4 x 3 x 4 m with a doorway; the camera is in the left one. Walls shine in red on the
// left and blue on the right; the floor is a mirror.
Scene make_two_rooms() {
  Scene scene = make_mirror_floor();
  scene.instances.clear();
  add_shining_patch(scene, {-4, 0, 2}, {8, 0, 0}, {0, 0, -4}, glm::vec3(0));
  scene.materials.back() = scene.materials.front();
  for (const double x : {-4.0, 0.0}) {
    const glm::vec3 light = x < 0 ? glm::vec3(1, 0.1, 0.1) : glm::vec3(0.1, 0.1, 1);
    add_shining_patch(scene, {x, 0, -2}, {4, 0, 0}, {0, 3, 0}, light);
    add_shining_patch(scene, {x + 4, 0, 2}, {-4, 0, 0}, {0, 3, 0}, 0.5f * light);
    add_shining_patch(scene, {x, 3, -2}, {4, 0, 0}, {0, 0, 4}, 0.7f * light);
  }
  add_shining_patch(scene, {-4, 0, 2}, {0, 0, -4}, {0, 3, 0}, {1, 1, 0});
  add_shining_patch(scene, {4, 0, -2}, {0, 0, 4}, {0, 3, 0}, {0, 1, 1});
  add_shining_patch(scene, {0, 0, -0.9}, {0, 0, 2.9}, {0, 3, 0}, {0, 1, 0});
  scene.cameras.front().camera_to_world =
      look_at(glm::dvec3(-3.5, 2, 1.6), glm::dvec3(0.5, 0.4, -1.6));
  return scene;
}

TEST_P(ProbePlaces, EachRoomHasProbesInItsOwnWalls) {
  const auto probes = find(GetParam(), make_two_rooms());
  ASSERT_EQ(probes.size(), 4u);
  for (const EnvironmentProbe& probe : probes) {
    const double left = probe.position.x < 0 ? -4 : 0;
    const glm::dvec3 low(left, 0, -2), high(left + 4, 3, 2);
    EXPECT_LT(glm::distance(probe.box_min, low), 1e-4) << probe.box_min.x;
    EXPECT_LT(glm::distance(probe.box_max, high), 1e-4) << probe.box_max.x;
  }
  const auto is_left = [](const EnvironmentProbe& probe) { return probe.position.x < 0; };
  EXPECT_EQ(std::count_if(probes.begin(), probes.end(), is_left), 2);
}

TEST_P(ProbePlaces, RoomsShareAsManyAsAreWanted) {
  EXPECT_EQ(find(GetParam(), make_two_rooms(), 1).size(), 1u);
  EXPECT_EQ(find(GetParam(), make_two_rooms(), 2).size(), 2u);
  EXPECT_EQ(find(GetParam(), make_two_rooms(), 8).size(), 8u);
}

// A room without a door is none for the camera, and the inside of a block is none either.
TEST_P(ProbePlaces, NoneIsWhereNothingLeads) {
  Scene closed = make_two_rooms();
  add_shining_patch(closed, {0, 0, -2}, {0, 0, 1.1}, {0, 3, 0}, {0, 1, 0});
  for (const EnvironmentProbe& probe : find(GetParam(), closed)) EXPECT_LT(probe.position.x, 0);
  Scene filled = make_two_rooms();
  add_shining_box(filled, {1.9, 1.4, 1.9}, {2, 1.5, 0}, glm::vec3(1));
  for (const EnvironmentProbe& probe : find(GetParam(), filled)) EXPECT_LT(probe.position.x, 0);
}

// The camera walks into the right room, whose walls its first place hardly saw.
TEST_P(ProbePlaces, SeveralShowBothRoomsBetterThanTheFirstPlaceOfTheCamera) {
  Scene scene = make_two_rooms();
  FrameMoment moment;
  moment.camera = scene.cameras.front();
  moment.camera.camera_to_world = look_at(glm::dvec3(3.5, 2, 1.6), glm::dvec3(2.5, 0.2, -1.6));
  const auto error = [&] {
    const auto renderer = make_renderer(GetParam(), scene);
    renderer->begin_frame(moment).value();
    renderer->render().value();
    FloatImage seen = renderer->read("env_map").value();
    FloatImage rays = renderer->read("reflection").value();
    const FloatImage ids = renderer->read("ids").value();
    for (std::size_t i = 0; i < seen.values.size(); ++i) {
      // The floor alone is a mirror.
      if (ids.values[i / seen.channels * ids.channels] != 1) seen.values[i] = rays.values[i] = 0;
    }
    return rmse_of(seen, rays);
  };
  const double found = error();
  scene.probes = {camera_probe(scene)};
  const double own = error();
  EXPECT_LT(found, 0.7 * own) << found << " against " << own;
}

// No length is the search's own, and nothing is above the floor but the camera.
TEST(ProbePlacesOfFloors, AreThoseOfTheSceneAtEveryScale) {
  const auto probes = find("embree", make_mirror_floor());
  const EnvironmentProbe own = camera_probe(make_mirror_floor());
  EXPECT_EQ(own.position, make_mirror_floor().cameras.front().position());
  for (const EnvironmentProbe& probe : probes) {
    EXPECT_TRUE(glm::all(glm::lessThan(probe.box_min, probe.position)));
    EXPECT_TRUE(glm::all(glm::lessThan(probe.position, probe.box_max)));
    EXPECT_GT(probe.box_max.y, 3 * own.position.y) << "the sky is far away";
  }
  for (const double s : {0x1p-10, 0x1p10}) {
    Scene scene = make_mirror_floor();
    for (Instance& instance : scene.instances) {
      instance.transform = glm::dmat4(glm::dmat3(s)) * instance.transform;
    }
    glm::dmat4& eye = scene.cameras.front().camera_to_world;
    eye[3] = glm::dvec4(glm::dvec3(eye[3]) * s, 1);
    const auto scaled = find("embree", scene);
    ASSERT_EQ(scaled.size(), probes.size());
    for (std::size_t i = 0; i < probes.size(); ++i) {
      EXPECT_EQ(scaled[i].position, probes[i].position * s);
      EXPECT_EQ(scaled[i].box_min, probes[i].box_min * s);
      EXPECT_EQ(scaled[i].box_max, probes[i].box_max * s);
    }
    EXPECT_EQ(camera_probe(scene).box_max, own.box_max * s);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ProbePlaces, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
