// SPDX-License-Identifier: MIT
// The drawn atlas against the one that rays render: the same texels, but for the edges of
// triangles.
#include "effects/light/lights/light_map_draws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "effects/assets/built_in/foliage.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/engine/picture.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kSunMap = 96;

// A closed room whose lamp sees all of it, a spot that sees a corner, things in both, and a card of
// leaves with holes.
Scene room() {
  Scene scene = start_scene("room");
  const std::uint32_t paint = add_paint(scene, "grey", glm::vec3(0.5f));
  add_box(scene, "floor", {-3, -0.1, -3}, {3, 0, 3}, paint);
  add_box(scene, "ceiling", {-3, 2.5, -3}, {3, 2.6, 3}, paint);
  add_box(scene, "left", {-3, 0, -3}, {-2.9, 2.5, 3}, paint);
  add_box(scene, "right", {2.9, 0, -3}, {3, 2.5, 3}, paint);
  add_box(scene, "back", {-3, 0, -3}, {3, 2.5, -2.9}, paint);
  add_box(scene, "front", {-3, 0, 2.9}, {3, 2.5, 3}, paint);
  add_box(scene, "crate", {0.6, 0, -0.8}, {1.4, 0.7, 0.1}, paint);
  add_thing(scene, "ball", ball(0.35, 24, 16), paint);
  scene.instances.back().transform = translate({-0.9, 0.8, 0.4});
  scene.sun.emplace().direction_to_sun = glm::normalize(glm::vec3(0.3f, 1.0f, 0.2f));
  add_lamp(scene, "lamp", {0.1, 1.3, 0.2}, 5.0f, 0.02f);
  Light spot;
  spot.name = "spot";
  spot.type = LightType::kSpot;
  spot.position = {-2, 2.2, 2};
  spot.direction = glm::normalize(glm::vec3(0.6f, -0.5f, -0.7f));
  spot.outer_cone_angle = 0.6f;
  spot.intensity = 30;
  scene.lights.push_back(spot);
  add_view(scene, "view", {0, 1.6, 2.5}, {0, 1, 0}, 1.0);
  return scene;
}

struct Rendered {
  std::unique_ptr<FrameRenderer> renderer;
  FloatImage atlas, lit;
};

Rendered render(const Scene& scene, const std::string& backend, LightMaps maps,
                std::uint32_t sun_map = kSunMap) {
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
  const auto device = test::device_for(desc);
  FrameSettings settings;
  settings.width = 32;
  settings.height = 18;
  settings.effects = choose_effects({"local"});
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  settings.light_maps = maps;
  settings.sun_map = sun_map;
  Rendered out;
  out.renderer = FrameRenderer::create(device, scene, settings).value();
  out.renderer->render().value();
  out.atlas = out.renderer->read(out.renderer->lights().lighting()->atlas()).value();
  if (out.renderer->effects().renders("local"))
    out.lit = out.renderer->read("local_lights").value();
  return out;
}

// Texels whose distance differs by more than a hundredth, or that are empty in one of the two, of
// all that see something, within columns of the atlas. A texel of a local light holds 1 / distance
// in w, the sun's a depth in x and 1 in w.
struct Difference {
  int seen = 0;
  int other = 0;
};

Difference compare(const FloatImage& a, const FloatImage& b, std::uint32_t first,
                   std::uint32_t last, bool is_sun) {
  Difference out;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = first; x < last; ++x) {
      const float w = a.at(x, y, 3), other = b.at(x, y, 3);
      if (w == 0 && other == 0) continue;
      ++out.seen;
      const bool is_same = is_sun ? w == other && std::abs(a.at(x, y, 0) - b.at(x, y, 0)) < 0.01f
                                  : std::abs(w - other) < 0.01f * w;
      out.other += !is_same;
    }
  }
  return out;
}

class LightMapDraw : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, LightMapDraw, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST_P(LightMapDraw, SeesWhatRaysSee) {
  const Scene scene = room();
  const Rendered traced = render(scene, GetParam(), LightMaps::kTraced);
  const Rendered drawn = render(scene, GetParam(), LightMaps::kDrawn);
  ASSERT_EQ(traced.atlas.width, 2 * kShadowTile + kSunMap);
  const struct {
    const char* map;
    std::uint32_t first, last;
    int least;
  } maps[] = {{"lamp", 0, kShadowTile, 16384},
              {"spot", kShadowTile, 2 * kShadowTile, 16384},
              {"sun", 2 * kShadowTile, 2 * kShadowTile + kSunMap, 3000}};
  for (const auto& map : maps) {
    const bool is_sun = map.first == 2 * kShadowTile;
    const Difference d = compare(traced.atlas, drawn.atlas, map.first, map.last, is_sun);
    EXPECT_GE(d.seen, map.least) << map.map << ": the room is closed";
    // Silhouettes, where the rasterizer's rule for shared edges decides.
    EXPECT_LE(d.other, d.seen / 500) << map.map;
  }
  double sum = 0, off = 0;
  for (std::size_t i = 0; i < traced.lit.values.size(); ++i) {
    sum += traced.lit.values[i];
    off += std::abs(traced.lit.values[i] - drawn.lit.values[i]);
  }
  EXPECT_GT(sum, 1);
  EXPECT_LT(off, 1e-3 * sum);
}

// The eight pictures of a point light meet without a gap, also where the middles of texels lie on
// the octahedron's edges: in a closed room each texel sees a wall, where rays see it.
TEST_P(LightMapDraw, FacesMeetWithoutASeam) {
  Scene scene = room();
  scene.lights.clear();
  add_lamp(scene, "lamp", {0.1, 1.1, 0.2}, 50.0f, 0.02f);
  const Rendered traced = render(scene, GetParam(), LightMaps::kTraced, 0);
  const Rendered drawn = render(scene, GetParam(), LightMaps::kDrawn, 0);
  int gaps = 0, edges = 0, other = 0;
  for (std::uint32_t y = 0; y < kShadowTile; ++y) {
    for (std::uint32_t x = 0; x < kShadowTile; ++x) {
      const float w = traced.atlas.at(x, y, 3), seen = drawn.atlas.at(x, y, 3);
      gaps += w != 0 && seen == 0;
      // The axes, and the square that stands on its corner between them.
      const int along = std::abs(2 * static_cast<int>(x) + 1 - static_cast<int>(kShadowTile));
      const int across = std::abs(2 * static_cast<int>(y) + 1 - static_cast<int>(kShadowTile));
      if (along > 1 && across > 1 && along + across != static_cast<int>(kShadowTile)) continue;
      ++edges;
      other += std::abs(w - seen) > 0.01f * w;
    }
  }
  EXPECT_EQ(gaps, 0);
  EXPECT_GT(edges, 700);
  EXPECT_LE(other, edges / 100);
}

// Light falls through the holes of leaves: drawn maps discard what rays ignore.
TEST(LightMapDraws, HolesAreOpen) {
  Scene scene = make_foliage({});
  scene.lights.clear();
  add_lamp(scene, "lamp", {0.2, 4.0, 0.3}, 50.0f, 0.02f);
  const Rendered traced = render(scene, "embree", LightMaps::kTraced, 0);
  const Rendered drawn = render(scene, "embree", LightMaps::kDrawn, 0);
  Scene solid = scene;
  for (Mesh& mesh : solid.meshes) {
    for (Geometry& geometry : mesh.geometries) geometry.alpha_tested = false;
  }
  const Rendered closed = render(solid, "embree", LightMaps::kDrawn, 0);
  const Difference same = compare(traced.atlas, drawn.atlas, 0, kShadowTile, false);
  const Difference other = compare(traced.atlas, closed.atlas, 0, kShadowTile, false);
  EXPECT_GT(other.other, 4 * std::max(same.other, 20));
  EXPECT_LT(same.other, same.seen / 50);
}

TEST(LightMapDraws, ExtremesDrawNothingAmiss) {
  Scene scene = room();
  scene.lights.clear();
  const Rendered none = render(scene, "embree", LightMaps::kDrawn, 8);
  for (const float value : none.atlas.values) EXPECT_TRUE(std::isfinite(value));
  // A point without a size in the middle of a box, and one that reaches nothing.
  add_lamp(scene, "inside", {1.0, 0.35, -0.3}, 5.0f, 0.0f);
  add_lamp(scene, "short", {0, 1.2, 0}, 5.0f, 0.01f, 0.05f);
  const Rendered traced = render(scene, "embree", LightMaps::kTraced, 0);
  const Rendered drawn = render(scene, "embree", LightMaps::kDrawn, 0);
  const Difference inside = compare(traced.atlas, drawn.atlas, 0, kShadowTile, false);
  EXPECT_GT(inside.seen, 16000);
  EXPECT_LE(inside.other, inside.seen / 500);
  for (std::uint32_t y = 0; y < kShadowTile; ++y) {
    for (std::uint32_t x = kShadowTile; x < 2 * kShadowTile; ++x) {
      ASSERT_EQ(drawn.atlas.at(x, y, 3), 0) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
