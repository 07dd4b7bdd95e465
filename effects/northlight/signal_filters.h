// SPDX-License-Identifier: MIT
/// @file
/// The denoisers of a frame: signals that are filtered alike share one.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/denoise/denoise.h"
#include "effects/denoise/sum_load.h"
#include "effects/denoise/visibility_denoiser.h"
#include "effects/engine/effect.h"
#include "effects/northlight/settings.h"

namespace kaamos::effects {

/// Returns whether a denoiser reads how sharp shadows are. [EffectSignal::is_visibility]
bool reads_sharpness(DenoiseMethod method);
/// Returns whether the filters of such a frame do.
bool reads_sharpness(const FrameSettings& settings);

/// The pictures to which an effect adds the samples of a signal, and what tells its denoiser more.
struct SignalSums {
  rtapi::Texture sum;        ///< of light or visibility
  rtapi::Texture sharpness;  ///< of visibility: EffectSignal::is_visibility; else null
  rtapi::Texture lights;     ///< VisibilityDenoiser::Signal::lights; null: none
  bool is_late = false;      ///< its effect reads what others' denoised signals make
  SignalChanges changes;     ///< [Denoiser::Signal]
};

/// The signals of one frame and the denoisers that they share.
class SignalFilters {
 public:
  /// A signal of the frame.
  struct Signal {
    std::string name;              ///< of its layer
    SignalSums sums;               ///< what its pass adds to
    rtapi::Texture mean;           ///< the denoiser's input
    rtapi::Texture sharpness;      ///< the same of SignalSums::sharpness
    std::uint32_t channels = 3;    ///< that hold light or visibility
    bool of_lobe = false;          ///< [Denoiser::Signal]
    std::uint32_t samples = 1;     ///< that the sum holds
    std::uint32_t pixel_step = 1;  ///< [PassConstants::pixel_step]
    bool rotates = false;          ///< [EffectSettings]
    std::size_t filter = 0;        ///< which of filters()
    std::size_t index = 0;         ///< its place in that filter
  };
  /// Makes a picture that the denoiser reads.
  struct Load {
    SumLoad sum;             ///< of the samples
    std::size_t signal = 0;  ///< which of signals()
  };
  /// A denoiser and what it filters.
  struct Filter {
    std::string name;                              ///< "denoise 5 signals"
    bool is_late = false;                          ///< of signals that are
    std::optional<Denoiser> denoiser;              ///< of all of them, or
    std::optional<VisibilityDenoiser> visibility;  ///< this one
    std::vector<std::size_t> signals;              ///< which of signals()
    std::vector<Load> loads;                       ///< of what `visibility` reads
    std::uint64_t sums_bytes = 0;                  ///< of the pictures of `loads`

    /// Bytes of the sums, the signals and the denoiser's own pictures.
    std::uint64_t bytes() const;
  };

  /// Adds a signal; its mean's picture is made.
  /// @errors those of rtapi::Device::CreateTexture.
  rtapi::Status add(const rtapi::Device& device, const Frame& frame, const EffectSignal& row,
                    const SignalSums& sums, const EffectSettings& settings);
  /// Makes the denoisers of all that were added.
  /// @errors those of Denoiser::create and of Denoiser::create_load.
  rtapi::Status create(const rtapi::Device& device, const Frame& frame,
                       const DenoiseLibraries& libraries, const DenoiseDesc& desc);

  /// Sets which pixel of each 2 x 2 the next frame's sums have, where it takes turns.
  void set_pixel_offset(std::uint32_t offset) { pixel_offset_ = offset; }
  /// Records the load of a filter's signals and its passes.
  void record(rtapi::CommandList& list, const Frame& frame, Filter& filter) const;
  /// Records all filters, one after the other.
  void record_all(rtapi::CommandList& list, const Frame& frame);
  /// The same for those of late signals, or of all others.
  void record_some(rtapi::CommandList& list, const Frame& frame, bool late);
  /// Histories begin anew, as after a cut.
  void reset();

  /// In the order in which they were added.
  const std::vector<Signal>& signals() const { return signals_; }
  /// In the order in which they run.
  std::vector<Filter>& filters() { return filters_; }
  /// Null: no such signal.
  Signal* find(const std::string& name);
  /// Null: no such signal.
  const Signal* find(const std::string& name) const;
  /// The picture that the denoiser of a signal keeps from frame to frame, one of both; null: none.
  struct Memory {
    const rtapi::Texture* moments = nullptr;     ///< of light [Denoiser::moments]
    const rtapi::Texture* visibility = nullptr;  ///< [VisibilityDenoiser::accumulated]
  };
  /// That of a signal; of visibility its first channel.
  Memory memory(const Signal& signal) const;
  /// The denoised picture of a signal.
  const rtapi::Texture& denoised(const Signal& signal) const {
    const Filter& filter = filters_[signal.filter];
    return filter.visibility ? filter.visibility->result(signal.index)
                             : filter.denoiser->result(signal.index);
  }

 private:
  rtapi::Status create_some(const rtapi::Device& device, const Frame& frame,
                            const DenoiseLibraries& libraries, const DenoiseDesc& desc, bool late);
  rtapi::Status create_filter(const rtapi::Device& device, const Frame& frame,
                              const DenoiseLibraries& libraries, const DenoiseDesc& desc,
                              const std::vector<std::size_t>& signals);
  rtapi::Status create_visibility_filter(const rtapi::Device& device, const Frame& frame,
                                         const DenoiseLibraries& libraries, const DenoiseDesc& desc,
                                         const std::vector<std::size_t>& signals);
  std::string filter_name(const std::vector<std::size_t>& signals) const;
  std::vector<Signal> signals_;
  std::vector<Filter> filters_;
  std::uint32_t pixel_offset_ = 0;
};

}  // namespace kaamos::effects
