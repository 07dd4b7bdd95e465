// SPDX-License-Identifier: MIT
#include "raster_table.h"

#include <cstdio>
#include <exception>
#include <memory>
#include <ostream>

#include "raster_run.h"

#if KAAMOS_HAS_VULKAN
#include "hand_vulkan_raster.h"
#endif

namespace kaamos::bench {
namespace {

std::string number(double value) {
  char out[32];
  std::snprintf(out, sizeof(out), "%.3g", value);
  return out;
}

// A row: a pass at a size with so many times the triangles of raster/... .
struct ScaledJob {
  const char* name;
  RasterPass pass;
  uint32_t width, height;
  double detail;
};
constexpr ScaledJob kByTriangles[] = {
    {"shadow, 30k triangles", RasterPass::kShadow, 2048, 2048, 0.1},
    {"shadow, 300k", RasterPass::kShadow, 2048, 2048, 1},
    {"shadow, 3M", RasterPass::kShadow, 2048, 2048, 10},
    {"G-buffer, 30k", RasterPass::kGBuffer, 1280, 720, 0.1},
    {"G-buffer, 300k", RasterPass::kGBuffer, 1280, 720, 1},
    {"G-buffer, 3M", RasterPass::kGBuffer, 1280, 720, 10},
};
constexpr ScaledJob kByPixels[] = {
    {"G-buffer, 0.5 Mpixels", RasterPass::kGBuffer, 960, 540, 1},
    {"G-buffer, 2 Mpixels", RasterPass::kGBuffer, 1920, 1080, 1},
    {"G-buffer, 8 Mpixels", RasterPass::kGBuffer, 3840, 2160, 1},
};
constexpr ScaledJob kByThreads[] = {
    {"shadow", RasterPass::kShadow, 2048, 2048, 1},
    {"G-buffer", RasterPass::kGBuffer, 1280, 720, 1},
};

class RasterTable {
 public:
  RasterTable(const Options& options, std::ostream& out) : options_(options), out_(out) {
    measure_.pairs = options.pairs;
    measure_.clock = options.clock;
    measure_.threads = options.threads;
  }

  void print() {
    print_head("triangles");
    for (const ScaledJob& job : kByTriangles) print_row(job);
    print_head("pixels");
    for (const ScaledJob& job : kByPixels) print_row(job);
    print_threads();
  }

 private:
  RasterScene scene_of(const ScaledJob& job) const {
    const uint32_t part = options_.quick ? 16 : 1;
    return make_raster_scene(job.pass, job.width / part, job.height / part,
                             job.detail / (options_.quick ? 100 : 1));
  }

  void print_head(const char* what) {
    out_ << "\n| " << what << " | ms | Mtris/s | Mpixels/s | lavapipe ms | lavapipe / ours |\n"
         << "|---|---|---|---|---|---|\n";
  }

  void print_row(const ScaledJob& job) {
    const RasterScene scene = scene_of(job);
    RasterRun ours(scene, "embree", options_.threads);
    const auto run = [&] { ours.run(); };
    double ms = 0;
    std::string of_baseline = "| |";
#if KAAMOS_HAS_VULKAN
    if (has_vulkan()) {
      HandVulkanRaster hand(scene);
      const Pairs times = time_pairs(measure_, run, [&] { hand.run(); });
      ms = 1e3 * times.ours;
      of_baseline = " " + number(1e3 * times.baseline) + " | " + number(1 / times.ratio) + " |";
    }
#endif
    if (ms == 0) ms = 1e3 * time_of(measure_, run);
    out_ << "| " << job.name << " | " << number(ms) << " | "
         << number(1e-3 * scene.triangles() / ms) << " | "
         << number(1e-3 * scene.width * scene.height / ms) << " |" << of_baseline << "\n"
         << std::flush;
  }

  // Wall-clock time: CPU time would not show it.
  void print_threads() {
    out_ << "\n| threads | ms | times as fast as one |\n|---|---|---|\n";
    Measure wall = measure_;
    wall.clock = Clock::kWall;
    for (const ScaledJob& job : kByThreads) {
      const RasterScene scene = scene_of(job);
      RasterRun one(scene, "embree", 1);
      for (uint32_t threads = 1; threads <= options_.threads; threads *= 2) {
        RasterRun several(scene, "embree", threads);
        const Pairs times = time_pairs(
            wall, [&] { several.run(); }, [&] { one.run(); });
        out_ << "| " << job.name << ", " << threads << " | " << number(1e3 * times.ours) << " | "
             << number(1 / times.ratio) << " |\n"
             << std::flush;
      }
    }
  }

  static double time_of(const Measure& measure, const std::function<void()>& work) {
    work();
    std::vector<double> times;
    for (int i = 0; i < measure.pairs; ++i) times.push_back(seconds(measure, work));
    return median(std::move(times));
  }

  const Options& options_;
  std::ostream& out_;
  Measure measure_;
};

}  // namespace

int print_raster_table(const Options& options, std::ostream& out, std::ostream& errors) {
  try {
    RasterTable(options, out).print();
    return 0;
  } catch (const std::exception& error) {
    errors << "kaamos-bench: error: the table of draws: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace kaamos::bench
