// SPDX-License-Identifier: MIT
// Models of skin, eyes and hair against integrals by hand, and what the unified model is off by.
#include "effects/materials/material_variants.h"

#include <gtest/gtest.h>
#include <rtapi/upload.h>
#include <shaders/variant_values.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <string>
#include <vector>

#include "effects/assets/built_in/portrait.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/engine/compute_pass.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kRows = 1024, kColumns = 512;
constexpr double kSkinWrap[] = {0.35, 0.15, 0.08};  // as in skin.hlsli
constexpr double kHairTilt = 0.035;                 // as in hair.hlsli

// Mirrors ValueConstants of variant_values.hlsl.
struct ValueWords {
  std::uint32_t model = 0;
  std::uint32_t rows = kRows, columns = kColumns;
  float cosine_view = 1;
  glm::vec3 color{1.0f};
  float roughness = 0.5f;
  glm::vec3 swapped_light{0.0f};
  float f0 = 0.04f;
  float f90 = 1;
};

class MaterialVariants : public test::OnBackends {
 protected:
  void SetUp() override {
    test::OnBackends::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    scene_ = make_portrait();
    rtapi::DeviceDesc desc;
    desc.Backend = GetParam();
    device_ = test::device_for(desc);
    FrameSettings settings;
    settings.width = settings.height = 8;
    settings.whole_frame = false;
    renderer_ = FrameRenderer::create(device_, scene_, settings).value();
    views_ = renderer_->frame().create_pass_views(device_).value();
    rtapi::BufferDesc buffer;
    buffer.SizeInBytes = kRows * kColumns * sizeof(glm::vec4);
    buffer.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    buffer.InitialState = rtapi::ResourceStates::kUnorderedAccess;
    values_ = device_.CreateBuffer(buffer).value();
    views_.set_unordered_access(0, values_, sizeof(glm::vec4)).value();
    library_ = rtapi::LoadShaderLibrary(kaamos_shaders_variant_values()).value();
  }

  std::vector<glm::vec4> run(const char* shader, const ValueWords& words) {
    const Frame& frame = renderer_->frame();
    const ComputePass pass = ComputePass::create(device_, frame, library_, shader).value();
    renderer_->runner()
        .execute([&](rtapi::CommandList& list) {
          pass.dispatch_groups(list, frame, {}, PassArguments(views_, words), kRows * kColumns / 64,
                               1);
        })
        .value();
    const auto bytes = rtapi::ReadbackBuffer(device_, renderer_->queue(), values_).value();
    std::vector<glm::vec4> out(kRows * kColumns);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }

  // Light that is sent to the view where light of radiance 1 comes from everywhere.
  glm::dvec3 furnace(const ValueWords& words) {
    glm::dvec3 sum(0.0);
    for (const glm::vec4& value : run("VariantValues", words)) sum += glm::dvec3(value);
    return sum * (4 * glm::pi<double>() / (kRows * kColumns));
  }

  Scene scene_;
  rtapi::Device device_;
  std::unique_ptr<FrameRenderer> renderer_;
  PassViews views_;
  rtapi::Buffer values_;
  rtapi::ShaderLibrary library_;
};
INSTANTIATE_TEST_SUITE_P(Backends, MaterialVariants, testing::Values("embree", "vulkan"),
                         [](const auto& each) { return each.param; });

// Without a specular part, the integral of the wrapped cosine is pi.
TEST_P(MaterialVariants, SkinSendsOnAsMuchAsItsColorSays) {
  for (const float cosine : {1.0f, 0.6f, 0.1f}) {
    const glm::dvec3 sent = furnace({.model = kMaterialSkin,
                                     .cosine_view = cosine,
                                     .color = {0.8f, 0.5f, 0.25f},
                                     .f0 = 0,
                                     .f90 = 0});
    EXPECT_NEAR(sent.x, 0.8, 1e-4);
    EXPECT_NEAR(sent.y, 0.5, 1e-4);
    EXPECT_NEAR(sent.z, 0.25, 1e-4);
  }
}

// Straight on, (1 + w) / (1 + w)^2 of Lambert; at the horizon w / (1 + w)^2, where that is dark.
TEST_P(MaterialVariants, SkinIsLitBeyondTheHorizon) {
  const std::vector<glm::vec4> values =
      run("VariantValues", {.model = kMaterialSkin, .rows = 1001, .columns = 1, .f0 = 0, .f90 = 0});
  for (std::uint32_t row : {0u, 250u, 500u, 600u, 900u}) {
    const double cosine = values[row].w;
    EXPECT_NEAR(cosine, 1 - 2 * (row + 0.5) / 1001, 1e-6);
    for (int c = 0; c < 3; ++c) {
      const double w = kSkinWrap[c];
      const double expected = std::max(cosine + w, 0.0) / std::pow(1 + w, 2) / glm::pi<double>();
      EXPECT_NEAR(values[row][c], expected, 1e-6) << row << " " << c;
    }
  }
}

// Lambert below a coat that reflects F by Schlick's law on the way in and out: the mean of F over
// the light's directions is f0 + (1 - f0) / 21.
TEST_P(MaterialVariants, AnEyeLosesLightInAndOut) {
  for (const float cosine : {1.0f, 0.6f, 0.3f}) {
    for (const float f0 : {0.025f, 0.2f}) {
      ValueWords words = {
          .model = kMaterialEye, .cosine_view = cosine, .color = glm::vec3(0.7f), .f0 = f0};
      const double with_color = furnace(words).x;
      words.color = glm::vec3(0);
      const double coat = furnace(words).x;
      const double seen = 1 - (f0 + (1 - f0) * std::pow(1 - cosine, 5));
      const double entered = (1 - f0) * 20 / 21;
      EXPECT_NEAR(with_color - coat, 0.7 * seen * entered, 2e-4) << cosine << " " << f0;
      EXPECT_LT(with_color, 1);
    }
  }
}

// Snell's law on a ball of radius 1, for rays straight along the axis.
TEST_P(MaterialVariants, AnIrisIsSeenWhereRefractionPutsIt) {
  const std::vector<glm::vec4> places = run("IrisPlaces", {.rows = 64});
  for (std::uint32_t i = 0; i < 64; ++i) {
    const double x = places[i].x, in = std::asin(x), inside = std::asin(x / 1.376);
    // The ray turns by the difference towards the axis, on its way from the ball to the plane.
    const double expected = x - (std::sqrt(1 - x * x) - 0.8) * std::tan(in - inside);
    EXPECT_NEAR(places[i].y, expected, 1e-5) << x;
    EXPECT_NEAR(places[i].z, 0, 1e-6);
  }
  EXPECT_LT(places[63].y, places[63].x - 0.01);
}

// Part of a Gaussian about `shift` that lies where a light's sine can be, -1 to 1.
double mass(double shift, double width, double sine_view) {
  const double root = width * std::sqrt(2.0);
  return 0.5 *
         (std::erf((1 + sine_view - shift) / root) - std::erf((-1 + sine_view - shift) / root));
}

// Each lobe sends on the mass of its Gaussian: R as much as Fresnel's law reflects on average
// around the fibre, TT and TRT what is left of the rest on its way through the coloured fibre.
TEST_P(MaterialVariants, HairSendsOnTheMassOfItsLobes) {
  struct Row {
    float f0, f90;
  };
  constexpr double kWidth = 0.25;  // of R, at roughness 0.5
  const double part = 31.0 / 3 - 105 * glm::pi<double>() / 32;
  for (const Row& row : {Row{0, 0}, Row{1, 1}, Row{0.0465f, 1}, Row{0.3f, 1}}) {
    for (const float sine : {0.0f, 0.5f, 0.9f}) {
      const ValueWords words = {.model = kMaterialHair,
                                .cosine_view = sine,  // to the fibre, which runs along +Z
                                .color = {0.6f, 0.3f, 0.1f},
                                .roughness = 0.5f,
                                .f0 = row.f0,
                                .f90 = row.f90};
      const glm::dvec3 sent = furnace(words);
      const double mean = row.f0 + (row.f90 - row.f0) * part, through = (1 - mean) * (1 - mean);
      for (int c = 0; c < 3; ++c) {
        const double color = words.color[c];
        const double expected =
            mean * mass(-2 * kHairTilt, kWidth, sine) +
            through * color * mass(kHairTilt, 0.5 * kWidth, sine) +
            through * mean * color * color * mass(4 * kHairTilt, 2 * kWidth, sine);
        EXPECT_NEAR(sent[c], expected, 1e-3) << row.f0 << " " << sine << " " << c;
      }
    }
  }
}

TEST_P(MaterialVariants, NoneMakesEnergy) {
  for (const std::uint32_t model : {0u, std::uint32_t{kMaterialSkin}, std::uint32_t{kMaterialEye},
                                    std::uint32_t{kMaterialHair}}) {
    for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f}) {
      const double sent = furnace({.model = model,
                                   .cosine_view = model == kMaterialHair ? 1 - cosine : cosine,
                                   .f0 = 0.0465f})
                              .x;
      EXPECT_LE(sent, 1.0005) << model << " " << cosine;
      EXPECT_GT(sent, 0.6) << model << " " << cosine;
    }
  }
}

// Values have the light's cosine in them; without it view and light can change places. Hair has no
// normal and no cosine. Skin's wrapped cosine is of the light alone.
TEST_P(MaterialVariants, EyesAndHairAreReciprocalAndSkinIsNot) {
  const auto skew = [&](std::uint32_t model) {
    ValueWords words = {.model = model, .rows = 64, .columns = 64, .cosine_view = 0.8f};
    const std::vector<glm::vec4> values = run("VariantValues", words);
    double worst = 0;
    for (const std::uint32_t at : {70u, 640u + 3, 1200u + 9}) {
      const double z = values[at].w, turn = 2 * glm::pi<double>() * (at % 64 + 0.5) / 64;
      const double r = std::sqrt(1 - z * z);
      words.swapped_light = glm::vec3(r * std::cos(turn), r * std::sin(turn), z);
      const glm::vec4 swapped = run("VariantValues", words)[0];
      const bool has_cosine = model != kMaterialHair;
      const double there = values[at].x / (has_cosine ? z : 1);
      const double back = swapped.x / (has_cosine ? swapped.w : 1);
      worst = std::max(worst, std::abs(there - back) / std::max(there, back));
    }
    return worst;
  };
  EXPECT_LT(skew(kMaterialEye), 1e-4);
  EXPECT_LT(skew(kMaterialHair), 1e-4);
  EXPECT_GT(skew(kMaterialSkin), 0.02);
}

// A ball in the middle of an orthographic picture, with the sun behind the camera.
TEST_P(MaterialVariants, TheFrameHasTheDifference) {
  Scene scene = start_scene("ball");
  MaterialConstants skin;
  skin.base_color = glm::vec4(0.8f, 0.5f, 0.4f, 1);
  skin.specular = 0;
  skin.flags = kMaterialSkin;
  add_thing(scene, "ball", ball(1, 256, 128), add_material(scene, "skin", skin),
            translate({0, 0, -5}));
  scene.sun = Sun{.direction_to_sun = {0, 0, 1}, .irradiance = glm::vec3(2), .angular_radius = 0};
  Camera camera;
  camera.half_height = 1.5;
  scene.cameras.push_back(camera);
  FrameSettings settings;
  settings.width = settings.height = 33;
  settings.effects = choose_effects({"sun", "material-variants"});
  settings.denoise.method = DenoiseMethod::kNone;
  rtapi::DeviceDesc device;
  device.Backend = GetParam();
  const auto renderer = FrameRenderer::create(test::device_for(device), scene, settings).value();
  renderer->render().value();
  const FloatImage difference = renderer->read("material_variants").value();
  for (std::uint32_t c = 0; c < 3; ++c) {
    const double lambert = 2 * skin.base_color[static_cast<int>(c)] / glm::pi<double>();
    EXPECT_NEAR(difference.at(16, 16, c), lambert * (1 / (1 + kSkinWrap[c]) - 1), 2e-3);
  }
}

// Root mean square difference of the unified model over an instance, and its mean, in the light of
// the sun.
TEST(Portrait, WhatTheUnifiedModelCosts) {
  const Scene scene = make_portrait();
  FrameSettings settings;
  settings.width = 320;
  settings.height = 180;
  settings.effects = choose_effects({"sun", "material-variants"});
  settings.denoise.method = DenoiseMethod::kNone;
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  const FloatImage own = renderer->read("radiance").value();
  const FloatImage difference = renderer->read("material_variants").value();
  const FloatImage ids = renderer->read("ids").value();
  double errors[5] = {};
  for (std::size_t instance = 2; instance < 5; ++instance) {
    double squares = 0, bias = 0, mean = 0;
    for (std::size_t i = 0; i < own.values.size(); ++i) {
      if (i % 4 == 3 || static_cast<std::size_t>(ids.values[i / 4 * 2]) != instance + 1) continue;
      squares += std::pow(difference.values[i], 2);
      bias -= difference.values[i];
      mean += own.values[i];
    }
    double count = 0;
    for (std::size_t i = 0; i < ids.values.size(); i += 2) {
      count += static_cast<std::size_t>(ids.values[i]) == instance + 1 ? 3 : 0;
    }
    ASSERT_GT(count, 300);
    errors[instance] = std::sqrt(squares / count) / (mean / count);
    std::printf("%s by the unified model: RMSE %.3f of the mean, energy %+.1f %%\n",
                scene.instances[instance].name.c_str(), errors[instance], 100 * bias / mean);
  }
  // They are far apart where the models say that they are, and nowhere else.
  for (std::size_t instance = 2; instance < 5; ++instance) EXPECT_GT(errors[instance], 0.1);
  for (std::size_t i = 0; i < difference.values.size(); ++i) {
    if (i % 4 != 3 && ids.values[i / 4 * 2] == 1) {
      EXPECT_EQ(difference.values[i], 0) << "the floor";
    }
  }
}

// Hits that are shaded by the unified model alone leave the mirror as it is.
TEST(Portrait, MirrorsShowWhatTheSettingSays) {
  const Scene scene = make_portrait();
  for (const std::uint32_t at_hits : {0u, 1u}) {
    FrameSettings settings;
    settings.width = 160;
    settings.height = 90;
    settings.effects = choose_effects({"material-variants"});
    settings.effects.at("material-variants").set_constants(VariantConstants{.at_hits = at_hits});
    const auto renderer =
        FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
    renderer->render().value();
    const FloatImage difference = renderer->read("material_variants").value();
    const FloatImage ids = renderer->read("ids").value();
    double mirrored = 0;
    for (std::size_t i = 0; i < ids.values.size() / 2; ++i) {
      if (ids.values[2 * i] == 2) mirrored += std::abs(difference.values[4 * i]);
    }
    EXPECT_EQ(mirrored > 10, at_hits == 1) << mirrored;
    if (at_hits == 0) {
      EXPECT_EQ(mirrored, 0);
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
