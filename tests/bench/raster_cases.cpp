// SPDX-License-Identifier: MIT
//
// raster/...: draws of the CPU backend against lavapipe, driven by a minimal program by hand.
#include <stdexcept>

#include "fixtures.h"
#include "raster_run.h"

#if KAAMOS_HAS_VULKAN
#include "hand_vulkan_raster.h"
#endif

namespace kaamos::bench {
namespace {

// A pass of raster/..., and the size of its targets.
struct Job {
  RasterPass pass;
  uint32_t width, height;
  uint32_t draws = 1;
};
constexpr Job kShadowJob = {RasterPass::kShadow, 2048, 2048};
constexpr Job kGBufferJob = {RasterPass::kGBuffer, 1280, 720};

RasterScene scene_of(const Job& job, const Options& options) {
  RasterScene scene = options.quick
                          ? make_raster_scene(job.pass, job.width / 16, job.height / 16, 0.01)
                          : make_raster_scene(job.pass, job.width, job.height);
  scene.draws = options.quick ? (job.draws + 99) / 100 : job.draws;
  return scene;
}

double drawn(const RasterScene& scene) {
  return 1e-6 * scene.triangles_per_draw() * scene.draws;
}

#if KAAMOS_HAS_VULKAN

Case raster_case(const std::string& name, const Job& job) {
  return {name, [=](Fixtures& f, const Measure& measure) -> Line {
            const RasterScene scene = scene_of(job, f.options());
            HandVulkanRaster hand(scene);
            RasterRun ours(scene, "embree", f.threads());
            const Pairs times = time_pairs(
                measure, [&] { ours.run(); }, [&] { hand.run(); });
            check_same_pictures(scene, ours.pictures(), hand.pictures());
            return {name,
                    1 / times.ratio,
                    drawn(scene) / times.ours,
                    drawn(scene) / times.baseline,
                    "Mtris/s",
                    true};
          }};
}

#endif

}  // namespace

std::vector<Case> raster_cases() {
  std::vector<Case> cases;
#if KAAMOS_HAS_VULKAN
  if (has_vulkan()) {
    cases.push_back(raster_case("raster/shadow-2048", kShadowJob));
    cases.push_back(raster_case("raster/gbuffer-720p", kGBufferJob));
  }
#endif
  return cases;
}

}  // namespace kaamos::bench
