// SPDX-License-Identifier: MIT
#include "effects/northlight/gradient_stage.h"

#include <algorithm>
#include <utility>

namespace kaamos::effects {

rtapi::Status GradientStage::create(const std::vector<std::unique_ptr<ActiveEffect>>& effects) {
  const FrameSettings& settings = context_.settings;
  if (settings.denoise.method != DenoiseMethod::kAdaptiveSvgf || !settings.moving) return {};
  auto created = TemporalGradients::create(context_.device, context_.frame, context_.gpu,
                                           denoise_libraries(context_.libraries));
  if (!created) return created.error();
  gradients_ = std::move(*created);
  for (const auto& effect : effects) {
    if (!effect->row().repeats || effect->rays() == nullptr) continue;
    const std::size_t wanted = effect->row().signals[0].channels == 2 ? 2 : 1;
    if (gradients_->signals() + wanted > kMostGradients) break;
    if (const auto s = add(*effect); !s) return s;
  }
  return {};
}

rtapi::Status GradientStage::add(const ActiveEffect& effect) {
  const Frame& past = gradients_->past();
  const auto pictures = effect.create_pictures(past, " again");
  if (!pictures) return pictures.error();
  auto views = effect.create_views(past, *pictures);
  if (!views) return views.error();
  if (effect.row().needs.strongest_lights) {
    const auto lights = gradients_->keep(context_.device, context_.frame, *effect.strongest());
    if (!lights) return lights.error();
    if (const auto s = views->set_unordered_access(0, *lights); !s) return s.error();
  }
  // Two visibilities in one picture change each for itself.
  const bool is_pair = effect.row().signals[0].channels == 2;
  std::optional<std::uint32_t> first;
  for (std::int32_t i = 0; i < (is_pair ? 2 : 1); ++i) {
    const auto channel =
        gradients_->add(context_.device, context_.frame, effect.pictures().signals[0],
                        pictures->signals[0], is_pair ? i : -1);
    if (!channel) return channel.error();
    if (!first) first = *channel;
  }
  effects_.push_back({&effect, *pictures, *views, *first});
  return {};
}

const GradientStage::Repeated* GradientStage::find(const ActiveEffect& effect) const {
  const auto found = std::find_if(effects_.begin(), effects_.end(),
                                  [&](const Repeated& each) { return each.effect == &effect; });
  return found == effects_.end() ? nullptr : &*found;
}

std::optional<std::uint32_t> GradientStage::channel(const ActiveEffect& effect) const {
  const Repeated* repeated = find(effect);
  return repeated == nullptr ? std::nullopt : std::optional(repeated->channel);
}

rtapi::Status GradientStage::begin() {
  if (!gradients_) return {};
  if (context_.moment.cut) gradients_->forget();
  if (const auto s = gradients_->follow(context_.device, context_.frame); !s) return s;
  // A pixel must have had rays for every effect.
  std::uint32_t step = 1, offset = 0;
  for (const Repeated& each : effects_) {
    const EffectSettings& settings = each.effect->settings();
    if (settings.pixel_step == 1) continue;
    step = settings.pixel_step;
    offset = pixel_offset(settings, past_index_);
  }
  return context_.runner.run_gradient("past samples", gradients_->bytes(), [&](auto& list) {
    gradients_->record_samples(list, context_.frame, step, offset);
  });
}

rtapi::Status GradientStage::repeat(const ActiveEffect& effect) {
  const Repeated* repeated = find(effect);
  if (repeated == nullptr) return {};
  const EffectSettings& settings = effect.settings();
  const PassConstants constants = {.first_sample = first_sample(settings, past_index_),
                                   .sample_count = settings.samples,
                                   .radius = settings.radius,
                                   .sharpness = 0};
  return context_.runner.run_gradient(effect.title() + " again", 0, [&](auto& list) {
    if (!gradients_->has_past()) return;
    gradients_->record_again(list, effect.rays()->pass(), constants,
                             PassArguments(repeated->views, settings.constants));
  });
}

rtapi::Status GradientStage::finish() {
  if (!gradients_) return {};
  past_index_ = context_.moment.index;
  return context_.runner.run_gradient("temporal gradients", gradients_->bytes(), [&](auto& list) {
    if (gradients_->has_past()) gradients_->record_changes(list, context_.frame);
    gradients_->record_keep(list, context_.frame);
  });
}

}  // namespace kaamos::effects
