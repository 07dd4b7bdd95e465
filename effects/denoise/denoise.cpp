// SPDX-License-Identifier: MIT
#include "effects/denoise/denoise.h"

#include <shaders/control.h>
#include <shaders/spatial.h>
#include <shaders/svgf.h>
#include <shaders/upscale.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <utility>

#include "effects/frame/picture.h"

namespace kaamos::effects {

using rtapi::Texture;

namespace {

bool is_temporal(DenoiseMethod method) {
  return method == DenoiseMethod::kTemporal || method == DenoiseMethod::kSvgf ||
         method == DenoiseMethod::kControl;
}

std::int32_t squarings_of(float power) {
  int exponent = 0;
  const bool is_power_of_two = std::frexp(power, &exponent) == 0.5f;
  return is_power_of_two && exponent >= 1 ? exponent - 1 : -1;
}

// Entries are kept for frames that may be gone by now.
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
  if (method == DenoiseMethod::kBilateral || method == DenoiseMethod::kBilateralExact) {
    desc.constants.sigma_n = 32.0f;
    desc.constants.sigma_l = 0.0f;  // noise would keep itself
  }
  if (method == DenoiseMethod::kTemporal) {
    desc.constants.alpha = 0.05f;
    desc.constants.clip_gamma = 1.5f;
  }
  if (method == DenoiseMethod::kControl) {
    desc.constants.alpha = desc.constants.moments_alpha = 0.1f;
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
  return DenoiseLibraries{*spatial, *svgf, *control, *upscale};
}

rtapi::Result<Denoiser> Denoiser::create(const rtapi::Device& device, const Frame& frame,
                                         const DenoiseLibraries& libraries, std::string name,
                                         const Texture& signal, const DenoiseDesc& desc) {
  Denoiser out;
  out.name_ = std::move(name);
  out.desc_ = desc;
  out.desc_.iterations = std::min<std::uint32_t>(desc.iterations, 8);
  out.desc_.constants.normal_squarings = squarings_of(desc.constants.sigma_n);
  out.signal_ = signal;
  if (const auto s = out.create_pictures(device, frame); !s) return s.error();
  const Recorder recorder = {device, frame, libraries};
  const std::uint32_t parities = is_temporal(desc.method) ? 2 : 1;
  for (std::uint32_t parity = 0; parity < parities; ++parity) {
    const auto s =
        is_temporal(desc.method) ? out.add_temporal(recorder, parity) : out.add_spatial(recorder);
    if (!s) return s.error();
  }
  return out;
}

rtapi::Status Denoiser::create_pictures(const rtapi::Device& device, const Frame& frame) {
  struct Picture {
    Texture* texture;
    const char* suffix;
  };
  const Picture pictures[] = {{&result_, " denoised"},      {&accumulated_, " accumulated"},
                              {&guides_[0], " guides 0"},   {&guides_[1], " guides 1"},
                              {&history_, " history"},      {&moments_[0], " moments 0"},
                              {&moments_[1], " moments 1"}, {&clamped_, " clamped"}};
  const std::size_t count = desc_.method == DenoiseMethod::kNone      ? 1
                            : desc_.method == DenoiseMethod::kControl ? std::size(pictures)
                            : is_temporal(desc_.method)               ? std::size(pictures) - 1
                                                                      : 3;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [texture, suffix] = pictures[i];
    const auto created =
        frame.create_picture(device, name_ + suffix, rtapi::Format::kR32G32B32A32Float);
    if (!created) return created.error();
    *texture = *created;
  }
  return {};
}

rtapi::Status Denoiser::add(const Recorder& to, std::uint32_t parity, const Kernel& kernel,
                            std::initializer_list<Binding> bindings,
                            const DenoiseConstants& constants) {
  const rtapi::ShaderLibrary& library = to.libraries.*kernel.library;
  const auto pass = to.libraries.pipelines->get(to.device, to.frame, library, kernel.name);
  if (!pass) return pass.error();
  auto views = to.frame.create_pass_views(to.device);
  if (!views) return views.error();
  for (const Binding& binding : bindings) {
    if (const auto s = views->set_unordered_access(binding.u, *binding.texture); !s) return s;
  }
  steps_[parity].push_back({*pass, *views, constants});
  return {};
}

rtapi::Status Denoiser::add_spatial(const Recorder& to) {
  if (desc_.method == DenoiseMethod::kNone) return add_copy(to, 0, signal_, result_);
  if (const auto s = add_guides(to, 0); !s) return s;
  const bool exact = desc_.method == DenoiseMethod::kBilateralExact;
  const Kernel kernel = desc_.method == DenoiseMethod::kGaussian ? kGaussian
                        : exact                                  ? kBilateralExact
                                                                 : kBilateral;
  const Texture* from = &signal_;
  for (std::uint32_t vertical = 0; vertical < (exact ? 1u : 2u); ++vertical) {
    const Texture* into = exact || vertical == 1 ? &result_ : &accumulated_;
    DenoiseConstants constants = desc_.constants;
    constants.vertical = vertical;
    if (const auto s = add(to, 0, kernel, {{0, from}, {1, into}, {3, &guides_[0]}}, constants);
        !s) {
      return s;
    }
    from = into;
  }
  return {};
}

rtapi::Status Denoiser::add_guides(const Recorder& to, std::uint32_t parity) {
  return add(to, parity, kPrepareGuides, {{3, &guides_[parity]}}, desc_.constants);
}

rtapi::Status Denoiser::add_copy(const Recorder& to, std::uint32_t parity, const Texture& from,
                                 const Texture& into) {
  return add(to, parity, kCopy, {{0, &from}, {1, &into}}, desc_.constants);
}

rtapi::Status Denoiser::add_filter(const Recorder& to, std::uint32_t parity, const Texture& from,
                                   const Texture& into, std::int32_t step) {
  DenoiseConstants constants = desc_.constants;
  constants.step = step;
  return add(to, parity, kAtrous, {{0, &from}, {3, &guides_[parity]}, {4, &into}}, constants);
}

rtapi::Status Denoiser::add_temporal(const Recorder& to, std::uint32_t parity) {
  const Texture& before = moments_[1 - parity];
  const bool is_control = desc_.method == DenoiseMethod::kControl;
  const Texture& noisy = is_control ? clamped_ : signal_;
  const std::initializer_list<Binding> all = {{0, &noisy},
                                              {1, &history_},
                                              {2, &before},
                                              {3, &guides_[parity]},
                                              {4, &accumulated_},
                                              {5, &moments_[parity]},
                                              {6, &guides_[1 - parity]}};
  if (const auto s = add_guides(to, parity); !s) return s;
  if (is_control) {
    if (const auto s = add(to, parity, kClampFireflies,
                           {{0, &signal_}, {1, &clamped_}, {3, &guides_[parity]}}, desc_.constants);
        !s) {
      return s;
    }
  }
  if (const auto s = add(to, parity, kTemporal, all, desc_.constants); !s) return s;
  if (is_control) return add_lobe_filter(to, parity, before);
  if (desc_.method == DenoiseMethod::kTemporal) {
    if (const auto s = add_copy(to, parity, accumulated_, history_); !s) return s;
    return add_copy(to, parity, accumulated_, result_);
  }
  // Into the moments of the frame before, which are done with.
  if (const auto s = add(to, parity, kVariance, all, desc_.constants); !s) return s;
  return add_wavelet(to, parity, before);
}

rtapi::Status Denoiser::add_lobe_filter(const Recorder& to, std::uint32_t parity,
                                        const Texture& scratch) {
  if (const auto s = add_copy(to, parity, accumulated_, history_); !s) return s;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Texture& from = i % 2 == 0 ? accumulated_ : scratch;
    const Texture& into = i % 2 == 0 ? scratch : i == 3 ? result_ : accumulated_;
    DenoiseConstants constants = desc_.constants;
    constants.vertical = i % 2;
    constants.step = i < 2 ? 1 : 2;
    if (const auto s =
            add(to, parity, kFilterLobe,
                {{0, &from}, {1, &into}, {2, &clamped_}, {3, &guides_[parity]}}, constants);
        !s) {
      return s;
    }
  }
  return {};
}

rtapi::Status Denoiser::add_wavelet(const Recorder& to, std::uint32_t parity,
                                    const Texture& first) {
  // The first pass's result is what the next frame starts from. [Schied et al. 2017]
  const Texture* from = &first;
  for (std::uint32_t i = 0; i < desc_.iterations; ++i) {
    const bool last = i + 1 == desc_.iterations;
    const Texture* into = i == 0                  ? &history_
                          : last                  ? &result_
                          : from == &accumulated_ ? &first
                                                  : &accumulated_;
    if (const auto s = add_filter(to, parity, *from, *into, 1 << i); !s) return s;
    from = into;
  }
  if (desc_.iterations == 0) {
    if (const auto s = add_copy(to, parity, *from, history_); !s) return s;
  }
  if (desc_.iterations < 2) return add_copy(to, parity, history_, result_);
  return {};
}

rtapi::Status Denoiser::create_load(const rtapi::Device& device, const Frame& frame,
                                    const DenoiseLibraries& libraries, const Texture& sum,
                                    std::uint32_t step) {
  const bool scalar = sum.GetDesc().Format == rtapi::Format::kR32Float;
  const auto& library = step == 2 ? libraries.upscale : libraries.spatial;
  const char* const name = step == 2 ? (scalar ? "UpscaleScalar" : "UpscaleColor")
                                     : (scalar ? "LoadScalar" : "LoadColor");
  const auto pass = libraries.pipelines->get(device, frame, library, name);
  if (!pass) return pass.error();
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto s = views->set_unordered_access(1, signal_); !s) return s;
  if (const auto s = views->set_unordered_access(scalar ? 2 : 0, sum); !s) return s;
  sum_ = sum;
  load_pass_ = *pass;
  load_views_ = *views;
  return {};
}

std::uint64_t Denoiser::bytes() const {
  std::uint64_t sum = 0;
  for (const Texture* texture : {&sum_, &signal_, &result_, &history_, &accumulated_, &guides_[0],
                                 &guides_[1], &moments_[0], &moments_[1], &clamped_}) {
    sum += picture_bytes(*texture);
  }
  return sum;
}

void Denoiser::load(rtapi::CommandList& list, const Frame& frame, float scale) const {
  DenoiseConstants constants = desc_.constants;
  constants.scale = scale;
  load_pass_->dispatch(list, frame, {}, PassArguments(load_views_, constants), frame.width(),
                       frame.height());
}

void Denoiser::dispatch(rtapi::CommandList& list, const Frame& frame) {
  const std::uint32_t parity = is_temporal(desc_.method) ? frames_ % 2 : 0;
  for (const Step& step : steps_[parity]) {
    DenoiseConstants constants = step.constants;
    constants.history_valid = frames_ > 0 ? 1 : 0;
    step.pass->dispatch(list, frame, {}, PassArguments(step.views, constants), frame.width(),
                        frame.height());
  }
  ++frames_;
}

}  // namespace kaamos::effects
