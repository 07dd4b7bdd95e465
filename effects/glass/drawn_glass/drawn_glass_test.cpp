// SPDX-License-Identifier: MIT
// Drawn glass against glass that rays see, layer by layer. [Control; survey 6.5]
#include "effects/glass/drawn_glass/drawn_glass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/reflections/environment_map/probe_places.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

const char* const kDrawn = "drawn-glass";

// One frame with traced and drawn glass, each over the black picture.
class GlassFrame {
 public:
  explicit GlassFrame(const Scene& scene, const std::string& backend = "embree",
                      std::uint32_t width = 48, std::uint32_t height = 27,
                      DrawnGlassFallback fallback = DrawnGlassFallback::kEnvironment)
      : scene_(scene) {
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
    FrameSettings settings;
    settings.width = width;
    settings.height = height;
    settings.effects = choose_effects({"transparent", kDrawn});
    settings.effects[kDrawn].set_constants(DrawnGlassConstants{.fallback = fallback});
    for (auto& [name, effect] : settings.effects) effect.keep = true;  // scenes without glass too
    settings.volume.given = std::make_shared<IndirectVolume>();
    renderer = FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene_, settings).value();
    renderer->render().value();
  }

  // Radiance and depth of the first layer.
  FloatImage traced(std::uint32_t reflecting_layers) {
    TransparentConstants constants = sorted_reference();
    constants.reflecting_layers = reflecting_layers;
    renderer->run("transparent", EffectSettings().set_constants(constants)).value();
    return renderer->read("glass").value();
  }
  FloatImage drawn(const DrawnGlassConstants& constants) {
    renderer->run(kDrawn, EffectSettings().set_constants(constants)).value();
    return renderer->read("drawn_glass").value();
  }
  FloatImage drawn(DrawnGlassFallback fallback, float tolerance = 1e-4f) {
    return drawn({.tolerance = tolerance, .fallback = fallback});
  }

  std::unique_ptr<FrameRenderer> renderer;

 private:
  Scene scene_;
};

// Root mean square over pixels, relative to the mean of `a`.
double difference(const FloatImage& a, const FloatImage& b) {
  double sum = 0, mean = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (i % 4 == 3) continue;
    sum += std::pow(static_cast<double>(a.values[i]) - b.values[i], 2);
    mean += a.values[i];
  }
  const auto count = static_cast<double>(a.values.size()) * 0.75;
  return std::sqrt(sum / count) / (mean / count);
}

// Two panes before a dark wall, and behind the camera a bright one with a dark half, which the
// panes mirror.
Scene two_panes() {
  const Pane panes[] = {{.distance = 1.0, .alpha = 0.2f}, {.distance = 1.5, .alpha = 0.2f}};
  Scene scene = make_pane_oracle(panes, glm::vec3(0.0f));
  add_paint(scene, "bright", glm::vec3(0.0f));
  scene.materials.back().constants.emissive = glm::vec3(4.0f);
  add_box(scene, "bright", {-6, -4, 5}, {0, 4, 5.1},
          static_cast<std::uint32_t>(scene.materials.size() - 1));
  return scene;
}

class DrawnGlasses : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, DrawnGlasses, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// With nothing in place of other reflections it is the same as rays of which the first alone
// reflects; and if no depth fits, as rays that do not reflect at all.
TEST_P(DrawnGlasses, TheNearestLayerAloneHasATracedMirrorImage) {
  GlassFrame frame(two_panes(), GetParam(), 48, 27, DrawnGlassFallback::kNothing);
  const FloatImage first = frame.traced(1), none = frame.traced(0);
  ASSERT_GT(difference(first, none), 0.5) << "reflections can be told from none";
  EXPECT_LT(difference(first, frame.drawn(DrawnGlassFallback::kNothing)), 1e-3);
  const FloatImage missed = frame.drawn(DrawnGlassFallback::kNothing, -1.0f);
  for (std::size_t i = 0; i < missed.values.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_NEAR(missed.values[i], none.values[i], 1e-5) << i;
    }
  }
}

// All that bright panes in the dark mirror is the wall, which an environment map from near the
// panes has as well: with it the second layer is nearer to what rays find than without.
TEST(DrawnGlass, TheEnvironmentStandsInForFurtherLayers) {
  Scene scene = two_panes();
  scene.probes = {camera_probe(scene)};
  GlassFrame frame(scene);
  const FloatImage all = frame.traced(2);
  const double nothing = difference(all, frame.drawn(DrawnGlassFallback::kNothing));
  const double environment = difference(all, frame.drawn(DrawnGlassFallback::kEnvironment));
  EXPECT_GT(nothing, 0.05);
  EXPECT_LT(environment, 0.7 * nothing);
}

// Layers are blended by where they are, not by the order in which the scene names them.
TEST(DrawnGlass, TheOrderOfInstancesDoesNotCount) {
  Scene scene = two_panes();
  GlassFrame first(scene, "embree", 48, 27, DrawnGlassFallback::kNothing);
  std::reverse(scene.instances.begin(), scene.instances.end());
  GlassFrame second(scene, "embree", 48, 27, DrawnGlassFallback::kNothing);
  const FloatImage a = first.drawn(DrawnGlassFallback::kNothing);
  EXPECT_GT(difference(a, FloatImage(a.width, a.height, a.channels)), 0.5);
  EXPECT_LT(difference(a, second.drawn(DrawnGlassFallback::kNothing)), 1e-5);
}

TEST(DrawnGlass, NoGlassAndOnePixelAreFine) {
  GlassFrame bare(make_pane_oracle({}, glm::vec3(0.5f)), "embree", 16, 9);
  for (const float value : bare.drawn(DrawnGlassFallback::kEnvironment).values) {
    EXPECT_EQ(value, 0.0f);
  }
  GlassFrame pixel(two_panes(), "embree", 1, 1);
  for (const float value : pixel.drawn(DrawnGlassFallback::kEnvironment).values) {
    EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace kaamos::effects
