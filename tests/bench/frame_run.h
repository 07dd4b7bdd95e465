// SPDX-License-Identifier: MIT
//
// The whole Northlight frame of the lounge, made once and run again and again, and the rays that it
// traces.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "effects/frame/ray_pass.h"
#include "embree_loops.h"
#include "examples/northlight/frame_effects.h"

namespace kaamos::bench {

// The parts of tracing and shading, in order. "lights" is their lists and shadow maps, and the
// light that they send to each pixel.
inline constexpr std::array kFrameParts = {"gbuffer", "lights", "ao",         "sun",
                                           "contact", "gi",     "reflections"};

class FrameRun {
 public:
  // One ray per pixel for each effect, plus the rays that their hits need.
  FrameRun(uint32_t width, uint32_t height, uint32_t threads);

  // Runs every part, or one part, which reads what the others last wrote.
  void trace_and_shade(const std::string& part = "");
  // Denoises every signal and composes the frame.
  void denoise_and_compose();

  // The rays of one frame, or of a part of it, in the order in which each thread traced them.
  // `hits`: how many hit something.
  std::vector<FrameRay> record(uint64_t& hits, const std::string& part = "");

  const rtapi::Device& device() const { return device_; }
  rtapi::CommandQueue& queue() { return queue_; }
  const effects::Frame& frame() const { return frame_; }
  const effects::Scene& scene() const { return scene_; }
  // The lounge as in the frame's top level: relative to the camera.
  SceneData scene_at_camera() const;

 private:
  using Record = std::function<void(rtapi::CommandList&, const effects::PassConstants&)>;
  Record ray_pass(const effects::RayPassDesc& desc, const effects::PassArguments& arguments);

  effects::Scene scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  effects::GpuScene gpu_;
  effects::Frame frame_;
  northlight::ShaderLibraries libraries_;
  northlight::FrameEffects effects_;
  std::vector<Record> parts_;  // as kFrameParts
  uint32_t frames_ = 0;        // traced so far
};

}  // namespace kaamos::bench
