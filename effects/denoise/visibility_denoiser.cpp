// SPDX-License-Identifier: MIT
#include "effects/denoise/visibility_denoiser.h"

#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

using rtapi::Texture;

namespace {

// The registers of visibility_filter.hlsl.
constexpr std::uint32_t kVisibilityChanges = 0, kPreviousGuides = 2, kGuides = 3, kDrawn = 4,
                        kHistory = 8, kPast = 12, kAccumulated = 16, kBlockers = 20, kFiltered = 24,
                        kSource = 28, kSharpness = 29, kLights = 30, kResult = 31;

// Pixels between the taps of the passes that look for occluders.
constexpr std::int32_t kBlockerSteps[] = {1, 3};

constexpr std::uint32_t kMostIterations = 8;
constexpr std::uint32_t kLines = 4;  // rows, columns, rows, columns

// Binds a picture of each channel to the registers from u on.
template <class Bindings, class Pictures>
void add_bindings(Bindings& bindings, std::uint32_t u, const Pictures& pictures) {
  for (const Texture* picture : pictures) bindings.push_back({u++, picture});
}

rtapi::Error refusal(const std::string& what) {
  return make_error(ErrorId::kDenoiser, "a VisibilityDenoiser of " + what);
}

}  // namespace

rtapi::Result<VisibilityDenoiser> VisibilityDenoiser::create(
    const rtapi::Device& device, const Frame& frame, const DenoiseLibraries& libraries,
    const std::vector<Signal>& signals, DenoiseMethod method, const VisibilityConstants& constants,
    std::uint32_t iterations) {
  if (method != DenoiseMethod::kTemporal && method != DenoiseMethod::kSvgf &&
      method != DenoiseMethod::kControl && method != DenoiseMethod::kAdaptiveSvgf) {
    return refusal("method " + std::to_string(static_cast<int>(method)) +
                   ": it takes kTemporal, kSvgf, kControl and kAdaptiveSvgf; Denoiser has the "
                   "others");
  }
  VisibilityDenoiser out;
  out.method_ = method;
  std::uint32_t changes = 0;
  for (const Signal& signal : signals) {
    out.signals_.push_back({signal, out.channels_.size(), {}});
    const std::size_t begin = out.channels_.size();
    const std::size_t end = begin + std::clamp(signal.channels, 1u, 2u);
    for (std::size_t i = begin; i < std::min(end, kMostVisibilityChannels); ++i) {
      if (!signal.changes.pictures[0] || method != DenoiseMethod::kAdaptiveSvgf) continue;
      out.changes_ = signal.changes.pictures;
      const auto channel = signal.changes.channel + static_cast<std::uint32_t>(i - begin);
      changes |= (1 + channel) << (4 * i);
    }
    out.channels_.resize(end);
  }
  if (signals.empty() || out.channels_.size() > kMostVisibilityChannels) {
    return refusal(std::to_string(out.channels_.size()) + " channels: it takes 1 to " +
                   std::to_string(kMostVisibilityChannels) + "; make a second one for the others");
  }
  out.constants_ = constants;
  out.constants_.changes = changes;
  out.constants_.channels = static_cast<std::int32_t>(out.channels_.size());
  if (const auto s = out.create_pictures(device, frame); !s) return s.error();
  for (std::uint32_t parity = 0; parity < 2; ++parity) {
    const Recorder recorder = {device, frame, libraries, parity};
    if (const auto s = out.add_inputs(recorder); !s) return s.error();
    if (const auto s = out.add_blockers(recorder); !s) return s.error();
    if (const auto s = out.add_accumulation(recorder); !s) return s.error();
    const auto filtered = out.add_filter(recorder, std::min(iterations, kMostIterations));
    if (!filtered) return filtered.error();
    if (const auto s = out.add_results(recorder, *filtered); !s) return s.error();
  }
  return out;
}

rtapi::Status VisibilityDenoiser::create_pictures(const rtapi::Device& device, const Frame& frame) {
  const auto create = [&](Texture& into, const std::string& name) -> rtapi::Status {
    const auto created = frame.create_picture(device, name, rtapi::Format::kR32G32B32A32Float);
    if (!created) return created.error();
    into = *created;
    return {};
  };
  for (Texture& guides : guides_) {
    if (const auto s = create(guides, signals_[0].signal.name + " guides"); !s) return s;
  }
  for (Input& input : signals_) {
    if (const auto s = create(input.result, input.signal.name + " denoised"); !s) return s;
  }
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    const std::string name = "visibility " + std::to_string(i);
    for (const auto& [texture, suffix] :
         {std::pair(&channel.drawn, " samples"), std::pair(&channel.past, " past"),
          std::pair(&channel.blockers[0], " blockers 0"),
          std::pair(&channel.blockers[1], " blockers 1"),
          std::pair(&channel.filtered[0], " filtered 0"),
          std::pair(&channel.filtered[1], " filtered 1"),
          std::pair(&channel.accumulated[0], " accumulated 0"),
          std::pair(&channel.accumulated[1], " accumulated 1")}) {
      if (const auto s = create(*texture, name + suffix); !s) return s;
    }
  }
  return {};
}

template <class Get>
VisibilityDenoiser::Pictures VisibilityDenoiser::pictures(Get get) const {
  Pictures out;
  for (const Channel& channel : channels_) out.push_back(&get(channel));
  return out;
}

rtapi::Status VisibilityDenoiser::add(const Recorder& to, const char* kernel,
                                      const std::vector<Binding>& bindings,
                                      const VisibilityConstants& constants) {
  const auto pass =
      to.libraries.pipelines->get(to.device, to.frame, to.libraries.visibility, kernel);
  if (!pass) return pass.error();
  auto views = to.frame.create_pass_views(to.device);
  if (!views) return views.error();
  if (const auto s = views->set_unordered_access(kGuides, guides_[to.parity]); !s) return s;
  for (const Binding& binding : bindings) {
    if (const auto s = views->set_unordered_access(binding.u, *binding.texture); !s) return s;
  }
  steps_[to.parity].push_back({*pass, *views, constants});
  return {};
}

rtapi::Status VisibilityDenoiser::add_inputs(const Recorder& to) {
  if (const auto s = add(to, "PrepareVisibilityGuides", {}, constants_); !s) return s;
  for (const Input& input : signals_) {
    const Signal& signal = input.signal;
    for (std::uint32_t i = 0; i < signal.channels; ++i) {
      VisibilityConstants constants = constants_;
      constants.channel = static_cast<std::int32_t>(i);
      std::vector<Binding> bindings = {{kSource, &signal.visibility},
                                       {kSharpness, &signal.sharpness},
                                       {kResult, &channels_[input.first_channel + i].drawn}};
      if (signal.lights) {
        constants.lights_channel = constants.channel;
        bindings.push_back({kLights, &signal.lights});
      }
      if (const auto s = add(to, "PrepareChannel", bindings, constants); !s) return s;
    }
  }
  return {};
}

rtapi::Status VisibilityDenoiser::add_blockers(const Recorder& to) {
  const auto drawn = pictures([](const Channel& c) -> auto& { return c.drawn; });
  const auto scratch = pictures([](const Channel& c) -> auto& { return c.filtered[0]; });
  const auto blockers = pictures([&](const Channel& c) -> auto& { return c.blockers[to.parity]; });
  for (const std::int32_t step : kBlockerSteps) {
    const bool is_first = step == kBlockerSteps[0];
    VisibilityConstants constants = constants_;
    constants.step = step;
    std::vector<Binding> bindings;
    add_bindings(bindings, kDrawn, drawn);
    if (!is_first) add_bindings(bindings, kFiltered, scratch);
    add_bindings(bindings, kBlockers, is_first ? scratch : blockers);
    if (const auto s = add(to, "SpreadBlockers", bindings, constants); !s) return s;
  }
  return {};
}

rtapi::Status VisibilityDenoiser::add_accumulation(const Recorder& to) {
  std::vector<Binding> bindings = {{kPreviousGuides, &guides_[1 - to.parity]}};
  add_bindings(bindings, kDrawn, pictures([](const Channel& c) -> auto& { return c.drawn; }));
  add_bindings(bindings, kHistory,
               pictures([&](const Channel& c) -> auto& { return c.accumulated[1 - to.parity]; }));
  add_bindings(bindings, kPast, pictures([](const Channel& c) -> auto& { return c.past; }));
  add_bindings(bindings, kAccumulated,
               pictures([&](const Channel& c) -> auto& { return c.accumulated[to.parity]; }));
  add_bindings(bindings, kBlockers,
               pictures([&](const Channel& c) -> auto& { return c.blockers[to.parity]; }));
  // These are the blockers of the previous frame.
  add_bindings(bindings, kFiltered,
               pictures([&](const Channel& c) -> auto& { return c.blockers[1 - to.parity]; }));
  if (const auto s = add(to, "ReprojectVisibility", bindings, constants_); !s) return s;
  for (std::uint32_t i = 0; i < kChangePictures; ++i) {
    if (changes_[i]) bindings.push_back({kVisibilityChanges + i, &changes_[i]});
  }
  return add(to, "AccumulateVisibility", bindings, constants_);
}

rtapi::Result<VisibilityDenoiser::Pictures> VisibilityDenoiser::add_filter(
    const Recorder& to, std::uint32_t iterations) {
  const bool by_lines = method_ == DenoiseMethod::kControl;
  const std::uint32_t count = method_ == DenoiseMethod::kTemporal ? 0
                              : by_lines                          ? kLines
                                                                  : iterations;
  Pictures from = pictures([&](const Channel& c) -> auto& { return c.accumulated[to.parity]; });
  for (std::uint32_t i = 0; i < count; ++i) {
    const Pictures into = pictures([&](const Channel& c) -> auto& { return c.filtered[i % 2]; });
    VisibilityConstants constants = constants_;
    constants.step = by_lines ? 1 : 1 << i;
    constants.vertical = i % 2;
    std::vector<Binding> bindings;
    add_bindings(bindings, kAccumulated, from);
    add_bindings(bindings, kBlockers,
                 pictures([&](const Channel& c) -> auto& { return c.blockers[to.parity]; }));
    add_bindings(bindings, kFiltered, into);
    const auto s = add(to, by_lines ? "FilterLine" : "FilterVisibility", bindings, constants);
    if (!s) return s.error();
    from = into;
  }
  return from;
}

rtapi::Status VisibilityDenoiser::add_results(const Recorder& to, const Pictures& from) {
  for (const Input& input : signals_) {
    VisibilityConstants constants = constants_;
    constants.channels = static_cast<std::int32_t>(input.signal.channels);
    std::vector<Binding> bindings = {{kResult, &input.result}};
    for (std::uint32_t i = 0; i < input.signal.channels; ++i) {
      bindings.push_back({kAccumulated + i, from[input.first_channel + i]});
    }
    if (const auto s = add(to, "WriteVisibility", bindings, constants); !s) return s;
  }
  return {};
}

std::uint64_t VisibilityDenoiser::bytes() const {
  std::uint64_t sum = picture_bytes(guides_[0]) + picture_bytes(guides_[1]);
  for (const Input& input : signals_) sum += picture_bytes(input.result);
  for (const Channel& channel : channels_) {
    for (const Texture* texture : {&channel.drawn, &channel.past, &channel.blockers[0],
                                   &channel.blockers[1], &channel.filtered[0], &channel.filtered[1],
                                   &channel.accumulated[0], &channel.accumulated[1]}) {
      sum += picture_bytes(*texture);
    }
  }
  return sum;
}

void VisibilityDenoiser::dispatch(rtapi::CommandList& list, const Frame& frame) {
  for (const Step& step : steps_[frames_ % 2]) {
    VisibilityConstants constants = step.constants;
    constants.history_valid = frames_ > 0 ? 1 : 0;
    step.pass->dispatch(list, frame, {}, PassArguments(step.views, constants), frame.width(),
                        frame.height());
  }
  ++frames_;
}

}  // namespace kaamos::effects
