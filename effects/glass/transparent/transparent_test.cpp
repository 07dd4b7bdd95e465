// SPDX-License-Identifier: MIT
// Glass against known answers.
#include "effects/glass/transparent/transparent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/common/specular_albedo.h"
#include "effects/assets/scene/shapes.h"
#include "effects/composition/composite/composite.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

struct Seen {
  FloatImage glass, transmittance;
  FloatImage behind, whole;  // without the glass and with it
};

// Runs all settings on one device, because making pipelines takes most of the time.
std::vector<Seen> look(const Scene& scene, const std::vector<TransparentConstants>& settings,
                       std::uint32_t size = 8, std::uint32_t threads = 0,
                       const IndirectVolume& volume = {}, const std::string& backend = "embree") {
  rtapi::DeviceDesc device_desc;
  device_desc.Threads = threads;
  device_desc.Backend = backend;
  FrameSettings frame_settings;
  frame_settings.width = size;
  frame_settings.height = size;
  frame_settings.effects = choose_effects({"transparent"});
  frame_settings.volume.given = std::make_shared<IndirectVolume>(volume);
  EffectSettings& glass = frame_settings.effects.at("transparent");
  glass.keep = true;  // scenes without glass are looked at too
  const auto renderer =
      FrameRenderer::create(test::device_for(device_desc), scene, frame_settings).value();
  renderer->run("transparent", glass).value();
  const CompositePass composite =
      CompositePass::create(renderer->device(), renderer->frame(), composite_library().value(), {})
          .value();
  const auto draw_behind = [&] {
    renderer->runner()
        .execute([&](rtapi::CommandList& list) { composite.dispatch(list, renderer->frame(), {}); })
        .value();
  };
  draw_behind();
  const FloatImage behind = renderer->read("radiance").value();
  std::vector<Seen> out;
  for (const TransparentConstants& constants : settings) {
    draw_behind();
    glass.set_constants(constants);
    renderer->run("transparent", glass).value();
    out.push_back({renderer->read("glass").value(), renderer->read("glass_transmittance").value(),
                   behind, renderer->read("radiance").value()});
  }
  return out;
}

// Reflections are scaled by coverage here, so the over operator describes everything.
TransparentConstants plain(std::uint32_t reflecting, std::uint32_t sorted,
                           BlendWeight weight = BlendWeight::kSquare) {
  TransparentConstants constants;
  constants.reflecting_layers = reflecting;
  constants.sorted_layers = sorted;
  constants.weight = weight;
  constants.full_reflection = 0;
  return constants;
}

constexpr BlendWeight kWeights[] = {BlendWeight::kNone, BlendWeight::kSquare, BlendWeight::kCube,
                                    BlendWeight::kFar, BlendWeight::kDepth};

const glm::vec3 kBehind(0.5f, 0.25f, 1.0f);  // exact in 16-bit floats

// Composites from the farthest pane to the nearest. The panes may come in any order.
glm::dvec3 over(std::vector<Pane> panes, glm::dvec3 behind) {
  std::sort(panes.begin(), panes.end(),
            [](const Pane& a, const Pane& b) { return a.distance > b.distance; });
  for (const Pane& pane : panes) {
    const double alpha = pane.alpha;
    behind = alpha * glm::dvec3(pane.emissive) + (1.0 - alpha) * behind;
  }
  return behind;
}

// Every pixel sees the same layers.
void expect_everywhere(const FloatImage& image, const glm::dvec3& expected, double relative) {
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(image.at(x, y, c), expected[c], relative * (1e-3 + std::abs(expected[c])))
            << "pixel " << x << "," << y << " channel " << c;
      }
    }
  }
}

double rms_difference(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    sum += std::pow(static_cast<double>(a.values[i]) - b.values[i], 2);
  }
  return std::sqrt(sum / a.values.size());
}

TEST(Transparent, NoGlassLeavesThePictureExactly) {
  for (const Seen& seen :
       look(make_pane_oracle({}, kBehind), {plain(0, 0), plain(1, 1), deck_layers(3)})) {
    EXPECT_EQ(seen.whole.values, seen.behind.values);
    expect_everywhere(seen.whole, kBehind, 0);
    expect_everywhere(seen.transmittance, glm::dvec3(1), 0);
    EXPECT_EQ(seen.glass.at(3, 3, 3), 0.0f);
  }
}

TEST(Transparent, AlphaZeroHasNoEffectExactly) {
  const Pane panes[] = {{.distance = 1, .alpha = 0, .emissive = glm::vec3(5)},
                        {.distance = 2, .alpha = 0, .emissive = glm::vec3(7), .thickness = 0.1}};
  for (const Seen& seen : look(make_pane_oracle(panes, kBehind),
                               {plain(0, 0), plain(1, 1), deck_layers(1), sorted_reference()})) {
    EXPECT_EQ(seen.whole.values, seen.behind.values);
    EXPECT_EQ(seen.transmittance.at(3, 3, 3), 0.0f) << "it took a layer's place";
  }
}

// A single layer has nothing to be weighed against, whatever its weight and depth.
TEST(Transparent, OneLayerIsTheOverOperator) {
  struct {
    float alpha, radiance;
    double distance;
  } const rows[] = {{0.001f, 1, 1}, {0.1f, 2, 0.01}, {0.5f, 65504, 49}, {1.0f, 3, 5}};
  for (const auto& row : rows) {
    const std::vector<Pane> panes = {{.distance = row.distance,
                                      .alpha = row.alpha,
                                      .emissive = glm::vec3(row.radiance, 0.5f, 0)}};
    std::vector<TransparentConstants> settings = {plain(1, 1), plain(0, 1)};
    for (const BlendWeight weight : kWeights) settings.push_back(plain(0, 0, weight));
    for (const Seen& seen : look(make_pane_oracle(panes, kBehind), settings)) {
      expect_everywhere(seen.whole, over(panes, kBehind), 1e-3);
      EXPECT_NEAR(seen.glass.at(3, 3, 3), row.distance, 1e-4 * row.distance);
    }
  }
}

// Red in front of blue, both of one alpha and one weight: each is wrong by alpha squared over two.
TEST(Transparent, TwoLayersErrByWhatIsKnown) {
  struct {
    float alpha;
    double error;
  } const rows[] = {{0.1f, 0.005}, {0.3f, 0.045}, {0.5f, 0.125}, {0.9f, 0.405}};
  for (const auto& row : rows) {
    const std::vector<Pane> panes = {
        {.distance = 1, .alpha = row.alpha, .emissive = glm::vec3(1, 0, 0)},
        {.distance = 2, .alpha = row.alpha, .emissive = glm::vec3(0, 0, 1)}};
    const std::vector<Seen> seen =
        look(make_pane_oracle(panes, glm::vec3(0)), {plain(0, 0, BlendWeight::kNone), plain(1, 8)});
    const glm::dvec3 exact = over(panes, glm::dvec3(0));
    expect_everywhere(seen[1].whole, exact, 1e-5);
    EXPECT_NEAR(exact.r - seen[0].whole.at(3, 3, 0), row.error, 1e-3);
    EXPECT_NEAR(seen[0].whole.at(3, 3, 2) - exact.b, row.error, 1e-3);
  }
}

// [McGuire and Bavoil 2013: equations 7 to 10], without the factor alpha. `near` is the camera's.
double paper_weight(BlendWeight kind, double z, double near) {
  const auto bounded = [](double w) { return std::clamp(w, 1e-2, 3e3); };
  switch (kind) {
    case BlendWeight::kNone:
      return 1;
    case BlendWeight::kSquare:
      return bounded(10 / (1e-5 + std::pow(z / 5, 2) + std::pow(z / 200, 6)));
    case BlendWeight::kCube:
      return bounded(10 / (1e-5 + std::pow(z / 10, 3) + std::pow(z / 200, 6)));
    case BlendWeight::kFar:
      return bounded(0.03 / (1e-5 + std::pow(z / 200, 4)));
    case BlendWeight::kDepth:
      return std::max(1e-2, 3e3 * std::pow(near / z, 3));
  }
  return 0;
}

TEST(Transparent, WeightsAreThoseOfThePaper) {
  const double depths[][2] = {{0.3, 0.7}, {2, 3}, {4, 30}, {20, 45}};
  const float alphas[] = {0.3f, 0.6f};
  std::vector<TransparentConstants> settings;
  for (const BlendWeight kind : kWeights) settings.push_back(plain(0, 0, kind));
  for (const auto& z : depths) {
    const std::vector<Pane> panes = {
        {.distance = z[0], .alpha = alphas[0], .emissive = glm::vec3(1, 0, 0)},
        {.distance = z[1], .alpha = alphas[1], .emissive = glm::vec3(0, 0, 1)}};
    const Scene scene = make_pane_oracle(panes, glm::vec3(0));
    const std::vector<Seen> seen = look(scene, settings, 4);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      glm::dvec2 w;
      for (int k = 0; k < 2; ++k) {
        const double of_alpha = kWeights[i] == BlendWeight::kNone ? 1 : double{alphas[k]};
        w[k] = alphas[k] * of_alpha *
               paper_weight(kWeights[i], z[k], scene.cameras.front().near_plane);
      }
      const double covered = 1 - (1 - alphas[0]) * (1 - alphas[1]);
      expect_everywhere(seen[i].whole, covered * glm::dvec3(w[0], 0, w[1]) / (w[0] + w[1]), 2e-3);
    }
  }
}

std::vector<Pane> eight_panes() {
  std::vector<Pane> panes;
  for (int i = 0; i < 8; ++i) {
    // The panes are not listed in the order of their depth.
    panes.push_back({.distance = 1.0 + 0.7 * ((i * 3) % 8),
                     .alpha = 0.1f + 0.1f * i,
                     .emissive = glm::vec3(0.1f * i, 1.0f - 0.1f * i, 0.5f * (i % 3))});
  }
  return panes;
}

TEST(Transparent, SortedLayersAreTheOverOperator) {
  const std::vector<Pane> panes = eight_panes();
  for (const Seen& seen :
       look(make_pane_oracle(panes, kBehind), {plain(8, 8), plain(1, 8), plain(0, 8)})) {
    expect_everywhere(seen.whole, over(panes, kBehind), 1e-5);
    EXPECT_EQ(seen.transmittance.at(3, 3, 3), 8.0f);
  }
}

// The visible part of the background does not depend on the order. [McGuire and Bavoil 2013]
TEST(Transparent, CoverageIsExactWithoutAnOrder) {
  const std::vector<Pane> panes = eight_panes();
  double open = 1;
  for (const Pane& pane : panes) open *= 1.0 - pane.alpha;
  std::vector<TransparentConstants> settings = {plain(3, 3), plain(8, 8)};
  for (const BlendWeight weight : kWeights) settings.push_back(plain(0, 0, weight));
  for (const Seen& seen : look(make_pane_oracle(panes, kBehind), settings)) {
    expect_everywhere(seen.transmittance, glm::dvec3(open), 1e-5);
  }
}

TEST(Transparent, EqualColoursNeedNoOrder) {
  std::vector<Pane> panes = eight_panes();
  for (Pane& pane : panes) pane.emissive = glm::vec3(0.3f, 2.0f, 0.7f);
  std::vector<TransparentConstants> settings;
  for (const BlendWeight weight : kWeights) settings.push_back(plain(0, 0, weight));
  for (const Seen& seen : look(make_pane_oracle(panes, kBehind), settings)) {
    expect_everywhere(seen.whole, over(panes, kBehind), 1e-5);
  }
}

// Many bright layers, at depth 0 and far away: the sums stay finite.
TEST(Transparent, SumsDoNotOverflow) {
  std::vector<Pane> panes;
  for (int i = 0; i < 64; ++i) {
    panes.push_back({.distance = i < 32 ? 1e-4 * (i + 1) : i,
                     .alpha = 0.9f,
                     .emissive = glm::vec3(i % 2 == 0 ? 65504.0f : 1e30f)});
  }
  for (Pane& pane : panes) pane.distance = std::min(pane.distance, 49.0);
  std::vector<TransparentConstants> settings = {plain(8, 8)};
  for (const BlendWeight weight : kWeights) settings.push_back(plain(0, 0, weight));
  for (const Seen& seen : look(make_pane_oracle(panes, kBehind), settings)) {
    expect_everywhere(seen.whole, glm::dvec3(65504), 1e-3);
  }
}

// A broken material darkens its own layer and nothing else.
TEST(Transparent, BrokenMaterialsAreContained) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Pane> panes = {{.distance = 1, .alpha = 0.5f, .emissive = glm::vec3(nan)},
                             {.distance = 2, .alpha = 0.5f, .emissive = glm::vec3(1)}};
  const Scene scene = make_pane_oracle(panes, kBehind);
  panes[0].emissive = glm::vec3(0);
  const std::vector<Seen> seen = look(scene, {plain(8, 8), plain(1, 1), plain(0, 0)});
  expect_everywhere(seen[0].whole, over(panes, kBehind), 1e-5);
  expect_everywhere(seen[1].whole, over(panes, kBehind), 1e-5);
  for (const float value : seen[2].whole.values) ASSERT_TRUE(std::isfinite(value));
  panes[0].alpha = 0;
  Scene no_coverage = scene;
  no_coverage.materials[1].constants.base_color.a = nan;
  for (const Seen& open : look(no_coverage, {plain(8, 8), plain(0, 0)})) {
    expect_everywhere(open.whole, over(panes, kBehind), 1e-5);
  }
}

// Several panes at the same distance: each ray starts strictly behind the previous layer, so the
// loop ends.
TEST(Transparent, CoincidentPanesEnd) {
  const Pane pane{.distance = 2, .alpha = 0.5f, .emissive = glm::vec3(1, 0, 0)};
  std::vector<Pane> panes(4, pane);
  panes.push_back({.distance = 3, .alpha = 0.25f, .emissive = glm::vec3(0, 1, 0)});
  const std::vector<Seen> seen = look(make_pane_oracle(panes, kBehind), {plain(8, 8), plain(0, 0)});
  expect_everywhere(seen[0].whole, over({pane, panes.back()}, kBehind), 1e-5);
  EXPECT_EQ(seen[0].transmittance.at(3, 3, 3), 2.0f);
  // Without an order every pane counts, since none has to be told from the others.
  expect_everywhere(seen[1].transmittance, glm::dvec3(0.75 / 16), 1e-5);
}

// A closed pane has two sides. Double-sided glass shows both; single-sided glass shows only the
// front, so nothing from inside.
TEST(Transparent, SidesOfThickGlass) {
  for (const bool double_sided : {true, false}) {
    const Pane pane{.distance = 1,
                    .alpha = 0.5f,
                    .emissive = glm::vec3(2, 1, 0),
                    .thickness = 1,
                    .double_sided = double_sided};
    Scene scene = make_pane_oracle(std::vector<Pane>{pane}, kBehind);
    Pane back = pane;
    back.distance = 2;
    for (const Seen& seen : look(scene, {plain(8, 8), plain(0, 0)})) {
      const std::vector<Pane> layers =
          double_sided ? std::vector<Pane>{pane, back} : std::vector<Pane>{pane};
      expect_everywhere(seen.whole, over(layers, kBehind), 1e-4);
    }
    scene.cameras[0].camera_to_world = translate({0, 0, -1.5});
    for (const Seen& seen : look(scene, {plain(8, 8), plain(1, 1), plain(0, 0)})) {
      const std::vector<Pane> layers = double_sided ? std::vector<Pane>{back} : std::vector<Pane>{};
      expect_everywhere(seen.whole, over(layers, kBehind), 1e-4);
    }
  }
}

double schlick(double cosine) {
  return 0.04 + 0.96 * std::pow(1 - cosine, 5);
}

// A bright wall behind the camera, mirrored in a pane at 1 m: fully visible up to 48 m, half at 54
// m, gone beyond 60 m. The second layer reflects only if it is asked to.
TEST(Transparent, MirrorRaysEndAtSixtyMetres) {
  struct {
    double distance, part;
  } const rows[] = {{20, 1}, {53, 0.5}, {80, 0}};
  for (const auto& row : rows) {
    const std::vector<Pane> panes = {{.distance = 1, .alpha = 0.25f},
                                     {.distance = 1.5, .alpha = 0.25f}};
    Scene scene = make_pane_oracle(panes, glm::vec3(0));
    Material bright;
    bright.name = "bright";
    bright.constants.base_color = glm::vec4(0, 0, 0, 1);
    bright.constants.emissive = glm::vec3(3);
    scene.materials.push_back(bright);
    Mesh mesh;
    mesh.name = "bright";
    add_shape(mesh, patch({300, -300, row.distance}, {-600, 0, 0}, {0, 600, 0}, 1, 1),
              static_cast<std::uint32_t>(scene.materials.size() - 1));
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
    scene.cameras[0].vertical_fov = 0.002;
    TransparentConstants one = deck_layers(1);
    one.sorted_layers = 8;
    const std::vector<Seen> seen = look(scene, {one, deck_layers(2)}, 4);
    const double f = schlick(1), mirrored = 3 * f * row.part;
    expect_everywhere(seen[0].glass, glm::dvec3(mirrored), 2e-3);
    // The wall is half a metre further from the second pane.
    const double second_part = row.part == 0.5 ? 0.5 - 0.5 / 12 : row.part;
    expect_everywhere(seen[1].glass, glm::dvec3(mirrored + 0.75 * (1 - f) * 3 * f * second_part),
                      2e-3);
  }
}

// Light of 2 from everywhere in 400 m around, where the sky is black. A wall that is as bright as
// that must not show an edge where the mirror rays end.
TEST(Transparent, MirrorRaysEndInTheVolumesLight) {
  IndirectVolume volume;
  volume.cell = 50;
  volume.origin = glm::dvec3(-200);
  volume.bricks = glm::uvec3(1);
  volume.brick_starts = {0};
  volume.cells.resize(kCellsPerBrick);
  for (VolumeCell& cell : volume.cells) {
    cell.mean = glm::vec3(2);
    cell.validity = 1;
  }
  for (const double distance : {20.0, 53.0, 58.9, 80.0}) {
    Scene scene =
        make_pane_oracle(std::vector<Pane>{{.distance = 1, .alpha = 0.25f}}, glm::vec3(0));
    for (Material& material : scene.materials) {
      material.constants.base_color *= glm::vec4(0, 0, 0, 1);
    }
    Material bright;
    bright.constants.base_color = glm::vec4(0, 0, 0, 1);
    bright.constants.emissive = glm::vec3(2);
    scene.materials.push_back(bright);
    Mesh mesh;
    add_shape(mesh, patch({150, -150, distance}, {-300, 0, 0}, {0, 300, 0}, 1, 1),
              static_cast<std::uint32_t>(scene.materials.size() - 1));
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
    scene.cameras[0].vertical_fov = 0.002;
    const std::vector<Seen> seen = look(scene, {deck_layers(1)}, 4, 0, volume);
    const double f = schlick(1);
    // The wall mirrors some of the volume's light, too.
    const double wall = 2 + 2 * specular_albedo(glm::vec3(0.04f), 1, 1).x;
    const double part = std::clamp((60 - (distance + 1)) / 12, 0.0, 1.0);
    expect_everywhere(seen[0].glass, glm::dvec3(f * (part * wall + (1 - part) * 2)), 5e-3);
  }
}

// The more layers have mirror rays, the closer the result is to the reference. E11: 1 layer is what
// Control shipped, 3 what the deck shows; both must be there. [effects/SOURCES.md]
TEST(Transparent, MoreLayersAreNearerToTheReference) {
  const Scene scene = make_glass_stack({.panes = 6});
  const std::vector<Seen> seen = look(
      scene, {sorted_reference(), deck_layers(0), deck_layers(1), deck_layers(3), deck_layers(8)},
      48);
  double last = 1e9;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const double error = rms_difference(seen[i].whole, seen[0].whole);
    EXPECT_LT(error, last) << "setting " << i;
    last = error;
  }
  EXPECT_EQ(last, 0);
  EXPECT_GT(rms_difference(seen[0].whole, seen[0].behind), 0.01);
}

// The scene at another place and scale; `move` is rigid.
Scene moved(Scene scene, const glm::dmat4& move, double scale) {
  const glm::dmat4 grow{glm::dmat3(scale)};
  for (Instance& instance : scene.instances) instance.transform = move * grow * instance.transform;
  const auto place = [&](const glm::dvec3& p) {
    return glm::dvec3(move * grow * glm::dvec4(p, 1));
  };
  for (Camera& camera : scene.cameras) {
    const glm::dvec3 eye = place(camera.position());
    camera.camera_to_world = move * camera.camera_to_world;
    camera.camera_to_world[3] = glm::dvec4(eye, 1);
    camera.near_plane *= scale;
  }
  for (Light& light : scene.lights) {
    light.position = place(light.position);
    light.intensity *= static_cast<float>(scale * scale);
    light.range *= static_cast<float>(scale);
    light.radius *= static_cast<float>(scale);
  }
  scene.sun->direction_to_sun =
      glm::vec3(glm::dmat3(move) * glm::dvec3(scene.sun->direction_to_sun));
  return scene;
}

// Rotated, moved, far from the origin, small and large.
TEST(Transparent, ThePlaceOfTheSceneDoesNotMatter) {
  constexpr std::uint32_t kSize = 32;
  const Scene scene = make_glass_stack({.panes = 4, .thick = true});
  // The texels of a lamp's shadow map follow the world's axes, so rotated scenes have no lamps.
  Scene dark = scene;
  dark.lights.clear();
  const Seen lit_here = look(scene, {deck_layers(2)}, kSize)[0];
  const Seen dark_here = look(dark, {deck_layers(2)}, kSize)[0];
  struct {
    glm::dvec3 offset;
    double angle, scale;
  } const rows[] = {{{3, -2, 5}, 1.5707963267948966, 1},
                    {{1e5, -3e4, 7e4}, 0, 1},
                    {{1e5, 2e3, 0}, 3.1, 1},
                    {{0, 0, 0}, 0, 1e-3},
                    {{0, 0, 0}, 0.3, 1e3}};
  for (const auto& row : rows) {
    TransparentConstants constants = deck_layers(2);
    constants.reflection_length *= static_cast<float>(row.scale);
    constants.depth_scale = static_cast<float>(1 / row.scale);
    const Seen& here = row.angle == 0 ? lit_here : dark_here;
    const Scene there = moved(row.angle == 0 ? scene : dark,
                              translate(row.offset) * rotate_y(row.angle), row.scale);
    const Seen seen = look(there, {constants}, kSize)[0];
    int different = 0;
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
      bool same = true;
      for (std::uint32_t c = 0; c < 4; ++c) {
        const float before = here.glass.values[4 * i + c];
        const double expected = c == 3 ? before * row.scale : before;
        same = same && std::abs(seen.glass.values[4 * i + c] - expected) <= 2e-3 * (0.1 + expected);
        same = same && std::abs(seen.transmittance.values[4 * i + c] -
                                here.transmittance.values[4 * i + c]) <= 1e-4;
      }
      different += !same;
    }
    // Only pixels whose centre lies on an edge differ.
    EXPECT_LE(different, kSize * kSize / 100) << "scale " << row.scale << " angle " << row.angle;
  }
}

// Panes that do not shine, in a sun on the left that a roof hides from the left half of the view.
Scene half_shaded(std::vector<Pane> panes) {
  for (Pane& pane : panes) pane.base_color = glm::vec3(0.8f);
  Scene scene = make_pane_oracle(panes, glm::vec3(0));
  scene.sun = Sun{};
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(-1, 0.5f, 0.25f));
  scene.cameras[0].vertical_fov = 0.02;
  Mesh mesh;
  // A ray from (x, 0, -2) to the sun is at (x - 4, 2, -1).
  add_shape(mesh, patch({-20, 2, 20}, {16, 0, 0}, {0, 0, -40}, 1, 1), 0);
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
  return scene;
}

class TransparentSun : public test::OnBackends {};

// Layers that any-hit shaders blend, which cannot trace rays: behind a traced one that faces away
// from the sun, and so does not ask whether it is visible, and without any that is traced.
TEST_P(TransparentSun, BlendedLayersBelowARoofGetNone) {
  const Pane turned{.distance = 1, .alpha = 0.5f, .turned = 1.0};
  const Pane pane{.distance = 2, .alpha = 0.5f};
  const std::vector<Seen> seen = look(
      half_shaded({turned, pane}), {plain(0, 8), plain(0, 1), plain(0, 0)}, 8, 0, {}, GetParam());
  const float sunlit = seen[0].glass.at(7, 3, 0);
  EXPECT_GT(sunlit, 0.03f);
  EXPECT_NEAR(seen[1].glass.at(7, 3, 0), sunlit, 1e-5);
  EXPECT_GT(seen[2].glass.at(7, 3, 0), 0);
  for (const Seen& each : seen) EXPECT_EQ(each.glass.at(0, 3, 0), 0);
}

// A single layer has nothing to be blended with.
TEST(Transparent, OneBlendedLayerIsInTheSunAsATracedOneIs) {
  const std::vector<Seen> seen =
      look(half_shaded({{.distance = 2, .alpha = 0.5f}}), {plain(0, 8), plain(0, 0)});
  EXPECT_GT(seen[0].glass.at(7, 3, 0), 0.06f);
  EXPECT_EQ(seen[0].glass.at(0, 3, 0), 0);
  for (std::size_t i = 0; i < seen[0].glass.values.size(); ++i) {
    ASSERT_NEAR(seen[1].glass.values[i], seen[0].glass.values[i], 1e-5) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, TransparentSun, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST(Transparent, ThreadsDoNotMatter) {
  const Scene scene = make_glass_stack({.panes = 8, .thick = true});
  const Seen one = look(scene, {deck_layers(1)}, 48, 1)[0];
  const Seen more = look(scene, {deck_layers(1)}, 48, 3)[0];
  EXPECT_EQ(one.glass.values, more.glass.values);
  EXPECT_EQ(one.transmittance.values, more.transmittance.values);
}

}  // namespace
}  // namespace kaamos::effects
