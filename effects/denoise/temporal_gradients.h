// SPDX-License-Identifier: MIT
/// @file
/// A-SVGF's temporal gradients: how much each signal of a frame has changed since the frame before,
/// apart from its noise. In each 3 x 3 pixels a sample of the frame before is taken again, of the
/// same surface, where it is now, and with the same random numbers; what then differs is light.
/// [Schied et al. 2018]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "effects/denoise/denoise.h"
#include "effects/engine/frame.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// Signals of one TemporalGradients: kMostSignals of temporal_gradients.hlsl.
inline constexpr std::size_t kMostGradients = 8;

/// The gradients of one frame, frame after frame. In each:
/// 1. follow(), once the frame has its camera and its G-buffer is there;
/// 2. record_samples(), and then record_again() for each pass, with what it was dispatched with in
///    the frame before;
/// 3. record_changes(), which writes changes();
/// 4. record_keep(), behind the passes that wrote the frame's sums.
/// Without a frame before (has_past()) only the last of them.
class TemporalGradients {
 public:
  /// Makes pictures and passes.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without a kernel;
  /// KA3091 a picture of more than 65,535 pixels on a side.
  static rtapi::Result<TemporalGradients> create(const rtapi::Device& device, const Frame& frame,
                                                 const GpuScene& gpu,
                                                 const DenoiseLibraries& libraries);
  /// Adds a signal and returns its channel in changes(). `sum`: what the frame's pass adds samples
  /// to, of one float or of four; `again`: the same in past(), where record_again's pass adds them.
  /// `component`: of four floats the one that counts, 0 to 2; -1: the luminance of the first three.
  /// @errors KA3091 more than kMostGradients; those of the device.
  rtapi::Result<std::uint32_t> add(const rtapi::Device& device, const Frame& frame,
                                   const rtapi::Texture& sum, const rtapi::Texture& again,
                                   std::int32_t component = -1);
  /// Returns what a picture of the frame's size holds in the frame before, for passes that read it.
  /// The picture must be in unordered-access state when record_keep is executed.
  /// @errors those of the device.
  rtapi::Result<rtapi::Texture> keep(const rtapi::Device& device, const Frame& frame,
                                     const rtapi::Texture& picture);

  /// Takes over the frame's camera and lights.
  /// @errors those of the device.
  rtapi::Status follow(const rtapi::Device& device, const Frame& frame) {
    return past_.follow(device, frame);
  }
  /// Records the choice of the samples that are taken again. `step` and `offset`: those of the
  /// samples of the frame before. [PassConstants::pixel_step]
  void record_samples(rtapi::CommandList& list, const Frame& frame, std::uint32_t step = 1,
                      std::uint32_t offset = 0) const;
  /// Records a pass over them. `constants` and `arguments`: those of the frame before, but with
  /// views of past().
  void record_again(rtapi::CommandList& list, const RayPass& pass, PassConstants constants,
                    const PassArguments& arguments) const;
  /// Records what makes changes() of the samples.
  void record_changes(rtapi::CommandList& list, const Frame& frame) const;
  /// Records that the frame becomes the frame before.
  void record_keep(rtapi::CommandList& list, const Frame& frame);
  /// The number of signals that were added.
  std::size_t signals() const { return signals_.size(); }
  /// Returns whether there is a frame before.
  bool has_past() const { return has_past_; }
  /// There is none any more, as after a cut.
  void forget() { has_past_ = false; }

  /// The surfaces of the frame before, with pictures of their own for what is summed up again.
  const Frame& past() const { return past_; }
  /// R8G8B8A8_UNORM, a channel for each signal, four in each: 0 where nothing changed, 1 where
  /// nothing is as it was. Valid once record_changes was executed.
  const std::array<rtapi::Texture, kChangePictures>& changes() const { return changes_; }
  /// Bytes of its pictures and buffers.
  std::uint64_t bytes() const;

 private:
  struct Signal {
    rtapi::Texture sum, before, again;
    std::int32_t component = -1;
    ComputePass compare;
    PassViews views;
  };
  rtapi::Status create_views(const rtapi::Device& device, const Frame& frame, const GpuScene& gpu);

  Frame past_;
  std::uint32_t columns_ = 0, rows_ = 0;               // of strata
  rtapi::Texture position_, normal_, shading_normal_;  // of the frame before, as they were
  std::array<rtapi::Texture, kChangePictures> changes_;
  std::vector<std::pair<rtapi::Texture, rtapi::Texture>> kept_;  // and what it is copied to
  rtapi::Buffer samples_, order_, gradients_, filtered_;
  ComputePass pick_, filter_, write_;
  PassViews views_, even_, odd_;  // of the filter's passes: there and back
  std::vector<Signal> signals_;
  rtapi::ShaderLibrary library_;
  bool has_past_ = false;
};

}  // namespace kaamos::effects
