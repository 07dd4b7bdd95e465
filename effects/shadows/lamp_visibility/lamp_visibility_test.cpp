// SPDX-License-Identifier: MIT
// Each light's shadow below a plate is where geometry says, and lights do not mix.
#include "effects/shadows/lamp_visibility/lamp_visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr double kPlateHeight = 1.0, kHalfPlate = 0.4;  // metres

Light lamp_at(const glm::dvec3& position, bool is_spot = false) {
  Light lamp;
  lamp.type = is_spot ? LightType::kSpot : LightType::kPoint;
  lamp.position = position;
  lamp.direction = {0, -1, 0};
  lamp.outer_cone_angle = 1.2f;
  lamp.intensity = 10;
  lamp.radius = 0.05f;
  return lamp;
}

// A floor below lamps; with a plate between them.
Scene make_scene(const std::vector<Light>& lamps, bool with_plate) {
  Scene scene = start_scene("lamps");
  const std::uint32_t white = add_paint(scene, "white", glm::vec3(0.8f));
  scene.materials[white].constants.flags = kMaterialDoubleSided;
  add_floor(scene, "floor", {-3, -3}, {3, 3}, 0, white);
  if (with_plate) {
    add_floor(scene, "plate", {-kHalfPlate, -kHalfPlate}, {kHalfPlate, kHalfPlate}, kPlateHeight,
              white);
  }
  scene.lights = lamps;
  add_view(scene, "view", {3.0, 0.8, 0}, {0, 0, 0}, 0.8);
  return scene;
}

// The renderer keeps a reference to the scene.
std::unique_ptr<FrameRenderer> render(const std::string& backend, const Scene& scene,
                                      const char* effect) {
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
  FrameSettings settings;
  settings.width = 64;
  settings.height = 36;
  settings.effects = choose_effects({effect});
  settings.volume.given = std::make_shared<IndirectVolume>();
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  auto renderer = FrameRenderer::create(test::device_for(desc), scene, settings).value();
  renderer->render().value();
  return renderer;
}

// Metres by which the way from a lamp to a point of the floor passes inside of the plate's edge;
// negative: outside.
double inside_of_plate(const glm::dvec3& lamp, const glm::dvec3& point) {
  const glm::dvec3 at = point + (lamp - point) * (kPlateHeight / lamp.y);
  return kHalfPlate - std::max(std::abs(at.x), std::abs(at.z));
}

class LampVisibility : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, LampVisibility, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST_P(LampVisibility, EachLightHasItsOwnShadow) {
  const std::vector<Light> lamps = {lamp_at({0, 2, 0}), lamp_at({-0.8, 2.5, 0.5}, true),
                                    lamp_at({0.7, 3, -0.6})};
  std::vector<FloatImage> alone;  // without the plate
  for (const Light& lamp : lamps) {
    const Scene scene = make_scene({lamp}, false);
    alone.push_back(render(GetParam(), scene, "local")->read("local_lights").value());
  }
  const Scene scene = make_scene(lamps, true);
  const auto renderer = render(GetParam(), scene, "lamp-visibility");
  const FloatImage seen = renderer->read("lamp_visibility").value();
  const FloatImage ids = renderer->read("ids").value(), at = renderer->read("position").value();
  const glm::dvec3 eye = scene.cameras.front().position();
  int count = 0, shadowed = 0;
  for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
    if (ids.values[2 * i] != 1) continue;
    const glm::dvec3 point = eye + glm::dvec3(at.values[4 * i], 0, at.values[4 * i + 2]);
    double wanted = 0;
    bool is_edge = false;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
      const double inside = inside_of_plate(lamps[k].position, {point.x, 0, point.z});
      is_edge = is_edge || std::abs(inside) < 1e-4;
      if (inside < 0) wanted += alone[k].values[4 * i];
      shadowed += inside > 0 ? 1 : 0;
    }
    if (is_edge) continue;
    // The sum's order may differ.
    ASSERT_NEAR(seen.values[4 * i], wanted, 1e-5 * wanted + 1e-6) << i;
    ++count;
  }
  EXPECT_GT(count, 800);
  EXPECT_GT(shadowed, 300);
}

// More lights than a word has bits, and than a pixel has.
TEST_P(LampVisibility, ManyLightsAreThoseOfMainLighting) {
  for (const int side : {6, 12}) {
    std::vector<Light> lamps;
    for (int i = 0; i < side * side; ++i) {
      lamps.push_back(lamp_at({0.3 * (i % side) - 1, 2, 0.3 * (i / side) - 1}));
    }
    const Scene scene = make_scene(lamps, false);
    const FloatImage wanted = render(GetParam(), scene, "local")->read("local_lights").value();
    const FloatImage seen =
        render(GetParam(), scene, "lamp-visibility")->read("lamp_visibility").value();
    for (std::size_t i = 0; i < seen.values.size(); i += 4) {
      ASSERT_NEAR(seen.values[i], wanted.values[i], 1e-4 * wanted.values[i] + 1e-6)
          << side * side << " lights";
    }
  }
}

// In a whole frame it takes the place of main lighting and of contact shadows.
TEST(LampVisibilityRow, MainLightingIsLeftOutBesideIt) {
  const Scene scene = make_scene({lamp_at({0, 2, 0})}, true);
  FrameSettings settings;
  settings.effects = choose_effects({"all", "lamp-visibility"});
  for (const char* name : {"local", "contact"}) {
    EXPECT_FALSE(is_rendered(scene, settings, northlight_effects(), name)) << name;
  }
  EXPECT_TRUE(is_rendered(scene, settings, northlight_effects(), "lamp-visibility"));
  settings.effects = choose_effects({"lamp-rays", "lamp-visibility"});
  EXPECT_TRUE(is_rendered(scene, settings, northlight_effects(), "local"));
}

}  // namespace
}  // namespace kaamos::effects
