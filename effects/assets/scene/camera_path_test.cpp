// SPDX-License-Identifier: MIT
#include "effects/assets/scene/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "effects/assets/built_in/camera_paths.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/runner.h"

namespace kaamos::effects {
namespace {

TEST(CameraPath, BuiltInOnesStartAtTheScenesCameraAndAreSmooth) {
  for (const Scene& scene : {make_lounge(), make_runner_scene()}) {
    for (const char* name : {"still", "dolly", "orbit"}) {
      const CameraPath path = make_camera_path(scene, name).value();
      const Camera& camera = scene.cameras.front();
      glm::dvec3 before = camera.position();
      double longest = 0;
      for (int i = 0; i < 61; ++i) {
        const Camera now = evaluate_camera(path, camera, i / 30.0);
        if (i == 0) {
          EXPECT_LT(glm::length(now.position() - before), 1e-9);
          EXPECT_GT(glm::dot(now.forward(), camera.forward()), 0.999) << name;
        }
        longest = std::max(longest, glm::length(now.position() - before));
        before = now.position();
        if (scene.name == "lounge") {  // inside the room
          EXPECT_LT(std::abs(before.x), 5.9);
          EXPECT_LT(std::abs(before.z), 4.9);
        }
      }
      const bool still = std::string(name) == "still";
      EXPECT_EQ(longest == 0, still) << name;
      EXPECT_LT(longest, 0.15) << scene.name << " " << name;
      if (!still) {
        EXPECT_GT(glm::length(before - camera.position()), 0.5);
      }
    }
  }
  EXPECT_EQ(make_camera_path(make_lounge(), "").value().name, "dolly");
  EXPECT_EQ(make_camera_path(make_runner_scene(), "").value().name, "still");
  const auto unknown = make_camera_path(make_runner_scene(), "roundabout");
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("\"roundabout\": there are still, dolly, orbit"),
            std::string::npos);
}

TEST(CameraPath, FilesAreRead) {
  const CameraPath path = parse_camera_path(
                              "# a comment\n\n"
                              "0  0 1 5  0 1 0\n"
                              "1\t2 1 5  2 1 0  # one second\r\n"
                              "2  4 1 5  4 1 0  fov=90\n"
                              "3  0 3 0  0 3 9  cut\n"
                              "4  0 4 0  0 4 9",
                              "keys")
                              .value();
  ASSERT_EQ(path.keys.size(), 5u);
  Camera camera;
  camera.vertical_fov = 0.5;
  const auto at = [&](double s) { return evaluate_camera(path, camera, s); };
  EXPECT_LT(glm::length(at(-1).position() - glm::dvec3(0, 1, 5)), 1e-12);
  EXPECT_LT(glm::length(at(1).position() - glm::dvec3(2, 1, 5)), 1e-12);
  EXPECT_LT(glm::length(at(1.5).position() - glm::dvec3(3, 1, 5)), 0.2);
  EXPECT_NEAR(at(2).vertical_fov, std::acos(0.0), 1e-12);
  EXPECT_NEAR(at(1).vertical_fov, 0.5, 1e-12);
  // The camera stands still before the cut and is elsewhere after it.
  EXPECT_LT(glm::length(at(2.9).position() - glm::dvec3(4, 1, 5)), 1e-12);
  EXPECT_LT(glm::length(at(3.5).position() - glm::dvec3(0, 3.5, 0)), 1e-12);
  EXPECT_NEAR(at(3.5).forward().z, 1, 1e-12);
  EXPECT_LT(glm::length(at(99).position() - glm::dvec3(0, 4, 0)), 1e-12);
  EXPECT_FALSE(has_cut(path, 2.0, 2.9));
  EXPECT_TRUE(has_cut(path, 2.9, 3.0));
  EXPECT_FALSE(has_cut(path, 3.0, 4.0));
}

TEST(CameraPath, MistakesAreNamed) {
  const std::tuple<const char*, const char*> cases[] = {
      {"", "keys: no position"},
      {"# nothing\n", "keys: no position"},
      {"0 0 1 5 0 1", "keys:1: 6 values, 7 expected"},
      {"0 0 1 5 0 1 0\n0 0 1 5 0 1 0", "keys:2: times must rise"},
      {"0 0 1 x 0 1 0", "keys:1: \"x\" is not a number"},
      {"0 0 1 1e300 0 1 0", "keys:1: \"1e300\" is not a number from -1e9 to 1e9"},
      {"0 0 1 nan 0 1 0", "keys:1: \"nan\""},
      {"0 0 1 5 0 1 5", "keys:1: the eye stands in its target"},
      {"0 0 1 5 0 1 0 fov=180", "keys:1: \"fov=180\" is neither"},
      {"0 0 1 5 0 1 0 jump", "keys:1: \"jump\" is neither \"cut\" nor"}};
  for (const auto& [text, expected] : cases) {
    const auto path = parse_camera_path(text, "keys");
    ASSERT_FALSE(path.ok()) << text;
    EXPECT_NE(path.error().message.find(expected), std::string::npos) << path.error().message;
  }
  EXPECT_FALSE(load_camera_path("no/such/file").ok());
}

}  // namespace
}  // namespace kaamos::effects
