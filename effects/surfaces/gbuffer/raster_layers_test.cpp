// SPDX-License-Identifier: MIT
// The drawn G-buffer against the one by rays: which triangles pixels show, and what is written
// where both show the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/runner.h"
#include "effects/assets/scene/levels.h"
#include "effects/assets/scene/shapes.h"
#include "effects/composition/taa/taa.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/surfaces/gbuffer/primary_comparison.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr double kEdgeShift = 7.3e-4;  // pixels by which snapping moves an edge, on average
constexpr double kDepthLimit = 1e-5;   // of near / view depth
constexpr std::uint32_t kWidth = 320, kHeight = 180;
constexpr FrameTexture kLayers[] = {kDepth,    kViewZ,    kNormal,   kShadingNormal, kBaseColor,
                                    kEmissive, kMaterial, kPosition, kMotion};
constexpr const char* kNames[] = {"depth",          "view z",     "normal",
                                  "shading normal", "base color", "emissive",
                                  "material",       "position",   "motion"};
constexpr std::size_t kLayerCount = std::size(kLayers);
using Layers = std::vector<FloatImage>;

std::unique_ptr<FrameRenderer> make_renderer(const std::string& backend, const Scene& scene,
                                             Primary primary, bool moving) {
  FrameSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.whole_frame = false;
  settings.primary = primary;
  settings.moving = moving;
  settings.taa = moving;
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  desc.OnMessage = [](const rtapi::Message& m) { ADD_FAILURE() << m.Text; };
  return FrameRenderer::create(test::device_for(desc), scene, settings).value();
}

Layers read_layers(FrameRenderer& renderer) {
  Layers out;
  for (const FrameTexture layer : kLayers) {
    out.push_back(renderer.read(renderer.frame().texture(layer)).value());
  }
  return out;
}

// Renders the same frame with draws and with rays.
class Pair {
 public:
  Pair(const std::string& backend, const Scene& scene, bool moving)
      : scene_(scene),
        drawn(make_renderer(backend, scene_, Primary::kRaster, moving)),
        traced(make_renderer(backend, scene_, Primary::kRays, moving)) {}

  void render(const FrameMoment& moment) {
    camera_ = moment.camera;
    jitter_ = taa_jitter(moment.index);
    for (FrameRenderer* renderer : {drawn.get(), traced.get()}) {
      renderer->begin_frame(moment).value();
      renderer->render().value();
    }
    see();
  }
  void render() {
    camera_ = scene_.cameras.front();
    drawn->render().value();
    traced->render().value();
    see();
  }

  // Pixels flip along edges because vertices snap to the rasterizer's grid, and for no other
  // reason.
  void expect_same_triangles() const {
    const PrimaryDifference d = compare_pictures(scene_, drawn->context().gpu,
                                                 {seen_by_draws, seen_by_rays, camera_, kHeight});
    std::printf(
        "%s: %.3g of %llu pixels differ, about %.3g expected at %.1f pixels a triangle: %llu "
        "neighbours, %llu silhouettes, %llu other surfaces close by, %llu hit or not\n",
        scene_.name.c_str(), d.share(), static_cast<unsigned long long>(d.covered),
        d.expected_share(), d.pixels_per_triangle(), static_cast<unsigned long long>(d.neighbours),
        static_cast<unsigned long long>(d.silhouettes), static_cast<unsigned long long>(d.others),
        static_cast<unsigned long long>(d.hit_or_not));
    EXPECT_GT(d.covered, d.pixels / 4);
    EXPECT_LE(d.share(), 2 * d.expected_share());
    EXPECT_LE(static_cast<double>(d.hit_or_not),
              1 + 1e-5 * static_cast<double>(d.covered) + 2 * kEdgeShift * border_length());
  }

  // The largest differences of each layer over pixels that show the same triangle, and how far off
  // its pixel's ray any drawn point is.
  std::vector<double> largest_differences(double least_facing, double& off_ray) const {
    const Layers a = read_layers(*drawn), b = read_layers(*traced);
    std::vector<double> out(kLayerCount);
    for (std::size_t i = 0; i < seen_by_rays.size(); ++i) {
      if (!seen_by_draws[i].same_triangle(seen_by_rays[i])) continue;
      if (seen_by_rays[i].instance == 0 || facing(b, i) < least_facing) continue;
      for (std::size_t layer = 0; layer < kLayerCount; ++layer) {
        const std::size_t channels = a[layer].channels;
        // At a border that the ray just misses, the point is up to sqrt(2) / 512 pixel beside it,
        // which a slanted surface lengthens. Elsewhere rounding is all.
        const bool is_length = kLayers[layer] == kViewZ || kLayers[layer] == kPosition;
        const double z = b[1].values[i], length = length_unit(z) / facing(b, i);
        double unit = is_length ? length : 1.0;
        // A pixel of parallel rays is as wide near the camera as anywhere, where near / depth
        // changes fast.
        if (layer == 0 && camera_.is_orthographic())
          unit = std::max(1.0, length * camera_.near_plane / (z * z) / kDepthLimit);
        for (std::size_t c = 0; c < channels; ++c) {
          const double difference =
              std::fabs(a[layer].values[i * channels + c] - b[layer].values[i * channels + c]);
          out[layer] = std::max(out[layer], difference / unit);
        }
      }
    }
    for (std::size_t i = 0; i < seen_by_rays.size(); ++i) {
      if (seen_by_draws[i].instance == 0 || facing(a, i) < least_facing) continue;
      const double unit = length_unit(a[1].values[i]) / facing(a, i);
      off_ray = std::max(off_ray, distance_to_ray(a[7], i) / unit);
    }
    std::printf("  %-15s %.3g\n", "off the ray", off_ray);
    for (std::size_t layer = 0; layer < kLayerCount; ++layer) {
      std::printf("  %-15s %.3g\n", kNames[layer], out[layer]);
    }
    return out;
  }

 private:
  // What a point may be off at a view depth: sqrt(2) / 512 pixel, and rounding.
  double length_unit(double view_z) const {
    const double pixel_size = 2 * camera_.picture_half_height() / kHeight;  // at distance 1
    return (camera_.is_orthographic() ? pixel_size : view_z * pixel_size) / 362 + view_z * 2e-6;
  }

  // Returns how far the point of a pixel is off the ray through its center, in metres.
  double distance_to_ray(const FloatImage& positions, std::size_t pixel) const {
    const double half = camera_.picture_half_height();
    const glm::dvec2 place(static_cast<double>(pixel % kWidth),
                           static_cast<double>(pixel / kWidth));
    const glm::dvec2 ndc = 2.0 * (place + 0.5 + jitter_) / glm::dvec2(kWidth, kHeight) - 1.0;
    const glm::dmat4& axes = camera_.camera_to_world;
    const glm::dvec3 aside =
        half * (kWidth * ndc.x / kHeight * glm::dvec3(axes[0]) - ndc.y * glm::dvec3(axes[1]));
    const bool is_parallel = camera_.is_orthographic();
    const glm::dvec3 direction =
        glm::normalize(is_parallel ? camera_.forward() : camera_.forward() + aside);
    const float* p = &positions.values[4 * pixel];
    const glm::dvec3 position =
        glm::dvec3(p[0], p[1], p[2]) - (is_parallel ? aside : glm::dvec3(0.0));
    return glm::length(position - glm::dot(position, direction) * direction);
  }

  // Cosine between view and geometric normal; 1 where nothing is.
  double facing(const Layers& layers, std::size_t pixel) const {
    const float* p = &layers[7].values[4 * pixel];
    const float u = layers[2].values[2 * pixel], v = layers[2].values[2 * pixel + 1];
    glm::dvec3 n(u, v, 1 - std::fabs(u) - std::fabs(v));
    if (n.z < 0) {
      n.x = (1 - std::fabs(v)) * (u >= 0 ? 1 : -1);
      n.y = (1 - std::fabs(u)) * (v >= 0 ? 1 : -1);
    }
    const glm::dvec3 position(p[0], p[1], p[2]);
    const double length = glm::length(position);
    if (length > 0 && camera_.is_orthographic())
      return std::fabs(glm::dot(glm::normalize(n), camera_.forward()));
    return length > 0 ? std::fabs(glm::dot(glm::normalize(n), position)) / length : 1.0;
  }

  // Returns how long the border between surfaces and nothing is, in pixels. [Cauchy-Crofton]
  double border_length() const {
    std::uint32_t crossings = 0;
    for (std::size_t i = 0; i + kWidth < seen_by_rays.size(); ++i) {
      const bool is_hit = seen_by_rays[i].instance != 0;
      crossings += is_hit != (seen_by_rays[i + kWidth].instance != 0);
      if ((i + 1) % kWidth != 0) crossings += is_hit != (seen_by_rays[i + 1].instance != 0);
    }
    return 0.785 * crossings;
  }

  void see() {
    seen_by_draws = read_drawn(drawn->device(), drawn->queue(), drawn->frame(),
                               drawn->context().gpu, *drawn->surfaces().raster())
                        .value();
    seen_by_rays =
        trace_seen(traced->device(), traced->queue(), traced->frame(), traced->context().gpu)
            .value();
  }

  Scene scene_;
  Camera camera_;
  glm::dvec2 jitter_{0.0};

 public:
  std::unique_ptr<FrameRenderer> drawn, traced;
  std::vector<SeenTriangle> seen_by_draws, seen_by_rays;
};

void expect_same_layers(const std::vector<double>& differences) {
  constexpr double kByte = 1.001 / 255;     // a value that rounds the other way
  constexpr double kShort = 1.001 / 32767;  // the same of normals
  // The place of a traced point along a sliver is less exact than that of the drawn one.
  const double limits[kLayerCount] = {kDepthLimit, 1,     kShort, 1e-3, 2 * kByte,
                                      2e-2,        kByte, 8,      2e-5};
  for (std::size_t layer = 0; layer < kLayerCount; ++layer) {
    EXPECT_LE(differences[layer], limits[layer]) << kNames[layer];
  }
}

class RasterGBufferTest : public test::OnBackends {};
INSTANTIATE_TEST_SUITE_P(Backends, RasterGBufferTest, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// Textures, leaves with holes, and far walls beside near furniture.
TEST_P(RasterGBufferTest, ShowsTheLoungeAsRaysDo) {
  Pair pair(GetParam(), make_lounge(), false);
  pair.render();
  pair.expect_same_triangles();
  double off_ray = 0;
  expect_same_layers(pair.largest_differences(0.02, off_ray));
  EXPECT_LE(off_ray, 1);
}

// Skinned figures in motion, a camera in motion, and jitter.
TEST_P(RasterGBufferTest, ShowsWalkingFiguresAsRaysDo) {
  Pair pair(GetParam(), make_runner_scene(), true);
  FrameMoment moment;
  moment.camera = make_runner_scene().cameras.front();
  for (std::uint32_t i = 0; i < 3; ++i) {
    moment.index = i;
    moment.seconds = 0.1 * i;
    moment.camera.camera_to_world[3] += glm::dvec4(0.05, 0.01, -0.02, 0);
    pair.render(moment);
  }
  pair.expect_same_triangles();
  const FloatImage motion = pair.drawn->read(pair.drawn->frame().texture(kMotion)).value();
  EXPECT_GT(*std::max_element(motion.values.begin(), motion.values.end()), 1e-3f);
  double off_ray = 0;
  expect_same_layers(pair.largest_differences(0.02, off_ray));
  EXPECT_LE(off_ray, 1);
}

// Depth is spread evenly there, and the rays of pixels start on a plane.
TEST_P(RasterGBufferTest, ShowsWalkingFiguresAsParallelRaysDo) {
  Scene scene = make_runner_scene();
  scene.cameras.front().half_height = 2;
  Pair pair(GetParam(), scene, true);
  FrameMoment moment;
  moment.camera = scene.cameras.front();
  for (std::uint32_t i = 0; i < 2; ++i) {
    moment.index = i;
    moment.seconds = 0.1 * i;
    moment.camera.camera_to_world[3] += glm::dvec4(0.05, 0.01, -0.02, 0);
    pair.render(moment);
  }
  pair.expect_same_triangles();
  double off_ray = 0;
  expect_same_layers(pair.largest_differences(0.02, off_ray));
  EXPECT_LE(off_ray, 1);
}

// A ball that is seen from far away, where it is a coarse one, and then from nearby.
TEST_P(RasterGBufferTest, DrawsTheLevelOfDetailThatRaysHit) {
  Scene scene = make_runner_scene({.crowd = 0});
  scene.name = "levels";
  Mesh fine, coarse;
  fine.name = "fine";
  coarse.name = "coarse";
  add_shape(fine, rounded_box(glm::dvec3(0.5), 0.4, 12), 0);
  add_shape(coarse, rounded_box(glm::dvec3(0.5), 0.4, 2), 0);
  const auto first = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(fine);
  scene.meshes.push_back(coarse);
  Instance ball;
  ball.name = "ball";
  ball.mesh = first;
  ball.levels = {{first, 0.5f}, {first + 1, 0.0f}};
  ball.transform = translate({0, 1, 0});
  scene.instances.push_back(ball);
  Pair pair(GetParam(), scene, true);
  std::size_t triangles[2];
  for (std::uint32_t i = 0; i < 2; ++i) {
    FrameMoment moment;
    moment.index = i;
    moment.camera = scene.cameras.front();
    moment.camera.camera_to_world = look_at({0.3, 1.2, i == 0 ? 5.0 : 1.5}, {0, 1, 0});
    pair.render(moment);
    pair.expect_same_triangles();
    const SceneDraw& last = pair.drawn->surfaces().raster()->draws().back();
    triangles[i] = pair.drawn->context().gpu.geometries[last.geometry].index_count / 3;
  }
  EXPECT_EQ(triangles[0], coarse.triangle_count());
  EXPECT_EQ(triangles[1], fine.triangle_count());
}

}  // namespace
}  // namespace kaamos::effects
