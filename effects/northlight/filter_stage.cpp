// SPDX-License-Identifier: MIT
#include "effects/northlight/filter_stage.h"

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

rtapi::Status FilterStage::create() {
  for (const auto& effect : effects_.active()) {
    for (std::size_t i = 0; i < effect->pictures().signals.size(); ++i) {
      if (!effect->row().signals[i].is_sum) continue;
      if (const auto s = add_signal(filters_, *effect, i); !s) return s;
    }
  }
  return filters_.create(context_.device, context_.frame, denoise_libraries(context_.libraries),
                         context_.settings.denoise);
}

rtapi::Status FilterStage::add_signal(SignalFilters& to, const ActiveEffect& effect,
                                      std::size_t index) const {
  const EffectSignal& signal = effect.row().signals[index];
  SignalSums sums = {effect.pictures().signals[index],
                     effect.pictures().sharpness[index],
                     {},
                     effect.is_late(),
                     {}};
  if (effect.row().needs.strongest_lights) sums.lights = lights_.main()->strongest();
  const GradientStage& gradients = effects_.gradients();
  if (const auto channel = gradients.channel(effect); channel && index == 0) {
    sums.changes = {gradients.gradients()->changes(), *channel};
  }
  return to.add(context_.device, context_.frame, signal, sums, effect.settings());
}

rtapi::Status FilterStage::add_signal(SignalFilters& to, const std::string& name) const {
  for (const auto& effect : effects_.active()) {
    for (std::size_t i = 0; i < effect->pictures().signals.size(); ++i) {
      if (effect->row().signals[i].name == name) return add_signal(to, *effect, i);
    }
  }
  return make_error(ErrorId::kFrameRenderer, "the frame has no signal \"" + name + "\"");
}

void FilterStage::see_samples() {
  for (const auto& effect : effects_.active()) {
    for (const EffectSignal& signal : effect->row().signals) {
      if (auto* filtered = filters_.find(signal.name)) filtered->samples = effect->samples();
    }
  }
}

void FilterStage::begin_frame() {
  filters_.set_pixel_offset(rotating_offset(context_.moment.index));
  if (context_.moment.cut) filters_.reset();
}

rtapi::Status FilterStage::run(bool late) {
  see_samples();
  for (SignalFilters::Filter& filter : filters_.filters()) {
    if (filter.is_late != late) continue;
    const auto s = context_.runner.run(filter.name, filter.bytes(), [&](auto& list) {
      filters_.record(list, context_.frame, filter);
    });
    if (!s) return s;
  }
  return {};
}

bool FilterStage::record_early(rtapi::CommandList& list) {
  if (is_early_done_) return false;
  see_samples();
  filters_.record_some(list, context_.frame, false);
  is_early_done_ = true;
  return true;
}

void FilterStage::record_rest(rtapi::CommandList& list) {
  see_samples();
  if (!is_early_done_) filters_.record_some(list, context_.frame, false);
  filters_.record_some(list, context_.frame, true);
  is_early_done_ = false;
}

const rtapi::Texture& FilterStage::composed(const ActiveEffect& effect, std::size_t signal) const {
  const SignalFilters::Signal* filtered = filters_.find(effect.row().signals[signal].name);
  if (filtered != nullptr) return filters_.denoised(*filtered);
  return effect.pictures().signals.empty() ? lights_.picture() : effect.pictures().signals[signal];
}

}  // namespace kaamos::effects
