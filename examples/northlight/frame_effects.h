// SPDX-License-Identifier: MIT
// The whole frame's effects besides ambient occlusion and the sun: local lights with contact
// shadows, indirect diffuse light and reflections, with their denoising and composition.
#pragma once

#include <rtapi/rtapi.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/composite/composite.h"
#include "effects/contact_shadow/contact_shadow.h"
#include "effects/denoise/denoise.h"
#include "effects/direct/direct.h"
#include "effects/frame/frame.h"
#include "effects/frame/ray_pass.h"
#include "effects/indirect_diffuse/indirect_diffuse.h"
#include "effects/lights/lighting.h"
#include "effects/reflections/reflections.h"
#include "effects/transparent/transparent.h"
#include "options.h"

namespace northlight {

// The shader libraries of a frame, built in or compiled at run time.
struct ShaderLibraries {
  rtapi::ShaderLibrary gbuffer;
  rtapi::ShaderLibrary ambient_occlusion;
  rtapi::ShaderLibrary sun_shadow;
  rtapi::ShaderLibrary composite;
  rtapi::ShaderLibrary lighting;
  rtapi::ShaderLibrary direct;
  rtapi::ShaderLibrary contact_shadow;
  rtapi::ShaderLibrary volume_bake;
  rtapi::ShaderLibrary indirect_diffuse;
  rtapi::ShaderLibrary reflections;
  rtapi::ShaderLibrary transparent;
  rtapi::ShaderLibrary ray_order;
  rtapi::ShaderLibrary taa;
  kaamos::effects::DenoiseLibraries denoise;
};
rtapi::Result<ShaderLibraries> built_in_libraries();

// A ray tracing pass of the frame, and the resources that only it uses.
struct RayStep {
  kaamos::effects::RayPassDesc desc;
  std::uint32_t samples = 1;
  kaamos::effects::PassArguments arguments;
  std::vector<kaamos::effects::FrameTexture> writes = {};  // pictures of the frame
  std::uint32_t pixel_step = 1;                            // 2: at half resolution
};

class FrameEffects {
 public:
  FrameEffects() = default;
  FrameEffects(const FrameEffects&) = delete;  // steps point into it
  FrameEffects& operator=(const FrameEffects&) = delete;

  // Makes the pictures and pipelines of the effects that `options` names and the scene needs. Loads
  // or bakes the volume of indirect light.
  rtapi::Status create(const rtapi::Device& device, rtapi::CommandQueue& queue,
                       const kaamos::effects::Frame& frame, const kaamos::effects::GpuScene& gpu,
                       const kaamos::effects::Scene& scene, const Options& options,
                       const ShaderLibraries& libraries,
                       const std::function<void(double)>& bake_progress,
                       const std::atomic<bool>& stop);

  // Moves on to a frame whose camera is at `origin`. `cut`: the frame is unrelated to the previous
  // one.
  void begin_frame(const glm::dvec3& origin, bool cut);
  // Light lists, shadow maps and the main lighting; runs after the G-buffer.
  void light(rtapi::CommandList& list, const kaamos::effects::Frame& frame) const;
  const std::vector<RayStep>& steps() const { return steps_; }
  // Denoises what the steps wrote; signals with the same filter are filtered together.
  struct Filter {
    std::string name;
    std::function<void(rtapi::CommandList&)> record;
    std::uint64_t bytes = 0;  // size of its pictures
  };
  std::vector<Filter> filters(const kaamos::effects::Frame& frame);
  // Composes the frame.
  void compose(rtapi::CommandList& list, const kaamos::effects::Frame& frame) const;
  // Bytes that light() and compose() read and write, not counting the frame's pictures.
  std::uint64_t light_bytes() const;
  std::uint64_t compose_bytes() const;

  // The input and output pictures of each denoiser.
  struct SignalPictures {
    std::string name;
    rtapi::Texture raw, denoised;
  };
  std::vector<SignalPictures> signals() const;
  // Pictures for files: name, picture, and the divisor for its values.
  struct Layer {
    std::string name;
    rtapi::Texture picture;
    float scale = 1;
  };
  std::vector<Layer> layers() const;
  // What was left out because the scene or the options do not need it.
  const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  struct Signal {
    std::string name;
    rtapi::Texture sum;   // the step adds to it
    rtapi::Texture mean;  // the denoiser's input
    std::uint32_t samples = 1;
    std::uint32_t pixel_step = 1;
    std::size_t filter = 0, index = 0;  // signal `index` of filters_[filter]
  };
  // Signals with the same filter.
  struct SignalFilter {
    std::string name;
    kaamos::effects::Denoiser denoiser;
    std::vector<const Signal*> signals;
  };
  rtapi::Status add_signal(const std::string& name, const rtapi::Texture& sum,
                           std::uint32_t samples, std::uint32_t pixel_step);
  rtapi::Status create_filters();
  rtapi::Status create_filter(const kaamos::effects::DenoiseDesc& desc,
                              const std::vector<Signal*>& signals);
  const rtapi::Texture& result(const Signal& signal) const {
    return filters_[signal.filter].denoiser.result(signal.index);
  }
  rtapi::Status add_contact();
  rtapi::Status add_indirect();
  rtapi::Status add_reflections();
  rtapi::Status add_transparent();
  rtapi::Result<kaamos::effects::IndirectVolume> volume(
      const kaamos::effects::Scene& scene, const std::function<void(double)>& bake_progress,
      const std::atomic<bool>& stop);
  const rtapi::Texture* denoised(const std::string& name) const;

  // The arguments of create(), for its parts.
  struct Given {
    rtapi::Device device;
    rtapi::CommandQueue queue;
    const kaamos::effects::Frame* frame = nullptr;
    const kaamos::effects::GpuScene* gpu = nullptr;
    Options options;
    const ShaderLibraries* libraries = nullptr;
    glm::dvec3 origin{0.0};
  } given_;
  std::optional<kaamos::effects::Lighting> lighting_;
  std::optional<kaamos::effects::DirectLighting> direct_;
  kaamos::effects::GpuVolume volume_;
  kaamos::effects::PassViews contact_views_, indirect_views_, reflection_views_, glass_views_;
  rtapi::Texture glass_, transmittance_;  // null: no glass
  kaamos::effects::ComputePass glass_compose_;
  bool has_glass_ = false;
  std::vector<RayStep> steps_;
  std::vector<std::unique_ptr<Signal>> signals_;
  std::vector<SignalFilter> filters_;
  std::optional<kaamos::effects::ComposePass> compose_;
  std::vector<std::string> left_out_;
  bool contact_ = false;
};

}  // namespace northlight
