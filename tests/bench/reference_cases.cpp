// SPDX-License-Identifier: MIT
//
// reference/...: the path-traced reference against paths written by hand on Embree.
#include <cmath>
#include <stdexcept>
#include <string>

#include "effects/northlight/frame_renderer.h"
#include "effects/path_tracer/path_tracer.h"
#include "effects/scene/lounge.h"
#include "fixtures.h"

namespace kaamos::bench {
namespace {

constexpr uint32_t kBounces = 4;
constexpr uint32_t kSamples = 4;
constexpr float kAlbedo = 0.7f;

// The lounge with everything opaque and of one rough material, lit by the sun alone.
effects::Scene one_material_scene() {
  effects::Scene scene = effects::make_lounge();
  for (effects::Material& material : scene.materials) {
    material.constants = {};
    material.constants.base_color = glm::vec4(kAlbedo, kAlbedo, kAlbedo, 1);
  }
  for (effects::Mesh& mesh : scene.meshes) {
    for (effects::Geometry& geometry : mesh.geometries) geometry.alpha_tested = false;
    for (effects::Vertex& vertex : mesh.vertices) vertex.tangent = glm::vec4(0);
  }
  scene.lights.clear();
  scene.sky = {};
  return scene;
}

Line paths(Fixtures& fixtures, const Measure& measure) {
  const Options& options = fixtures.options();
  const effects::Scene scene = one_material_scene();
  rtapi::DeviceDesc desc;
  desc.Threads = options.threads;
  effects::FrameSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.whole_frame = false;
  const auto renderer =
      effects::FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene, settings).value();
  const effects::Camera& camera = scene.cameras.front();
  const effects::PathTracer tracer =
      effects::PathTracer::create(renderer->device(), renderer->frame(), renderer->gpu_scene(),
                                  scene, effects::evaluate_instances(scene, 0), camera.position(),
                                  {.bounces = kBounces, .occlusion_radius = 0},
                                  effects::path_tracer_library().value())
          .value();
  EmbreeScene::PathScene by_hand = {};
  by_hand.albedo = kAlbedo;
  for (int axis = 0; axis < 3; ++axis) by_hand.to_sun[axis] = scene.sun->direction_to_sun[axis];
  by_hand.tan_sun_radius = std::tan(scene.sun->angular_radius);
  by_hand.sun_irradiance = scene.sun->irradiance.r;
  by_hand.bounces = kBounces;
  const EmbreeScene& embree = fixtures.embree_scene(false);
  const RayGrid& primary = fixtures.rays(RaySet::kPrimary);
  double lit = 0;
  uint32_t sample = 0;
  const Pairs times = time_pairs(
      measure,
      [&] {
        renderer
            ->execute([&](rtapi::CommandList& list) {
              tracer.record(list, renderer->frame(), 0, sample, kSamples, 0, options.height);
            })
            .value();
        sample += kSamples;
      },
      [&] { embree.paths(fixtures.arena(), primary, kSamples, by_hand, lit); });
  const effects::FloatImage seen = renderer->read(tracer.layer(effects::kPathVisibility)).value();
  const effects::FloatImage ids = renderer->read(tracer.layer(effects::kPathDiffuseAlbedo)).value();
  double ours = 0;
  for (size_t i = 0; i < seen.values.size() / 4; ++i) {
    if (ids.values[4 * i] > 0) ours += seen.values[4 * i + 1];
  }
  ours /= static_cast<double>(seen.values.size()) / 4 * kSamples;
  if (std::fabs(ours - lit) > 0.01) {
    throw std::runtime_error("results differ: " + std::to_string(ours) +
                             " of the paths begin in the sun, of the baseline's " +
                             std::to_string(lit));
  }
  const double count = static_cast<double>(options.width) * options.height * kSamples;
  return {"reference/paths",
          1 / times.ratio,
          1e-6 * count / times.ours,
          1e-6 * count / times.baseline,
          "Mpaths/s",
          true};
}

}  // namespace

std::vector<Case> reference_cases() {
  return {{"reference/paths", paths}};
}

}  // namespace kaamos::bench
