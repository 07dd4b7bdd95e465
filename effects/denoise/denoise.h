// SPDX-License-Identifier: MIT
// Denoising of one signal of a frame: filters in space, accumulation over time, and SVGF, which is
// both. A signal is a picture of the frame's size, R32G32B32A32_FLOAT, of light without the
// surface's own colour; a scalar signal is three equal channels. [effects-spec B6]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
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
  std::int32_t normal_squarings = 7;  ///< of sigma_n; set by Denoiser
  float lobe_scale = 0.0f;
  float sigma_hit = 0.5f;
  float sigma_roughness = 0.05f;
};
static_assert(sizeof(DenoiseConstants) == 68);

enum class DenoiseMethod {
  kNone,
  kGaussian,        ///< N1: blurs over edges
  kBilateral,       ///< N2: rows, then columns
  kBilateralExact,  ///< N2 in two dimensions: slow
  kTemporal,        ///< N3: over frames only
  kSvgf,            ///< N4
  kControl,         ///< N8: fireflies, accumulation, a filter as wide as the lobe
};

struct DenoiseDesc {
  DenoiseMethod method = DenoiseMethod::kSvgf;
  DenoiseConstants constants;
  std::uint32_t iterations = 5;  ///< of SVGF's wavelet filter, 0 to 8
};

/// What a method takes by default: B6.1 for the bilateral filters, alpha 0.05 for accumulation.
/// kControl: a filter of fixed radius; with constants.lobe_scale 1 it is that of reflections, whose
/// signal has the mean distance of its hits, in metres, in w.
DenoiseDesc default_denoise(DenoiseMethod method);

/// Pipelines of kernels by name, made when the first denoiser asks; all signals of a frame share
/// them. Not for several threads at once.
class DenoisePipelines {
 public:
  rtapi::Result<std::shared_ptr<ComputePass>> get(const rtapi::Device& device, const Frame& frame,
                                                  const rtapi::ShaderLibrary& library,
                                                  const std::string& name);

 private:
  struct Entry {
    rtapi::RootSignature root_signature;  // of the frame that it is for
    rtapi::ShaderLibrary library;
    std::string name;
    std::shared_ptr<ComputePass> pass;
  };
  std::vector<Entry> entries_;
};

struct DenoiseLibraries {
  rtapi::ShaderLibrary spatial;
  rtapi::ShaderLibrary svgf;
  rtapi::ShaderLibrary control;
  rtapi::ShaderLibrary upscale;
  std::shared_ptr<DenoisePipelines> pipelines = std::make_shared<DenoisePipelines>();
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
  /// Makes signal = scale * sum at each load; `sum` is a picture of one float or of four. `step` 2:
  /// only even pixels of it were written (PassConstants::pixel_step), the others are worked out
  /// from them by joint bilateral upscaling. [effects-spec B7.2]
  rtapi::Status create_load(const rtapi::Device& device, const Frame& frame,
                            const DenoiseLibraries& libraries, const rtapi::Texture& sum,
                            std::uint32_t step = 1);
  void load(rtapi::CommandList& list, const Frame& frame, float scale) const;

  /// Records the passes of one frame, behind the one that wrote the signal.
  void dispatch(rtapi::CommandList& list, const Frame& frame);
  /// The next frame starts without history, as after a cut.
  void reset() { frames_ = 0; }

  const rtapi::Texture& result() const { return result_; }
  /// Of the sum, the signal and the denoiser's own pictures.
  std::uint64_t bytes() const;
  /// Frames that stand behind each pixel, in z; kTemporal and kSvgf.
  const rtapi::Texture& moments() const { return moments_[(frames_ + 1) % 2]; }

 private:
  struct Step {
    std::shared_ptr<ComputePass> pass;
    PassViews views;
    DenoiseConstants constants;
  };

  struct Binding {
    std::uint32_t u;
    const rtapi::Texture* texture;
  };
  struct Kernel {
    rtapi::ShaderLibrary DenoiseLibraries::*library;
    const char* name;
  };
  // What making a step takes.
  struct Recorder {
    const rtapi::Device& device;
    const Frame& frame;
    const DenoiseLibraries& libraries;
  };
  static constexpr auto kSpatialLibrary = &DenoiseLibraries::spatial;
  static constexpr auto kSvgfLibrary = &DenoiseLibraries::svgf;
  static constexpr auto kControlLibrary = &DenoiseLibraries::control;
  static constexpr Kernel kCopy{kSpatialLibrary, "Copy"},
      kPrepareGuides{kSpatialLibrary, "PrepareGuides"}, kGaussian{kSpatialLibrary, "Gaussian"},
      kBilateral{kSpatialLibrary, "BilateralSeparable"},
      kBilateralExact{kSpatialLibrary, "BilateralExact"},
      kTemporal{kSvgfLibrary, "TemporalAccumulation"}, kVariance{kSvgfLibrary, "EstimateVariance"},
      kAtrous{kSvgfLibrary, "Atrous"}, kClampFireflies{kControlLibrary, "ClampFireflies"},
      kFilterLobe{kControlLibrary, "FilterLobe"};

  rtapi::Status create_pictures(const rtapi::Device& device, const Frame& frame);
  rtapi::Status add(const Recorder& to, std::uint32_t parity, const Kernel& kernel,
                    std::initializer_list<Binding> bindings, const DenoiseConstants& constants);
  rtapi::Status add_guides(const Recorder& to, std::uint32_t parity);
  rtapi::Status add_spatial(const Recorder& to);
  rtapi::Status add_temporal(const Recorder& to, std::uint32_t parity);
  rtapi::Status add_lobe_filter(const Recorder& to, std::uint32_t parity,
                                const rtapi::Texture& scratch);
  rtapi::Status add_wavelet(const Recorder& to, std::uint32_t parity, const rtapi::Texture& first);
  rtapi::Status add_copy(const Recorder& to, std::uint32_t parity, const rtapi::Texture& from,
                         const rtapi::Texture& into);
  rtapi::Status add_filter(const Recorder& to, std::uint32_t parity, const rtapi::Texture& from,
                           const rtapi::Texture& into, std::int32_t step);

  std::string name_;
  DenoiseDesc desc_;
  rtapi::Texture sum_, signal_, result_, history_, accumulated_, guides_[2], moments_[2], clamped_;
  std::vector<Step> steps_[2];  // of even and odd frames
  std::shared_ptr<ComputePass> load_pass_;
  PassViews load_views_;
  std::uint32_t frames_ = 0;  // since the last cut
};

}  // namespace kaamos::effects
