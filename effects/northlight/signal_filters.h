// SPDX-License-Identifier: MIT
// The denoisers of a frame: signals that are filtered alike share one.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effects/denoise/denoise.h"
#include "effects/northlight/effect.h"

namespace kaamos::effects {

class SignalFilters {
 public:
  /// A signal of the frame.
  struct Signal {
    std::string name;
    rtapi::Texture sum;   ///< what its pass adds to
    rtapi::Texture mean;  ///< the denoiser's input
    bool of_lobe = false;
    std::uint32_t samples = 1;     ///< that the sum holds
    std::uint32_t pixel_step = 1;  ///< [PassConstants::pixel_step]
    std::size_t filter = 0, index = 0;
  };
  struct Filter {
    std::string name;
    Denoiser denoiser;
    std::vector<std::size_t> signals;
  };

  /// Adds a signal; its mean's picture is made.
  rtapi::Status add(const rtapi::Device& device, const Frame& frame, const EffectSignal& row,
                    const rtapi::Texture& sum, const EffectSettings& settings);
  /// Makes the denoisers of all that were added.
  rtapi::Status create(const rtapi::Device& device, const Frame& frame,
                       const DenoiseLibraries& libraries, const DenoiseDesc& desc);

  /// Records the load of a filter's signals and its passes.
  void record(rtapi::CommandList& list, const Frame& frame, Filter& filter) const;
  void record_all(rtapi::CommandList& list, const Frame& frame);
  /// Histories begin anew, as after a cut.
  void reset();

  const std::vector<Signal>& signals() const { return signals_; }
  std::vector<Filter>& filters() { return filters_; }
  /// Null: no such signal.
  Signal* find(const std::string& name);
  const Signal* find(const std::string& name) const;
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
