// SPDX-License-Identifier: MIT
//
// reference/...: the path-traced reference against paths written by hand on Embree.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "effects/assets/built_in/lounge.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/reference/path_tracer.h"
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
      effects::PathTracer::create(renderer->device(), renderer->frame(), renderer->context().gpu,
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
        renderer->runner()
            .execute([&](rtapi::CommandList& list) {
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

std::string northlight_path() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "northlight").string();
}

std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  char part[4096];
  while (const size_t size = std::fread(part, 1, sizeof part, pipe)) out.append(part, size);
  if (pclose(pipe) != 0) throw std::runtime_error(command + " failed: " + out);
  return out;
}

// Seconds that ranks of one thread take to trace a reference together.
double ranked_seconds(const Options& options, int ranks) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("kaamos-bench-ranks-" + std::to_string(getpid()));
  const std::string out = output_of(
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
      "OMPI_MCA_rmaps_base_oversubscribe=1 mpirun -n " +
      std::to_string(ranks) + " " + northlight_path() + " --threads 1 --size " +
      std::to_string(options.width / 2) + "x" + std::to_string(options.height / 2) +
      " --reference-path-traced " + (options.quick ? "2" : "32") + " --out " + folder.string());
  std::filesystem::remove_all(folder);
  const size_t at = out.find(" samples a pixel, ");
  if (at == std::string::npos) throw std::runtime_error("mpirun says nothing of time: " + out);
  return std::strtod(out.c_str() + at + 18, nullptr);
}

// Measures how much of twice one rank's speed two ranks reach.
Line ranks(Fixtures& fixtures, const Measure& measure) {
  const Options& options = fixtures.options();
  const Pairs times = run_pairs(
      measure, [&] { return ranked_seconds(options, 2); },
      [&] { return ranked_seconds(options, 1); });
  return {"reference/mpi", 0.5 / times.ratio, times.ours, times.baseline, "s", true};
}

bool has_ranks() {
  return std::system("command -v mpirun > /dev/null 2>&1") == 0 &&
         std::system(("ldd " + northlight_path() + " 2>&1 | grep -q libmpi").c_str()) == 0;
}

}  // namespace

std::vector<Case> reference_cases() {
  std::vector<Case> cases = {{"reference/paths", paths}};
  if (has_ranks()) cases.push_back({"reference/mpi", ranks});
  return cases;
}

}  // namespace kaamos::bench
