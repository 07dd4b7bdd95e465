// SPDX-License-Identifier: MIT
// Views of what reflection rays hit: a mirror for a floor, and behind it a wall that is known.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/views/views_fixture.h"

namespace kaamos::effects {
namespace {

class HitViews : public test::OnBackends {};

constexpr glm::dvec3 kCorner = {-1.5, 0.1, -2};  // of the wall, which is 3 m wide and 2 m high
constexpr glm::dvec3 kLamp = {0.4, 1.3, -0.5};
const glm::vec3 kPaint(0.25f, 0.5f, 0.125f);

// The wall stands upright and faces the camera; u runs to the right and v up, both from 0 to 1.
Scene make_wall_behind_mirror() {
  Scene scene = make_bare_floor();
  scene.materials.front().constants.metallic = 1;
  scene.materials.front().constants.roughness = 0;
  const std::uint32_t paint = add_paint(scene, "paint", kPaint);
  add_thing(scene, "wall", patch(kCorner, {3, 0, 0}, {0, 2, 0}, 1, 1), paint);
  add_lamp(scene, "lamp", kLamp, 5.0f, 0.01f);
  return scene;
}

// The place where the ray of a pixel of the mirror meets the wall.
struct Meeting {
  bool is_mirror = false;  // the pixel shows the floor
  bool is_sure = false;    // not so close to the wall's edge that rounding decides
  bool hits = false;
  double u = 0, v = 0, distance = 0;
  glm::dvec3 point{0.0};
};

class Meetings {
 public:
  Meetings(FrameRenderer& renderer, const Scene& scene)
      : ids_(renderer.read("ids").value()),
        position_(renderer.read("position").value()),
        eye_(scene.cameras.front().position()) {}

  Meeting at(std::uint32_t x, std::uint32_t y) const {
    Meeting out;
    out.is_mirror = ids_.at(x, y, 0) == 1;
    if (!out.is_mirror) return out;
    const glm::dvec3 way(position_.at(x, y, 0), position_.at(x, y, 1), position_.at(x, y, 2));
    const glm::dvec3 from = eye_ + way;
    const glm::dvec3 along = glm::normalize(way * glm::dvec3(1, -1, 1));
    out.distance = (kCorner.z - from.z) / along.z;
    out.point = from + along * out.distance;
    out.u = (out.point.x - kCorner.x) / 3;
    out.v = (out.point.y - kCorner.y) / 2;
    const double margin = std::min(std::min(out.u, 1 - out.u), std::min(out.v, 1 - out.v));
    out.is_sure = std::abs(margin) > 1e-3 && std::abs(out.distance) > 1e-2;
    out.hits = out.distance > 0 && margin > 0;
    return out;
  }

 private:
  FloatImage ids_, position_;
  glm::dvec3 eye_;
};

// Calls check(x, y, meeting) for every pixel of the mirror whose ray hits the wall, and holds the
// distance of all pixels against what the view tells.
template <class Check>
void check_hits(FrameRenderer& renderer, const Scene& scene, const FloatImage& view, Check check) {
  const Meetings meetings(renderer, scene);
  int hits = 0, misses = 0;
  for (std::uint32_t y = 0; y < kViewHeight; ++y) {
    for (std::uint32_t x = 0; x < kViewWidth; ++x) {
      const Meeting meeting = meetings.at(x, y);
      if (!meeting.is_mirror || !meeting.is_sure) continue;
      if (!meeting.hits) {
        ++misses;
        EXPECT_EQ(view.at(x, y, 3), -1) << x << ", " << y;
        continue;
      }
      ++hits;
      EXPECT_NEAR(view.at(x, y, 3), meeting.distance, 1e-3) << x << ", " << y;
      check(x, y, meeting);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 50);
}

TEST_P(HitViews, UvAndAlbedoAreThoseOfWhatTheMirrorShows) {
  const Scene scene = make_wall_behind_mirror();
  const auto renderer =
      make_view_renderer(scene, {GetParam(), {"ao"}, DenoiseMethod::kNone, {}, false});
  renderer->render().value();
  const FloatImage uv = see(*renderer, "hit-uv");
  const FloatImage albedo = see(*renderer, "hit-albedo");
  check_hits(*renderer, scene, uv, [&](std::uint32_t x, std::uint32_t y, const Meeting& meeting) {
    EXPECT_NEAR(uv.at(x, y, 0), meeting.u, 1e-3) << x << ", " << y;
    EXPECT_NEAR(uv.at(x, y, 1), meeting.v, 1e-3) << x << ", " << y;
  });
  check_hits(*renderer, scene, albedo, [&](std::uint32_t x, std::uint32_t y, const Meeting&) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(albedo.at(x, y, c), kPaint[c]) << x << ", " << y;
  });
}

TEST_P(HitViews, LightingIsThatOfAWhiteSurface) {
  const Scene scene = make_wall_behind_mirror();
  const auto renderer = make_view_renderer(scene, {GetParam(), {"reflections"}});
  renderer->render().value();
  const FloatImage lighting = see(*renderer, "hit-lighting");
  // The same where lamps are read before the first frame alone.
  const auto mapped = make_view_renderer(scene, {GetParam(), {"env-map"}});
  mapped->render().value();
  EXPECT_EQ(see(*mapped, "hit-lighting").values, lighting.values);
  check_hits(*renderer, scene, lighting,
             [&](std::uint32_t x, std::uint32_t y, const Meeting& meeting) {
               const glm::dvec3 to_lamp = kLamp - meeting.point;
               const double distance = glm::length(to_lamp);
               const double expected = 5.0 * (to_lamp.z / distance) / (distance * distance) / M_PI;
               for (int c = 0; c < 3; ++c) {
                 EXPECT_NEAR(lighting.at(x, y, c), expected, 2e-3 * expected) << x << ", " << y;
               }
             });
}

INSTANTIATE_TEST_SUITE_P(Backends, HitViews, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
