// SPDX-License-Identifier: MIT
//
// Inputs at the ends of their ranges: what must be exact there, and what must stay finite.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "comparing.h"
#include "effects/assets/scene/shapes.h"
#include "room.h"

namespace kaamos::test {
namespace {

using namespace effects;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

RigOptions small(std::uint32_t effects) {
  RigOptions options;
  options.effects = effects;
  options.width = 32;
  options.height = 18;
  options.samples = 2;
  options.denoise = DenoiseMethod::kNone;
  if ((effects & kRigIndirect) != 0) options.volume = IndirectVolume{};
  return options;
}

void expect_all(const FloatImage& image, float value, const std::string& what) {
  for (const float v : image.values) ASSERT_EQ(v, value) << what;
}

void expect_within(const FloatImage& image, float low, float high, const std::string& what) {
  for (const float v : image.values) {
    ASSERT_GE(v, low) << what;  // false for NaN
    ASSERT_LE(v, high) << what;
  }
}

// --- Ambient occlusion

TEST(AmbientOcclusionExtremes, NoRadiusIsOpen) {
  RigOptions options = small(kRigAo);
  options.ao_radius = 0;
  options.samples = 16;
  expect_all(render(make_room(), options).at("ao"), 1, "radius 0");
}

TEST(AmbientOcclusionExtremes, InfiniteRadiusIsThatOfAnyLargeOne) {
  RigOptions options = small(kRigAo);
  options.ao_radius = kInfinity;
  const Pictures infinite = render(make_room(), options);
  options.ao_radius = 100;
  EXPECT_EQ(differing(infinite, render(make_room(), options), {}), "");
  expect_within(infinite.at("ao"), 0, 1, "infinite");
}

// --- Sun

TEST(SunExtremes, ASunWithoutAreaHasNoNoise) {
  Scene scene = make_room();
  scene.sun->angular_radius = 0;
  RigOptions options = small(kRigSun);
  options.samples = 1;
  const Pictures one = render(scene, options);
  options.samples = 8;
  EXPECT_EQ(one.at("sun").values, render(scene, options).at("sun").values);
}

// Every direction of the sun has a valid basis.
TEST(SunExtremes, EveryDirectionHasItsDisk) {
  const RigOptions options = small(kRigSun | kRigReflections | kRigGlass);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      Pictures exact;
      for (const float off : {0.0f, 1e-7f, -1e-7f}) {
        Scene scene = make_room();
        glm::vec3 d(off);
        d[axis] = sign;
        scene.sun->direction_to_sun = glm::normalize(d);
        const Pictures now = render(scene, options);
        const std::string what = "axis " + std::to_string(axis) + " sign " + std::to_string(sign) +
                                 " off by " + std::to_string(off);
        EXPECT_EQ(not_finite(now), "") << what;
        expect_within(now.at("sun"), 0, 1, what);
        if (off == 0) {
          exact = now;
          continue;
        }
        // Rounding decides whether surfaces parallel to the light are lit; none of the walls are
        // here.
        EXPECT_LE(pixels_off(now.at("sun"), exact.at("sun"), 0.6), 4u) << what;
      }
    }
  }
}

TEST(SunExtremes, OneStraightBelowLightsNoFloor) {
  Scene scene = make_room();
  scene.sun->direction_to_sun = {0, -1, 0};
  const Pictures pictures = render(scene, small(kRigSun));
  const FloatImage& ids = pictures.at("ids");
  for (std::size_t i = 0; i < ids.values.size(); i += 2) {
    const bool is_floor = ids.values[i] == 1;
    ASSERT_TRUE(!is_floor || pictures.at("sun").values[i / 2] == 0) << i / 2;
  }
}

TEST(SunExtremes, ASunOfHalfTheSkyIsFinite) {
  for (const float degrees : {45.0f, 90.0f, 120.0f, kInfinity, kNan}) {
    Scene scene = make_room();
    scene.sun->angular_radius = glm::radians(degrees);
    const Pictures pictures = render(scene, small(kRigSun));
    EXPECT_EQ(not_finite(pictures), "") << degrees;
    expect_within(pictures.at("sun"), 0, 1, std::to_string(degrees));
  }
}

// A page 0.1 mm thick, from near and far: light reaches one side and never passes through.
TEST(SunExtremes, NoLightGoesThroughAPage) {
  Scene scene = make_room();
  scene.meshes.resize(1);
  scene.instances.resize(1);
  scene.meshes[0] = Mesh{};
  add_shape(scene.meshes[0], box({1, 5e-5, 1}), kRoomWall);
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(0.3f, 1, 0.2f));
  for (const double distance : {1.0, 10.0, 100.0, 300.0}) {
    for (const double side : {1.0, -1.0}) {
      Camera& camera = scene.cameras.front();
      const glm::dvec3 eye = glm::normalize(glm::dvec3(0.4, side, 0.3)) * distance;
      camera.camera_to_world = look_at(eye, glm::dvec3(0));
      camera.vertical_fov = 0.5 / distance;
      RigOptions options = small(kRigSun | kRigAo);
      options.ao_radius = 1e-3f;
      const Pictures pictures = render(scene, options);
      expect_all(pictures.at("sun"), side > 0 ? 1 : 0, std::to_string(distance));
      expect_all(pictures.at("ao"), 1, "ao " + std::to_string(distance));
    }
  }
}

// --- Local lights and contact shadows

TEST(LightExtremes, WithoutAnyLightAllIsBlack) {
  Scene scene = make_room();
  scene.lights.clear();
  scene.sun.reset();
  scene.sky = {};
  scene.materials[kRoomLamp].constants.emissive = glm::vec3(0);
  RigOptions options;
  const Pictures pictures = render(scene, options);
  for (const char* name : {"direct", "local", "indirect", "reflection", "glass", "radiance"}) {
    expect_all(pictures.at(name), 0, name);
  }
  for (std::size_t i = 0; i < pictures.at("contact").values.size(); i += 4) {
    ASSERT_EQ(pictures.at("contact").values[i], 1);
    ASSERT_EQ(pictures.at("contact").values[i + 1], 1);
  }
}

TEST(LightExtremes, ALightWithoutRadiusHasAHardShadow) {
  Scene scene = make_room();
  for (Light& light : scene.lights) light.radius = 0;
  RigOptions options = small(kRigLocal | kRigContact);
  options.contact.length = 1e6f;  // reaches the light
  options.samples = 1;
  const Pictures one = render(scene, options);
  options.samples = 8;
  EXPECT_EQ(one.at("contact").values, render(scene, options).at("contact").values);
}

// Wherever lights stand and whatever their values, no pixel becomes NaN, infinite or negative.
TEST(LightExtremes, NoPlaceAndNoStrengthBreaksAPixel) {
  const Scene room = make_room();
  const RigOptions options =
      small(kRigLocal | kRigContact | kRigReflections | kRigGlass | kRigIndirect);
  struct {
    const char* what;
    void (*change)(Light&, const Scene&);
  } const changes[] = {
      {"on the floor",
       [](Light& l, const Scene&) {
         l.position = {0, 0, 0};
       }},
      {"in a corner",
       [](Light& l, const Scene&) {
         l.position = {-2, 0, -2};
       }},
      {"in the ball",
       [](Light& l, const Scene&) {
         l.position = {0.75, 0.375, -0.5};
       }},
      {"in the camera",
       [](Light& l, const Scene& s) { l.position = s.cameras.front().position(); }},
      {"on the pane",
       [](Light& l, const Scene&) {
         l.position = {0.375, 1, 0.25};
       }},
      {"wider than the room", [](Light& l, const Scene&) { l.radius = 10; }},
      {"touches the floor", [](Light& l, const Scene&) { l.position.y = l.radius; }},
      {"without range", [](Light& l, const Scene&) { l.range = 0; }},
      {"with a range of 1e-6 m", [](Light& l, const Scene&) { l.range = 1e-6f; }},
      {"with an infinite range", [](Light& l, const Scene&) { l.range = kInfinity; }},
      {"of 1e9 cd", [](Light& l, const Scene&) { l.intensity = 1e9f; }},
      {"of 1e9 cd without range", [](Light& l, const Scene&) { l.intensity = 1e9f, l.range = 0; }},
      {"of 1e38 cd", [](Light& l, const Scene&) { l.intensity = 1e38f, l.range = 0; }},
      {"of no intensity", [](Light& l, const Scene&) { l.intensity = 0, l.range = 0; }},
      {"1e9 m away",
       [](Light& l, const Scene&) {
         l.position = {0, 1e9, 0};
       }},
      {"a cone of no angle",
       [](Light& l, const Scene&) { l.inner_cone_angle = l.outer_cone_angle = 0; }},
      {"a cone of a right angle",
       [](Light& l, const Scene&) { l.inner_cone_angle = l.outer_cone_angle = 1.5707964f; }},
      {"straight down",
       [](Light& l, const Scene&) {
         l.direction = {0, -1, 0};
       }},
      {"straight along -z",
       [](Light& l, const Scene&) {
         l.direction = {0, 0, -1};
       }},
      {"of negative radius", [](Light& l, const Scene&) { l.radius = -1; }},
  };
  for (const auto& change : changes) {
    for (const float radius : {0.0f, 0.0625f}) {
      Scene scene = room;
      for (Light& light : scene.lights) {
        light.radius = radius;
        change.change(light, scene);
      }
      const Pictures pictures = render(scene, options);
      const std::string what = std::string(change.what) + ", radius " + std::to_string(radius);
      EXPECT_EQ(not_finite(pictures), "") << what;
      for (const char* name : {"direct", "local", "reflection", "glass", "radiance", "indirect"}) {
        expect_within(pictures.at(name), 0, kInfinity, what + ": " + name);
      }
      expect_within(pictures.at("contact"), 0, 1, what);
    }
  }
}

// A light exactly at a pixel's position.
TEST(LightExtremes, APixelAtALightIsFinite) {
  Scene scene = make_room();
  const RigOptions options = small(kRigLocal | kRigContact | kRigReflections);
  const FloatImage position = render(scene, options).at("position");
  const glm::vec3 p(position.at(16, 14, 0), position.at(16, 14, 1), position.at(16, 14, 2));
  for (Light& light : scene.lights) {
    light.position = scene.cameras.front().position() + glm::dvec3(p);
    light.radius = 0;
  }
  const Pictures pictures = render(scene, options);
  EXPECT_EQ(not_finite(pictures), "");
  expect_within(pictures.at("contact"), 0, 1, "contact");
}

// --- Roughness and reflections

Scene with_roughness(float roughness) {
  Scene scene = make_room();
  for (Material& material : scene.materials) material.constants.roughness = roughness;
  return scene;
}

TEST(ReflectionExtremes, AlmostSmoothIsSmooth) {
  const RigOptions options = small(kRigReflections | kRigLocal);
  const Pictures mirror = render(with_roughness(0), options);
  EXPECT_EQ(not_finite(mirror), "");
  for (const float roughness : {-0.0f, 1e-4f, 1e-38f, -1.0f, kNan, -kInfinity}) {
    EXPECT_EQ(differing(render(with_roughness(roughness), options), mirror, {}), "") << roughness;
  }
}

TEST(ReflectionExtremes, RoughnessStaysInItsRange) {
  const RigOptions options = small(kRigReflections | kRigLocal);
  const Pictures rough = render(with_roughness(1), options);
  EXPECT_EQ(not_finite(rough), "");
  for (const float roughness : {1.5f, 1e38f, kInfinity}) {
    EXPECT_EQ(differing(render(with_roughness(roughness), options), rough, {}), "") << roughness;
  }
  for (const float roughness : {0.01f, 0.03f, 0.031f, 0.1f}) {
    EXPECT_EQ(not_finite(render(with_roughness(roughness), options)), "") << roughness;
  }
}

// Rays reach 200 m for a mirror and 3 m for a rough surface, and never shade anything further away.
TEST(ReflectionExtremes, RaysAreAsLongAsTheirRoughnessAllows) {
  double before = 1e30;
  for (const float roughness : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    const float allowed = 200.0f * std::pow(3.0f / 200.0f, roughness);
    const FloatImage length =
        render(with_roughness(roughness), small(kRigReflections)).at("reflection_length");
    const float longest = *std::max_element(length.values.begin(), length.values.end());
    EXPECT_LE(longest, allowed * 1.01f) << roughness;
    EXPECT_LT(longest, before) << roughness;
    before = longest;
  }
}

// --- Glass

Scene with_pane(float alpha) {
  Scene scene = make_room();
  scene.materials[kRoomGlass].constants.base_color.a = alpha;
  return scene;
}

TEST(GlassExtremes, NoCoverageIsNoGlassExactly) {
  const RigOptions options = small(kRigAll & ~std::uint32_t{kRigIndirect});
  Scene without = make_room();
  std::erase_if(without.instances, [](const Instance& i) { return i.mask == kMaskTransparent; });
  EXPECT_EQ(differing(render(with_pane(0), options), render(without, options), {}), "");
}

TEST(GlassExtremes, FullCoverageLetsNothingThrough) {
  for (const float alpha : {1.0f, 2.0f, kInfinity}) {
    const Pictures pictures = render(with_pane(alpha), small(kRigGlass));
    const FloatImage& layers = pictures.at("glass_layers");
    for (std::size_t i = 0; i < layers.values.size(); ++i) {
      if (layers.values[i] == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(pictures.at("transmittance").values[3 * i + c], 0) << alpha;
      }
    }
  }
}

TEST(GlassExtremes, ACameraInTheGlassSeesTheWayOut) {
  Scene scene = make_room();
  // As thick as the room, and around the camera.
  Instance& pane = scene.instances.back();
  pane.transform = translate(scene.cameras.front().position()) *
                   glm::dmat4(glm::dmat3(1.0, 0, 0, 0, 1.0, 0, 0, 0, 32.0));
  const Pictures pictures = render(scene, small(kRigGlass));
  EXPECT_EQ(not_finite(pictures), "");
  const FloatImage& layers = pictures.at("glass_layers");
  EXPECT_EQ(*std::max_element(layers.values.begin(), layers.values.end()), 1);
}

// --- The volume of indirect light

IndirectVolume filled(const glm::dvec3& origin, float cell, const glm::uvec3& bricks,
                      glm::vec3 (*mean)(const glm::dvec3&)) {
  IndirectVolume volume;
  volume.origin = origin;
  volume.cell = cell;
  volume.bricks = bricks;
  for (std::uint32_t i = 0; i < bricks.x * bricks.y * bricks.z; ++i) {
    volume.brick_starts.push_back(i * kCellsPerBrick);
  }
  volume.cells.resize(volume.brick_starts.size() * kCellsPerBrick);
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    volume.cells[i].mean = mean(centers[i]);
    volume.cells[i].validity = 1;
  }
  return volume;
}

Pictures render_volume(const IndirectVolume& volume) {
  RigOptions options = small(kRigIndirect);
  options.samples = 1;
  options.indirect.mode = IndirectMode::kDirect;
  options.volume = volume;
  return render(make_room(), options);
}

glm::vec3 black(const glm::dvec3&) {
  return glm::vec3(0);
}
glm::vec3 one(const glm::dvec3&) {
  return glm::vec3(1);
}
glm::vec3 linear(const glm::dvec3& p) {
  return glm::vec3(p + 8.0);
}

TEST(VolumeExtremes, BlackIsBlackAndOutsideIsTheSky) {
  expect_all(render_volume(filled({-8, -8, -8}, 1, {2, 2, 2}, black)).at("indirect"), 0, "black");
  const Pictures none = render_volume({});
  const glm::vec3 sky = make_room().sky.zenith;
  for (std::size_t i = 0; i < none.at("indirect").values.size(); ++i) {
    ASSERT_EQ(none.at("indirect").values[i], sky[static_cast<int>(i % 3)]);
  }
  for (const double far : {100.0, 1e6, 1e12, -1e30}) {
    EXPECT_EQ(differing(render_volume(filled(glm::dvec3(far), 1, {1, 1, 1}, one)), none, {}), "")
        << far;
  }
}

// Interpolation reproduces a linear field exactly: no cell, corner or brick border shows. Bricks of
// 8 cells end inside the room.
TEST(VolumeExtremes, BordersOfCellsAndBricksDoNotShow) {
  for (const float cell : {0.25f, 0.125f}) {
    const IndirectVolume volume =
        filled({-3, -1, -3}, cell, glm::uvec3(glm::ceil(6.0f / (8 * cell))), linear);
    const Pictures pictures = render_volume(volume);
    const Camera camera = make_room().cameras.front();
    const FloatImage& position = pictures.at("position");
    const FloatImage& normal = pictures.at("normal");
    double worst = 0;
    for (std::size_t i = 0; i < position.values.size() / 4; ++i) {
      const float u = normal.values[2 * i], v = normal.values[2 * i + 1];
      glm::dvec3 n(u, v, 1 - std::abs(u) - std::abs(v));
      // The ball is smooth, so its normals are not those of its triangles.
      if (pictures.at("ids").values[2 * i] == 7) continue;
      if (n.z < 0) {
        n.x = (1 - std::abs(v)) * (u >= 0 ? 1 : -1);
        n.y = (1 - std::abs(u)) * (v >= 0 ? 1 : -1);
      }
      for (int c = 0; c < 3; ++c) {
        const double p =
            camera.position()[c] + position.values[4 * i + static_cast<std::size_t>(c)];
        const double expected = p + glm::normalize(n)[c] * 0.5 * cell + 8;
        worst = std::max(
            worst, std::abs(pictures.at("indirect").values[3 * i + static_cast<std::size_t>(c)] -
                            expected));
      }
    }
    std::printf("cells of %g m: off by up to %.1e of 11\n", static_cast<double>(cell), worst);
    EXPECT_LE(worst, 8 * 9.6e-7);  // 8 ulps of a float between 8 and 16
  }
}

// If light falls off steeply enough, a linear function of the direction is below zero on the dark
// side. There it is as good as dark.
TEST(VolumeExtremes, LightIsNeverNegative) {
  IndirectVolume volume = filled({-8, -8, -8}, 1, {2, 2, 2}, one);
  for (VolumeCell& cell : volume.cells) cell.slope_x = cell.slope_y = glm::vec3(-9);
  const Pictures pictures = render_volume(volume);
  expect_within(pictures.at("indirect"), 0, 1e3f, "steep");
  EXPECT_LT(*std::min_element(pictures.at("indirect").values.begin(),
                              pictures.at("indirect").values.end()),
            0.01f);
}

TEST(VolumeExtremes, CellsOfAnySize) {
  // Cells of a kilometre: the room lies in one of them.
  expect_all(render_volume(filled(glm::dvec3(-4000), 1000, {1, 1, 1}, one)).at("indirect"), 1,
             "1000 m");
  // Millimetres cover a spot on the floor, micrometres and less hardly a pixel. The rest is lit by
  // the sky.
  for (const float cell : {1e-3f, 1e-6f, 1e-7f}) {
    const Pictures pictures = render_volume(filled({0, -4e-3, 0}, cell, {8, 1, 8}, one));
    EXPECT_EQ(not_finite(pictures), "") << cell;
    expect_within(pictures.at("indirect"), 0.25f, 1, "small cells");
  }
}

// --- Parameters

// Zero, infinite and NaN ray lengths: nothing hangs, and no NaN gets into the picture.
TEST(ParameterExtremes, LengthsOfRays) {
  const Scene scene = make_room();
  for (const float length : {0.0f, -1.0f, 1e-40f, 1e38f, kInfinity, kNan}) {
    RigOptions options = small(kRigAll & ~std::uint32_t{kRigIndirect});
    options.effects |= kRigIndirect;
    options.volume = filled({-8, -8, -8}, 1, {2, 2, 2}, one);
    options.ao_radius = length;
    options.contact.length = length;
    options.indirect.length = length;
    options.reflection.longest = options.reflection.shortest = length;
    options.glass.reflection_length = length;
    EXPECT_EQ(not_finite(render(scene, options)), "") << length;
    options.reflection = {};
    options.reflection.longest = length;
    EXPECT_EQ(not_finite(render(scene, options)), "") << "longest " << length;
    options.reflection = {};
    options.reflection.shortest = length;
    EXPECT_EQ(not_finite(render(scene, options)), "") << "shortest " << length;
  }
}

TEST(ParameterExtremes, WhatElseEffectsTake) {
  const Scene scene = make_room();
  for (const float value : {0.0f, -1.0f, 2.0f, 1e38f, kInfinity, kNan}) {
    RigOptions options = small(kRigLocal | kRigReflections | kRigGlass);
    options.reflection.length_jitter = value;
    options.reflection.firefly_limit = value;
    options.glass.fade = value;
    options.glass.depth_scale = value;
    options.glass.sorted_layers = options.glass.reflecting_layers = 0;
    for (const BlendWeight weight :
         {BlendWeight::kSquare, BlendWeight::kCube, BlendWeight::kFar, BlendWeight::kDepth}) {
      options.glass.weight = weight;
      EXPECT_EQ(not_finite(render(scene, options)), "") << value;
    }
    options.glass.sorted_layers = options.glass.reflecting_layers = 0xFFFFFFFF;
    EXPECT_EQ(not_finite(render(scene, options)), "") << value;
  }
}

// --- Cameras

TEST(CameraExtremes, EverySizeOfPicture) {
  const std::pair<std::uint32_t, std::uint32_t> sizes[] = {{1, 1}, {1, 9}, {9, 1}, {3, 5}, {17, 2}};
  for (const auto& [width, height] : sizes) {
    for (const DenoiseMethod method :
         {DenoiseMethod::kSvgf, DenoiseMethod::kBilateral, DenoiseMethod::kTemporal}) {
      RigOptions options = small(kRigAll);
      options.width = width;
      options.height = height;
      options.denoise = method;
      const Scene scene = make_room();
      const std::vector<Scene> frames(2, scene);
      for (const Pictures& pictures : render_frames(frames, options)) {
        EXPECT_EQ(not_finite(pictures), "") << width << " x " << height;
      }
    }
  }
}

TEST(CameraExtremes, FieldsOfView) {
  for (const double fov : {1e-6, 1e-3, 3.0, 3.1415}) {
    Scene scene = make_room();
    scene.cameras.front().vertical_fov = fov;
    EXPECT_EQ(not_finite(render(scene, small(kRigAll))), "") << fov;
  }
}

// Straight along an axis, where some ways to build a basis fail.
TEST(CameraExtremes, DirectionsAlongAxes) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Scene scene = make_room();
      glm::dvec3 forward(0);
      forward[axis] = sign;
      scene.cameras.front().camera_to_world =
          look_at({0, 1.25, 0.5}, glm::dvec3(0, 1.25, 0.5) + forward);
      EXPECT_EQ(not_finite(render(scene, small(kRigAll))), "") << axis << " " << sign;
    }
  }
}

}  // namespace
}  // namespace kaamos::test
