// SPDX-License-Identifier: MIT
/// @file
/// Denoises the signals of a frame: spatial filters, accumulation over time, and SVGF, which is
/// both. A signal is a picture of the frame's size (R32G32B32A32_FLOAT) of light without the
/// surface's own colour; a scalar signal has three equal channels.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "effects/denoise/sum_load.h"
#include "effects/denoise/visibility_constants.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"

namespace kaamos::effects {

/// Constants b0, space3, of every kernel: mirrors DenoiseConstants of denoise_common.hlsli. The
/// defaults are SVGF's. [Schied et al. 2017]
struct DenoiseConstants {
  float alpha = 0.2f;          ///< least weight of the new frame, 0 to 1
  float moments_alpha = 0.2f;  ///< the same for its moments
  float sigma_z = 1.0f;        ///< of depth, in slopes of the surface
  float sigma_n = 128.0f;      ///< exponent of the cosine between normals
  float sigma_l = 4.0f;        ///< of luminance, in standard deviations
  float sigma_pixels = 2.0f;   ///< of the Gaussian, pixels
  /// Clips history to the mean of 3 x 3 pixels plus or minus so many deviations; 0: no clipping.
  float clip_gamma = 0.0f;
  std::uint32_t max_history = 32;     ///< frames
  std::uint32_t history_valid = 0;    ///< set by Denoiser; 0: there is no frame before
  std::int32_t step = 1;              ///< set by Denoiser: texels between taps
  std::int32_t radius = 4;            ///< taps to each side
  std::uint32_t vertical = 0;         ///< set by Denoiser: separable filters, 0 rows, 1 columns
  float scale = 1.0f;                 ///< set by SumLoad: factor on the sum
  std::int32_t normal_squarings = 7;  ///< set by Denoiser: of sigma_n
  float lobe_scale = 0.0f;         ///< of the radius of a lobe's footprint; 0: the radius is fixed
  float sigma_hit = 0.5f;          ///< of hit distances, relative to the farther one
  float sigma_roughness = 0.05f;   ///< of roughness
  std::int32_t signals = 1;        ///< set by Denoiser
  std::uint32_t lobes = 0;         ///< set by Denoiser
  std::uint32_t changes = 0;       ///< set by Denoiser
  std::uint32_t pixel_offset = 0;  ///< set by SumLoad [PassConstants::pixel_offset]
  /// 1: light that comes in few bright samples is not lost: what kControl takes from fireflies goes
  /// to the pixels around them, and history is only clipped where it is off by more than samples
  /// vary over time. 0: fireflies and history are cut to what 3 x 3 pixels of one frame show, as
  /// the sources do.
  std::uint32_t keep_energy = 1;
  /// In place of `alpha` for scalars such as ambient occlusion, whose noise is large beside what
  /// changes. [Falcor]
  float scalar_alpha = 0.05f;
  std::uint32_t scalars = 0;  ///< set by Denoiser
};
static_assert(sizeof(DenoiseConstants) == 96);

/// Signals that one Denoiser takes: kMostSignals of svgf.hlsl.
inline constexpr std::size_t kMostSignals = 5;

/// The method by which a signal is denoised.
enum class DenoiseMethod {
  kNone,            ///< the signal as it is
  kGaussian,        ///< blurs edges too
  kBilateral,       ///< rows, then columns
  kBilateralExact,  ///< the same in two dimensions: slow
  kTemporal,        ///< over frames only
  kSvgf,            ///< over pixels and frames, by the variance [Schied et al. 2017]
  kControl,         ///< fireflies, accumulation, a filter as wide as the lobe
  /// SVGF that lets history go where light has changed [temporal_gradients.h]. Where no
  /// gradients are handed over, it is SVGF with as many passes in each frame.
  kAdaptiveSvgf,
};

/// Describes what Denoiser does.
struct DenoiseDesc {
  DenoiseMethod method = DenoiseMethod::kSvgf;  ///< how
  DenoiseConstants constants;                   ///< with which numbers
  /// Passes of SVGF's wavelet filter, 0 to 8: in the first frames, and once kFramesOfHistory frames
  /// stand behind a frame. What many frames have smoothed needs no filter that wide: with fewer
  /// passes the result is nearer to the truth, as effects/denoise/README.md shows.
  ///@{
  std::uint32_t iterations = 5;
  std::uint32_t iterations_with_history = 3;
  ///@}
  VisibilityConstants visibility;  ///< of signals that say how sharp their shadows are
  /// 1: what is kept of light from frame to frame has half floats. Steps of the new frame's weight
  /// that are smaller than half of their last digit are lost: history stops short of where light
  /// went.
  std::uint32_t half_history = 0;
};

/// From so many frames on the variance is taken over time instead of over neighbours: kEnoughFrames
/// of svgf.hlsl. [Schied et al. 2017]
inline constexpr std::uint32_t kFramesOfHistory = 4;

/// The settings of a method. Bilateral filters look at depths and normals only, not at luminance.
/// kControl gets a filter of fixed radius; with constants.lobe_scale = 1 it becomes that of
/// reflections, whose signal holds the mean distance of its hits, metres, in w.
DenoiseDesc default_denoise(DenoiseMethod method);

/// Pipelines of kernels by name, made when the first denoiser asks; all signals of a frame share
/// them. Not for several threads at once.
class DenoisePipelines {
 public:
  /// The kernel `name` of a library for a frame, made at the first call.
  /// @errors KA0537 no such kernel; those of rtapi::Device::CreateComputePipelineState.
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

/// Pictures of changes that a denoiser reads, four signals in each: those of svgf.hlsl and
/// visibility_filter.hlsl.
inline constexpr std::size_t kChangePictures = 2;

/// The pictures that say how much signals have changed. [TemporalGradients]
struct SignalChanges {
  /// TemporalGradients::changes; null: nobody knows
  std::array<rtapi::Texture, kChangePictures> pictures;
  std::uint32_t channel = 0;  ///< the signal's: 0 to 3 in the first, 4 to 7 in the second
};

/// The shaders of every method, and the pipelines made of them.
struct DenoiseLibraries {
  rtapi::ShaderLibrary spatial;     ///< spatial.hlsl
  rtapi::ShaderLibrary svgf;        ///< svgf.hlsl
  rtapi::ShaderLibrary control;     ///< control.hlsl
  rtapi::ShaderLibrary upscale;     ///< upscale.hlsl
  rtapi::ShaderLibrary visibility;  ///< visibility_filter.hlsl
  rtapi::ShaderLibrary gradients;   ///< temporal_gradients.hlsl
  /// Shared by all denoisers that are made of these libraries.
  std::shared_ptr<DenoisePipelines> pipelines = std::make_shared<DenoisePipelines>();
};
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<DenoiseLibraries> denoise_libraries();

/// Denoises up to kMostSignals signals of one frame in the same way, frame after frame; they share
/// what is to be known of the surfaces. Each comes out as it would alone.
class Denoiser {
 public:
  /// A signal to denoise.
  struct Signal {
    std::string name;        ///< for messages
    rtapi::Texture picture;  ///< of the frame's size, R32G32B32A32_FLOAT
    /// The signal comes from rays in the reflection lobe of the surface: SVGF leaves mirrors as
    /// they are, because their lobe is one direction and has no noise.
    bool of_lobe = false;
    /// For kAdaptiveSvgf; all signals that have some share the pictures.
    SignalChanges changes = {};
    /// Visibility or a part from 0 to 1, three equal channels: new frames weigh
    /// DenoiseConstants::scalar_alpha.
    bool is_scalar = false;
  };

  /// Makes the pictures and the passes for 1 to kMostSignals signals. The signals' pictures must
  /// outlive it; `frame` must be that of every later call.
  /// @errors KA3043 no signal, or more than kMostSignals; those of the device, among them KA0990 no
  /// memory and KA0537 a library without a kernel.
  static rtapi::Result<Denoiser> create(const rtapi::Device& device, const Frame& frame,
                                        const DenoiseLibraries& libraries,
                                        const std::vector<Signal>& signals,
                                        const DenoiseDesc& desc);
  /// Makes them for one signal.
  /// @errors as of the overload for several.
  static rtapi::Result<Denoiser> create(const rtapi::Device& device, const Frame& frame,
                                        const DenoiseLibraries& libraries, std::string name,
                                        const rtapi::Texture& signal, const DenoiseDesc& desc) {
    return create(device, frame, libraries, {{std::move(name), signal}}, desc);
  }
  /// Makes signal `index` = scale * sum at each load; `sum` is a picture of one float or of four.
  /// `step` 2: only one pixel of each 2 x 2 was written (PassConstants::pixel_step), the others are
  /// worked out from them by joint bilateral upscaling. [Kopf et al. 2007]
  /// @errors those of the device.
  rtapi::Status create_load(const rtapi::Device& device, const Frame& frame,
                            const DenoiseLibraries& libraries, const rtapi::Texture& sum,
                            std::uint32_t step = 1, std::size_t index = 0);
  /// Records what create_load made, behind the passes that wrote the sum: signal = `scale` * sum.
  /// `pixel_offset`: as the passes had it.
  void load(rtapi::CommandList& list, const Frame& frame, float scale, std::size_t index = 0,
            std::uint32_t pixel_offset = 0) const;

  /// Records the passes of one frame, behind those that wrote the signals.
  void dispatch(rtapi::CommandList& list, const Frame& frame);
  /// The next frame starts without history, as after a cut.
  void reset() { frames_ = 0; }

  /// The denoised signal, R32G32B32A32_FLOAT.
  const rtapi::Texture& result(std::size_t index = 0) const { return channels_[index].result; }
  /// Bytes of the sums, the signals and the denoiser's own pictures.
  std::uint64_t bytes() const;
  /// R32G32B32A32_FLOAT: moments of the luminance in x and y, and in z the frames that stand behind
  /// each pixel. Null for methods that keep nothing from frame to frame.
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
    rtapi::Texture signal, result, history, accumulated, moments[2], clamped;
    SumLoad load;
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
      kSpreadFireflies{kControlLibrary, "SpreadFireflies"},
      kFilterLobe{kControlLibrary, "FilterLobe"};

  rtapi::Status create_pictures(const rtapi::Device& device, const Frame& frame);
  rtapi::Status add(const Recorder& to, const Kernel& kernel, const std::vector<Binding>& bindings,
                    const DenoiseConstants& constants);
  rtapi::Status add_guides(const Recorder& to);
  rtapi::Status add_spatial(const Recorder& to, const Channel& channel);
  rtapi::Status add_temporal(const Recorder& to);
  rtapi::Status add_fireflies(const Recorder& to, const Channel& channel);
  rtapi::Status add_lobe_filter(const Recorder& to, const Channel& channel);
  rtapi::Status add_wavelet(const Recorder& to);
  rtapi::Status add_copy(const Recorder& to, const Pictures& from, const Pictures& into);
  template <class Member>
  Pictures pictures(Member member) const;
  Pictures moments_of(std::uint32_t parity) const;

  DenoiseDesc desc_;
  std::vector<Channel> channels_;
  rtapi::Texture guides_[2];
  std::array<rtapi::Texture, kChangePictures> changes_;
  std::vector<Step> steps_[2];               // for even and odd frames
  std::vector<Step> steps_with_history_[2];  // empty: same as steps_
  std::uint32_t frames_ = 0;                 // since the last cut
};

}  // namespace kaamos::effects
