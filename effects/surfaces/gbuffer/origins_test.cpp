// SPDX-License-Identifier: MIT
// Rays that start at drawn surfaces: neither do they hit the surface that they leave (acne), nor do
// they slip through it (leaks). On a convex body the truth is known: a ray is free where the
// triangle faces it, and nowhere else.
#include <gtest/gtest.h>
#include <shaders/origin_probe.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "effects/assets/scene/shapes.h"
#include "effects/engine/compute_pass.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

// Mirrors ProbeConstants of origin_probe.hlsl.
struct ProbeConstants {
  glm::vec3 direction;
  float near_plane;
};

// The way the body gets to where it is: by its instance's transform, or by its vertices.
enum class Moved { kInstance, kVertices };

Shape make_body(bool is_round) {
  if (!is_round) return box(glm::dvec3(0.5, 0.3, 0.4));
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 48; ++i) {
    const double angle = 3.14159265358979 * (i / 48.0 - 0.5);
    profile.emplace_back(i % 48 == 0 ? 0.0 : 0.5 * std::cos(angle), 0.5 * std::sin(angle));
  }
  return revolve(profile, 96);
}

Scene make_scene(bool is_round, double size, double distance, const glm::dvec3& place,
                 Moved moved) {
  Scene scene;
  scene.name = is_round ? "ball" : "box";
  scene.materials.emplace_back();
  scene.samplers.emplace_back();
  Mesh mesh;
  Shape body;
  append(body, make_body(is_round), rotate_y(0.7) * rotate_x(0.4));
  if (moved == Moved::kVertices) {
    deform(body, [&](const glm::dvec3& p) { return size * p + place; });
  }
  add_shape(mesh, body, 0);
  scene.meshes.push_back(mesh);
  Instance instance;
  if (moved == Moved::kInstance) {
    instance.transform = translate(place);
    for (int i = 0; i < 3; ++i) instance.transform[i] *= size;
  }
  scene.instances.push_back(instance);
  Camera camera;
  camera.camera_to_world = look_at(place + distance * glm::dvec3(0.48, 0.36, 0.8), place);
  camera.vertical_fov = 2.2 * std::atan(0.5 * size / distance);
  scene.cameras.push_back(camera);
  return scene;
}

// The places where rays start: at points of the drawn G-buffer, by its depth, and at points of a
// traced one.
enum Origin { kDrawn, kByDepth, kTraced, kOriginCount };

constexpr const char* kOriginNames[] = {"drawn", "by depth", "traced"};

struct Counts {
  std::uint32_t lit = 0, dark = 0, flipped = 0;
  std::uint32_t acne[kOriginCount] = {}, leaks[kOriginCount] = {};
};

void probe(const rtapi::Device& device, const Scene& scene, Counts& counts) {
  FrameSettings settings;
  settings.width = 200;
  settings.height = 200;
  settings.whole_frame = false;
  settings.primary = Primary::kRaster;
  const auto renderer = FrameRenderer::create(device, scene, settings).value();
  renderer->render().value();
  const Frame& frame = renderer->frame();
  const GpuScene& gpu = renderer->context().gpu;
  const std::vector<SeenTriangle> drawn =
      read_drawn(device, renderer->queue(), frame, gpu, *renderer->surfaces().raster()).value();
  const std::vector<SeenTriangle> traced =
      trace_seen(device, renderer->queue(), frame, gpu).value();
  const auto library = rtapi::LoadShaderLibrary(kaamos_shaders_origin_probe()).value();
  const ComputePass pass = ComputePass::create(device, frame, library, "ProbeOrigins").value();
  const rtapi::Texture picture =
      frame.create_picture(device, "probed", rtapi::Format::kR32G32B32A32Float).value();
  PassViews views = frame.create_pass_views(device).value();
  views.set_shader_resource(0, renderer->surfaces().raster()->depth(), rtapi::Format::kR32Float)
      .value();
  views.set_unordered_access(0, picture).value();
  const RayPass rays =
      RayPass::create(device, frame, gpu, gbuffer_pass(gbuffer_library().value())).value();
  const float near_plane = static_cast<float>(scene.cameras.front().near_plane) * kRasterNearShare;
  for (const glm::vec3& direction : {glm::vec3(0.3, 0.9, 0.2), glm::vec3(-0.9, 0.1, 0.3),
                                     glm::vec3(0.5, -0.2, -0.8), glm::vec3(0.1, 0.2, 1.0)}) {
    const ProbeConstants constants = {glm::normalize(direction), near_plane};
    const auto probed = [&](bool is_traced) {
      renderer->runner()
          .execute([&](rtapi::CommandList& list) {
            if (is_traced) {
              rays.dispatch(list, frame, {.sample_count = 1}, frame.height());
            } else {
              renderer->record(list, "gbuffer", {});
            }
            pass.dispatch(list, frame, {}, PassArguments(views, constants), frame.width(),
                          frame.height());
          })
          .value();
      return renderer->read(picture).value();
    };
    const FloatImage by_draws = probed(false), by_rays = probed(true);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const float* pixel = &by_draws.values[4 * i];
      // Along the surface, rounding decides.
      if (pixel[2] == 0 || std::fabs(pixel[3]) < 1e-3f) continue;
      // A pixel that flipped lies on the edge of two triangles, of which one may be lit.
      if (!drawn[i].same_triangle(traced[i])) {
        ++counts.flipped;
        continue;
      }
      const bool lit = pixel[3] > 0;
      ++(lit ? counts.lit : counts.dark);
      const float is_free[kOriginCount] = {pixel[0], pixel[1], by_rays.values[4 * i]};
      for (int origin = 0; origin < kOriginCount; ++origin) {
        counts.acne[origin] += lit && is_free[origin] == 0;
        counts.leaks[origin] += !lit && is_free[origin] != 0;
      }
    }
  }
}

class DrawnOrigins : public test::OnBackends {};
INSTANTIATE_TEST_SUITE_P(Backends, DrawnOrigins, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

TEST_P(DrawnOrigins, HaveNoAcneAndNoLeaks) {
  struct Place {
    const char* name;
    double size, distance;
    glm::dvec3 place;
    Moved moved;
  };
  const Place places[] = {{"at the origin", 1, 3, {0, 0, 0}, Moved::kInstance},
                          {"1 km away", 1, 3, {800, 30, -600}, Moved::kInstance},
                          {"1 km away, by its vertices", 1, 3, {800, 30, -600}, Moved::kVertices},
                          {"40 m large, seen from 200 m", 40, 200, {0, 0, 0}, Moved::kInstance}};
  rtapi::DeviceDesc desc;
  desc.Backend = GetParam();
  const rtapi::Device device = test::device_for(desc);
  // A software Vulkan driver takes seconds for each: the places far away say most there.
  const bool is_quick = GetParam() == "embree";
  for (const Place& p : places) {
    if (!is_quick && p.place == glm::dvec3(0)) continue;
    Counts counts;
    for (const bool is_round : {false, true}) {
      if (!is_quick && !is_round) continue;
      probe(device, make_scene(is_round, p.size, p.distance, p.place, p.moved), counts);
    }
    std::printf("%-28s %u lit, %u dark, %u flipped\n", p.name, counts.lit, counts.dark,
                counts.flipped);
    for (int origin = 0; origin < kOriginCount; ++origin) {
      std::printf("  %-9s acne %u, leaks %u\n", kOriginNames[origin], counts.acne[origin],
                  counts.leaks[origin]);
    }
    // Floats 1 km away are 6e-5 m apart, a hundredth of a pixel here: rays and vertices may be off
    // by that much, and at an edge with a lit face a ray may start on its other side.
    const bool is_rounded = p.moved == Moved::kVertices;
    EXPECT_LT(counts.flipped, (counts.lit + counts.dark) / (is_rounded ? 50 : 500));
    const std::uint32_t most_leaks = is_rounded ? counts.leaks[kTraced] + counts.dark / 40000 : 0;
    EXPECT_GT(counts.lit, 20000u);
    EXPECT_GT(counts.dark, 20000u);
    for (const Origin origin : {kDrawn, kByDepth}) {
      EXPECT_EQ(counts.acne[origin], 0u) << p.name << ", " << kOriginNames[origin];
      EXPECT_LE(counts.leaks[origin], most_leaks) << p.name << ", " << kOriginNames[origin];
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
