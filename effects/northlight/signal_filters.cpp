// SPDX-License-Identifier: MIT
#include "effects/northlight/signal_filters.h"

#include <algorithm>
#include <utility>

#include "effects/engine/picture.h"

namespace kaamos::effects {

bool reads_sharpness(DenoiseMethod method) {
  return method == DenoiseMethod::kTemporal || method == DenoiseMethod::kSvgf ||
         method == DenoiseMethod::kControl || method == DenoiseMethod::kAdaptiveSvgf;
}

bool reads_sharpness(const FrameSettings& settings) {
  return settings.whole_frame && reads_sharpness(settings.denoise.method);
}

std::uint64_t SignalFilters::Filter::bytes() const {
  return visibility ? visibility->bytes() + sums_bytes : denoiser->bytes();
}

rtapi::Status SignalFilters::add(const rtapi::Device& device, const Frame& frame,
                                 const EffectSignal& row, const SignalSums& sums,
                                 const EffectSettings& settings) {
  Signal signal = {.name = row.name,
                   .sums = sums,
                   .channels = row.channels,
                   .of_lobe = row.of_lobe,
                   .samples = settings.samples,
                   .pixel_step = settings.pixel_step,
                   .rotates = settings.rotates};
  const auto mean =
      frame.create_picture(device, row.name + " mean", rtapi::Format::kR32G32B32A32Float);
  if (!mean) return mean.error();
  signal.mean = *mean;
  if (sums.sharpness) {
    const auto sharpness =
        frame.create_picture(device, row.name + " sharpness", rtapi::Format::kR32G32B32A32Float);
    if (!sharpness) return sharpness.error();
    signal.sharpness = *sharpness;
  }
  signals_.push_back(std::move(signal));
  return {};
}

rtapi::Status SignalFilters::create(const rtapi::Device& device, const Frame& frame,
                                    const DenoiseLibraries& libraries, const DenoiseDesc& desc) {
  for (const bool late : {false, true}) {
    if (const auto s = create_some(device, frame, libraries, desc, late); !s) return s;
  }
  return {};
}

rtapi::Status SignalFilters::create_some(const rtapi::Device& device, const Frame& frame,
                                         const DenoiseLibraries& libraries, const DenoiseDesc& desc,
                                         bool late) {
  std::vector<std::size_t> alike, visibilities;
  std::size_t channels = 0;  // of the visibilities
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    if (signals_[i].sums.is_late != late) continue;
    if (reads_sharpness(desc.method) && signals_[i].sharpness) {
      if (channels + signals_[i].channels > kMostVisibilityChannels) {
        const auto s = create_visibility_filter(device, frame, libraries, desc, visibilities);
        if (!s) return s;
        visibilities.clear();
        channels = 0;
      }
      visibilities.push_back(i);
      channels += signals_[i].channels;
    } else if (desc.method == DenoiseMethod::kControl && signals_[i].of_lobe) {
      // Only such signals say how far away their hits are.
      DenoiseDesc of_lobes = desc;
      of_lobes.constants.lobe_scale = 1;
      if (const auto s = create_filter(device, frame, libraries, of_lobes, {i}); !s) return s;
    } else {
      alike.push_back(i);
    }
  }
  if (!visibilities.empty()) {
    const auto s = create_visibility_filter(device, frame, libraries, desc, visibilities);
    if (!s) return s;
  }
  for (std::size_t first = 0; first < alike.size(); first += kMostSignals) {
    const auto begin = alike.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(kMostSignals, alike.size() - first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    if (const auto s = create_filter(device, frame, libraries, desc, {begin, end}); !s) return s;
  }
  return {};
}

std::string SignalFilters::filter_name(const std::vector<std::size_t>& signals) const {
  return signals.size() == 1 ? "denoise " + signals_[signals[0]].name
                             : "denoise " + std::to_string(signals.size()) + " signals";
}

rtapi::Status SignalFilters::create_filter(const rtapi::Device& device, const Frame& frame,
                                           const DenoiseLibraries& libraries,
                                           const DenoiseDesc& desc,
                                           const std::vector<std::size_t>& signals) {
  Filter filter;
  filter.name = filter_name(signals);
  filter.is_late = signals_[signals[0]].sums.is_late;
  filter.signals = signals;
  std::vector<Denoiser::Signal> inputs;
  for (const std::size_t i : signals) {
    signals_[i].filter = filters_.size();
    signals_[i].index = inputs.size();
    inputs.push_back({signals_[i].name, signals_[i].mean, signals_[i].of_lobe,
                      signals_[i].sums.changes, signals_[i].channels == 1});
  }
  auto denoiser = Denoiser::create(device, frame, libraries, inputs, desc);
  if (!denoiser) return denoiser.error();
  filter.denoiser = std::move(*denoiser);
  for (const std::size_t i : signals) {
    const Signal& signal = signals_[i];
    const auto s = filter.denoiser->create_load(device, frame, libraries, signal.sums.sum,
                                                signal.pixel_step, signal.index);
    if (!s) return s;
  }
  filters_.push_back(std::move(filter));
  return {};
}

rtapi::Status SignalFilters::create_visibility_filter(const rtapi::Device& device,
                                                      const Frame& frame,
                                                      const DenoiseLibraries& libraries,
                                                      const DenoiseDesc& desc,
                                                      const std::vector<std::size_t>& signals) {
  Filter filter;
  filter.name = filter_name(signals);
  filter.is_late = signals_[signals[0]].sums.is_late;
  filter.signals = signals;
  std::vector<VisibilityDenoiser::Signal> inputs;
  for (const std::size_t i : signals) {
    Signal& signal = signals_[i];
    signal.filter = filters_.size();
    signal.index = inputs.size();
    inputs.push_back({signal.name, signal.channels, signal.mean, signal.sharpness,
                      signal.sums.lights, signal.sums.changes});
    for (const auto& [sum, into] : {std::pair(&signal.sums.sum, &signal.mean),
                                    std::pair(&signal.sums.sharpness, &signal.sharpness)}) {
      const auto load = SumLoad::create(device, frame, libraries, *sum, *into, signal.pixel_step);
      if (!load) return load.error();
      filter.loads.push_back({*load, i});
      filter.sums_bytes += picture_bytes(*sum) + picture_bytes(*into);
    }
  }
  auto denoiser = VisibilityDenoiser::create(device, frame, libraries, inputs, desc.method,
                                             desc.visibility, desc.iterations);
  if (!denoiser) return denoiser.error();
  filter.visibility = std::move(*denoiser);
  filters_.push_back(std::move(filter));
  return {};
}

void SignalFilters::record(rtapi::CommandList& list, const Frame& frame, Filter& filter) const {
  const auto scale = [&](std::size_t i) {
    return 1.0f / static_cast<float>(std::max(signals_[i].samples, 1u));
  };
  const auto offset = [&](std::size_t i) { return signals_[i].rotates ? pixel_offset_ : 0u; };
  if (filter.visibility) {
    for (const Load& load : filter.loads) {
      load.sum.record(list, frame, scale(load.signal), offset(load.signal));
    }
    filter.visibility->dispatch(list, frame);
    return;
  }
  for (const std::size_t i : filter.signals) {
    filter.denoiser->load(list, frame, scale(i), signals_[i].index, offset(i));
  }
  filter.denoiser->dispatch(list, frame);
}

void SignalFilters::record_all(rtapi::CommandList& list, const Frame& frame) {
  for (Filter& filter : filters_) record(list, frame, filter);
}

void SignalFilters::record_some(rtapi::CommandList& list, const Frame& frame, bool late) {
  for (Filter& filter : filters_) {
    if (filter.is_late == late) record(list, frame, filter);
  }
}

void SignalFilters::reset() {
  for (Filter& filter : filters_) {
    if (filter.visibility) filter.visibility->reset();
    if (filter.denoiser) filter.denoiser->reset();
  }
}

SignalFilters::Memory SignalFilters::memory(const Signal& signal) const {
  const Filter& filter = filters_[signal.filter];
  if (!filter.visibility) {
    const rtapi::Texture& moments = filter.denoiser->moments(signal.index);
    return {.moments = moments ? &moments : nullptr};
  }
  std::size_t channel = 0;
  for (std::size_t i = 0; i < signal.index; ++i) channel += signals_[filter.signals[i]].channels;
  return {.visibility = &filter.visibility->accumulated(channel)};
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
