// SPDX-License-Identifier: MIT
#include "effects/northlight/effect_stage.h"

#include <algorithm>
#include <utility>

namespace kaamos::effects {

namespace {

// With so many samples per pixel, what reads the volume has found the cells that count.
constexpr std::uint32_t kMostReadingSamples = 4;

}  // namespace

void EffectStage::choose() {
  for (const Effect& effect : context_.effects) {
    if (renders(effect.name)) active_.push_back(std::make_unique<ActiveEffect>(context_, effect));
  }
}

bool EffectStage::renders(const std::string& effect) const {
  return is_rendered(context_.scene, context_.settings, context_.effects, effect);
}

ActiveEffect* EffectStage::find(const std::string& effect) const {
  const auto found = std::find_if(active_.begin(), active_.end(),
                                  [&](const auto& each) { return each->row().name == effect; });
  return found == active_.end() ? nullptr : found->get();
}

bool EffectStage::has_late() const {
  return std::any_of(active_.begin(), active_.end(),
                     [](const auto& effect) { return effect->is_late(); });
}

LightStage::Needs EffectStage::light_needs() const {
  LightStage::Needs out;
  for (const auto& effect : active_) {
    if (!effect->has_passes()) out.main = true;
    if (effect->row().needs.strongest_lights) out.strongest = true;
  }
  return out;
}

rtapi::Status EffectStage::create() {
  if (context_.settings.order != RayOrder::kPixels) {
    auto sorter = RaySorter::create(context_.device, context_.frame,
                                    context_.libraries.at("surfaces/ray_order/ray_order"));
    if (!sorter) return sorter.error();
    sorter_ = std::move(*sorter);
    inputs_.is_sorted = true;
  }
  if (const auto s = create_radiance(); !s) return s;
  for (const auto& effect : active_) {
    if (const auto s = effect->create(inputs_); !s) return s;
  }
  return context_.settings.whole_frame ? gradients_.create(active_) : rtapi::Status{};
}

rtapi::Status EffectStage::create_radiance() {
  if (!has_late()) return {};
  const auto kept = KeptRadiance::create(context_.device, context_.frame,
                                         context_.libraries.at("composition/composite/composite"));
  if (!kept) return kept.error();
  kept_ = *kept;
  inputs_.kept_radiance = kept_->picture();
  return forget_radiance();
}

rtapi::Status EffectStage::forget_radiance() {
  if (!kept_) return {};
  const auto done = context_.runner.execute(
      [&](rtapi::CommandList& list) { kept_->record_nothing(list, context_.frame); });
  if (!done) return done.error();
  return {};
}

rtapi::Result<Outcome> EffectStage::read_volume(const Progress& progress) {
  for (const auto& effect : active_) {
    if (!effect->has_passes() || !effect->row().needs.volume) continue;
    SampledWork work = effect->work(nullptr);
    work.title = "indirect light";
    work.samples = std::min(work.samples, kMostReadingSamples);
    work.done = nullptr;
    if (const auto done = context_.runner.run_samples(work, progress); !is_done(done)) return done;
  }
  return Outcome::kDone;
}

rtapi::Status EffectStage::remake_readers() {
  inputs_.shared->clear();
  for (const auto& effect : active_) {
    if (!effect->row().needs.volume || effect->rays() != nullptr) continue;
    if (const auto s = effect->remake(); !s) return s;
  }
  return {};
}

rtapi::Status EffectStage::begin_frame() {
  for (const auto& effect : active_) {
    if (const auto s = effect->begin_frame(); !s) return s;
  }
  return {};
}

rtapi::Status EffectStage::begin() {
  for (const auto& effect : active_) effect->set_samples(effect->settings().samples);
  if (context_.moment.cut) {
    if (const auto s = forget_radiance(); !s) return s;
  }
  return gradients_.begin();
}

rtapi::Result<Outcome> EffectStage::run(bool late, const Progress& progress) {
  for (const auto& effect : active_) {
    if (!effect->has_passes() || effect->is_late() != late) continue;
    const SampledWork work = effect->work(sorter_ ? &*sorter_ : nullptr);
    const auto done = context_.runner.run_pass(work, effect->bytes(), progress);
    if (!is_done(done)) return done;
    if (const auto s = gradients_.repeat(*effect); !s) return s.error();
  }
  if (late) return Outcome::kDone;
  if (const auto s = gradients_.finish(); !s) return s.error();
  return Outcome::kDone;
}

void EffectStage::record(rtapi::CommandList& list, ActiveEffect& effect,
                         const PartOptions& options) {
  const EffectSettings& settings = effect.settings();
  effect.set_samples(options.samples > 0 ? options.samples : settings.samples);
  effect.record(list, settings,
                {.first_sample = options.first_sample,
                 .sample_count = effect.samples(),
                 .sorted = options.is_sorted ? 1u : 0u,
                 .accumulate = 0});
}

void EffectStage::record_sort(rtapi::CommandList& list, const std::string& name) const {
  const ActiveEffect* effect = find(name);
  const RayEffect* rays = effect == nullptr ? nullptr : effect->rays();
  if (rays == nullptr || !rays->has_keys()) return;
  const EffectSettings& settings = effect->settings();
  rays->record_keys(list, settings, {.sample_count = 1, .radius = settings.radius});
  sorter_->sort(list, context_.frame, context_.settings.order);
}

void EffectStage::record_keep(rtapi::CommandList& list) const {
  if (kept_) kept_->record(list, context_.frame);
}

rtapi::Texture EffectStage::sum(const std::string& signal) const {
  for (const auto& effect : active_) {
    for (std::size_t i = 0; i < effect->pictures().signals.size(); ++i) {
      if (effect->row().signals[i].name == signal) return effect->pictures().signals[i];
    }
  }
  return {};
}

}  // namespace kaamos::effects
