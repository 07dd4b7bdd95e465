// SPDX-License-Identifier: MIT
#include "effects/denoise/denoise.h"

#include <shaders/spatial.h>
#include <shaders/svgf.h>

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <utility>

namespace kaamos::effects {

using rtapi::Texture;

namespace {

enum PassId : std::size_t {
  kCopy,
  kGaussian,
  kBilateral,
  kBilateralExact,
  kTemporal,
  kVariance,
  kAtrous,
  kStoreGuide,
  kPassCount
};

bool is_temporal(DenoiseMethod method) {
  return method == DenoiseMethod::kTemporal || method == DenoiseMethod::kSvgf;
}

struct Binding {
  std::uint32_t u;
  const Texture* texture;
};

rtapi::Result<PassViews> bind(const rtapi::Device& device, const Frame& frame,
                              std::initializer_list<Binding> bindings) {
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  for (const Binding& binding : bindings) {
    if (const auto s = views->set_unordered_access(binding.u, *binding.texture); !s) {
      return s.error();
    }
  }
  return views;
}

}  // namespace

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
  return desc;
}

rtapi::Result<DenoiseLibraries> denoise_libraries() {
  const auto spatial = rtapi::LoadShaderLibrary(kaamos_shaders_spatial());
  if (!spatial) return spatial.error();
  const auto svgf = rtapi::LoadShaderLibrary(kaamos_shaders_svgf());
  if (!svgf) return svgf.error();
  return DenoiseLibraries{*spatial, *svgf};
}

rtapi::Result<Denoiser> Denoiser::create(const rtapi::Device& device, const Frame& frame,
                                         const DenoiseLibraries& libraries, std::string name,
                                         const Texture& signal, const DenoiseDesc& desc) {
  Denoiser out;
  out.name_ = std::move(name);
  out.desc_ = desc;
  out.desc_.iterations = std::min<std::uint32_t>(desc.iterations, 8);
  out.signal_ = signal;
  if (const auto s = out.create_pictures(device, frame); !s) return s.error();
  if (const auto s = out.create_passes(device, frame, libraries); !s) return s.error();
  if (!is_temporal(desc.method)) {
    if (const auto s = out.add_spatial(device, frame); !s) return s.error();
    return out;
  }
  for (std::uint32_t parity = 0; parity < 2; ++parity) {
    if (const auto s = out.add_temporal(device, frame, parity); !s) return s.error();
  }
  return out;
}

rtapi::Status Denoiser::create_pictures(const rtapi::Device& device, const Frame& frame) {
  std::vector<std::pair<Texture*, const char*>> pictures = {{&result_, " denoised"}};
  if (desc_.method != DenoiseMethod::kNone) pictures.push_back({&accumulated_, " accumulated"});
  if (is_temporal(desc_.method)) {
    pictures.insert(pictures.end(), {{&history_, " history"},
                                     {&guide_, " guide"},
                                     {&moments_[0], " moments 0"},
                                     {&moments_[1], " moments 1"}});
  }
  for (const auto& [texture, suffix] : pictures) {
    const auto created =
        frame.create_picture(device, name_ + suffix, rtapi::Format::kR32G32B32A32Float);
    if (!created) return created.error();
    *texture = *created;
  }
  return {};
}

rtapi::Status Denoiser::create_passes(const rtapi::Device& device, const Frame& frame,
                                      const DenoiseLibraries& libraries) {
  struct Entry {
    const rtapi::ShaderLibrary* library;
    const char* name;
  };
  const Entry entries[kPassCount] = {{&libraries.spatial, "Copy"},
                                     {&libraries.spatial, "Gaussian"},
                                     {&libraries.spatial, "BilateralSeparable"},
                                     {&libraries.spatial, "BilateralExact"},
                                     {&libraries.svgf, "TemporalAccumulation"},
                                     {&libraries.svgf, "EstimateVariance"},
                                     {&libraries.svgf, "Atrous"},
                                     {&libraries.svgf, "StoreGuide"}};
  for (const Entry& entry : entries) {
    const auto pass = ComputePass::create(device, frame, *entry.library, entry.name);
    if (!pass) return pass.error();
    passes_.push_back(std::make_shared<ComputePass>(*pass));
  }
  return {};
}

rtapi::Status Denoiser::add_spatial(const rtapi::Device& device, const Frame& frame) {
  if (desc_.method == DenoiseMethod::kNone) return add_copy(device, frame, 0, signal_, result_);
  const bool exact = desc_.method == DenoiseMethod::kBilateralExact;
  const PassId pass = desc_.method == DenoiseMethod::kGaussian ? kGaussian
                      : exact                                  ? kBilateralExact
                                                               : kBilateral;
  const Texture* from = &signal_;
  for (std::uint32_t vertical = 0; vertical < (exact ? 1u : 2u); ++vertical) {
    const Texture* to = exact || vertical == 1 ? &result_ : &accumulated_;
    const auto views = bind(device, frame, {{0, from}, {1, to}});
    if (!views) return views.error();
    DenoiseConstants constants = desc_.constants;
    constants.vertical = vertical;
    steps_[0].push_back({passes_[pass].get(), *views, constants});
    from = to;
  }
  return {};
}

rtapi::Status Denoiser::add_copy(const rtapi::Device& device, const Frame& frame,
                                 std::uint32_t parity, const Texture& from, const Texture& to) {
  const auto views = bind(device, frame, {{0, &from}, {1, &to}});
  if (!views) return views.error();
  steps_[parity].push_back({passes_[kCopy].get(), *views, desc_.constants});
  return {};
}

rtapi::Status Denoiser::add_filter(const rtapi::Device& device, const Frame& frame,
                                   std::uint32_t parity, const Texture& from, const Texture& to,
                                   std::int32_t step) {
  const auto views = bind(device, frame, {{0, &from}, {4, &to}});
  if (!views) return views.error();
  DenoiseConstants constants = desc_.constants;
  constants.step = step;
  steps_[parity].push_back({passes_[kAtrous].get(), *views, constants});
  return {};
}

rtapi::Status Denoiser::add_temporal(const rtapi::Device& device, const Frame& frame,
                                     std::uint32_t parity) {
  const Texture& before = moments_[1 - parity];
  const auto views = bind(device, frame,
                          {{0, &signal_},
                           {1, &history_},
                           {2, &before},
                           {3, &guide_},
                           {4, &accumulated_},
                           {5, &moments_[parity]}});
  if (!views) return views.error();
  const auto add = [&](PassId pass) {
    steps_[parity].push_back({passes_[pass].get(), *views, desc_.constants});
  };
  add(kTemporal);
  if (desc_.method == DenoiseMethod::kTemporal) {
    if (const auto s = add_copy(device, frame, parity, accumulated_, history_); !s) return s;
    if (const auto s = add_copy(device, frame, parity, accumulated_, result_); !s) return s;
    add(kStoreGuide);
    return {};
  }
  add(kVariance);  // into the moments of the frame before, which are done with
  // The first pass's result is what the next frame starts from. [Schied et al. 2017]
  const Texture* from = &before;
  for (std::uint32_t i = 0; i < desc_.iterations; ++i) {
    const bool last = i + 1 == desc_.iterations;
    const Texture* to = i == 0                  ? &history_
                        : last                  ? &result_
                        : from == &accumulated_ ? &before
                                                : &accumulated_;
    if (const auto s = add_filter(device, frame, parity, *from, *to, 1 << i); !s) return s;
    from = to;
  }
  if (desc_.iterations == 0) {
    if (const auto s = add_copy(device, frame, parity, *from, history_); !s) return s;
  }
  if (desc_.iterations < 2) {
    if (const auto s = add_copy(device, frame, parity, history_, result_); !s) return s;
  }
  add(kStoreGuide);
  return {};
}

rtapi::Status Denoiser::create_load(const rtapi::Device& device, const Frame& frame,
                                    const DenoiseLibraries& libraries, const Texture& sum) {
  const bool scalar = sum.GetDesc().Format == rtapi::Format::kR32Float;
  const auto pass =
      ComputePass::create(device, frame, libraries.spatial, scalar ? "LoadScalar" : "LoadColor");
  if (!pass) return pass.error();
  const auto views = bind(device, frame, {{1, &signal_}, {scalar ? 2u : 0u, &sum}});
  if (!views) return views.error();
  load_pass_ = std::make_shared<ComputePass>(*pass);
  load_views_ = *views;
  return {};
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
