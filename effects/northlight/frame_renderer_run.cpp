// SPDX-License-Identifier: MIT
// Single effects, run again and again with any settings, and what can be read of a frame.
#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

namespace {

constexpr double kDispatchMs = 300;
constexpr std::uint32_t kMostSamplesPerDispatch = 1024;

}  // namespace

void FrameRenderer::set_samples(Active& effect, std::uint32_t samples) {
  effect.samples = samples;
  for (const EffectSignal& signal : effect.row->signals) {
    if (auto* filtered = filters_.find(signal.name)) filtered->samples = samples;
  }
}

rtapi::Status FrameRenderer::set_seed(std::uint32_t seed) {
  frame_.set_seed(seed);
  if (gradients_) gradients_->forget();  // samples of another seed cannot be compared
  return frame_.set_camera(device_, scene_, moment_.camera,
                           {.index = moment_.index, .previous_camera = moment_.camera});
}

PassArguments FrameRenderer::arguments(const Active& effect, const EffectSettings& settings) const {
  const auto& views = settings.trace_only ? effect.trace_views : effect.views;
  return views ? PassArguments(*views, settings.constants) : PassArguments{};
}

rtapi::Result<FrameRenderer::Active*> FrameRenderer::runnable(const std::string& name,
                                                              const EffectSettings& settings) {
  if (const auto s = draw_surfaces(); !s) return s.error();
  auto* effect = const_cast<Active*>(active(name));
  if (effect == nullptr || !has_passes(*effect->row)) {
    return make_error(
        ErrorId::kFrameRenderer,
        "effect \"" + name +
            "\" cannot be run: it is not chosen, has no passes, or the scene has no use for it");
  }
  if (is_late(*effect)) {
    if (const auto s = find_radiance(); !s) return s.error();
  }
  if (const auto s = find_own(*effect, settings); !s) return s.error();
  if (!settings.trace_only || effect->trace_views) return effect;
  if (!effect->row->trace)
    return make_error(ErrorId::kFrameRenderer,
                      "effect \"" + name + "\" has no pass that only traces");
  const auto views =
      create_views(frame_, *effect, effect->pictures, no_volume_, effect->trace_views);
  if (!views) return views.error();
  const RayPassDesc desc = effect->row->trace(libraries_.at(effect->row->library.file));
  const auto pass = RayPass::create(device_, frame_, gpu_, desc);
  if (!pass) return pass.error();
  effect->trace = *pass;
  return effect;
}

void FrameRenderer::record_pass(rtapi::CommandList& list, const Active& effect,
                                const EffectSettings& settings, PassConstants constants) const {
  constants.radius = settings.radius;
  constants.pixel_step = settings.pixel_step;
  constants.pixel_offset = pixel_offset(settings, moment_.index);
  if (effect.own) return own_of(effect, settings)->record(list, settings, constants);
  const PassArguments words = arguments(effect, settings);
  const RayPass& pass = settings.trace_only ? effect.trace : effect.pass;
  pass.dispatch(list, frame_, constants, traced_rows(constants, frame_.height()), words);
}

rtapi::Result<RunStatistics> FrameRenderer::run(const std::string& effect, std::uint32_t samples) {
  const auto chosen = settings_.effects.find(effect);
  EffectSettings settings;
  if (chosen != settings_.effects.end()) settings = chosen->second;
  settings.samples = samples;
  return run(effect, settings);
}

rtapi::Result<RunStatistics> FrameRenderer::run(const std::string& name,
                                                const EffectSettings& settings,
                                                std::uint32_t first_sample) {
  const auto effect = runnable(name, settings);
  if (!effect) return effect.error();
  device_.ResetStatistics();
  const auto ms = execute([&](rtapi::CommandList& list) {
    record_pass(list, **effect, settings,
                {.first_sample = first_sample, .sample_count = settings.samples, .accumulate = 0});
    if (!(*effect)->compose) return;
    (*effect)->compose->dispatch(list, frame_, {}, arguments(**effect, settings), frame_.width(),
                                 frame_.height());
  });
  if (!ms) return ms.error();
  set_samples(**effect, settings.samples);
  return RunStatistics{*ms, device_.GetStatistics().TraceRayCalls};
}

rtapi::Result<Outcome> FrameRenderer::accumulate(const std::string& name,
                                                 const EffectSettings& settings,
                                                 const Progress& progress) {
  if (const auto s = prepare(progress); !is_done(s)) return s;
  const auto effect = runnable(name, settings);
  if (!effect) return effect.error();
  std::uint32_t step = 1;
  for (std::uint32_t sample = 0; sample < settings.samples;) {
    const std::uint32_t count = std::min(step, settings.samples - sample);
    const auto ms = execute([&](rtapi::CommandList& list) {
      record_pass(
          list, **effect, settings,
          {.first_sample = sample, .sample_count = count, .accumulate = sample > 0 ? 1u : 0u});
    });
    if (!ms) return ms.error();
    sample += count;
    set_samples(**effect, sample);
    const double done = static_cast<double>(sample) / settings.samples;
    if (progress && !progress(name, done)) return Outcome::kStopped;
    const double fit = step * std::clamp(kDispatchMs / std::max(*ms, 0.1), 0.5, 2.0);
    step = static_cast<std::uint32_t>(
        std::clamp(fit, 1.0, static_cast<double>(kMostSamplesPerDispatch)));
  }
  return Outcome::kDone;
}

// What the composition takes for a signal: denoised, as its pass wrote it, or main lighting.
const rtapi::Texture* FrameRenderer::composed(const Active& effect, std::size_t signal) const {
  const SignalFilters::Signal* filtered = filters_.find(effect.row->signals[signal].name);
  if (filtered != nullptr) return &filters_.denoised(*filtered);
  if (!effect.pictures.empty()) return &effect.pictures[signal];
  return has_strongest_effect() ? &direct_->total() : &direct_->direct();
}

rtapi::Result<FrameParts> FrameRenderer::parts_of(const std::vector<std::string>& signals) const {
  FrameParts parts;
  for (const std::string& name : signals) {
    bool is_part = false;
    for (const Effect& row : effects_) {
      for (std::size_t i = 0; i < row.signals.size(); ++i) {
        const EffectSignal& signal = row.signals[i];
        if (signal.name != name || signal.part == nullptr) continue;
        is_part = true;
        const Active* effect = active(row.name);
        if (effect != nullptr) parts.*signal.part = composed(*effect, i);
      }
    }
    if (!is_part) {
      return make_error(ErrorId::kFrameRenderer, "signal \"" + name + "\" is not composed");
    }
  }
  parts.is_matte = std::count(signals.begin(), signals.end(), "reflection") != 0 && is_matte();
  // Without indirect light the open sky would stand in for it.
  if (parts.indirect == nullptr) parts.indirect = &black_;
  return parts;
}

rtapi::Result<FloatImage> FrameRenderer::read_composed(const std::vector<std::string>& signals) {
  if (!black_) {
    const auto black = frame_.create_picture(device_, "black", rtapi::Format::kR32G32B32A32Float);
    if (!black) return black.error();
    black_ = *black;
  }
  const auto parts = parts_of(signals);
  if (!parts) return parts.error();
  auto found = compose_some_.find(signals);
  if (found == compose_some_.end()) {
    const auto pass = ComposePass::create(device_, frame_,
                                          libraries_.at("composition/composite/composite"), *parts);
    if (!pass) return pass.error();
    found = compose_some_.emplace(signals, *pass).first;
  }
  const auto done =
      execute([&](rtapi::CommandList& list) { found->second.dispatch(list, frame_); });
  if (!done) return done.error();
  return read("radiance");
}

std::vector<std::string> FrameRenderer::parts() const {
  std::vector<std::string> out = {"gbuffer"};
  for (const auto& effect : active_) {
    if (comes_first(*effect)) out.push_back(effect->row->name);
  }
  if (settings_.whole_frame) out.push_back("lights");
  for (const bool late : {false, true}) {
    for (const auto& effect : active_) {
      if (!has_passes(*effect->row) || comes_first(*effect) || is_late(*effect) != late) continue;
      out.push_back(effect->row->name);
    }
  }
  return out;
}

void FrameRenderer::record(rtapi::CommandList& list, const std::string& part,
                           const PartOptions& options) {
  if (part == "gbuffer") {
    record_gbuffer(list);
  } else if (part == "lights") {
    record_lights(list);
  } else if (auto* effect = const_cast<Active*>(active(part)); effect && has_passes(*effect->row)) {
    const std::uint32_t samples = options.samples > 0 ? options.samples : effect->settings.samples;
    if (is_late(*effect)) record_early(list);
    record_pass(list, *effect, effect->settings,
                {.first_sample = options.first_sample,
                 .sample_count = samples,
                 .sorted = options.is_sorted ? 1u : 0u,
                 .accumulate = 0});
    set_samples(*effect, samples);
  }
}

void FrameRenderer::record_sort(rtapi::CommandList& list, const std::string& part) const {
  const Active* effect = active(part);
  if (effect == nullptr || !effect->keys) return;
  const PassConstants constants = {.sample_count = 1, .radius = effect->settings.radius};
  effect->keys->dispatch(list, frame_, constants, frame_.height(),
                         arguments(*effect, effect->settings));
  sorter_->sort(list, frame_, settings_.order);
}

rtapi::Texture FrameRenderer::sum(const std::string& signal) const {
  for (const auto& effect : active_) {
    for (std::size_t i = 0; i < effect->pictures.size(); ++i) {
      if (effect->row->signals[i].name == signal) return effect->pictures[i];
    }
  }
  return {};
}

std::vector<FrameRenderer::Layer> FrameRenderer::find_layers() const {
  constexpr std::pair<const char*, FrameTexture> kSurfaces[] = {
      {"depth", kDepth},          {"view_z", kViewZ},
      {"normal", kNormal},        {"shading_normal", kShadingNormal},
      {"base_color", kBaseColor}, {"emissive", kEmissive},
      {"material", kMaterial},    {"ids", kIds},
      {"position", kPosition}};
  std::vector<Layer> out;
  for (const auto& [name, texture] : kSurfaces) {
    out.push_back({name, frame_.texture(texture), 1, texture == kBaseColor});
  }
  for (const auto& effect : active_) {
    for (std::size_t i = 0; i < effect->row->signals.size(); ++i) {
      const EffectSignal& signal = effect->row->signals[i];
      if (!has_passes(*effect->row)) {
        if (!direct_) continue;
        out.push_back({signal.name, has_strongest_effect() ? direct_->total() : direct_->direct()});
        continue;
      }
      if (!signal.is_sum) {
        out.push_back({signal.name, effect->pictures[i]});
        continue;
      }
      const SignalFilters::Signal* filtered = filters_.find(signal.name);
      const float scale = 1.0f / static_cast<float>(std::max(effect->samples, 1u));
      // A sum of every other pixel has holes, which the denoiser's input has not.
      if (filtered != nullptr && !signal.picture && filtered->pixel_step != 1) {
        out.push_back({signal.name, filtered->mean});
      } else {
        out.push_back({signal.name, effect->pictures[i], scale});
      }
      if (filtered != nullptr) {
        out.push_back({signal.name + "_denoised", filters_.denoised(*filtered)});
      }
    }
  }
  return out;
}

std::vector<std::string> FrameRenderer::layers() const {
  std::vector<std::string> out;
  for (const Layer& layer : find_layers()) out.push_back(layer.name);
  out.push_back("radiance");
  return out;
}

rtapi::Result<FloatImage> FrameRenderer::read(const rtapi::Texture& picture) {
  return read_picture(device_, queue_, picture);
}

rtapi::Result<FloatImage> FrameRenderer::read(const std::string& name) {
  if (name == "radiance") return read(taa_ ? taa_->result() : frame_.texture(kRadiance));
  for (const Layer& layer : find_layers()) {
    if (layer.name != name) continue;
    auto image = read(layer.picture);
    if (!image) return image;
    if (layer.scale != 1) {
      for (float& value : image->values) value *= layer.scale;
    }
    // As EncodeColor stores it; alpha is 1. [effects/shaders/encoding.hlsli]
    if (layer.is_encoded_color) {
      for (float& value : image->values) value *= value;
    }
    return image;
  }
  std::string known;
  for (const std::string& layer : layers()) known += (known.empty() ? "" : ", ") + layer;
  return make_error(ErrorId::kFrameRenderer,
                    "the frame has no layer \"" + name + "\" but " + known);
}

}  // namespace kaamos::effects
