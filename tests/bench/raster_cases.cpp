// SPDX-License-Identifier: MIT
//
// raster/...: draws of the CPU backend, and of the Vulkan backend, against lavapipe driven by a
// minimal program by hand; of the CPU backend against itself on one thread and primary rays.
#include <cmath>
#include <stdexcept>

#include "fixtures.h"
#include "raster_run.h"

#if KAAMOS_HAS_VULKAN
#include "hand_vulkan_raster.h"
#endif

namespace kaamos::bench {
namespace {

// The pass that is drawn, how often, and the size of its targets.
struct RasterJob {
  RasterPass pass;
  uint32_t width, height;
  uint32_t draws = 1;
};
constexpr RasterJob kShadowJob = {RasterPass::kShadow, 2048, 2048};
constexpr RasterJob kGBufferJob = {RasterPass::kGBuffer, 1280, 720};
constexpr RasterJob kManyDraws = {RasterPass::kGBuffer, 1280, 720, 5000};

RasterScene raster_scene(const RasterJob& job, const Options& options) {
  RasterScene scene = options.quick
                          ? make_raster_scene(job.pass, job.width / 16, job.height / 16, 0.01)
                          : make_raster_scene(job.pass, job.width, job.height);
  scene.draws = options.quick ? (job.draws + 99) / 100 : job.draws;
  return scene;
}

Line triangle_rates(const std::string& name, const RasterScene& scene, const Pairs& times) {
  const double millions = 1e-6 * scene.triangles_per_draw() * scene.draws;
  return {name, 1 / times.ratio, millions / times.ours, millions / times.baseline, "Mtris/s", true};
}

// Wall-clock time whatever the clock is: CPU time would not show it.
Case threads_case(const std::string& name, const RasterJob& job) {
  return {name, [=](Fixtures& f, const Measure& measure) {
            const RasterScene scene = raster_scene(job, f.options());
            RasterRun two(scene, "embree", 2);
            RasterRun one(scene, "embree", 1);
            Measure wall = measure;
            wall.clock = Clock::kWall;
            const Pairs times = time_pairs(
                wall, [&] { two.run(); }, [&] { one.run(); });
            check_same_pictures(scene, two.pictures(), one.pictures());
            return triangle_rates(name, scene, times);
          }};
}

// Hit or not may differ for 1 in 1,000 pixels, and by more than 1 in 1,000 the distance for 1 in
// 100: other triangles at edges.
void check_same_distances(const RasterScene& scene, const std::vector<float>& depth,
                          const effects::Camera& camera, const RayGrid& grid,
                          const std::vector<ClosestResult>& hits) {
  const glm::vec3 forward(camera.forward());
  size_t missed = 0, far = 0;
  for (size_t i = 0; i < hits.size(); ++i) {
    const bool covered = depth[i] != scene.cleared_depth();
    if (covered != (hits[i].t >= 0)) {
      ++missed;
    } else if (covered) {
      const float* d = grid.rays[i].direction;
      const float ray_z = hits[i].t * glm::dot(forward, glm::vec3(d[0], d[1], d[2]));
      far += !(std::fabs(kRasterNear / depth[i] - ray_z) <= 1e-3f * ray_z) ? 1 : 0;
    }
  }
  const size_t pixels = hits.size();
  if (missed > std::max<size_t>(pixels / 1000, 1) || far > std::max<size_t>(pixels / 100, 2)) {
    throw std::runtime_error("of " + std::to_string(pixels) + " pixels " + std::to_string(missed) +
                             " are not covered where rays hit or the other way round, and " +
                             std::to_string(far) + " have another distance");
  }
}

Line primary(Fixtures& f, const Measure& measure) {
  const RayGrid& grid = f.rays(RaySet::kPrimary);
  const EmbreeScene& embree = f.embree_scene(false);
  const RasterScene scene = make_raster_scene(f.scene(), grid.width, grid.height);
  RasterRun ours(scene, "embree", f.threads());
  std::vector<ClosestResult> hits(grid.rays.size());
  const Pairs times = time_pairs(
      measure, [&] { ours.run(); }, [&] { embree.closest(f.arena(), grid, hits); });
  check_same_distances(scene, ours.pictures().depth, f.scene().scene.cameras.front(), grid, hits);
  const double millions = 1e-6 * static_cast<double>(hits.size());
  return {"raster/primary",          1 / times.ratio, millions / times.ours,
          millions / times.baseline, "Mpixels/s",     true};
}

#if KAAMOS_HAS_VULKAN

Case hand_raster_case(const std::string& name, const RasterJob& job, const char* backend) {
  return {name, [=](Fixtures& f, const Measure& measure) {
            const RasterScene scene = raster_scene(job, f.options());
            HandVulkanRaster hand(scene);
            RasterRun ours(scene, backend, f.threads());
            const Pairs times = time_pairs(
                measure, [&] { ours.run(); }, [&] { hand.run(); });
            check_same_pictures(scene, ours.pictures(), hand.pictures());
            return triangle_rates(name, scene, times);
          }};
}

#endif

}  // namespace

std::vector<Case> raster_cases() {
  std::vector<Case> cases;
#if KAAMOS_HAS_VULKAN
  if (has_vulkan()) {
    cases.push_back(hand_raster_case("raster/shadow-2048", kShadowJob, "embree"));
    cases.push_back(hand_raster_case("raster/gbuffer-720p", kGBufferJob, "embree"));
    cases.push_back(hand_raster_case("raster/draws", kManyDraws, "embree"));
    cases.push_back(hand_raster_case("raster/vulkan/shadow-2048", kShadowJob, "vulkan"));
    cases.push_back(hand_raster_case("raster/vulkan/gbuffer-720p", kGBufferJob, "vulkan"));
  }
#endif
  cases.push_back(threads_case("raster/threads/shadow-2048", kShadowJob));
  cases.push_back(threads_case("raster/threads/gbuffer-720p", kGBufferJob));
  cases.push_back({"raster/primary", primary});
  return cases;
}

}  // namespace kaamos::bench
