// SPDX-License-Identifier: MIT
/// @file
/// Denoises visibility: of the sun, of local lights. Where noise can be, and how far a filter may
/// reach, follows from how wide penumbras are. [Schied et al. 2017; Control; NRD: SIGMA]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effects/denoise/denoise.h"
#include "effects/denoise/visibility_constants.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"

namespace kaamos::effects {

/// Channels that one VisibilityDenoiser takes: kMostChannels of visibility_filter.hlsl.
inline constexpr std::size_t kMostVisibilityChannels = 4;

/// Denoises up to kMostVisibilityChannels scalar channels of one frame in the same way, frame after
/// frame. Each comes out as it would alone.
class VisibilityDenoiser {
 public:
  /// One visibility, or two that lie in one picture.
  struct Signal {
    std::string name;            ///< for messages
    std::uint32_t channels = 1;  ///< 1, or 2: r and g
    /// The visible part of the samples, 0 to 1; R32G32B32A32_FLOAT, as large as the frame.
    rtapi::Texture visibility;
    /// The same, means over all samples, those without an occluder being 0. r, g: 1 / radius of the
    /// penumbra that the closest occluder casts, 1/m. b, a: the part whose occluder moves.
    rtapi::Texture sharpness;
    /// R32G32_UINT: which light the visibility in r and g is of; a pixel of another light has no
    /// part in a pixel's history or filter. Empty: it is the same everywhere.
    rtapi::Texture lights;
    /// For kAdaptiveSvgf: that of its first channel, and behind it that of its second.
    SignalChanges changes = {};
  };

  /// Makes the pictures and the passes. `method`: kTemporal, kSvgf and kAdaptiveSvgf (a
  /// wavelet filter of `iterations` passes, 0 to 8) or kControl (rows and columns, twice); what is
  /// to be filtered in space is as wide for both. The signals' pictures must outlive it; `frame`
  /// must be that of every later call.
  /// @errors KA3043 another method, no channel, or more than kMostVisibilityChannels; those of the
  /// device, among them KA0990 no memory and KA0537 a library without a kernel.
  static rtapi::Result<VisibilityDenoiser> create(const rtapi::Device& device, const Frame& frame,
                                                  const DenoiseLibraries& libraries,
                                                  const std::vector<Signal>& signals,
                                                  DenoiseMethod method,
                                                  const VisibilityConstants& constants = {},
                                                  std::uint32_t iterations = 5);

  /// Records the passes of one frame, behind those that wrote the signals.
  void dispatch(rtapi::CommandList& list, const Frame& frame);
  /// The next frame starts without history, as after a cut.
  void reset() { frames_ = 0; }

  /// The denoised signal, R32G32B32A32_FLOAT: three equal channels, or r and g as they came.
  const rtapi::Texture& result(std::size_t index = 0) const { return signals_[index].result; }
  /// R32G32B32A32_FLOAT of a channel, counted over all signals: visibility over time, the frames
  /// that stand behind it, the square of the deviation by which resampling has blurred it (pixels),
  /// and its light.
  const rtapi::Texture& accumulated(std::size_t channel = 0) const {
    return channels_[channel].accumulated[(frames_ + 1) % 2];
  }
  /// Bytes of the denoiser's own pictures.
  std::uint64_t bytes() const;

 private:
  struct Step {
    std::shared_ptr<ComputePass> pass;
    PassViews views;
    VisibilityConstants constants;
  };
  struct Input {
    Signal signal;
    std::size_t first_channel = 0;
    rtapi::Texture result;
  };
  // A scalar, by itself.
  struct Channel {
    rtapi::Texture drawn, past, blockers[2], filtered[2], accumulated[2];
  };
  struct Binding {
    std::uint32_t u;
    const rtapi::Texture* texture;
  };
  // Everything needed to create the steps of even or of odd frames.
  struct Recorder {
    const rtapi::Device& device;
    const Frame& frame;
    const DenoiseLibraries& libraries;
    std::uint32_t parity;
  };
  using Pictures = std::vector<const rtapi::Texture*>;

  rtapi::Status create_pictures(const rtapi::Device& device, const Frame& frame);
  rtapi::Status add(const Recorder& to, const char* kernel, const std::vector<Binding>& bindings,
                    const VisibilityConstants& constants);
  rtapi::Status add_inputs(const Recorder& to);
  rtapi::Status add_blockers(const Recorder& to);
  rtapi::Status add_accumulation(const Recorder& to);
  rtapi::Result<Pictures> add_filter(const Recorder& to, std::uint32_t iterations);
  rtapi::Status add_results(const Recorder& to, const Pictures& from);
  template <class Get>
  Pictures pictures(Get get) const;

  DenoiseMethod method_ = DenoiseMethod::kSvgf;
  VisibilityConstants constants_;
  std::vector<Input> signals_;
  std::vector<Channel> channels_;
  rtapi::Texture guides_[2];
  std::array<rtapi::Texture, kChangePictures> changes_;
  std::vector<Step> steps_[2];  // for even and odd frames
  std::uint32_t frames_ = 0;    // since the last cut
};

}  // namespace kaamos::effects
