// SPDX-License-Identifier: MIT
#include "effects/denoise/denoise.h"

#include <shaders/control.h>
#include <shaders/spatial.h>
#include <shaders/svgf.h>
#include <shaders/temporal_gradients.h>
#include <shaders/upscale.h>
#include <shaders/visibility_filter.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

using rtapi::Texture;

namespace {

bool has_wavelet(DenoiseMethod method) {
  return method == DenoiseMethod::kSvgf || method == DenoiseMethod::kAdaptiveSvgf;
}

bool is_temporal(DenoiseMethod method) {
  return has_wavelet(method) || method == DenoiseMethod::kTemporal ||
         method == DenoiseMethod::kControl;
}

std::int32_t squarings_of(float power) {
  int exponent = 0;
  const bool is_power_of_two = std::frexp(power, &exponent) == 0.5f;
  return is_power_of_two && exponent >= 1 ? exponent - 1 : -1;
}

// The registers of svgf.hlsl.
constexpr std::uint32_t kSignals = 4, kHistories = 9, kPreviousMoments = 14, kAccumulated = 19,
                        kMoments = 24, kPreviousGuides = 29, kChanges = 30;

// Binds an array of pictures to the registers from u on.
template <class Bindings, class Pictures>
void add_bindings(Bindings& bindings, std::uint32_t u, const Pictures& pictures) {
  for (const Texture* picture : pictures) bindings.push_back({u++, picture});
}

// Entries may belong to frames that no longer exist, so their number is bounded.
constexpr std::size_t kMostPipelines = 64;

}  // namespace

rtapi::Result<std::shared_ptr<ComputePass>> DenoisePipelines::get(
    const rtapi::Device& device, const Frame& frame, const rtapi::ShaderLibrary& library,
    const std::string& name) {
  for (const Entry& entry : entries_) {
    if (entry.name == name && entry.library == library &&
        entry.root_signature == frame.root_signature()) {
      return entry.pass;
    }
  }
  const auto pass = ComputePass::create(device, frame, library, name);
  if (!pass) return pass.error();
  if (entries_.size() == kMostPipelines) entries_.erase(entries_.begin());
  entries_.push_back({frame.root_signature(), library, name, std::make_shared<ComputePass>(*pass)});
  return entries_.back().pass;
}

DenoiseDesc default_denoise(DenoiseMethod method) {
  DenoiseDesc desc;
  desc.method = method;
  // Wherever light changes, pixels are in their first frames again.
  if (method == DenoiseMethod::kAdaptiveSvgf) desc.iterations_with_history = desc.iterations;
  if (method == DenoiseMethod::kBilateral || method == DenoiseMethod::kBilateralExact) {
    desc.constants.sigma_n = 32.0f;
    desc.constants.sigma_l = 0.0f;  // a luminance weight would keep the noise
  }
  if (method == DenoiseMethod::kTemporal) {
    desc.constants.alpha = 0.05f;
    desc.constants.clip_gamma = 1.5f;
  }
  if (method == DenoiseMethod::kControl) {
    desc.constants.alpha = desc.constants.moments_alpha = desc.constants.scalar_alpha = 0.1f;
    desc.constants.clip_gamma = 1.25f;
    desc.constants.sigma_n = 32.0f;
    desc.constants.radius = 8;
    desc.constants.sigma_pixels = 24.0f;
  }
  return desc;
}

rtapi::Result<DenoiseLibraries> denoise_libraries() {
  const auto spatial = rtapi::LoadShaderLibrary(kaamos_shaders_spatial());
  if (!spatial) return spatial.error();
  const auto svgf = rtapi::LoadShaderLibrary(kaamos_shaders_svgf());
  if (!svgf) return svgf.error();
  const auto control = rtapi::LoadShaderLibrary(kaamos_shaders_control());
  if (!control) return control.error();
  const auto upscale = rtapi::LoadShaderLibrary(kaamos_shaders_upscale());
  if (!upscale) return upscale.error();
  const auto visibility = rtapi::LoadShaderLibrary(kaamos_shaders_visibility_filter());
  if (!visibility) return visibility.error();
  const auto gradients = rtapi::LoadShaderLibrary(kaamos_shaders_temporal_gradients());
  if (!gradients) return gradients.error();
  return DenoiseLibraries{*spatial, *svgf, *control, *upscale, *visibility, *gradients};
}

rtapi::Result<Denoiser> Denoiser::create(const rtapi::Device& device, const Frame& frame,
                                         const DenoiseLibraries& libraries,
                                         const std::vector<Signal>& signals,
                                         const DenoiseDesc& desc) {
  if (signals.empty() || signals.size() > kMostSignals) {
    return make_error(ErrorId::kDenoiser, "a Denoiser of " + std::to_string(signals.size()) +
                                              " signals: it takes 1 to " +
                                              std::to_string(kMostSignals) +
                                              "; make a second one for the others");
  }
  Denoiser out;
  out.desc_ = desc;
  out.desc_.constants.normal_squarings = squarings_of(desc.constants.sigma_n);
  out.desc_.constants.signals = static_cast<std::int32_t>(signals.size());
  for (const Signal& signal : signals) {
    if (signal.of_lobe) out.desc_.constants.lobes |= 1u << out.channels_.size();
    if (signal.is_scalar) out.desc_.constants.scalars |= 1u << out.channels_.size();
    if (signal.changes.pictures[0] && desc.method == DenoiseMethod::kAdaptiveSvgf) {
      out.changes_ = signal.changes.pictures;
      out.desc_.constants.changes |= (1 + signal.changes.channel) << (4 * out.channels_.size());
    }
    out.channels_.push_back({.name = signal.name, .signal = signal.picture});
  }
  if (const auto s = out.create_pictures(device, frame); !s) return s.error();
  if (!is_temporal(desc.method)) {
    const Recorder recorder = {device, frame, libraries, out.steps_[0]};
    if (desc.method != DenoiseMethod::kNone) {
      if (const auto s = out.add_guides(recorder); !s) return s.error();
    }
    for (const Channel& channel : out.channels_) {
      if (const auto s = out.add_spatial(recorder, channel); !s) return s.error();
    }
    return out;
  }
  constexpr std::uint32_t kMostIterations = 8;
  const std::uint32_t first = std::min(desc.iterations, kMostIterations);
  const std::uint32_t later = std::min(desc.iterations_with_history, kMostIterations);
  for (std::uint32_t parity = 0; parity < 2; ++parity) {
    const Recorder recorder = {device, frame, libraries, out.steps_[parity], parity, first};
    if (const auto s = out.add_temporal(recorder); !s) return s.error();
    if (!has_wavelet(desc.method) || later == first) continue;
    const Recorder with_history = {device, frame, libraries, out.steps_with_history_[parity],
                                   parity, later};
    if (const auto s = out.add_temporal(with_history); !s) return s.error();
  }
  return out;
}

rtapi::Status Denoiser::create_pictures(const rtapi::Device& device, const Frame& frame) {
  const auto create = [&](Texture& into, const std::string& name,
                          bool half = false) -> rtapi::Status {
    const auto created = frame.create_picture(
        device, name, half ? rtapi::Format::kR16G16B16A16Float : rtapi::Format::kR32G32B32A32Float);
    if (!created) return created.error();
    into = *created;
    return {};
  };
  const bool temporal = is_temporal(desc_.method);
  const bool filters = desc_.method != DenoiseMethod::kNone;
  for (int i = 0; i < (temporal ? 2 : filters ? 1 : 0); ++i) {
    const auto s = create(guides_[i], channels_[0].name + " guides " + std::to_string(i));
    if (!s) return s;
  }
  for (Channel& channel : channels_) {
    struct Picture {
      Texture* texture;
      const char* suffix;
      bool wanted;
    };
    const Picture pictures[] = {
        {&channel.result, " denoised", true},
        {&channel.accumulated, " accumulated", filters},
        {&channel.history, " history", temporal},
        {&channel.moments[0], " moments 0", temporal},
        {&channel.moments[1], " moments 1", temporal},
        {&channel.clamped, " clamped", desc_.method == DenoiseMethod::kControl}};
    for (const auto& [texture, suffix, wanted] : pictures) {
      if (!wanted) continue;
      const bool half = texture == &channel.history && desc_.half_history != 0;
      if (const auto s = create(*texture, channel.name + suffix, half); !s) return s;
    }
  }
  return {};
}

template <class Member>
Denoiser::Pictures Denoiser::pictures(Member member) const {
  Pictures out;
  for (const Channel& channel : channels_) out.push_back(&(channel.*member));
  return out;
}

Denoiser::Pictures Denoiser::moments_of(std::uint32_t parity) const {
  Pictures out;
  for (const Channel& channel : channels_) out.push_back(&channel.moments[parity]);
  return out;
}

rtapi::Status Denoiser::add(const Recorder& to, const Kernel& kernel,
                            const std::vector<Binding>& bindings,
                            const DenoiseConstants& constants) {
  const rtapi::ShaderLibrary& library = to.libraries.*kernel.library;
  const auto pass = to.libraries.pipelines->get(to.device, to.frame, library, kernel.name);
  if (!pass) return pass.error();
  auto views = to.frame.create_pass_views(to.device);
  if (!views) return views.error();
  for (const Binding& binding : bindings) {
    if (const auto s = views->set_unordered_access(binding.u, *binding.texture); !s) return s;
  }
  to.steps.push_back({*pass, *views, constants});
  return {};
}

rtapi::Status Denoiser::add_spatial(const Recorder& to, const Channel& channel) {
  if (desc_.method == DenoiseMethod::kNone) {
    return add_copy(to, {&channel.signal}, {&channel.result});
  }
  const bool exact = desc_.method == DenoiseMethod::kBilateralExact;
  const Kernel kernel = desc_.method == DenoiseMethod::kGaussian ? kGaussian
                        : exact                                  ? kBilateralExact
                                                                 : kBilateral;
  const Texture* from = &channel.signal;
  for (std::uint32_t vertical = 0; vertical < (exact ? 1u : 2u); ++vertical) {
    const Texture* into = exact || vertical == 1 ? &channel.result : &channel.accumulated;
    DenoiseConstants constants = desc_.constants;
    constants.vertical = vertical;
    if (const auto s = add(to, kernel, {{0, from}, {1, into}, {3, &guides_[0]}}, constants); !s) {
      return s;
    }
    from = into;
  }
  return {};
}

rtapi::Status Denoiser::add_guides(const Recorder& to) {
  return add(to, kPrepareGuides, {{3, &guides_[to.parity]}}, desc_.constants);
}

rtapi::Status Denoiser::add_copy(const Recorder& to, const Pictures& from, const Pictures& into) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto s = add(to, kCopy, {{0, from[i]}, {1, into[i]}}, desc_.constants);
    if (!s) return s;
  }
  return {};
}

rtapi::Status Denoiser::add_temporal(const Recorder& to) {
  const bool is_control = desc_.method == DenoiseMethod::kControl;
  if (const auto s = add_guides(to); !s) return s;
  if (is_control) {
    for (const Channel& channel : channels_) {
      if (const auto s = add_fireflies(to, channel); !s) return s;
    }
  }
  const Pictures accumulated = pictures(&Channel::accumulated);
  std::vector<Binding> bindings = {{3, &guides_[to.parity]},
                                   {kPreviousGuides, &guides_[1 - to.parity]}};
  add_bindings(bindings, kSignals, pictures(is_control ? &Channel::clamped : &Channel::signal));
  add_bindings(bindings, kHistories, pictures(&Channel::history));
  add_bindings(bindings, kPreviousMoments, moments_of(1 - to.parity));
  add_bindings(bindings, kAccumulated, accumulated);
  add_bindings(bindings, kMoments, moments_of(to.parity));
  for (std::uint32_t i = 0; i < kChangePictures; ++i) {
    if (changes_[i]) bindings.push_back({kChanges + i, &changes_[i]});
  }
  if (const auto s = add(to, kTemporal, bindings, desc_.constants); !s) return s;
  if (has_wavelet(desc_.method)) {
    // The output goes into the previous frame's moments, which are no longer needed.
    if (const auto s = add(to, kVariance, bindings, desc_.constants); !s) return s;
    return add_wavelet(to);
  }
  const auto kept = add_copy(to, accumulated, pictures(&Channel::history));
  if (!kept) return kept;
  if (!is_control) return add_copy(to, accumulated, pictures(&Channel::result));
  for (const Channel& channel : channels_) {
    if (const auto s = add_lobe_filter(to, channel); !s) return s;
  }
  return {};
}

rtapi::Status Denoiser::add_fireflies(const Recorder& to, const Channel& channel) {
  const Texture& guides = guides_[to.parity];
  const bool spreads = desc_.constants.keep_energy != 0;
  // Accumulation writes there later.
  const Texture& cut = spreads ? channel.accumulated : channel.clamped;
  const auto s =
      add(to, kClampFireflies, {{0, &channel.signal}, {1, &cut}, {3, &guides}}, desc_.constants);
  if (!s || !spreads) return s;
  return add(to, kSpreadFireflies,
             {{0, &channel.signal}, {1, &channel.clamped}, {2, &cut}, {3, &guides}},
             desc_.constants);
}

rtapi::Status Denoiser::add_lobe_filter(const Recorder& to, const Channel& channel) {
  const Texture& scratch = channel.moments[1 - to.parity];
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Texture& from = i % 2 == 0 ? channel.accumulated : scratch;
    const Texture& into = i % 2 == 0 ? scratch : i == 3 ? channel.result : channel.accumulated;
    DenoiseConstants constants = desc_.constants;
    constants.vertical = i % 2;
    constants.step = i < 2 ? 1 : 2;
    const auto s =
        add(to, kFilterLobe,
            {{0, &from}, {1, &into}, {2, &channel.clamped}, {3, &guides_[to.parity]}}, constants);
    if (!s) return s;
  }
  return {};
}

rtapi::Status Denoiser::add_wavelet(const Recorder& to) {
  const Pictures first = moments_of(1 - to.parity);
  const Pictures accumulated = pictures(&Channel::accumulated);
  const Pictures history = pictures(&Channel::history);
  const Pictures results = pictures(&Channel::result);
  // The next frame's history is the output of the first pass. [Schied et al. 2017]
  const Pictures* from = &first;
  for (std::uint32_t i = 0; i < to.iterations; ++i) {
    const bool last = i + 1 == to.iterations;
    const Pictures* into = i == 0                 ? &history
                           : last                 ? &results
                           : from == &accumulated ? &first
                                                  : &accumulated;
    DenoiseConstants constants = desc_.constants;
    constants.step = 1 << i;
    std::vector<Binding> bindings = {{3, &guides_[to.parity]}};
    add_bindings(bindings, kSignals, *from);
    add_bindings(bindings, kAccumulated, *into);
    if (const auto s = add(to, kAtrous, bindings, constants); !s) return s;
    from = into;
  }
  if (to.iterations == 0) {
    if (const auto s = add_copy(to, *from, history); !s) return s;
  }
  if (to.iterations < 2) return add_copy(to, history, results);
  return {};
}

rtapi::Status Denoiser::create_load(const rtapi::Device& device, const Frame& frame,
                                    const DenoiseLibraries& libraries, const Texture& sum,
                                    std::uint32_t step, std::size_t index) {
  Channel& channel = channels_[index];
  const auto load = SumLoad::create(device, frame, libraries, sum, channel.signal, step);
  if (!load) return load.error();
  channel.load = *load;
  return {};
}

std::uint64_t Denoiser::bytes() const {
  std::uint64_t sum = picture_bytes(guides_[0]) + picture_bytes(guides_[1]);
  for (const Channel& channel : channels_) {
    for (const Texture* texture :
         {&channel.load.sum(), &channel.signal, &channel.result, &channel.history,
          &channel.accumulated, &channel.moments[0], &channel.moments[1], &channel.clamped}) {
      sum += picture_bytes(*texture);
    }
  }
  return sum;
}

void Denoiser::load(rtapi::CommandList& list, const Frame& frame, float scale, std::size_t index,
                    std::uint32_t pixel_offset) const {
  channels_[index].load.record(list, frame, scale, pixel_offset);
}

void Denoiser::dispatch(rtapi::CommandList& list, const Frame& frame) {
  const std::uint32_t parity = is_temporal(desc_.method) ? frames_ % 2 : 0;
  const bool has_history = frames_ >= kFramesOfHistory && !steps_with_history_[parity].empty();
  for (const Step& step : has_history ? steps_with_history_[parity] : steps_[parity]) {
    DenoiseConstants constants = step.constants;
    constants.history_valid = frames_ > 0 ? 1 : 0;
    step.pass->dispatch(list, frame, {}, PassArguments(step.views, constants), frame.width(),
                        frame.height());
  }
  ++frames_;
}

}  // namespace kaamos::effects
