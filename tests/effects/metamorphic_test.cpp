// SPDX-License-Identifier: MIT
//
// Tests what must not change a picture, however the scene is expressed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "comparing.h"
#include "effects/assets/scene/shapes.h"
#include "room.h"

namespace kaamos::test {
namespace {

using namespace effects;

const Pictures& room() {
  static const Pictures pictures = render(make_room(), {});
  return pictures;
}

void multiply(Pictures& pictures, const std::vector<std::string>& names, float k) {
  for (const std::string& name : names) {
    for (float& value : pictures.at(name).values) value *= k;
  }
}

// Renders the scaled room, with results in the units of the original.
Pictures render_scaled(double s, bool by_transforms) {
  const Case larger = scaled({make_room(), {}}, s, by_transforms);
  Pictures out = render(larger.scene, larger.options);
  multiply(out, {"position", "view_z", "indirect_length", "reflection_length", "glass_depth"},
           static_cast<float>(1 / s));
  return out;
}

// Prints the worst picture.
void expect_decibels(const char* what, const Pictures& a, const Pictures& reference, double least,
                     const std::vector<std::string>& but = {}) {
  double worst = 1000;
  std::string worst_name;
  for (const auto& [name, image] : reference) {
    if (std::find(but.begin(), but.end(), name) != but.end()) continue;
    const double db = decibels(a.at(name), image);
    EXPECT_GE(db, least) << what << ": " << name << ", " << pixels_off(a.at(name), image, 1e-3)
                         << " pixels are off by more than a thousandth";
    if (db < worst) worst = db, worst_name = name;
  }
  std::printf("%-28s %4.0f dB at least (%s)\n", what, worst, worst_name.c_str());
}

// Otherwise the tests below would prove little.
TEST(Metamorphic, TheRoomShowsEveryEffect) {
  for (const char* name : {"ao", "sun", "contact", "indirect", "reflection", "local", "glass"}) {
    const auto& values = room().at(name).values;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    EXPECT_LT(*low, 0.1f) << name;
    EXPECT_GT(*high, 0.5f) << name;
  }
  EXPECT_EQ(not_finite(room()), "");
}

// Scaling by a power of two rounds nothing. A bit can only change because of a length that is not
// the scene's, a number of metres somewhere in a shader.
TEST(Metamorphic, PowersOfTwoChangeNoBit) {
  EXPECT_EQ(differing(render_scaled(0x1p-20, true), room(), {}), "");
  EXPECT_EQ(differing(render_scaled(0x1p-10, false), room(), {}), "");
  EXPECT_EQ(differing(render_scaled(0x1p10, true), room(), {}), "");
  EXPECT_EQ(differing(render_scaled(0x1p20, false), room(), {}), "");
}

TEST(Metamorphic, PowersOfTwoChangeNoBitOfOtherFiltersAndSecondFrames) {
  for (const DenoiseMethod method :
       {DenoiseMethod::kSvgf, DenoiseMethod::kTemporal, DenoiseMethod::kBilateral}) {
    Case usual{make_room(), {}};
    usual.options.denoise = method;
    usual.options.effects = kRigAo | kRigLocal | kRigContact;
    const Case larger = scaled(usual, 0x1p10);
    const std::vector<Scene> frames(2, usual.scene), larger_frames(2, larger.scene);
    EXPECT_EQ(differing(render_frames(larger_frames, larger.options)[1],
                        render_frames(frames, usual.options)[1], {"position", "view_z"}),
              "")
        << static_cast<int>(method);
  }
}

TEST(Metamorphic, ThousandsChangeRoundingOnly) {
  expect_decibels("scale 1e-6", render_scaled(1e-6, true), room(), 60);
  expect_decibels("scale 1e-3", render_scaled(1e-3, false), room(), 60);
  expect_decibels("scale 1e3", render_scaled(1e3, true), room(), 60);
  expect_decibels("scale 1e6", render_scaled(1e6, false), room(), 60);
}

// Positions relative to the camera are the same to the bit as long as doubles can represent them:
// the world's origin must not show anywhere in the picture.
TEST(Metamorphic, DistanceFromTheOriginChangesNoBit) {
  for (const double t : {1e2, 1e4, 1e6}) {
    EXPECT_EQ(differing(render(moved(make_room(), {t, -t, t}), {}), room(), {}), "") << t;
  }
  const glm::dvec3 uneven(1234567.891, -0.123456789, 7654321.12345);
  RigOptions options;  // the cells of a baked volume are aligned to the world
  options.volume = IndirectVolume{};
  expect_decibels("moved by 7.7e6 m, uneven", render(moved(make_room(), uneven), options),
                  render(make_room(), options), 60);
}

TEST(Metamorphic, OrderOfTrianglesChangesRoundingOnly) {
  expect_decibels("triangles reordered", render(reordered(make_room()), {}), room(), 60, {"ids"});
}

TEST(Metamorphic, FlatteningChangesRoundingOnly) {
  expect_decibels("instances flattened", render(flattened(make_room()), {}), room(), 60);
}

// Instances that scale by 64:1 and skew: ray origins and normals depend on both matrices.
TEST(Metamorphic, UnevenTransformsChangeRoundingOnly) {
  RigOptions options;
  options.volume = IndirectVolume{};  // skewed meshes' larger boxes would move a baked one's cells
  expect_decibels("instances stretched", render(stretched(make_room()), options),
                  render(make_room(), options), 60);
}

TEST(Metamorphic, TilesAndThreadsChangeNoBit) {
  for (const auto& [rows, threads] : {std::pair(1u, 1u), std::pair(5u, 7u)}) {
    RigOptions options;
    options.rows = rows;
    options.threads = threads;
    EXPECT_EQ(differing(render(make_room(), options), room(), {}), "") << rows << " rows";
  }
}

// Light is linear throughout: nothing clamps unless asked to.
TEST(Metamorphic, LightTimesKIsOutputTimesK) {
  const std::vector<std::string> light = {
      "indirect", "indirect_denoised", "reflection", "direct", "reflection_denoised",
      "local",    "radiance",          "glass"};
  for (const float k : {0x1p-6f, 0x1p6f}) {
    Pictures expected = room();
    multiply(expected, light, k);
    EXPECT_EQ(differing(render(brightened(make_room(), k), {}), expected, {}), "") << k;
  }
  Pictures expected = room();
  multiply(expected, light, 1000);
  expect_decibels("light times 1000", render(brightened(make_room(), 1000), {}), expected, 60);
}

// Effects without random directions: hard sun, hard lights, mirrors.
Case hard_room() {
  Case out{make_room(), {}};
  out.scene.sun->angular_radius = 0;
  for (Light& light : out.scene.lights) light.radius = 0;
  for (Material& material : out.scene.materials) material.constants.roughness = 0;
  out.options.effects = kRigSun | kRigReflections | kRigGlass | kRigLocal;
  out.options.samples = 1;
  out.options.reflection.length_jitter = 0;
  out.options.denoise = DenoiseMethod::kNone;
  return out;
}

// The shadow maps of local lights are aligned to the world's axes, so the edges of their shadows
// move by a fraction of a texel.
void expect_same_but_edges(const std::string& what, const Pictures& a, const Pictures& reference) {
  const auto pixels = static_cast<double>(reference.at("view_z").values.size());
  for (const char* name :
       {"ids", "view_z", "sun", "reflection_length", "glass_layers", "glass_depth"}) {
    EXPECT_LE(pixels_off(a.at(name), reference.at(name), 1e-3), 0.003 * pixels) << what << name;
  }
  for (const char* name : {"direct", "reflection", "glass"}) {
    EXPECT_LE(pixels_off(a.at(name), reference.at(name), 0.01), 0.05 * pixels) << what << name;
  }
}

TEST(Metamorphic, MirroredInstancesMirrorThePicture) {
  Case upright = hard_room();
  const Pictures reference = render(upright.scene, upright.options);
  Pictures turned_back = render(mirrored(upright.scene), upright.options);
  for (auto& [name, image] : turned_back) image = reversed(image);
  expect_same_but_edges("mirrored: ", turned_back, reference);
}

glm::dmat3 quarter_turn(int axis) {
  glm::dmat3 out(0.0);
  out[axis][axis] = 1;
  out[(axis + 1) % 3][(axis + 2) % 3] = 1;
  out[(axis + 2) % 3][(axis + 1) % 3] = -1;
  return out;
}

glm::dmat3 uneven_turn() {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), 2.1, glm::normalize(glm::dvec3(2, -3, 1))));
}

TEST(Metamorphic, TurningTheWorldTurnsNothingOfThePicture) {
  const Case upright = hard_room();
  const Pictures reference = render(upright.scene, upright.options);
  for (int axis = 0; axis < 3; ++axis) {
    expect_same_but_edges("axis " + std::to_string(axis) + ": ",
                          render(turned(upright.scene, quarter_turn(axis)), upright.options),
                          reference);
  }
  expect_same_but_edges(
      "uneven turn: ", render(turned(upright.scene, uneven_turn()), upright.options), reference);
}

// Random directions differ in a turned world: the results agree in the mean and are no further
// apart than those of two seeds.
TEST(Metamorphic, TurningTheWorldChangesNoiseOnly) {
  RigOptions options;
  options.effects = kRigAo | kRigSun | kRigLocal | kRigContact | kRigReflections | kRigIndirect;
  options.volume = IndirectVolume{};  // its cells are aligned to the world's axes
  options.samples = 16;
  options.width = 64;
  options.height = 36;
  const Scene scene = make_room();
  const Pictures reference = render(scene, options);
  std::vector<Pictures> others;
  for (std::uint32_t seed = 2; seed < 6; ++seed) {
    RigOptions other_seed = options;
    other_seed.seed = seed;
    others.push_back(render(scene, other_seed));
  }
  const auto rms = [](const FloatImage& a, const FloatImage& b, double& mean) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      const double d = static_cast<double>(a.values[i]) - static_cast<double>(b.values[i]);
      sum += d, squares += d * d;
    }
    const auto n = static_cast<double>(a.values.size());
    mean = sum / n;
    return std::sqrt(squares / n);
  };
  const glm::dmat3 turns[] = {quarter_turn(0), quarter_turn(1), quarter_turn(2), uneven_turn()};
  for (const glm::dmat3& turn : turns) {
    const Pictures now = render(turned(scene, turn), options);
    for (const char* name : {"ao", "sun", "contact", "reflection", "indirect"}) {
      double mean = 0, mean_of_seeds = 0, squares = 0;
      for (const Pictures& other : others) {
        squares += std::pow(rms(other.at(name), reference.at(name), mean_of_seeds), 2);
      }
      const double noise = std::sqrt(squares / static_cast<double>(others.size()));
      const double change = rms(now.at(name), reference.at(name), mean);
      const auto pixels =
          static_cast<double>(reference.at(name).values.size()) / reference.at(name).channels;
      EXPECT_LE(change, 1.25 * noise) << name;
      EXPECT_LE(std::abs(mean), 5 * noise / std::sqrt(pixels)) << name;
    }
  }
}

}  // namespace
}  // namespace kaamos::test
