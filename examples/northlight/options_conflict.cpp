// SPDX-License-Identifier: MIT
#include "options_conflict.h"

#include <utility>

#include "effects/measure/study/family_study.h"

namespace northlight {

using namespace kaamos::effects;

// Options that show a single frame or render forever exclude --frames; options that look for a
// pixel at its place in a dispatch exclude --sort-rays.
std::string conflict(const Options& options) {
  if (options.frame.order != RayOrder::kPixels &&
      (options.explain || options.pixel || !options.heatmap.empty())) {
    return "--sort-rays and what looks at pixels (--explain, --pixel, --heatmap) exclude each "
           "other: leave one out";
  }
  if (options.heatmap == "overdraw" && options.frame.primary == Primary::kRays) {
    return "--heatmap overdraw counts the pixel shaders of draws, and rays draw nothing: add "
           "--primary raster";
  }
  if (!options.camera_path.empty() && options.frames == 0 && options.measure != "svgf" &&
      !options.study) {
    return "--camera-path requires --frames, --measure svgf or --study";
  }
  if (options.quick && !options.study && options.measure.empty()) {
    return "--quick requires --study or --measure";
  }
  if (options.backend == kBothBackends && !options.study) {
    return "--backend both is for --study: give embree or vulkan";
  }
  // Each of these prints or writes something instead of everything else.
  std::string instead;
  for (const auto& [name, chosen] : {std::pair("--pixel", options.pixel.has_value()),
                                     std::pair("--tables", !options.tables.empty()),
                                     std::pair("--explain", options.explain.has_value()),
                                     std::pair("--heatmap", !options.heatmap.empty())}) {
    if (!chosen) continue;
    if (!instead.empty()) return instead + " and " + name + " exclude each other: leave one out";
    instead = name;
  }
  if (options.goal) {
    for (const auto& [name, chosen] :
         {std::pair("--measure", !options.measure.empty()), std::pair("--claims", options.claims),
          std::pair("--study", options.study), std::pair("--split", !options.split.empty()),
          std::pair("--reference-path-traced", options.path_samples > 0),
          std::pair("--measure-left-out", options.measure_left_out)}) {
      if (!chosen) continue;
      return std::string(options.goal->budget_ms ? "--budget" : "--quality") + " and " + name +
             " exclude each other: leave one out";
    }
  }
  if (options.path_samples > 0) {
    for (const auto& [name, chosen] :
         {std::pair("--frames", options.frames > 0),
          std::pair("--explain", options.explain.has_value()), std::pair("--watch", options.watch),
          std::pair("--pixel", options.pixel.has_value()),
          std::pair("--tables", !options.tables.empty()),
          std::pair("--heatmap", !options.heatmap.empty()),
          std::pair("--measure", !options.measure.empty()), std::pair("--claims", options.claims),
          std::pair("--study", options.study), std::pair("--split", !options.split.empty()),
          std::pair("--reference", options.reference > 0),
          std::pair("--measure-left-out", options.measure_left_out)}) {
      if (!chosen) continue;
      return std::string("--reference-path-traced and ") + name +
             " exclude each other: leave one out";
    }
  }
  if (!options.views.empty()) {
    for (const auto& [name, chosen] :
         {std::pair("--tables", !options.tables.empty()),
          std::pair("--explain", options.explain.has_value()),
          std::pair("--heatmap", !options.heatmap.empty()),
          std::pair("--measure", !options.measure.empty()), std::pair("--claims", options.claims),
          std::pair("--study", options.study), std::pair("--split", !options.split.empty()),
          std::pair("--reference-path-traced", options.path_samples > 0),
          std::pair("--measure-left-out", options.measure_left_out)}) {
      if (chosen) return std::string("--view and ") + name + " exclude each other: leave one out";
    }
  }
  if (options.frames == 0) return {};
  const std::pair<const char*, bool> given[] = {{"--watch", options.watch},
                                                {"--pixel", options.pixel.has_value()},
                                                {"--explain", options.explain.has_value()},
                                                {"--tables", !options.tables.empty()},
                                                {"--heatmap", !options.heatmap.empty()},
                                                {"--measure", !options.measure.empty()},
                                                {"--claims", options.claims},
                                                {"--study", options.study},
                                                {"--split", !options.split.empty()},
                                                {"--reference", options.reference > 0},
                                                {"--measure-left-out", options.measure_left_out}};
  for (const auto& [name, chosen] : given) {
    if (chosen) return std::string("--frames and ") + name + " exclude each other: leave one out";
  }
  return {};
}

}  // namespace northlight
