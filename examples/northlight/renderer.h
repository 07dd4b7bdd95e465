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
};

// Done part of the pass, from 0 to 1.
using Progress = std::function<void(const std::string& pass, double done)>;

// The shader libraries of a frame; built in, or compiled at run time.
struct ShaderLibraries {
  rtapi::ShaderLibrary gbuffer;
  rtapi::ShaderLibrary ambient_occlusion;
  rtapi::ShaderLibrary sun_shadow;
  rtapi::ShaderLibrary composite;
};
rtapi::Result<ShaderLibraries> built_in_libraries();

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
  rtapi::Status run_pass(const kaamos::effects::RayPass& pass, const std::string& name,
                         std::uint32_t samples, const Progress& progress,
                         const std::atomic<bool>& stop, FrameResult& result);
  rtapi::Status read_layers(FrameResult& result);
  struct Step {
    kaamos::effects::RayPassDesc desc;
    std::uint32_t samples;
  };
  std::vector<Step> steps(const ShaderLibraries& libraries) const;
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
