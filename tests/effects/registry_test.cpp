// SPDX-License-Identifier: MIT
//
// The registry: what its rows say holds for the frame, and one more row is one more effect.
#include <gtest/gtest.h>
#include <shaders/toy.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "effects/northlight/frame_renderer.h"
#include "room.h"

namespace kaamos::test {
namespace {

using namespace effects;

// Mirrors ToyConstants of toy.hlsl.
struct ToyConstants {
  float strength = 0.25f;
};

RayPassDesc toy_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "toy rays";
  desc.library = std::move(library);
  desc.ray_generation = "ToyRayGen";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  return desc;
}

std::vector<Effect> effects_with_toy() {
  std::vector<Effect> effects = northlight_effects();
  effects.push_back(
      {.name = "toy",
       .about = "a glow of what sees the sky",
       .library = {"toy/toy", [] { return rtapi::LoadShaderLibrary(kaamos_shaders_toy()); }},
       .pass = toy_pass,
       .compose = "ToyCompose",
       .signals = {{.name = "toy"}},
       .defaults = EffectSettings().set_constants(ToyConstants{})});
  return effects;
}

FrameSettings small_settings(const std::vector<std::string>& names,
                             const std::vector<Effect>& effects = northlight_effects()) {
  FrameSettings settings;
  settings.width = 48;
  settings.height = 27;
  settings.effects = choose_effects(names, effects);
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  settings.volume.given = std::make_shared<IndirectVolume>();
  return settings;
}

rtapi::Device make_device() {
  return rtapi::CreateDevice().value();
}

TEST(Registry, ARowIsAnEffect) {
  const Scene scene = make_room();
  const std::vector<Effect> effects = effects_with_toy();
  const auto without =
      FrameRenderer::create(make_device(), scene, small_settings({"ao"}, effects), effects).value();
  const auto with =
      FrameRenderer::create(make_device(), scene, small_settings({"ao", "toy"}, effects), effects)
          .value();
  without->render().value();
  with->render().value();
  const FloatImage dark = without->read("radiance").value();
  const FloatImage lit = with->read("radiance").value();
  const FloatImage toy = with->read("toy").value();
  std::size_t open = 0;
  for (std::size_t i = 0; i < toy.values.size(); i += 4) {
    open += toy.values[i] == 1 ? 1 : 0;
    EXPECT_EQ(lit.values[i], dark.values[i] + ToyConstants().strength * toy.values[i]);
  }
  EXPECT_GT(open, toy.values.size() / 4 / 20);
  EXPECT_LT(open, toy.values.size() / 4 * 19 / 20);
  EXPECT_EQ(with->read("toy_denoised").value().values, toy.values);
  EXPECT_TRUE(std::any_of(with->passes().begin(), with->passes().end(),
                          [](const PassStatistics& pass) { return pass.name == "toy rays"; }));
  // On its own, with any number of samples: what is read is their mean.
  EXPECT_GT(with->run("toy", 3).value().rays, 0u);
  EXPECT_EQ(with->read("toy").value().values, toy.values);
}

TEST(Registry, NamesAreKnownOrRefused) {
  const Scene scene = make_room();
  EXPECT_TRUE(choose_effects({"contact"}).count("local")) << "contact shadows include local lights";
  EXPECT_EQ(choose_effects({"all"}).size(), northlight_effects().size());
  const auto refused = FrameRenderer::create(make_device(), scene, small_settings({"fog"}));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("no effect \"fog\""), std::string::npos);
  FrameSettings plain = small_settings({"gi"});
  plain.whole_frame = false;
  EXPECT_FALSE(FrameRenderer::create(make_device(), scene, plain));
  const auto renderer = FrameRenderer::create(make_device(), scene, small_settings({"ao"})).value();
  EXPECT_FALSE(renderer->run("sun", 1)) << "it was not chosen";
  EXPECT_FALSE(renderer->read("nothing"));
  renderer->set_libraries({});
  const auto without = renderer->render();
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().message.find("\"gbuffer/gbuffer\""), std::string::npos);
}

// Indirect light takes the place of ambient occlusion: nothing would read its rays.
TEST(Registry, WhatNothingReadsIsNotTraced) {
  const Scene scene = make_room();
  const auto has_ao = [&](const std::vector<std::string>& names, bool& is_said) {
    FrameSettings settings = small_settings(names);
    settings.volume.given = std::make_shared<IndirectVolume>();
    const auto renderer = FrameRenderer::create(make_device(), scene, settings).value();
    renderer->render().value();
    is_said =
        std::any_of(renderer->left_out().begin(), renderer->left_out().end(),
                    [](const std::string& text) { return text.find("ambient occlusion") == 0; });
    const auto layers = renderer->layers();
    return std::find(layers.begin(), layers.end(), "ao") != layers.end();
  };
  bool is_said = false;
  EXPECT_FALSE(has_ao({"all"}, is_said));
  EXPECT_TRUE(is_said);
  EXPECT_TRUE(has_ao({"all", "ao"}, is_said));
  EXPECT_FALSE(is_said);
  EXPECT_TRUE(has_ao({"ao", "gi"}, is_said));
  EXPECT_TRUE(has_ao({"ao", "reflections"}, is_said));
  EXPECT_FALSE(is_said);
}

TEST(Registry, EveryRowHasItsShaderFileAndItsOwnNames) {
  std::set<std::string> names, signals;
  for (const Effect& effect : northlight_effects()) {
    EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
    for (const EffectSignal& signal : effect.signals) {
      EXPECT_TRUE(signals.insert(signal.name).second) << signal.name;
    }
  }
  FrameSettings settings = small_settings({"all"});
  settings.taa = true;
  settings.order = RayOrder::kDirection;
  const auto libraries = frame_libraries(settings);
  EXPECT_GT(libraries.size(), northlight_effects().size());
  for (const EffectLibrary& library : libraries) {
    const std::string file = KAAMOS_SOURCE_DIR "/effects/" + library.file + ".hlsl";
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
    EXPECT_TRUE(library.built_in()) << library.file;
  }
}

// Being stopped is an outcome; what fails is an error, and neither is taken for the other.
TEST(FrameRenderer, StopsWhenTheCallbackSaysSo) {
  const Scene scene = make_room();
  FrameSettings settings = small_settings({"all", "ao"});
  settings.volume = {.cell = 1.0f, .samples = 4};
  const auto renderer = FrameRenderer::create(make_device(), scene, settings).value();
  std::string last;
  const auto stop_at = [&](const std::string& wanted) {
    return [&, wanted](const std::string& what, double) {
      last = what;
      return what != wanted;
    };
  };
  EXPECT_EQ(*renderer->render(stop_at("indirect light")), Outcome::kStopped);
  EXPECT_EQ(last, "indirect light");
  EXPECT_EQ(*renderer->render(stop_at("reflections")), Outcome::kStopped);
  EXPECT_EQ(last, "reflections");
  EXPECT_EQ(*renderer->render(stop_at("")), Outcome::kDone);
  EXPECT_EQ(*renderer->accumulate("ao", {.samples = 64, .radius = 1}, stop_at("ao")),
            Outcome::kStopped);
}

TEST(FrameRenderer, FailuresAreNoStops) {
  Scene scene = make_room();
  const Light light = scene.lights.front();
  scene.lights.assign(4097, light);
  const auto renderer =
      FrameRenderer::create(make_device(), scene, small_settings({"local"})).value();
  const auto rendered = renderer->render();
  ASSERT_FALSE(rendered);
  EXPECT_NE(rendered.error().message.find("4097 local lights"), std::string::npos)
      << rendered.error().message;
}

}  // namespace
}  // namespace kaamos::test
