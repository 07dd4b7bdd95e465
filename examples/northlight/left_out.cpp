// SPDX-License-Identifier: MIT
#include "left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr int kRounds = 5;

// A part that a scene may not need, and the scene or the options that bring it back.
struct Part {
  std::string name;
  Scene scene;
  Options options;
};

bool has_alpha_test(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    for (const Geometry& geometry : mesh.geometries) {
      if (geometry.alpha_tested) return true;
    }
  }
  return false;
}

std::vector<Part> parts_left_out(const Options& options, const Scene& scene) {
  std::vector<Part> out;
  {
    // The cost without FORCE_OPAQUE and opaque geometries: any-hit shaders run for everything.
    Part part{
        has_alpha_test(scene) ? "any-hit shaders of what is not alpha-tested" : "any-hit shaders",
        scene, options};
    for (Mesh& mesh : part.scene.meshes) {
      for (Geometry& geometry : mesh.geometries) geometry.alpha_tested = true;
    }
    out.push_back(std::move(part));
  }
  const bool glass = std::any_of(scene.instances.begin(), scene.instances.end(),
                                 [](const Instance& i) { return i.mask & kMaskTransparent; });
  if (options.transparent && !glass) {
    out.push_back({"glass", scene, options});
    out.back().options.keep_glass = true;
  }
  if (options.local && scene.lights.empty()) {
    out.push_back({"local lights and contact shadows", scene, options});
    out.back().options.keep_local = true;
  }
  return out;
}

// One scene on a device of its own that can be rendered again and again.
struct Run {
  std::unique_ptr<Renderer> renderer;
  std::vector<double> ms;

  static rtapi::Result<Run> create(const Options& options, const Scene& scene,
                                   const ShaderLibraries& libraries, const Progress& progress,
                                   const std::atomic<bool>& stop) {
    auto renderer = Renderer::create(options, scene, [](const std::string&) {});
    if (!renderer) return renderer.error();
    FrameResult ignored;
    if (const auto s = (*renderer)->prepare(libraries, progress, stop, ignored); !s) {
      return s.error();
    }
    return Run{std::move(*renderer), {}};
  }
  rtapi::Status render(const std::atomic<bool>& stop) {
    FrameResult result;
    const auto quiet = [](const std::string&, double) {};
    if (const auto s = renderer->render_frame(quiet, stop, result); !s) return s;
    double sum = 0;
    for (const PassStatistics& pass : result.passes) sum += pass.ms;
    ms.push_back(sum);
    return {};
  }
  double median() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  }
};

}  // namespace

rtapi::Result<std::string> measure_left_out(const Options& options, const Scene& scene,
                                            const ShaderLibraries& libraries,
                                            const Progress& progress,
                                            const std::atomic<bool>& stop) {
  std::string out =
      fmt::format("{:<46}{:>12}{:>12}{:>12}\n", "left out", "ms without", "ms with", "saved ms");
  for (const Part& part : parts_left_out(options, scene)) {
    auto without = Run::create(options, scene, libraries, progress, stop);
    if (!without) return without.error();
    auto with = Run::create(part.options, part.scene, libraries, progress, stop);
    if (!with) return with.error();
    for (int round = 0; round < kRounds; ++round) {
      for (Run* run : {&*without, &*with}) {
        if (const auto s = run->render(stop); !s) return s.error();
      }
      progress(part.name, (round + 1.0) / kRounds);
    }
    const double less = without->median();
    const double more = with->median();
    out += fmt::format("{:<46}{:>12.1f}{:>12.1f}{:>12.1f}\n", part.name, less, more, more - less);
  }
  return out + fmt::format("medians of {} frames each, in turn, at {}x{}\n", kRounds, options.width,
                           options.height);
}

}  // namespace northlight
