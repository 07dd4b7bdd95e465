// SPDX-License-Identifier: MIT
// Shadows of a lamp beside a straight edge, against the closed form of its penumbra.
#include "effects/shadows/lamp_shadow/lamp_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"
#include "effects/shadows/rows.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr double kLampHeight = 3.0, kSheetHeight = 1.5, kLampRadius = 0.4;
const char* const kName = "lamp-shadow";

std::vector<Effect> registry() {
  std::vector<Effect> out = northlight_effects();
  out.push_back(lamp_shadow_row());
  return out;
}

// A floor below a lamp, and between them a sheet that ends below the lamp's centre.
struct LampScene {
  explicit LampScene(const std::string& backend, bool is_spot = false,
                     double sheet_height = kSheetHeight)
      : sheet(sheet_height) {
    scene = start_scene("lamp");
    const std::uint32_t white = add_paint(scene, "white", glm::vec3(0.8f));
    scene.materials[white].constants.flags = kMaterialDoubleSided;
    add_floor(scene, "floor", {-3, -3}, {3, 3}, 0, white);
    add_floor(scene, "sheet", {-3, -3}, {0, 3}, sheet, white);
    Light lamp;
    lamp.type = is_spot ? LightType::kSpot : LightType::kPoint;
    lamp.position = {0, kLampHeight, 0};
    lamp.direction = {0, -1, 0};
    lamp.outer_cone_angle = 0.7f;
    lamp.intensity = 10;
    lamp.radius = static_cast<float>(kLampRadius);
    scene.lights.push_back(lamp);
    add_view(scene, "view", {1.4, 1.2, 0}, {0, 0, 0}, 0.7);
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    FrameSettings settings;
    settings.width = 72;
    settings.height = 48;
    settings.effects = choose_effects(
        {"adaptive-sun", kName, "lamp-pcf", "lamp-pcss", "lamp-hybrid", "lamp-rays"}, registry());
    settings.effects.at("lamp-rays").samples = 64;
    settings.volume.given = std::make_shared<IndirectVolume>();
    settings.denoise = default_denoise(DenoiseMethod::kNone);
    scene.sun = Sun{};  // adaptive-sun is of use
    renderer = FrameRenderer::create(test::device_for(desc), scene, settings, registry()).value();
  }

  // Share of the lamp that is to be seen from the floor at x: its disk is cut by the sheet's edge
  // as the sun's is.
  double truth(double x) const {
    const double half_width = kLampRadius * sheet / (kLampHeight - sheet);
    return penumbra_visibility(sheet, std::atan(half_width / sheet), x);
  }
  double hard(double x) const { return x > 0 ? 1 : 0; }

  // Root mean square of the difference on the floor, below the lamp, of a layer and a function.
  template <class Function>
  double error(const char* layer, Function wanted) {
    const FloatImage visible = renderer->read(layer).value();
    const FloatImage ids = renderer->read("ids").value(), at = renderer->read("position").value();
    const glm::dvec3 eye = scene.cameras.front().position();
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
      if (ids.values[2 * i] != 1) continue;
      const double x = at.values[4 * i] + eye.x, z = at.values[4 * i + 2] + eye.z;
      if (std::abs(x) > 1 || std::abs(z) > 0.5) continue;
      const double off = visible.values[visible.channels * i] - wanted(x);
      sum += off * off;
      ++count;
    }
    EXPECT_GT(count, 300);
    return std::sqrt(sum / count);
  }
  double error_of(const LampShadowConstants& constants, std::uint32_t rays = 1) {
    renderer->run(kName, EffectSettings{.samples = rays}.set_constants(constants)).value();
    return error("lamp_shadow", [&](double x) { return truth(x); });
  }

  double sheet;
  Scene scene;
  std::unique_ptr<FrameRenderer> renderer;
};

class LampShadows : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, LampShadows, testing::Values("embree", "vulkan"),
                         [](const auto& backend) {
                           return backend.param == "embree" ? "Embree" : "Vulkan";
                         });

TEST_P(LampShadows, HaveThePenumbraOfTheClosedForm) {
  for (const bool is_spot : {false, true}) {
    LampScene s(GetParam(), is_spot);
    EXPECT_LT(s.error_of({.method = LampShadow::kRays}, 64), 0.02);
    // A hard shadow is off by as much as a step is from the penumbra.
    const double step = s.error_of({.method = LampShadow::kRayHard});
    EXPECT_LT(s.error("lamp_shadow", [&](double x) { return s.hard(x); }), 0.05);
    EXPECT_GT(step, 0.15);
    EXPECT_NEAR(s.error_of({.method = LampShadow::kMapHard}), step, 0.25 * step);
    // A filter as wide as the penumbra is nearer to it than a step or a narrow filter.
    const double soft = s.error_of({.method = LampShadow::kMapPcss, .taps = 64});
    EXPECT_LT(soft, 0.35 * step);
    EXPECT_LT(soft, s.error_of({.method = LampShadow::kMapPcf, .taps = 64, .widest = 0.05f}));
  }
}

TEST_P(LampShadows, HybridIsTheRayNearWhatCastsAndTheMapFarFromIt) {
  LampScene s(GetParam());
  const double soft = s.error_of({.method = LampShadow::kMapPcss});
  EXPECT_NEAR(s.error_of({.method = LampShadow::kHybrid}), soft, 0.05);
  s.error_of({.method = LampShadow::kHybrid, .soft_from = 1e6f});
  EXPECT_LT(s.error("lamp_shadow", [&](double x) { return s.hard(x); }), 0.05);
  // Close below its edge a sheet's shadow is as good as hard, which the map is too coarse for.
  LampScene near_floor(GetParam(), false, 0.03);
  EXPECT_LT(near_floor.error_of({.method = LampShadow::kHybrid}),
            0.8 * near_floor.error_of({.method = LampShadow::kMapPcss}));
}

// The lamp is every pixel's strongest of its kind, so that the rows of the registry have its shadow
// in the channel of the kind, and none of the other.
TEST_P(LampShadows, OfEachPixelsStrongestLampsAreThoseOfTheLamp) {
  for (const bool is_spot : {false, true}) {
    LampScene s(GetParam(), is_spot);
    s.renderer->render().value();
    const std::pair<const char*, LampShadow> rows[] = {{"lamp_pcf", LampShadow::kMapPcf},
                                                       {"lamp_pcss", LampShadow::kMapPcss},
                                                       {"lamp_hybrid", LampShadow::kHybrid}};
    const FloatImage ids = s.renderer->read("ids").value();
    for (const auto& [layer, method] : rows) {
      const FloatImage strongest = s.renderer->read(layer).value();
      s.renderer
          ->run(kName,
                EffectSettings().set_constants(LampShadowConstants{
                    .method = method, .widest = method == LampShadow::kMapPcf ? 0.05f : 0.5f}))
          .value();
      const FloatImage one = s.renderer->read("lamp_shadow").value();
      int seen = 0;
      double off = 0;
      for (std::size_t i = 0; i < ids.values.size() / ids.channels; ++i) {
        if (ids.values[ids.channels * i] != 1) continue;
        const float* of = &strongest.values[strongest.channels * i];
        // Where the lamp does not shine it is nobody's strongest, and nothing is hidden.
        if (one.values[one.channels * i] == 0 || of[is_spot ? 1 : 0] == 1) continue;
        off += std::abs(of[is_spot ? 1 : 0] - one.values[one.channels * i]);
        EXPECT_EQ(of[is_spot ? 0 : 1], 1);
        ++seen;
      }
      EXPECT_GT(seen, 20) << layer;
      // The two kinds turn their taps by other random numbers.
      EXPECT_LT(off, (is_spot ? 0.1 : 1e-6) * seen) << layer;
    }
    if (is_spot) continue;
    EXPECT_LT(s.error("lamp_rays", [&](double x) { return s.truth(x); }), 0.03);
  }
}

TEST_P(LampShadows, AdaptiveRaysServeLampsToo) {
  LampScene s(GetParam());
  const EffectSettings settings = EffectSettings{.samples = kAdaptiveHighSamples}.set_constants(
      AdaptiveShadowConstants{.light = 0});
  double first = 0, last = 0;
  for (std::uint32_t frame = 0; frame < 12; ++frame) {
    s.renderer->begin_frame({.index = frame, .camera = s.scene.cameras.front(), .cut = frame == 0})
        .value();
    s.renderer->run("adaptive-sun", settings).value();
    const FloatImage taken = s.renderer->read("adaptive_sun_rays").value();
    last = 0;
    for (std::size_t i = 0; i < taken.values.size(); i += taken.channels) last += taken.values[i];
    if (frame == 0) first = last;
  }
  EXPECT_LT(last, first);
  EXPECT_LT(s.error("adaptive_sun", [&](double x) { return s.truth(x); }), 0.05);
}

}  // namespace
}  // namespace kaamos::effects
