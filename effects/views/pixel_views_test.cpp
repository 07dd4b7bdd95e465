// SPDX-License-Identifier: MIT
// Views of what the frame holds for each pixel, and the registry of all views.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "effects/views/views_fixture.h"

namespace kaamos::effects {
namespace {

class PixelViews : public test::OnBackends {};

// Calls check(x, y) for every pixel.
template <class Check>
void for_each_pixel(Check check) {
  for (std::uint32_t y = 0; y < kViewHeight; ++y) {
    for (std::uint32_t x = 0; x < kViewWidth; ++x) check(x, y);
  }
}

// Returns where the camera sees a point, pixels.
glm::dvec2 project(const Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 p(glm::inverse(camera.camera_to_world) * glm::dvec4(point, 1));
  const double scale = 0.5 * kViewHeight / std::tan(0.5 * camera.vertical_fov) / -p.z;
  return {0.5 * kViewWidth + p.x * scale, 0.5 * kViewHeight - p.y * scale};
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - (a + t * (b - a)));
}

TEST_P(PixelViews, EdgesStandWhereTheBoxesOfInstancesProject) {
  Scene scene = make_bare_floor();
  scene.meshes.clear();
  scene.instances.clear();
  const glm::dvec3 half(0.3, 0.5, 0.2);
  const std::uint32_t mesh = add_mesh(scene, "box", box(half), 0);
  const std::uint32_t other = add_mesh(scene, "ball", ball(0.3, 12, 8), 0);
  add_instance(scene, "left", mesh, translate({-0.8, 0.5, 0}) * rotate_y(0.4));
  add_instance(scene, "right", mesh, translate({0.7, 0.4, -0.3}) * rotate_x(0.3));
  add_instance(scene, "ball", other, translate({0.1, 1.1, 0}));
  const auto renderer =
      make_view_renderer(scene, {GetParam(), {"ao"}, DenoiseMethod::kNone, {}, false});
  renderer->render().value();
  const FloatImage seen = see(*renderer, "bottom-levels");
  std::vector<std::pair<glm::dvec2, glm::dvec2>> edges;
  for (const Instance& instance : scene.instances) {
    const glm::dvec3 size = instance.mesh == mesh ? half : glm::dvec3(0.3);
    for (int i = 0; i < 8; ++i) {
      for (int bit = 1; bit < 8; bit *= 2) {
        if ((i & bit) != 0) continue;
        const auto corner = [&](int k) {
          const glm::dvec3 side((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1,
                                (k & 4) != 0 ? 1 : -1);
          return project(scene.cameras.front(),
                         glm::dvec3(instance.transform * glm::dvec4(side * size, 1)));
        };
        edges.emplace_back(corner(i), corner(i | bit));
      }
    }
  }
  const auto reach = [&](std::uint32_t x, std::uint32_t y) {
    double least = 1e9;
    for (const auto& [a, b] : edges) {
      least = std::min(least, distance_to_segment({x + 0.5, y + 0.5}, a, b));
    }
    return least;
  };
  const std::map<float, float> levels = {{1, 1}, {2, 1}, {3, 2}};  // by instance + 1
  int drawn = 0;
  for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
    if (seen.at(x, y, 1) > 0) {
      EXPECT_EQ(seen.at(x, y, 0), levels.at(seen.at(x, y, 1))) << x << ", " << y;
    }
    if (seen.at(x, y, 3) == 0) return;
    ++drawn;
    EXPECT_LT(reach(x, y), 0.75) << "no edge is at " << x << ", " << y;
  });
  // Against the sky nothing hides an edge: those of the ball's box that do not cross it.
  EXPECT_GT(drawn, 80);
  for (const auto& [a, b] : edges) {
    const glm::dvec2 middle = 0.5 * (a + b);
    const auto x = static_cast<std::uint32_t>(middle.x), y = static_cast<std::uint32_t>(middle.y);
    if (x >= kViewWidth || y >= kViewHeight || seen.at(x, y, 1) > 0) continue;
    float near = 0;
    for (const std::uint32_t i : {x - 1, x, x + 1}) near = std::max(near, seen.at(i, y, 3));
    EXPECT_EQ(near, 1) << "an edge is missing at " << x << ", " << y;
  }
}

TEST_P(PixelViews, AClusterShowsTheLightsThatReachIntoIt) {
  Scene scene = make_bare_floor();
  for (int i = 0; i < 3; ++i) add_lamp(scene, "far", {i - 1.0, 2.0, 0}, 5.0f, 0.01f);
  const glm::dvec3 near_lamp(0.1, 0.3, 0);
  constexpr double kRange = 0.5;
  add_lamp(scene, "near", near_lamp, 5.0f, 0.01f, kRange);
  const auto renderer = make_view_renderer(scene, {GetParam(), {"local"}});
  renderer->render().value();
  const FloatImage seen = see(*renderer, "light-clusters");
  // The same where no effect of the frame reads the clusters.
  const auto unlit = make_view_renderer(scene, {GetParam(), {"gtao"}});
  unlit->render().value();
  EXPECT_EQ(see(*unlit, "light-clusters").values, seen.values);
  const FloatImage position = renderer->read("position").value();
  const FloatImage ids = renderer->read("ids").value();
  int by_count[5] = {};
  for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
    if (ids.at(x, y, 0) == 0) return;  // the sky
    const glm::dvec3 from_eye(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
    const glm::dvec3 point = scene.cameras.front().position() + from_eye;
    const auto lights = static_cast<int>(seen.at(x, y, 0));
    ASSERT_TRUE(lights == 3 || lights == 4) << lights;
    if (glm::length(point - near_lamp) < kRange) {
      EXPECT_EQ(lights, 4) << x << ", " << y;
    }
    EXPECT_EQ(seen.at(x, y, 2), 0);
    ++by_count[lights];
  });
  EXPECT_GT(by_count[3], 100) << "the near lamp is in few clusters";
  EXPECT_GT(by_count[4], 20);
}

// Without anything that occludes, each sample is 1.
TEST_P(PixelViews, StillFramesOfAConstantSignalGatherHistoryAndHaveNoVariance) {
  Scene scene = make_bare_floor();
  scene.sun.emplace();
  const auto renderer =
      make_view_renderer(scene, {GetParam(), {"ao", "sun"}, DenoiseMethod::kSvgf});
  EXPECT_EQ(remembered_signals(*renderer), (std::vector<std::string>{"ao", "sun"}));
  constexpr std::uint32_t kFrames = 3;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(renderer->begin_frame({.index = i, .camera = scene.cameras.front()}).ok());
    renderer->render().value();
  }
  const FloatImage ids = renderer->read("ids").value();
  for (const char* signal : {"ao", "sun"}) {
    const FloatImage history = see(*renderer, "history-length", signal);
    const FloatImage variance = see(*renderer, "variance", signal);
    for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
      const bool is_sky = ids.at(x, y, 0) == 0;
      ASSERT_EQ(history.at(x, y, 0), is_sky ? 0 : kFrames) << signal << x << ", " << y;
      ASSERT_EQ(variance.at(x, y, 0), 0) << signal << x << ", " << y;
      ASSERT_EQ(variance.at(x, y, 2), is_sky ? 0 : 1) << signal << x << ", " << y;
    });
  }
}

// Half of the samples in a penumbra see the sun: m - m * m of n, for any mean m.
TEST_P(PixelViews, VarianceOfVisibilityFollowsFromItsMean) {
  Scene scene = make_bare_floor();
  scene.sun.emplace().angular_radius = 0.5f;
  add_box(scene, "sheet", {-4, 0.8, -4}, {0, 0.81, 4}, 0);
  const auto renderer = make_view_renderer(scene, {GetParam(), {"sun"}, DenoiseMethod::kSvgf});
  renderer->render().value();
  const FloatImage variance = see(*renderer, "variance", "sun");
  const auto samples = static_cast<float>(renderer->context().settings.effects.at("sun").samples);
  int partly = 0;
  for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
    const float mean = variance.at(x, y, 2);
    partly += mean > 0 && mean < 1;
    EXPECT_NEAR(variance.at(x, y, 0), (mean - mean * mean) / samples, 1e-6);
    EXPECT_NEAR(variance.at(x, y, 1), std::sqrt(variance.at(x, y, 0)), 1e-6);
  });
  EXPECT_GT(partly, 15);
}

TEST_P(PixelViews, VolumeCellsAreThoseOfTheGrid) {
  const Scene scene = make_bare_floor();
  auto volume = std::make_shared<IndirectVolume>(layout_volume(scene, 0.5f).value());
  for (std::size_t i = 0; i < volume->cells.size(); ++i) {
    volume->cells[i].validity = i % 3 == 0 ? 0.0f : 1.0f;
  }
  const auto renderer =
      make_view_renderer(scene, {GetParam(), {"gi"}, DenoiseMethod::kNone, volume});
  renderer->render().value();
  const FloatImage seen = see(*renderer, "volume-cells");
  const FloatImage position = renderer->read("position").value();
  const FloatImage ids = renderer->read("ids").value();
  int cells = 0;
  for_each_pixel([&](std::uint32_t x, std::uint32_t y) {
    if (ids.at(x, y, 0) == 0) {
      EXPECT_EQ(seen.at(x, y, 0), -1);
      return;
    }
    const glm::dvec3 from_eye(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
    const glm::dvec3 point = scene.cameras.front().position() + from_eye + glm::dvec3(0, 0.25, 0);
    const glm::dvec3 at = (point - volume->origin) / 0.5;
    const glm::dvec3 part = glm::fract(at);
    for (int c = 0; c < 3; ++c) {
      if (part[c] < 1e-3 || part[c] > 1 - 1e-3) return;  // rounding decides
    }
    const glm::uvec3 cell(at);
    const glm::uvec3 brick = cell / kBrickCells;
    const std::uint32_t entry =
        volume->brick_starts[brick.x + volume->bricks.x * (brick.y + volume->bricks.y * brick.z)];
    ASSERT_EQ(brick_level(entry), 0u) << "surfaces lie in the finest cells";
    const glm::uvec3 place = cell % kBrickCells;
    const std::uint32_t index =
        brick_start(entry) + place.x + kBrickCells * (place.y + kBrickCells * place.z);
    EXPECT_EQ(seen.at(x, y, 0), 0);
    EXPECT_EQ(seen.at(x, y, 1), static_cast<float>(index)) << x << ", " << y;
    EXPECT_EQ(seen.at(x, y, 2), 0.5f);
    EXPECT_EQ(seen.at(x, y, 3), index % 3 == 0 ? 1.0f : 0.0f) << x << ", " << y;
    ++cells;
  });
  EXPECT_GT(cells, 300);
}

INSTANTIATE_TEST_SUITE_P(Backends, PixelViews, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST(Views, NamesAreUniqueAndAnUnknownOneIsToldAllOfThem) {
  std::set<std::string> names;
  for (const View& view : views()) {
    EXPECT_TRUE(names.insert(view.name).second) << view.name;
    EXPECT_EQ(view.channels.size(), 4u) << view.name;
    EXPECT_EQ(find_view(view.name).value(), &view);
  }
  const auto unknown = find_view("fog");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().message.find("KA3080"), 0u) << unknown.error().message;
  for (const std::string& name : names) {
    EXPECT_NE(unknown.error().message.find(name), std::string::npos) << unknown.error().message;
  }
}

TEST(Views, AFrameThatLacksSomethingIsToldWhatToAdd) {
  const Scene scene = make_bare_floor();
  const auto say = [&](const ViewFrame& frame, const std::string& view, const std::string& signal) {
    const auto renderer = make_view_renderer(scene, frame);
    const auto s = check_view(*find_view(view).value(), *renderer, signal);
    return s.ok() ? std::string() : s.error().message;
  };
  const ViewFrame single = {"embree", {"ao"}, DenoiseMethod::kSvgf, {}, false};
  const ViewFrame whole = {"embree", {"ao"}, DenoiseMethod::kSvgf};
  const ViewFrame noisy = {"embree", {"ao"}, DenoiseMethod::kNone};
  EXPECT_EQ(say(single, "hit-uv", ""), "");
  EXPECT_EQ(say(whole, "variance", ""), "");
  EXPECT_EQ(say(whole, "variance", "ao"), "");
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  for (const auto& [said, id, part] :
       {std::tuple(say(single, "light-clusters", ""), "KA3081", "such as sun, local"),
        std::tuple(say(whole, "volume-cells", ""), "KA3081", "such as gi"),
        std::tuple(say(noisy, "history-length", ""), "KA3081", "svgf"),
        std::tuple(say(whole, "variance", "fog"), "KA3082", "\"fog\"")}) {
    EXPECT_TRUE(contains(said, id) && contains(said, part)) << said;
  }
}

// The colours of numbers that are known.
TEST(Views, ColoursTellNumbersApart) {
  FloatImage numbers(2, 1, 4);
  numbers.at(0, 0, 0) = 0;
  numbers.at(1, 0, 0) = 8;
  const ByteImage white{2, 1, 3, {255, 255, 255, 255, 255, 255}};
  const ViewPicture history = find_view("history-length").value()->show(numbers, white, 1);
  EXPECT_EQ(history.image.values, (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255}));
  EXPECT_NE(history.legend.find("white 8"), std::string::npos) << history.legend;
  numbers.at(0, 0, 3) = -1;
  numbers.at(1, 0, 3) = 1;
  numbers.at(1, 0, 0) = 3.5f;
  numbers.at(1, 0, 1) = -0.25f;
  const ViewPicture uv = find_view("hit-uv").value()->show(numbers, white, 1);
  EXPECT_EQ(uv.image.values, (std::vector<std::uint8_t>{24, 32, 72, 128, 191, 0}));
}

}  // namespace
}  // namespace kaamos::effects
