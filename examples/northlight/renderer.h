// SPDX-License-Identifier: MIT
// A scene, a frame and its passes, rendered in bands so that a person sees progress and can stop.
#pragma once

#include <rtapi/explain.h>
#include <rtapi/rtapi.h>
#include <rtapi/table_description.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "effects/composite/composite.h"
#include "effects/frame/frame.h"
#include "effects/frame/ray_pass.h"
#include "frame_effects.h"
#include "options.h"

namespace northlight {

struct PassStatistics {
  std::string name;
  double ms = 0;
  rtapi::RaytracingStatistics rays;
};

// One dispatch in which the pixel of --explain lies.
struct ExplainedDispatch {
  std::string pass;
  std::uint32_t first_row = 0;  // of the band; the dispatch's y counts from there
  rtapi::PixelExplanation pixel;
};

// What a finished frame consists of.
struct FrameResult {
  std::map<std::string, kaamos::effects::FloatImage> layers;  // "ao", "normal", ...
  kaamos::effects::FloatImage radiance;                       // RGBA, linear
  std::vector<PassStatistics> passes;
  std::vector<ExplainedDispatch> explained;          // with --explain
  std::vector<rtapi::PixelStatistics> pixel_counts;  // with --heatmap: width * height
  std::vector<std::string> left_out;                 // effects and parts, and why
};

// Done part of the pass, from 0 to 1.
using Progress = std::function<void(const std::string& pass, double done)>;

class Renderer {
 public:
  // `scene` must stay as it is for the renderer's life.
  static rtapi::Result<std::unique_ptr<Renderer>> create(
      const Options& options, const kaamos::effects::Scene& scene,
      std::function<void(const std::string&)> message);
  // Renders with these shaders. An empty error id in the result means that `stop` was set.
  rtapi::Result<FrameResult> render(const ShaderLibraries& libraries, const Progress& progress,
                                    const std::atomic<bool>& stop);

  // The tables of each pass, by its name.
  rtapi::Result<std::vector<std::pair<std::string, rtapi::TableDescription>>> describe_tables(
      const ShaderLibraries& libraries);

  const rtapi::DeviceInfo& device_info() const { return device_.GetInfo(); }
  const kaamos::effects::GpuSceneStatistics& scene_statistics() const { return gpu_.statistics; }

 private:
  Renderer(const Options& options, const kaamos::effects::Scene& scene)
      : options_(options), scene_(scene) {}
  rtapi::Status run_step(const RayStep& step, const Progress& progress,
                         const std::atomic<bool>& stop, FrameResult& result);
  // A pass without rays, timed.
  rtapi::Status run_compute(const std::string& name,
                            const std::function<void(rtapi::CommandList&)>& record,
                            FrameResult& result);
  // Local lights, indirect light, reflections, denoising and the composition of all.
  rtapi::Status run_effects(FrameEffects& effects, const Progress& progress,
                            const std::atomic<bool>& stop, FrameResult& result);
  rtapi::Status run_composite(const ShaderLibraries& libraries, FrameResult& result);
  rtapi::Status read_layers(FrameResult& result);
  // The G-buffer, ambient occlusion and the sun.
  std::vector<RayStep> steps(const ShaderLibraries& libraries) const;
  // Executes a band of rows, and looks at it as --explain and --heatmap ask. [inspect.cpp]
  rtapi::Status execute_band(rtapi::CommandList& list, const std::string& pass,
                             std::uint32_t first_row, std::uint32_t row_count, FrameResult& result);

  Options options_;
  const kaamos::effects::Scene& scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  kaamos::effects::GpuScene gpu_;
  kaamos::effects::Frame frame_;
};

}  // namespace northlight
