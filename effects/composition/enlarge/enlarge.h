// SPDX-License-Identifier: MIT
/// @file
/// Enlarges a finished picture along its edges. [AMD 2021: FidelityFX Super Resolution 1.0]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"

namespace kaamos::effects {

/// The kernel of an enlarged picture.
enum class EnlargeMethod : std::uint32_t {
  kBilinear,    ///< four pixels, whatever they show: to compare with
  kAlongEdges,  ///< twelve, by a kernel that is turned and stretched as edges run
};

/// Constants b0, space3: mirrors EnlargeConstants of enlarge.hlsl.
struct EnlargeConstants {
  float edges = 1.0f;  ///< how far kernels follow edges; 0: not at all
  EnlargeMethod method = EnlargeMethod::kAlongEdges;  ///< the kernel
};
static_assert(sizeof(EnlargeConstants) == 8);

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> enlarge_library();

/// Enlarges one picture of a frame after the other.
class Enlarger {
 public:
  /// Makes the pass and its picture, `factor` times as wide and high as the frame, rounded.
  /// Precondition: 1 to 4.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without the pass.
  static rtapi::Result<Enlarger> create(const rtapi::Device& device, const Frame& frame,
                                        const rtapi::ShaderLibrary& library, float factor,
                                        const EnlargeConstants& constants = {});
  /// Sets the picture that is enlarged, of the frame's size; it must stay. Nothing that was
  /// recorded may run.
  /// @errors those of rtapi::Device::CreateUnorderedAccessView.
  rtapi::Status bind(const rtapi::Texture& source);
  /// Records the pass, behind the one that wrote the picture.
  void dispatch(rtapi::CommandList& list, const Frame& frame) const;
  /// Bytes of what the pass reads and writes.
  std::uint64_t bytes() const { return views_.bytes(); }

  /// R32G32B32A32_FLOAT: radiance.
  const rtapi::Texture& result() const { return result_; }

 private:
  EnlargeConstants constants_;
  ComputePass pass_;
  PassViews views_;
  rtapi::Texture result_;
};

}  // namespace kaamos::effects
