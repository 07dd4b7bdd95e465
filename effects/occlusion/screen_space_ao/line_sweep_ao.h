// SPDX-License-Identifier: MIT
/// @file
/// Ambient occlusion with exact horizons along lines of the depth picture. [Timonen 2013]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"
#include "effects/engine/pass_views.h"

namespace kaamos::effects {

/// The options of the sweep.
struct LineSweepSettings {
  std::uint32_t directions = 16;  ///< of lines over the picture, 1 to 64
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> line_sweep_ao_library();

/// The passes over one frame: there and back along the lines of each direction.
class LineSweepAo {
 public:
  /// Makes the pipeline and its pictures. `views` must have the result, a picture of the frame's
  /// size of R32G32B32A32_FLOAT, at register u0; other registers are set here. It must outlive the
  /// passes.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without a kernel.
  static rtapi::Result<LineSweepAo> create(const rtapi::Device& device, const Frame& frame,
                                           const rtapi::ShaderLibrary& library, PassViews& views);
  /// Records the whole picture, behind the G-buffer. constants.radius is how far occluders reach,
  /// metres. Without a limit (infinity) horizons are exact; with one, a point behind a higher one
  /// is forgotten although a later pixel may be too far from the higher one.
  void record(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
              const LineSweepSettings& settings) const;
  /// Bytes of the pictures between the passes.
  std::uint64_t bytes() const;

 private:
  ComputePass pass_;
  PassViews* views_ = nullptr;
  std::array<rtapi::Texture, 3> pictures_;
};

}  // namespace kaamos::effects
