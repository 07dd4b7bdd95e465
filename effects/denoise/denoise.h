// SPDX-License-Identifier: MIT
// Denoising of one signal of a frame: filters in space, accumulation over time, and SVGF, which is
// both. A signal is a picture of the frame's size, R32G32B32A32_FLOAT, of light without the
// surface's own colour; a scalar signal is three equal channels. [effects-spec B6]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "effects/frame/compute_pass.h"
#include "effects/frame/frame.h"

namespace kaamos::effects {

/// Mirrors DenoiseConstants of denoise_common.hlsli, which says what each is. The defaults are
/// SVGF's. [Schied et al. 2017]
struct DenoiseConstants {
  float alpha = 0.2f;
  float moments_alpha = 0.2f;
  float sigma_z = 1.0f;
  float sigma_n = 128.0f;
  float sigma_l = 4.0f;
  float sigma_pixels = 2.0f;
  float clip_gamma = 0.0f;
  std::uint32_t max_history = 32;
  std::uint32_t history_valid = 0;
  std::int32_t step = 1;
  std::int32_t radius = 4;
  std::uint32_t vertical = 0;
  float scale = 1.0f;
};
static_assert(sizeof(DenoiseConstants) == 52);

enum class DenoiseMethod {
  kNone,
  kGaussian,        ///< N1: blurs over edges
  kBilateral,       ///< N2: rows, then columns
  kBilateralExact,  ///< N2 in two dimensions: slow
  kTemporal,        ///< N3: over frames only
  kSvgf,            ///< N4
};

struct DenoiseDesc {
  DenoiseMethod method = DenoiseMethod::kSvgf;
  DenoiseConstants constants;
  std::uint32_t iterations = 5;  ///< of SVGF's wavelet filter, 0 to 8
};

/// What a method takes by default: B6.1 for the bilateral filters, alpha 0.05 for accumulation.
DenoiseDesc default_denoise(DenoiseMethod method);

struct DenoiseLibraries {
  rtapi::ShaderLibrary spatial;
  rtapi::ShaderLibrary svgf;
};
rtapi::Result<DenoiseLibraries> denoise_libraries();

/// Denoises one signal, frame after frame.
class Denoiser {
 public:
  /// `signal` and, if it is a sum of one channel, the picture that it is loaded from: give the sum
  /// to `load`. Errors: those of the device.
  static rtapi::Result<Denoiser> create(const rtapi::Device& device, const Frame& frame,
                                        const DenoiseLibraries& libraries, std::string name,
                                        const rtapi::Texture& signal, const DenoiseDesc& desc);
  /// Makes signal = scale * sum at each load; `sum` is a picture of one float or of four.
  rtapi::Status create_load(const rtapi::Device& device, const Frame& frame,
                            const DenoiseLibraries& libraries, const rtapi::Texture& sum);
  void load(rtapi::CommandList& list, const Frame& frame, float scale) const;

  /// Records the passes of one frame, behind the one that wrote the signal.
  void dispatch(rtapi::CommandList& list, const Frame& frame);
  /// The next frame starts without history, as after a cut.
  void reset() { frames_ = 0; }

  const rtapi::Texture& result() const { return result_; }
  /// Frames that stand behind each pixel, in z; kTemporal and kSvgf.
  const rtapi::Texture& moments() const { return moments_[(frames_ + 1) % 2]; }

 private:
  struct Step {
    const ComputePass* pass;
    PassViews views;
    DenoiseConstants constants;
  };

  rtapi::Status create_passes(const rtapi::Device& device, const Frame& frame,
                              const DenoiseLibraries& libraries);
  rtapi::Status create_pictures(const rtapi::Device& device, const Frame& frame);
  rtapi::Status add_spatial(const rtapi::Device& device, const Frame& frame);
  rtapi::Status add_temporal(const rtapi::Device& device, const Frame& frame, std::uint32_t parity);
  rtapi::Status add_copy(const rtapi::Device& device, const Frame& frame, std::uint32_t parity,
                         const rtapi::Texture& from, const rtapi::Texture& to);
  rtapi::Status add_filter(const rtapi::Device& device, const Frame& frame, std::uint32_t parity,
                           const rtapi::Texture& from, const rtapi::Texture& to, std::int32_t step);

  std::string name_;
  DenoiseDesc desc_;
  rtapi::Texture signal_, result_, history_, accumulated_, guide_, moments_[2];
  std::vector<std::shared_ptr<ComputePass>> passes_;  // by PassId; steps point at them
  std::vector<Step> steps_[2];                        // of even and odd frames
  std::shared_ptr<ComputePass> load_pass_;
  PassViews load_views_;
  std::uint32_t frames_ = 0;  // since the last cut
};

}  // namespace kaamos::effects
