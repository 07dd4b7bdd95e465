// SPDX-License-Identifier: MIT
// Tests what the deck packs into atlases besides the lights' shadow maps: the slides of spots, each
// texel where it belongs, and the sun's map, against the rays that it stands for. [Northlight deck:
// Lighting Data]
#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/built_in/matched_scenes.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/projector.h"
#include "effects/light/lights/lighting.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/reflections/traced/reflections.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

class Atlas : public test::OnBackends {
 protected:
  std::unique_ptr<FrameRenderer> render(const Scene& scene, FrameSettings settings) const {
    settings.width = 64;
    settings.height = 40;
    settings.denoise.method = DenoiseMethod::kNone;
    settings.volume.given = std::make_shared<IndirectVolume>();
    rtapi::DeviceDesc device;
    device.Backend = GetParam();
    auto out = FrameRenderer::create(test::device_for(device), scene, settings).value();
    out->render().value();
    return out;
  }
};

// A spot above a plane, tilted, so that its slide is stretched; 4 x 4 texels, each its own colour.
Scene slide_on_plane(bool with_slide) {
  Scene scene = make_sphere_oracle(0.01, 0.02);
  scene.sun.reset();
  scene.samplers = {{.wrap_u = Wrap::kClamp,
                     .wrap_v = Wrap::kClamp,
                     .mag_filter = Filter::kNearest,
                     .mipmapped = false}};
  TextureImage image;
  image.name = "slide";
  image.width = image.height = 4;
  image.mips.emplace_back(4 * 4 * 4);
  for (std::size_t i = 0; i < 16; ++i) {
    std::uint8_t* out = &image.mips[0][4 * i];
    out[0] = static_cast<std::uint8_t>(51 * (i % 4 + 1));
    out[1] = static_cast<std::uint8_t>(51 * (i / 4 + 1));
    out[2] = 255;
    out[3] = 255;
  }
  scene.images = {image};
  Light light;
  light.name = "projector";
  light.type = LightType::kSpot;
  light.position = {0.5, 4, 1};
  light.direction = glm::vec3(glm::normalize(glm::dvec3(0, 0, 0) - light.position));
  light.outer_cone_angle = 0.7f;
  light.inner_cone_angle = 0.69f;
  light.range = 50;
  light.intensity = 20;
  light.radius = 0;
  if (with_slide) light.projection = ProjectionMap{.up = {0, 0, -1}};
  scene.lights = {light};
  scene.cameras.front().camera_to_world = look_at({0.2, 5, 2}, {0, 0, 0});
  scene.cameras.front().vertical_fov = 0.8;
  return scene;
}

TEST_P(Atlas, SlidesLieWhereTheSpotThrowsThem) {
  FrameSettings settings;
  settings.effects = choose_effects({"local"});
  const auto with = render(slide_on_plane(true), settings);
  const auto without = render(slide_on_plane(false), settings);
  const FloatImage seen = with->read("local_lights").value();
  const FloatImage plain = without->read("local_lights").value();
  const FloatImage position = with->read("position").value();
  const Scene scene = slide_on_plane(true);
  const Light& light = scene.lights.front();
  const glm::dvec3 eye = scene.cameras.front().position();
  const glm::dvec3 axis(light.direction);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, -1)));
  const glm::dvec3 up = glm::cross(right, axis);
  int count = 0;
  for (std::uint32_t y = 0; y < seen.height; ++y) {
    for (std::uint32_t x = 0; x < seen.width; ++x) {
      if (!(plain.at(x, y, 0) > 0)) continue;
      const glm::dvec3 p =
          eye + glm::dvec3(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
      const glm::dvec3 d = p - light.position;
      const double scale = 1 / (glm::dot(d, axis) * std::tan(0.7));
      const double u = 2 + 2 * glm::dot(d, right) * scale, v = 2 - 2 * glm::dot(d, up) * scale;
      // Not beside an edge between texels.
      if (std::abs(u - std::round(u)) < 0.01 || std::abs(v - std::round(v)) < 0.01) continue;
      const float red = 0.2f * static_cast<float>(std::floor(u) + 1);
      const float green = 0.2f * static_cast<float>(std::floor(v) + 1);
      EXPECT_NEAR(seen.at(x, y, 0) / plain.at(x, y, 0), red, 1e-3f) << u << ", " << v;
      EXPECT_NEAR(seen.at(x, y, 1) / plain.at(x, y, 1), green, 1e-3f) << u << ", " << v;
      EXPECT_NEAR(seen.at(x, y, 2) / plain.at(x, y, 2), 1, 1e-3f);
      ++count;
    }
  }
  EXPECT_GT(count, 800);
}

// A mirror in a yard: the sun's shadows in it by rays, by the map, and without the sun.
TEST_P(Atlas, TheSunsMapShadowsWhatRaysHitAsRaysDo) {
  const auto mirrored = [&](SunAtHits sun, std::uint32_t map) {
    FrameSettings settings;
    settings.effects = choose_effects({"reflections"});
    ReflectionConstants constants;
    constants.length_jitter = 0;
    constants.fireflies = Fireflies::kKeep;
    constants.sun_at_hits = sun;
    settings.effects.at("reflections").set_constants(constants);
    settings.sun_map = map;
    const auto renderer = render(make_matched_yard(), settings);
    return renderer->read("reflection").value();
  };
  const FloatImage rays = mirrored(SunAtHits::kByRay, 0);
  const FloatImage map = mirrored(SunAtHits::kByMap, 1024);
  int differ = 0;
  for (std::size_t i = 0; i < rays.values.size(); i += rays.channels) {
    if (std::abs(rays.values[i] - map.values[i]) > 0.02f) ++differ;
  }
  EXPECT_LT(differ, 25);  // edges of shadows
  if (GetParam() != "embree") return;
  const FloatImage coarse = mirrored(SunAtHits::kByMap, 64);
  const FloatImage none = mirrored(SunAtHits::kNone, 0);
  int lit = 0, differ_coarse = 0;
  for (std::size_t i = 0; i < rays.values.size(); i += rays.channels) {
    const float unlit = none.values[i];
    if (std::abs(rays.values[i] - unlit) > 0.01f) ++lit;
    if (std::abs(rays.values[i] - coarse.values[i]) > 0.02f) ++differ_coarse;
  }
  EXPECT_GT(lit, 300);
  EXPECT_GT(differ_coarse, differ);  // wider ones
  // Without a map in the frame rays are traced: the same bits.
  EXPECT_EQ(mirrored(SunAtHits::kByMap, 0).values, rays.values);
}

TEST(AtlasLayouts, TilesAndTheSunsMapLieBesideEachOther) {
  const AtlasLayout few = atlas_layout(3, 0), many = atlas_layout(4096, 2048);
  EXPECT_EQ(few.width, 3 * kShadowTile);
  EXPECT_EQ(few.height, kShadowTile);
  EXPECT_EQ(many.tile_width, kShadowTilesPerRow * kShadowTile);
  EXPECT_EQ(many.width, many.tile_width + 2048);
  EXPECT_EQ(many.height, 16384u);
  EXPECT_EQ(atlas_layout(0, 8192).height, 8192u);
}

TEST(AtlasSettings, WrongOnesAreRefused) {
  Scene scene = make_projector();
  ASSERT_TRUE(validate(scene).ok());
  scene.lights[0].projection->image = 7;
  EXPECT_NE(validate(scene).error().message.find("image 7 of 2"), std::string::npos);
  scene = make_projector();
  scene.lights[1].type = LightType::kPoint;
  EXPECT_NE(validate(scene).error().message.find("is no spot"), std::string::npos);
  FrameSettings settings;
  settings.width = settings.height = 8;
  settings.effects = choose_effects({"local"});
  settings.sun_map = 10000;
  const auto made =
      FrameRenderer::create(rtapi::CreateDevice().value(), make_projector(), settings);
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("8192"), std::string::npos);
}

// The scene on the device stays where it was made for.
TEST(AtlasSettings, ARendererThatStandsStillRefusesACameraThatMoves) {
  const Scene scene = make_projector();
  FrameSettings settings;
  settings.width = settings.height = 8;
  settings.effects = choose_effects({"local"});
  auto renderer = FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  FrameMoment moment;
  moment.index = 1;
  moment.camera = scene.cameras.front();
  EXPECT_TRUE(renderer->begin_frame(moment).ok());
  moment.camera.camera_to_world[3].x += 0.5;
  const auto status = renderer->begin_frame(moment);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("FrameSettings::moving"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Backends, Atlas, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

}  // namespace
}  // namespace kaamos::effects
