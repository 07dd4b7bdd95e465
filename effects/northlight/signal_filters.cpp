// SPDX-License-Identifier: MIT
#include "effects/northlight/signal_filters.h"

#include <algorithm>
#include <utility>

namespace kaamos::effects {

rtapi::Status SignalFilters::add(const rtapi::Device& device, const Frame& frame,
                                 const EffectSignal& row, const rtapi::Texture& sum,
                                 const EffectSettings& settings) {
  const auto mean =
      frame.create_picture(device, row.name + " mean", rtapi::Format::kR32G32B32A32Float);
  if (!mean) return mean.error();
  signals_.push_back({.name = row.name,
                      .sum = sum,
                      .mean = *mean,
                      .of_lobe = row.of_lobe,
                      .samples = settings.samples,
                      .pixel_step = settings.pixel_step});
  return {};
}

rtapi::Status SignalFilters::create(const rtapi::Device& device, const Frame& frame,
                                    const DenoiseLibraries& libraries, const DenoiseDesc& desc) {
  std::vector<std::size_t> alike;
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    // Only such signals say how far away their hits are.
    if (desc.method == DenoiseMethod::kControl && signals_[i].of_lobe) {
      DenoiseDesc of_lobes = desc;
      of_lobes.constants.lobe_scale = 1;
      if (const auto s = create_filter(device, frame, libraries, of_lobes, {i}); !s) return s;
    } else {
      alike.push_back(i);
    }
  }
  for (std::size_t first = 0; first < alike.size(); first += kMostSignals) {
    const auto begin = alike.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(kMostSignals, alike.size() - first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    if (const auto s = create_filter(device, frame, libraries, desc, {begin, end}); !s) return s;
  }
  return {};
}

rtapi::Status SignalFilters::create_filter(const rtapi::Device& device, const Frame& frame,
                                           const DenoiseLibraries& libraries,
                                           const DenoiseDesc& desc,
                                           const std::vector<std::size_t>& signals) {
  Filter filter;
  filter.name = signals.size() == 1 ? "denoise " + signals_[signals[0]].name
                                    : "denoise " + std::to_string(signals.size()) + " signals";
  filter.signals = signals;
  std::vector<Denoiser::Signal> inputs;
  for (const std::size_t i : signals) {
    signals_[i].filter = filters_.size();
    signals_[i].index = inputs.size();
    inputs.push_back({signals_[i].name, signals_[i].mean, signals_[i].of_lobe});
  }
  auto denoiser = Denoiser::create(device, frame, libraries, inputs, desc);
  if (!denoiser) return denoiser.error();
  filter.denoiser = std::move(*denoiser);
  for (const std::size_t i : signals) {
    const Signal& signal = signals_[i];
    const auto s = filter.denoiser.create_load(device, frame, libraries, signal.sum,
                                               signal.pixel_step, signal.index);
    if (!s) return s;
  }
  filters_.push_back(std::move(filter));
  return {};
}

void SignalFilters::record(rtapi::CommandList& list, const Frame& frame, Filter& filter) const {
  for (const std::size_t i : filter.signals) {
    const Signal& signal = signals_[i];
    const float scale = 1.0f / static_cast<float>(std::max(signal.samples, 1u));
    filter.denoiser.load(list, frame, scale, signal.index);
  }
  filter.denoiser.dispatch(list, frame);
}

void SignalFilters::record_all(rtapi::CommandList& list, const Frame& frame) {
  for (Filter& filter : filters_) record(list, frame, filter);
}

void SignalFilters::reset() {
  for (Filter& filter : filters_) filter.denoiser.reset();
}

SignalFilters::Signal* SignalFilters::find(const std::string& name) {
  return const_cast<Signal*>(std::as_const(*this).find(name));
}

const SignalFilters::Signal* SignalFilters::find(const std::string& name) const {
  const auto found = std::find_if(signals_.begin(), signals_.end(),
                                  [&](const Signal& signal) { return signal.name == name; });
  return found == signals_.end() ? nullptr : &*found;
}

}  // namespace kaamos::effects
