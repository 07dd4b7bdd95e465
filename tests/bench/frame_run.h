// SPDX-License-Identifier: MIT
//
// The whole Northlight frame of the lounge, made once and run again and again, and the rays that it
// traces.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effects/frame/ray_pass.h"
#include "embree_loops.h"
#include "examples/northlight/frame_effects.h"

namespace kaamos::bench {

class FrameRun {
 public:
  // One ray a pixel for each effect, and what their hits need more.
  FrameRun(uint32_t width, uint32_t height, uint32_t threads);

  // The G-buffer, lights with their shadow maps, every ray tracing pass.
  void trace_and_shade();
  // Denoises every signal and puts the frame together.
  void denoise_and_compose();

  // One frame's rays, in the order in which each thread traced them; `hits`: what they hit.
  std::vector<FrameRay> record(uint64_t& hits);

  const rtapi::Device& device() const { return device_; }
  rtapi::CommandQueue& queue() { return queue_; }
  const effects::Frame& frame() const { return frame_; }
  const effects::Scene& scene() const { return scene_; }
  // The lounge where the frame's top level has it: relative to the camera.
  SceneData scene_at_camera() const;

 private:
  struct Pass {
    effects::RayPass pass;
    effects::PassArguments arguments;
  };
  void add(const effects::RayPassDesc& desc, const effects::PassArguments& arguments);

  effects::Scene scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  effects::GpuScene gpu_;
  effects::Frame frame_;
  northlight::ShaderLibraries libraries_;
  northlight::FrameEffects effects_;
  std::vector<Pass> passes_;
  uint32_t frames_ = 0;  // that were traced
};

}  // namespace kaamos::bench
