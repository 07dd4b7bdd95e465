// SPDX-License-Identifier: MIT
/// @file
/// Temporal antialiasing of the frame's radiance. Each frame looks through another point of its
/// pixels, and what earlier frames saw is carried along with the surfaces. [Karis 2014]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"

namespace kaamos::effects {

/// Constants b0, space3: mirrors TaaConstants of taa.hlsl.
struct TaaConstants {
  float alpha = 0.1f;             ///< least weight of the new frame; the Nth has at least 1 / N
  float clip_gamma = 1.0f;        ///< deviations of 3 x 3 pixels; 0: history is not clipped
  float depth_tolerance = 0.02f;  ///< relative; what was nearer by more may have hidden the surface
  std::uint32_t history_valid = 0;  ///< set by TemporalAntialiasing
};
static_assert(sizeof(TaaConstants) == 16);

/// Frames after which taa_jitter begins anew.
inline constexpr std::uint32_t kTaaJitterPeriod = 16;

/// Returns where in its pixels frame `index` looks through: pixels from their middle, within half a
/// pixel. These are points of the Halton sequence to bases 2 and 3. [Halton 1960]
glm::vec2 taa_jitter(std::uint32_t index);

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> taa_library();

/// Resolves the radiance of one frame after the other.
class TemporalAntialiasing {
 public:
  /// Makes the pass and its pictures of the frame's size.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without the pass.
  static rtapi::Result<TemporalAntialiasing> create(const rtapi::Device& device, const Frame& frame,
                                                    const rtapi::ShaderLibrary& library,
                                                    const TaaConstants& constants = {});
  /// Records the pass, behind the one that wrote kRadiance. The frame's time must hold the camera
  /// before and the jitter.
  void dispatch(rtapi::CommandList& list, const Frame& frame);
  /// The next frame starts without history, as after a cut: its result is its radiance.
  void reset() { frames_ = 0; }
  /// Bytes of what a frame's pass reads and writes besides the G-buffer.
  std::uint64_t bytes() const { return views_[written_].bytes(); }

  /// R32G32B32A32_FLOAT: radiance of the frame dispatched last, and in w the frames behind it.
  const rtapi::Texture& result() const { return pictures_[written_]; }

 private:
  TaaConstants constants_;
  ComputePass pass_;
  std::array<rtapi::Texture, 2> pictures_, surfaces_;
  std::array<PassViews, 2> views_;  // indexed by the picture that is written
  std::uint32_t written_ = 0;
  std::uint32_t frames_ = 0;  // since the last cut
};

}  // namespace kaamos::effects
