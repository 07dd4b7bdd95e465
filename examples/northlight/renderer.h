// SPDX-License-Identifier: MIT
// A scene, a frame and its passes, rendered in bands so that progress shows and the user can stop.
#pragma once

#include <rtapi/explain.h>
#include <rtapi/rtapi.h>
#include <rtapi/table_description.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/composite/composite.h"
#include "effects/frame/frame.h"
#include "effects/frame/ray_pass.h"
#include "effects/ray_order/ray_order.h"
#include "effects/structures/structures.h"
#include "effects/taa/taa.h"
#include "frame_effects.h"
#include "options.h"

namespace northlight {

struct PassStatistics {
  std::string name;
  double ms = 0;
  rtapi::RaytracingStatistics rays;
  std::uint64_t bytes = 0;  // of pictures and buffers that the pass writes or only it reads
};

// A dispatch that contains the pixel of --explain.
struct ExplainedDispatch {
  std::string pass;
  std::uint32_t first_row = 0;  // first row of the band; the dispatch's y counts from there
  rtapi::PixelExplanation pixel;
};

// The results of a finished frame.
struct FrameResult {
  std::map<std::string, kaamos::effects::FloatImage> layers;  // "ao", "normal", ...
  kaamos::effects::FloatImage radiance;                       // RGBA, linear
  std::vector<PassStatistics> passes;
  std::vector<ExplainedDispatch> explained;          // with --explain
  std::vector<rtapi::PixelStatistics> pixel_counts;  // with --heatmap: width * height
  std::vector<std::string> left_out;                 // effects and parts left out, and why
};

// A frame of a sequence.
struct Moment {
  std::uint32_t index = 0;
  double seconds = 0;
  kaamos::effects::Camera camera;
  bool cut = false;  // the frame is unrelated to the previous one
};

// How much of the pass is done, from 0 to 1.
using Progress = std::function<void(const std::string& pass, double done)>;

class Renderer {
 public:
  // `scene` must stay unchanged as long as the renderer lives.
  static rtapi::Result<std::unique_ptr<Renderer>> create(
      const Options& options, const kaamos::effects::Scene& scene,
      std::function<void(const std::string&)> message);
  // Renders with these shaders: prepare, one frame, read_layers. Here and below, an error with an
  // empty id means that `stop` was set.
  rtapi::Result<FrameResult> render(const ShaderLibraries& libraries, const Progress& progress,
                                    const std::atomic<bool>& stop);
  // Makes all passes, pictures and histories with these shaders, and bakes what must be baked.
  // `libraries` must outlive the renderer's passes.
  rtapi::Status prepare(const ShaderLibraries& libraries, const Progress& progress,
                        const std::atomic<bool>& stop, FrameResult& result);
  // Moves on to another frame of a sequence: poses, structures, camera.
  rtapi::Status begin_frame(const Moment& moment, FrameResult& result);
  rtapi::Status render_frame(const Progress& progress, const std::atomic<bool>& stop,
                             FrameResult& result);
  rtapi::Status read_layers(FrameResult& result);
  rtapi::Status read_radiance(FrameResult& result);

  rtapi::Result<kaamos::effects::FloatImage> read(const rtapi::Texture& picture);
  const kaamos::effects::Frame& frame() const { return frame_; }
  const FrameEffects* effects() const { return effects_.get(); }  // null unless whole_frame()
  // Null without antialiasing over frames.
  const kaamos::effects::TemporalAntialiasing* taa() const { return taa_ ? &*taa_ : nullptr; }
  // Null if nothing moves.
  const kaamos::effects::StructureStatistics* structures() const {
    return structures_ ? &structures_->statistics() : nullptr;
  }

  // The shader tables of each pass, with its name.
  rtapi::Result<std::vector<std::pair<std::string, rtapi::TableDescription>>> describe_tables(
      const ShaderLibraries& libraries);

  const rtapi::DeviceInfo& device_info() const { return device_.GetInfo(); }
  const kaamos::effects::GpuSceneStatistics& scene_statistics() const { return gpu_.statistics; }

 private:
  struct Pass {
    RayStep step;
    kaamos::effects::RayPass pass;
    std::optional<kaamos::effects::RayPass> keys;  // sorts its rays
  };

  Renderer(const Options& options, const kaamos::effects::Scene& scene)
      : options_(options), scene_(scene) {}
  rtapi::Status create_scene();
  rtapi::Status add_passes(const std::vector<RayStep>& steps, std::vector<Pass>& out);
  rtapi::Status run_pass(const Pass& pass, const Progress& progress, const std::atomic<bool>& stop,
                         FrameResult& result);
  // Poses, and the levels of detail for the camera.
  std::vector<kaamos::effects::InstanceState> states_at(const Moment& moment) const;
  // Puts the pixels in the order of the rays that the pass is about to trace; adds to `ms`.
  rtapi::Status sort_rays(const Pass& pass, const kaamos::effects::PassConstants& constants,
                          double& ms);
  // Runs and times a pass without rays. `bytes`: as in PassStatistics.
  rtapi::Status run_compute(const std::string& name, std::uint64_t bytes,
                            const std::function<void(rtapi::CommandList&)>& record,
                            FrameResult& result);
  // Local lights, indirect light, reflections, denoising and composition.
  rtapi::Status run_effects(const Progress& progress, const std::atomic<bool>& stop,
                            FrameResult& result);
  rtapi::Status run_composite(FrameResult& result);
  // The G-buffer, ambient occlusion and the sun.
  std::vector<RayStep> steps(const ShaderLibraries& libraries) const;
  // Executes a band of rows, and inspects it for --explain and --heatmap. [inspect.cpp]
  rtapi::Status execute_band(rtapi::CommandList& list, const std::string& pass,
                             std::uint32_t first_row, std::uint32_t row_count, FrameResult& result);

  Options options_;
  const kaamos::effects::Scene& scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  kaamos::effects::GpuScene gpu_;
  kaamos::effects::Frame frame_;
  std::optional<kaamos::effects::StructureManager> structures_;  // for scenes that move
  Moment moment_;
  glm::vec2 jitter_{0.0f};
  // Made by prepare.
  std::unique_ptr<FrameEffects> effects_;
  std::vector<Pass> passes_, effect_passes_;
  kaamos::effects::CompositePass composite_;
  std::optional<kaamos::effects::RaySorter> sorter_;
  std::optional<kaamos::effects::TemporalAntialiasing> taa_;
};

}  // namespace northlight
