// SPDX-License-Identifier: MIT
// Shadows of glass against the product of what panes let through; the map against rays; the truth
// against both. [survey 5.3]
#include "effects/shadows/glass_shadow/glass_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"
#include "effects/reference/path_reference.h"
#include "effects/shadows/glass_shadow/glass_shadow_map.h"
#include "effects/shadows/shadow_map/map_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

const char* const kRays = "glass-shadow";
const char* const kMap = "glass-shadow-map";
constexpr double kHalf = 10;  // metres, of floor and panes

// Colours and coverages, in the order from the floor up.
const std::vector<glm::vec4>& tints() {
  static const std::vector<glm::vec4> all = {
      {0.9f, 0.2f, 0.1f, 0.5f}, {0.1f, 0.8f, 0.3f, 0.25f}, {0.5f, 0.5f, 0.5f, 0.75f}};
  return all;
}

// Lets `tint` of the colour through.
glm::dvec3 through(const glm::vec4& color, double tint = 1) {
  return glm::dvec3(1.0) - double{color.a} * (glm::dvec3(1.0) - tint * glm::dvec3(color));
}

glm::dvec3 product(double tint = 1) {
  glm::dvec3 out(1.0);
  for (const glm::vec4& color : tints()) out *= through(color, tint);
  return out;
}

// A floor below panes that are as wide, one metre above each other, under a slanted sun. The camera
// sees the middle of the floor; instance 0 is the floor.
Scene below_panes(const std::vector<glm::vec4>& colors = tints()) {
  Scene scene;
  scene.name = "below-panes";
  scene.samplers.push_back(Sampler{});
  scene.sun = Sun{};
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(0.3f, 1.0f, 0.2f));
  scene.sun->irradiance = glm::vec3(2, 3, 4);
  add_paint(scene, "floor", glm::vec3(0.5f));
  scene.materials.back().constants.roughness = 1;
  add_thing(scene, "floor", patch({-kHalf, 0, kHalf}, {2 * kHalf, 0, 0}, {0, 0, -2 * kHalf}, 1, 1),
            0, glm::dmat4(1.0));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    MaterialConstants glass;
    glass.base_color = colors[i];
    glass.flags = kMaterialBlend;
    const std::string name = "pane " + std::to_string(i);
    const std::uint32_t id = add_material(scene, name, glass);
    add_thing(scene, name, patch({-kHalf, 0, kHalf}, {2 * kHalf, 0, 0}, {0, 0, -2 * kHalf}, 1, 1),
              id, translate({0, 1.0 + i, 0}))
        .mask = kMaskTransparent;
  }
  add_view(scene, scene.name, {0, 3, 3}, {0, 0, 0}, 0.7);
  return scene;
}

MapFrame frame_of(const Scene& scene, float tint = 1, const std::string& backend = "embree") {
  const auto change = [tint](const std::string& name, EffectSettings& settings) {
    if (name == kRays) settings.set_constants(GlassShadowConstants{tint});
    if (name != kMap) return;
    GlassShadowMapConstants constants;
    constants.map.size = 512;
    constants.tint = tint;
    settings.set_constants(constants);
  };
  return {scene, {"sun", kRays, kMap}, change, 1, MapFrame::kWidth, MapFrame::kHeight, backend};
}

void expect_colour(const FloatImage& picture, const std::vector<std::size_t>& pixels,
                   const glm::dvec3& expected, double within) {
  ASSERT_FALSE(pixels.empty());
  for (const std::size_t i : pixels) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(picture.values[picture.channels * i + c], expected[c], within)
          << "pixel " << i << " channel " << c;
    }
  }
}

class GlassShadows : public test::OnBackends {};

INSTANTIATE_TEST_SUITE_P(Backends, GlassShadows, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// No pixel of the floor is off, those below the edges of triangles either.
TEST_P(GlassShadows, AStackOfPanesLetsTheProductThrough) {
  for (const float tint : {1.0f, 0.5f, 0.0f}) {
    MapFrame frame = frame_of(below_panes(), tint, GetParam());
    expect_colour(frame.read("glass_shadow"), frame.floor(), product(tint), 2e-6);
    expect_colour(frame.read("glass_shadow_map"), frame.floor(), product(tint), 2e-6);
  }
}

TEST_P(GlassShadows, ThePictureHasTheProductOfTheSun) {
  Scene scene = below_panes();
  scene.sun->angular_radius = 0;
  MapFrame tinted = frame_of(scene, 1, GetParam());
  const auto plain = [](const std::string&, EffectSettings&) {};
  MapFrame bare(scene, {"sun", "contact"}, plain, 1, MapFrame::kWidth, MapFrame::kHeight,
                GetParam());
  const FloatImage with = tinted.read("radiance"), without = bare.read("radiance");
  for (const std::size_t i : tinted.floor()) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(with.values[4 * i + c], without.values[4 * i + c] * product()[c], 1e-5) << i;
    }
  }
}

TEST(GlassShadow, HolesAndOpaquePanes) {
  MapFrame hole = frame_of(below_panes({{0, 0, 0, 0}}));
  MapFrame wall = frame_of(below_panes({{0, 0, 0, 1}, {1, 1, 1, 0.5f}}));
  for (const char* layer : {"glass_shadow", "glass_shadow_map"}) {
    expect_colour(hole.read(layer), hole.floor(), glm::dvec3(1.0), 0);
    expect_colour(wall.read(layer), wall.floor(), glm::dvec3(0.0), 0);
  }
}

// Sums of whole numbers have no order: neither that of instances, nor that of triangles, nor the
// number of threads changes a bit.
TEST(GlassShadow, NoOrderChangesABit) {
  Scene scene = make_glass_stack({.thick = true});
  const auto render = [](const Scene& of, std::uint32_t threads) {
    FrameSettings settings;
    settings.width = 64;
    settings.height = 36;
    settings.effects = choose_effects({kRays});
    settings.denoise = default_denoise(DenoiseMethod::kNone);
    rtapi::DeviceDesc desc;
    desc.Threads = threads;
    auto renderer = FrameRenderer::create(test::device_for(desc), of, settings).value();
    renderer->render().value();
    return renderer->read("glass_shadow").value().values;
  };
  const std::vector<float> first = render(scene, 1);
  EXPECT_EQ(render(scene, 7), first) << "threads";
  std::reverse(scene.instances.begin(), scene.instances.end());
  EXPECT_EQ(render(scene, 2), first) << "instances";
  for (Mesh& mesh : scene.meshes) {
    for (Geometry& geometry : mesh.geometries) {
      const std::size_t bytes = std::size_t{3} * geometry.index_size_bytes;
      auto* first_index = mesh.indices.data() + geometry.index_offset_bytes;
      for (std::size_t i = 0, j = geometry.index_count / 3 - 1; i < j; ++i, --j) {
        std::swap_ranges(first_index + i * bytes, first_index + (i + 1) * bytes,
                         first_index + j * bytes);
      }
    }
  }
  EXPECT_EQ(render(scene, 2), first) << "triangles";
}

// The map has one colour a texel, of all panes: what stands between two gets the other's as well.
TEST(GlassShadow, TheMapTintsBetweenPanesTooMuch) {
  Scene scene = below_panes();
  // Just above the lowest pane; the camera sees its top in the middle of the picture.
  add_box(scene, "table", {-0.5, 0.1, -0.5}, {0.5, 1.5, 0.5}, 0);
  MapFrame frame = frame_of(scene);
  const FloatImage rays = frame.read("glass_shadow"), map = frame.read("glass_shadow_map");
  const glm::dvec3 upper = through(tints()[1]) * through(tints()[2]);
  std::size_t count = 0;
  for (const std::size_t i : frame.surfaces()) {
    if (std::abs(frame.position(i).y - 1.5) > 1e-3) continue;
    ++count;
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(rays.values[4 * i + c], upper[c], 2e-6) << i;
      ASSERT_NEAR(map.values[4 * i + c], product()[c], 2e-6) << i;
    }
  }
  EXPECT_GT(count, 50u);
}

// Where there are no panes between others the map's error is that of its edges.
TEST(GlassShadow, TheMapAgreesWithRaysBesidePanes) {
  const auto rms = [](std::uint32_t size, std::uint32_t taps) {
    const auto change = [=](const std::string& name, EffectSettings& settings) {
      if (name == kRays) settings.samples = 64;
      if (name != kMap) return;
      GlassShadowMapConstants constants;
      constants.map.size = size;
      constants.map.taps = taps;
      settings.set_constants(constants);
    };
    MapFrame frame(make_glass_stack({.cabinet = false}), {"sun", kRays, kMap}, change, 1, 96, 54,
                   "embree");
    return frame.difference("glass_shadow", "glass_shadow_map");
  };
  const double coarse = rms(8, 1), fine = rms(2048, 16);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_LT(fine, 0.02);
}

// All light that reaches a surface passes the panes, whichever way it is found.
TEST_P(GlassShadows, TheTruthHasTheProductOfTheSun) {
  const Scene scene = below_panes();
  const auto sun = [&](float tint, PathWays ways) {
    PathReferenceDesc desc;
    desc.width = 16;
    desc.height = 9;
    desc.paths.bounces = 0;
    desc.paths.glass_tint = tint;
    desc.paths.ways = ways;
    desc.sun_angular_radius = 0.3f;  // wide enough to be found by directions
    rtapi::DeviceDesc device;
    device.Backend = GetParam();
    auto reference = PathReference::create(test::device_for(device), scene, desc).value();
    EXPECT_EQ(reference->accumulate(256, {}).value(), Outcome::kDone);
    const PathSums& sums = reference->sums();
    EXPECT_EQ(sums.find("sun_tint") != nullptr, tint >= 0);
    glm::dvec3 mean(0.0);
    const FloatImage picture = sums.mean(*sums.find("sun"));
    for (std::size_t i = 0; i < picture.values.size(); ++i) mean[i % 3] += picture.values[i];
    if (tint >= 0) {
      for (const float value : sums.mean(*sums.find("sun_tint")).values) EXPECT_GT(value, 0);
    }
    return mean;
  };
  const glm::dvec3 bare = sun(-1, PathWays::kBoth);
  for (const PathWays ways : {PathWays::kBoth, PathWays::kLightsOnly, PathWays::kDirectionsOnly}) {
    const double within = ways == PathWays::kBoth ? 1e-4 : 0.03;
    const glm::dvec3 part = sun(1, ways) / bare;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(part[c] / product()[c], 1, within) << static_cast<int>(ways) << " " << c;
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
