// SPDX-License-Identifier: MIT
/// @file
/// The denoisers of a frame: signals that are filtered alike share one.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effects/denoise/denoise.h"
#include "effects/northlight/effect.h"

namespace kaamos::effects {

/// The signals of one frame and the denoisers that they share.
class SignalFilters {
 public:
  /// A signal of the frame.
  struct Signal {
    std::string name;              ///< of its layer
    rtapi::Texture sum;            ///< what its pass adds to
    rtapi::Texture mean;           ///< the denoiser's input
    bool of_lobe = false;          ///< [Denoiser::Signal]
    std::uint32_t samples = 1;     ///< that the sum holds
    std::uint32_t pixel_step = 1;  ///< [PassConstants::pixel_step]
    std::size_t filter = 0;        ///< which of filters()
    std::size_t index = 0;         ///< its place in that filter
  };
  /// A denoiser and what it filters.
  struct Filter {
    std::string name;                  ///< "denoise 5 signals"
    Denoiser denoiser;                 ///< of all of them
    std::vector<std::size_t> signals;  ///< which of signals()
  };

  /// Adds a signal; its mean's picture is made.
  /// @errors those of rtapi::Device::CreateTexture.
  rtapi::Status add(const rtapi::Device& device, const Frame& frame, const EffectSignal& row,
                    const rtapi::Texture& sum, const EffectSettings& settings);
  /// Makes the denoisers of all that were added.
  /// @errors those of Denoiser::create and of Denoiser::create_load.
  rtapi::Status create(const rtapi::Device& device, const Frame& frame,
                       const DenoiseLibraries& libraries, const DenoiseDesc& desc);

  /// Records the load of a filter's signals and its passes.
  void record(rtapi::CommandList& list, const Frame& frame, Filter& filter) const;
  /// Records all filters, one after the other.
  void record_all(rtapi::CommandList& list, const Frame& frame);
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
  /// What the denoiser makes of a signal.
  const rtapi::Texture& denoised(const Signal& signal) const {
    return filters_[signal.filter].denoiser.result(signal.index);
  }

 private:
  rtapi::Status create_filter(const rtapi::Device& device, const Frame& frame,
                              const DenoiseLibraries& libraries, const DenoiseDesc& desc,
                              const std::vector<std::size_t>& signals);

  std::vector<Signal> signals_;
  std::vector<Filter> filters_;
};

}  // namespace kaamos::effects
