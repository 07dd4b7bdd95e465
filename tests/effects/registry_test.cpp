// SPDX-License-Identifier: MIT
//
// The registry: what its rows say holds for the frame, and one more row is one more effect.
#include <gtest/gtest.h>
#include <shaders/toy.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "effects/engine/compute_pass.h"
#include "effects/northlight/frame_layers.h"
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

// Counts what the frame asks of it.
class FacingPass : public EffectPass {
 public:
  static inline int frames = 0;
  static inline int records = 0;

  static rtapi::Result<std::unique_ptr<EffectPass>> make(const EffectScope& scope) {
    auto out = std::make_unique<FacingPass>(scope.frame, scope.views);
    const auto pass =
        ComputePass::create(scope.device, scope.frame, scope.library("toy/toy"), "ToyFacing");
    if (!pass) return pass.error();
    out->pass_ = *pass;
    return std::unique_ptr<EffectPass>(std::move(out));
  }
  FacingPass(const Frame& frame, const PassViews& views) : frame_(frame), views_(views) {}
  rtapi::Status begin_frame(const Camera&) override {
    ++frames;
    return {};
  }
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    ++records;
    pass_.dispatch(list, frame_, constants, PassArguments(views_, settings.constants),
                   frame_.width(), frame_.height());
  }
  std::uint64_t bytes() const override { return 12; }

 private:
  const Frame& frame_;
  const PassViews& views_;
  ComputePass pass_;
};

std::vector<Effect> effects_with_toy() {
  std::vector<Effect> effects = northlight_effects();
  effects.push_back(
      {.name = "facing",
       .about = "how far surfaces face up",
       .library = {"toy/toy", [] { return rtapi::LoadShaderLibrary(kaamos_shaders_toy()); }},
       .make = FacingPass::make,
       .signals = {{.name = "facing", .is_sum = false, .part = &FrameParts::ambient}},
       .defaults = EffectSettings().set_constants(ToyConstants{1.0f}),
       .alternative_to = "ao"});
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
  EXPECT_TRUE(std::any_of(with->runner().passes().begin(), with->runner().passes().end(),
                          [](const PassStatistics& pass) { return pass.name == "toy rays"; }));
  // On its own, with any number of samples: what is read is their mean.
  EXPECT_GT(with->run("toy", 3).value().rays, 0u);
  EXPECT_EQ(with->read("toy").value().values, toy.values);
}

// An alternative has passes of its own and takes the place of what it is an alternative to.
TEST(Registry, AnAlternativeTakesTheOthersPlace) {
  const Scene scene = make_room();
  const std::vector<Effect> effects = effects_with_toy();
  EXPECT_EQ(choose_effects({"all"}, effects).count("facing"), 0u);
  const auto make = [&](const std::vector<std::string>& names) {
    return FrameRenderer::create(make_device(), scene, small_settings(names, effects), effects)
        .value();
  };
  const auto with = make({"all", "facing"});
  const auto alone = make({"facing"});
  const auto both = make({"facing", "ao"});
  FacingPass::frames = FacingPass::records = 0;
  alone->render().value();
  EXPECT_EQ(FacingPass::frames, 1);
  EXPECT_EQ(FacingPass::records, 1);
  ASSERT_TRUE(alone->begin_frame({.index = 1, .camera = scene.cameras.front()}));
  alone->render().value();
  EXPECT_EQ(FacingPass::frames, 2);
  EXPECT_EQ(alone->runner().passes().front().name, "G-buffer");
  const FloatImage facing = alone->read("facing").value();
  EXPECT_GT(*std::max_element(facing.values.begin(), facing.values.end()), 0.99f);
  EXPECT_EQ(alone->run("facing", 1).value().rays, 0u);
  EXPECT_EQ(alone->read("facing").value().values, facing.values);
  both->render().value();
  EXPECT_EQ(both->read("radiance").value().values, alone->read("radiance").value().values)
      << "the alternative is composed, and ao is a layer beside it";
  EXPECT_TRUE(both->read("ao"));
  with->render().value();
  EXPECT_FALSE(with->effects().renders("ao"));
  EXPECT_TRUE(with->read("facing"));
}

TEST(Registry, NamesAreKnownOrRefused) {
  const Scene scene = make_room();
  EXPECT_TRUE(choose_effects({"contact"}).count("local")) << "contact shadows include local lights";
  const auto is_alternative = [](const Effect& each) {
    return each.on_request || !each.alternative_to.empty();
  };
  EXPECT_EQ(choose_effects({"all"}).size() +
                static_cast<std::size_t>(std::count_if(northlight_effects().begin(),
                                                       northlight_effects().end(), is_alternative)),
            northlight_effects().size());
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
  EXPECT_NE(without.error().message.find("\"surfaces/gbuffer/gbuffer\""), std::string::npos);
}

// --layers is checked before anything is baked.
TEST(FrameRenderer, LayersAreKnownBeforeTheFrameIsPrepared) {
  const Scene scene = make_room();
  const std::vector<std::string> possible = possible_layers(northlight_effects());
  FrameSettings plain = small_settings({"ao", "sun"});
  plain.whole_frame = false;
  FrameSettings filtered = small_settings({"all", "ao", "gtao", "ssr"});
  filtered.denoise = default_denoise(DenoiseMethod::kSvgf);
  for (const FrameSettings& settings :
       {plain, filtered, small_settings({"all"}), small_settings({"contact", "transparent"}),
        small_settings({"gtao"})}) {
    const auto renderer = FrameRenderer::create(make_device(), scene, settings).value();
    const std::vector<std::string> names = renderer->layers();
    EXPECT_FALSE(renderer->read(names[9])) << "no effect has a picture yet";
    renderer->render().value();
    EXPECT_EQ(renderer->layers(), names);
    std::vector<std::string> found;
    for (const FrameLayer& layer : find_layers(renderer->context(), renderer->lights(),
                                               renderer->effects(), renderer->filters())) {
      found.push_back(layer.name);
      EXPECT_NE(std::find(possible.begin(), possible.end(), layer.name), possible.end())
          << layer.name;
    }
    found.emplace_back("radiance");
    EXPECT_EQ(found, names);
    for (const std::string& name : names) EXPECT_TRUE(renderer->read(name)) << name;
  }
  const auto renderer = FrameRenderer::create(make_device(), scene, plain).value();
  EXPECT_TRUE(renderer->check_layer("sun"));
  const auto unknown = renderer->check_layer("gtao");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("no layer \"gtao\" but depth, "), std::string::npos);
  EXPECT_NE(unknown.error().message.find(", ao, sun, radiance"), std::string::npos);
}

TEST(Registry, FramesWithoutGlassSaySo) {
  const Scene scene = make_room();
  const auto says = [&](const std::vector<std::string>& names) {
    FrameSettings settings = small_settings(names);
    settings.volume.given = std::make_shared<IndirectVolume>();
    const auto renderer = FrameRenderer::create(make_device(), scene, settings).value();
    renderer->render().value();
    return std::any_of(
        renderer->context().left_out.begin(), renderer->context().left_out.end(),
        [](const std::string& text) { return text.find("glass and what else is blended") == 0; });
  };
  EXPECT_TRUE(says({"ao", "sun"}));
  EXPECT_FALSE(says({"sun", "transparent"}));
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
        std::any_of(renderer->context().left_out.begin(), renderer->context().left_out.end(),
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

// The mean of the frame's radiance.
double mean_radiance(FrameRenderer& renderer) {
  const FloatImage picture = renderer.read("radiance").value();
  double sum = 0;
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    if (i % picture.channels != 3) sum += picture.values[i];
  }
  return sum / static_cast<double>(picture.values.size());
}

// A frame whose only effect looks at the picture traces no map of a lamp, and says so.
TEST(Registry, MapsThatNothingReadsAreNotTraced) {
  const Scene scene = make_room();
  FrameSettings settings = small_settings({"gtao"});
  settings.primary = Primary::kRaster;
  const auto rays_of = [&](const FrameSettings& of, bool is_said) {
    rtapi::DeviceDesc desc;
    desc.CollectStatistics = true;
    const rtapi::Device device = rtapi::CreateDevice(desc).value();
    const auto renderer = FrameRenderer::create(device, scene, of).value();
    renderer->render().value();
    const auto& said = renderer->context().left_out;
    EXPECT_EQ(std::any_of(said.begin(), said.end(),
                          [](const std::string& line) {
                            return line.find("shadow maps of local lights") != std::string::npos;
                          }),
              is_said);
    std::uint64_t rays = 0;
    for (const PassStatistics& pass : renderer->runner().passes()) {
      rays += pass.rays.TraceRayCalls;
    }
    return rays;
  };
  EXPECT_EQ(rays_of(settings, true), 0u);
  FrameSettings lit = small_settings({"gtao", "local"});
  lit.primary = Primary::kRaster;
  EXPECT_GT(rays_of(lit, false), 0u);
}

// A prepared frame that was rendered on a device that counts.
struct Counted {
  std::unique_ptr<FrameRenderer> renderer;
  explicit Counted(const Scene& scene, const FrameSettings& settings) {
    rtapi::DeviceDesc desc;
    desc.CollectStatistics = true;
    renderer = FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene, settings).value();
    renderer->render().value();
  }
  std::uint64_t rays_before() const {
    return renderer->context().set_up.value().rays.TraceRayCalls;
  }
  // Empty: the frame has no such pass.
  std::optional<PassStatistics> pass(const std::string& name) const {
    for (const PassStatistics& pass : renderer->runner().passes()) {
      if (pass.name == name) return pass;
    }
    return std::nullopt;
  }
  bool leaves_out(const std::string& text) const {
    const auto& lines = renderer->context().left_out;
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(text) != std::string::npos;
    });
  }
};

// Baking reads the maps of lamps before the first frame; a volume that is there has no need of it.
TEST(Registry, MapsAreTracedBeforeTheFrameOnlyToBake) {
  const Scene scene = make_room();
  const Counted kept(scene, small_settings({"gi"}));
  EXPECT_EQ(kept.rays_before(), 0u);
  EXPECT_GT(kept.pass("local lights").value().rays.TraceRayCalls, 0u);
  FrameSettings baked = small_settings({"gi"});
  baked.volume = {.cell = 2.0f, .samples = 1};
  EXPECT_GT(Counted(scene, baked).rays_before(), 0u);
}

// An environment map is baked when it is made. What follows rays over the picture reads no lamp.
TEST(Registry, MapsThatOnlyAnEnvironmentMapReadsAreTracedOnce) {
  const Scene scene = make_room();
  const std::string said = "shadow maps of local lights in every frame";
  for (const std::string name : {"ssr", "ssr-masked", "ssr-stochastic", "ssr-blurred", "env-map"}) {
    const Counted frame(scene, small_settings({name}));
    EXPECT_GT(frame.rays_before(), 0u) << name;
    EXPECT_FALSE(frame.pass("local lights")) << name;
    EXPECT_TRUE(frame.leaves_out(said)) << name;
  }
  for (const std::string name : {"hybrid-reflections", "planar", "reflections"}) {
    const Counted frame(scene, small_settings({name}));
    EXPECT_GT(frame.pass("local lights").value().rays.TraceRayCalls, 0u) << name;
    EXPECT_FALSE(frame.leaves_out(said)) << name;
  }
}

// Nor are there lists for what looks at the picture alone, however many lamps there are.
TEST(Registry, LampsThatNothingReadsHaveNoLists) {
  Scene scene = make_room();
  const Light light = scene.lights.front();
  scene.lights.assign(4097, light);
  const Counted frame(scene, small_settings({"gtao"}));
  EXPECT_FALSE(frame.pass("local lights"));
  EXPECT_TRUE(frame.leaves_out("lists and shadow maps of local lights: no effect reads them"));
}

// Four floats a pixel.
TEST(Registry, SharpnessOfShadowsIsWrittenForDenoisersThatReadIt) {
  const Scene scene = make_room();
  const std::string said = "how sharp shadows are";
  FrameSettings filtered = small_settings({"sun", "contact"});
  filtered.denoise = default_denoise(DenoiseMethod::kSvgf);
  const Counted without(scene, small_settings({"sun", "contact"})), with(scene, filtered);
  for (const std::string pass : {"sun shadow", "contact shadow"}) {
    EXPECT_EQ(without.pass(pass)->bytes + 48 * 27 * 16, with.pass(pass)->bytes + 16) << pass;
  }
  EXPECT_TRUE(without.leaves_out(said));
  EXPECT_FALSE(with.leaves_out(said));
  EXPECT_EQ(without.renderer->read("sun").value().values,
            with.renderer->read("sun").value().values);
  EXPECT_FALSE(Counted(scene, small_settings({"gtao"})).leaves_out(said));
}

TEST(Registry, MatteSurfacesReflectTheLightAroundWithoutRays) {
  Scene scene = make_room();
  for (Material& material : scene.materials) {
    material.constants.metallic = 0;
    material.constants.roughness = 1;
    material.constants.image[kMetallicRoughnessTexture] = kNoTexture;
  }
  const auto render = [&](const std::vector<std::string>& names) {
    FrameSettings settings = small_settings(names);
    for (auto& [name, effect] : settings.effects) effect.samples = 16;
    auto renderer = FrameRenderer::create(make_device(), scene, settings).value();
    renderer->render().value();
    return renderer;
  };
  const auto said = [](const FrameRenderer& renderer) {
    return std::any_of(renderer.context().left_out.begin(), renderer.context().left_out.end(),
                       [](const std::string& text) { return text.find("reflections: no") == 0; });
  };
  const auto left_out = render({"all"}), traced = render({"all", "reflections"});
  EXPECT_FALSE(left_out->effects().renders("reflections"));
  EXPECT_TRUE(traced->effects().renders("reflections"));
  EXPECT_TRUE(said(*left_out));
  EXPECT_FALSE(said(*traced));
  const double reflected = mean_radiance(*traced);
  const double nothing = [&] {
    read_composed(*traced, {"sun", "local_lights", "indirect"}).value();
    return mean_radiance(*traced);
  }();
  ASSERT_GT(reflected, nothing);
  EXPECT_NEAR(mean_radiance(*left_out), reflected, 0.2 * (reflected - nothing));

  scene.materials[0].constants.roughness = 0.5f;
  EXPECT_TRUE(render({"all"})->effects().renders("reflections"));
}

TEST(Registry, EveryRowHasItsShaderFileAndItsOwnNames) {
  std::set<std::string> names, signals;
  for (const Effect& effect : northlight_effects()) {
    EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
    for (const EffectSignal& signal : effect.signals) {
      EXPECT_TRUE(signals.insert(signal.name).second) << signal.name;
    }
    EXPECT_FALSE(effect.pass && effect.make) << effect.name;
    if (effect.alternative_to.empty()) continue;
    EXPECT_NE(find_effect(northlight_effects(), effect.alternative_to), nullptr) << effect.name;
  }
  std::vector<std::string> all;
  for (const std::string& name : names) all.push_back(name);
  FrameSettings settings = small_settings(all);
  settings.taa = true;
  settings.order = RayOrder::kDirection;
  const auto libraries = frame_libraries(settings);
  EXPECT_GT(libraries.size(), 15u);
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
