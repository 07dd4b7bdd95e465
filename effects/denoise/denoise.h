// SPDX-License-Identifier: MIT
// Denoises the signals of a frame: spatial filters, accumulation over time, and SVGF, which is
// both. A signal is a picture of the frame's size (R32G32B32A32_FLOAT) of light without the
// surface's own colour; a scalar signal has three equal channels. [effects-spec B6]
#pragma once

#include <rtapi/rtapi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
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
  std::int32_t signals = 1;  ///< set by Denoiser
  std::uint32_t lobes = 0;   ///< set by Denoiser
};
static_assert(sizeof(DenoiseConstants) == 76);

/// Signals that one Denoiser takes: kMostSignals of svgf.hlsl.
inline constexpr std::size_t kMostSignals = 5;

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
  /// Of SVGF's wavelet filter, 0 to 8: while fewer than kFramesOfHistory frames stand behind this
  /// one, and then. What many frames have smoothed already needs no filter that wide: with fewer
  /// passes it is nearer to the truth. [README.md]
  std::uint32_t iterations = 5;
  std::uint32_t iterations_with_history = 3;
};

/// From here on the variance is one over time. [svgf.hlsl: kEnoughFrames]
inline constexpr std::uint32_t kFramesOfHistory = 4;

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
    rtapi::RootSignature root_signature;  // of the frame that it was made for
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

/// Denoises up to kMostSignals signals of one frame in the same way, frame after frame; they share
/// what is to be known of the surfaces. Each comes out as it would alone.
class Denoiser {
 public:
  struct Signal {
    std::string name;
    rtapi::Texture picture;
    /// Of rays in the reflection lobe of the surface: SVGF leaves mirrors as they are, whose lobe
    /// is one direction and has no noise.
    bool of_lobe = false;
  };

  /// Errors: those of the device; more signals than there may be, or none.
  static rtapi::Result<Denoiser> create(const rtapi::Device& device, const Frame& frame,
                                        const DenoiseLibraries& libraries,
                                        const std::vector<Signal>& signals,
                                        const DenoiseDesc& desc);
  /// Of one.
  static rtapi::Result<Denoiser> create(const rtapi::Device& device, const Frame& frame,
                                        const DenoiseLibraries& libraries, std::string name,
                                        const rtapi::Texture& signal, const DenoiseDesc& desc) {
    return create(device, frame, libraries, {{std::move(name), signal}}, desc);
  }
  /// Makes signal `index` = scale * sum at each load; `sum` is a picture of one float or of four.
  /// `step` 2: only even pixels of it were written (PassConstants::pixel_step), the others are
  /// worked out from them by joint bilateral upscaling. [effects-spec B7.2]
  rtapi::Status create_load(const rtapi::Device& device, const Frame& frame,
                            const DenoiseLibraries& libraries, const rtapi::Texture& sum,
                            std::uint32_t step = 1, std::size_t index = 0);
  void load(rtapi::CommandList& list, const Frame& frame, float scale, std::size_t index = 0) const;

  /// Records the passes of one frame, behind those that wrote the signals.
  void dispatch(rtapi::CommandList& list, const Frame& frame);
  /// The next frame starts without history, as after a cut.
  void reset() { frames_ = 0; }

  const rtapi::Texture& result(std::size_t index = 0) const { return channels_[index].result; }
  /// Of the sums, the signals and the denoiser's own pictures.
  std::uint64_t bytes() const;
  /// Frames that stand behind each pixel, in z; kTemporal and kSvgf.
  const rtapi::Texture& moments(std::size_t index = 0) const {
    return channels_[index].moments[(frames_ + 1) % 2];
  }

 private:
  struct Step {
    std::shared_ptr<ComputePass> pass;
    PassViews views;
    DenoiseConstants constants;
  };

  // Everything that belongs to one signal.
  struct Channel {
    std::string name;
    rtapi::Texture sum, signal, result, history, accumulated, moments[2], clamped;
    std::shared_ptr<ComputePass> load_pass;
    PassViews load_views;
  };

  struct Binding {
    std::uint32_t u;
    const rtapi::Texture* texture;
  };
  struct Kernel {
    rtapi::ShaderLibrary DenoiseLibraries::*library;
    const char* name;
  };
  // Everything needed to create the steps.
  struct Recorder {
    const rtapi::Device& device;
    const Frame& frame;
    const DenoiseLibraries& libraries;
    std::vector<Step>& steps;
    std::uint32_t parity = 0;
    std::uint32_t iterations = 0;  // of the wavelet filter
  };
  // One picture per channel.
  using Pictures = std::vector<const rtapi::Texture*>;

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
  rtapi::Status add(const Recorder& to, const Kernel& kernel, const std::vector<Binding>& bindings,
                    const DenoiseConstants& constants);
  rtapi::Status add_guides(const Recorder& to);
  rtapi::Status add_spatial(const Recorder& to, const Channel& channel);
  rtapi::Status add_temporal(const Recorder& to);
  rtapi::Status add_lobe_filter(const Recorder& to, const Channel& channel);
  rtapi::Status add_wavelet(const Recorder& to);
  rtapi::Status add_copy(const Recorder& to, const Pictures& from, const Pictures& into);
  template <class Member>
  Pictures pictures(Member member) const;
  Pictures moments_of(std::uint32_t parity) const;

  DenoiseDesc desc_;
  std::vector<Channel> channels_;
  rtapi::Texture guides_[2];
  std::vector<Step> steps_[2];               // for even and odd frames
  std::vector<Step> steps_with_history_[2];  // empty: same as steps_
  std::uint32_t frames_ = 0;                 // since the last cut
};

}  // namespace kaamos::effects
