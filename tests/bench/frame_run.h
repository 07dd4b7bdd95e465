// SPDX-License-Identifier: MIT
//
// The whole Northlight frame of the lounge, made once and run again and again, and the rays that it
// traces.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effects/northlight/frame_renderer.h"
#include "embree_loops.h"

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

  const rtapi::Device& device() const { return renderer_->device(); }
  rtapi::CommandQueue& queue() { return renderer_->queue(); }
  const effects::Frame& frame() const { return renderer_->frame(); }
  // What the samples of a signal are added to.
  rtapi::Texture sum(const std::string& signal) const { return renderer_->effects().sum(signal); }
  // The lounge as in the frame's top level: relative to the camera.
  SceneData scene_at_camera() const;

 private:
  effects::Scene scene_;
  std::unique_ptr<effects::FrameRenderer> renderer_;
  uint32_t frames_ = 0;  // that were traced
};

}  // namespace kaamos::bench
