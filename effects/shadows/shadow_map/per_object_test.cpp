// SPDX-License-Identifier: MIT
// A shadow map of the hero's own besides the scene's: on the hero and in its shadow it is finer
// than one map with as many texels. [survey 5.1.1]
#include <algorithm>
#include <cmath>

#include "effects/shadows/shadow_map/map_fixture.h"

namespace kaamos::effects {
namespace {

class PerObjectMaps : public test::OnBackends {};

std::string per_object_backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

INSTANTIATE_TEST_SUITE_P(Backends, PerObjectMaps, testing::Values("embree", "vulkan"),
                         per_object_backend_name);

// The sole of a shoe is the hero, on a floor 60 m wide.
Scene with_hero() {
  Scene scene = make_peter_panning({.angular_radius = 0});
  for (Instance& instance : scene.instances) {
    if (instance.name == "sole") instance.build_class = BuildClass::kHero;
  }
  scene.cameras.front().camera_to_world = look_at({-0.5, 0.15, 1.35}, {0.05, 0, 1.35});
  return scene;
}

// Pixels where a layer says something else than a ray to the sun.
int wrong_pixels(MapFrame& frame, const std::string& layer) {
  const FloatImage map = frame.read(layer), rays = frame.read("sun");
  int count = 0;
  for (const std::size_t i : frame.surfaces()) {
    count += std::abs(map.values[map.channels * i] - rays.values[rays.channels * i]) > 0.5f;
  }
  return count;
}

// 2 x 362^2 texels are no more than 512^2.
TEST_P(PerObjectMaps, AreFinerAtEqualTexels) {
  const Scene scene = with_hero();
  MapFrame frame(
      scene, {"sun", "sun-map", "sun-per-object"},
      [&](const std::string& name, EffectSettings& settings) {
        if (name == "sun-map") settings.set_constants(ShadowMapConstants{.size = 512});
        if (name == "sun-per-object") {
          settings.set_constants(
              ShadowMapConstants{.flags = kShadowMapPerObject, .size = 362, .cascades = 1});
        }
      },
      1, 96, 54, GetParam());
  const int one = wrong_pixels(frame, "sun_map"), fitted = wrong_pixels(frame, "sun_per_object");
  RecordProperty("one_map", one);
  RecordProperty("per_object", fitted);
  EXPECT_GT(one, 60) << fitted;
  EXPECT_LT(3 * fitted, one);
}

// No hero: the scene's map is asked everywhere, the same bits. Nor does a hero that no
// ray sees change anything.
TEST_P(PerObjectMaps, WithoutAHeroAreTheScenesMap) {
  Scene none = make_peter_panning({.angular_radius = 0});
  Scene unseen = with_hero();
  for (Instance& instance : unseen.instances) {
    if (instance.name == "sole") instance.mask = 0;
  }
  for (const Scene& scene : {none, unseen}) {
    MapFrame frame(
        scene, {"sun-map", "sun-per-object"},
        [&](const std::string& name, EffectSettings& settings) {
          settings.set_constants(ShadowMapConstants{
              .flags = name == "sun-map" ? 0u : std::uint32_t{kShadowMapPerObject},
              .size = 256,
              .cascades = name == "sun-map" ? 0u : 4u});
        },
        1, 64, 36, GetParam());
    EXPECT_EQ(frame.read("sun_map").values, frame.read("sun_per_object").values);
  }
}

// Where a filter would read beside the hero's map, the scene's is asked. One wider than the scene
// leaves nothing for the hero's: the same bits as without it.
TEST(PerObjectMap, FiltersStayInTheirMap) {
  const auto with = [](float radius, std::uint32_t objects) {
    const std::uint32_t per_object = objects > 0 ? kShadowMapPerObject : 0u;
    const ShadowMapConstants soft = {.method = kShadowMapPcf,
                                     .flags = kShadowMapReceiverPlane | per_object,
                                     .size = 256,
                                     .cascades = objects,
                                     .radius = radius};
    MapFrame frame(with_hero(), {"sun-per-object"}, &soft, 1, 32, 18);
    return frame.read("sun_per_object").values;
  };
  EXPECT_NE(with(0.03f, 1), with(0.03f, 0));
  EXPECT_EQ(with(100.0f, 1), with(100.0f, 0));
}

TEST(PerObjectMap, HoldsItsObjectFinestFirst) {
  SunMapsDesc desc;
  desc.direction_to_sun = glm::normalize(glm::dvec3(0.6, 0.5, -0.3));
  desc.bounds.add({-20, -1, -35});
  desc.bounds.add({30, 12, 25});
  desc.size = 512;
  desc.objects.resize(3);  // the last one stays empty
  desc.objects[0].add({-2, 0, -2});
  desc.objects[0].add({2, 3, 2});
  desc.objects[1].add({5, 0, 5});
  desc.objects[1].add({6, 2, 6});
  desc.border = 0.25;
  Camera camera;
  camera.camera_to_world = look_at({3, 2, 1}, {0, 1, -4});
  const auto maps = sun_maps(desc, camera);
  ASSERT_EQ(maps.size(), 4u);
  for (std::size_t i = 0; i + 1 < maps.size(); ++i) EXPECT_LE(maps[i].texel, maps[i + 1].texel);
  EXPECT_EQ(maps[2].texel, maps[3].texel);
  for (const glm::dvec3 corner : {glm::dvec3(5, 0, 5), glm::dvec3(6, 2, 6), glm::dvec3(5, 2, 6)}) {
    const glm::dvec4 p(corner - camera.position(), 1.0);
    const double border = desc.border / maps[0].texel - 1e-2;
    for (int axis = 0; axis < 2; ++axis) {
      const double at = glm::dot(glm::dvec4(maps[0].to_map[axis]), p);
      EXPECT_GE(at, border);
      EXPECT_LE(at, 512.0 - border);
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
