// SPDX-License-Identifier: MIT
#include "effects/northlight/compose_stage.h"

#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

rtapi::Status ComposeStage::create() {
  if (context_.settings.whole_frame) {
    if (const auto s = create_whole(); !s) return s;
  } else {
    if (const auto s = create_plain(); !s) return s;
  }
  if (context_.settings.enlarge > 1.0f) {
    auto enlarger = Enlarger::create(
        context_.device, context_.frame, context_.libraries.at("composition/enlarge/enlarge"),
        context_.settings.enlarge, context_.settings.enlarge_constants);
    if (!enlarger) return enlarger.error();
    enlarger_ = std::move(*enlarger);
  }
  if (!context_.settings.taa) return {};
  const auto taa = TemporalAntialiasing::create(context_.device, context_.frame,
                                                context_.libraries.at("composition/taa/taa"),
                                                context_.settings.taa_constants);
  if (!taa) return taa.error();
  taa_ = *taa;
  return {};
}

rtapi::Status ComposeStage::create_plain() {
  FrameParts sums;
  for (const auto& effect : effects_.active()) {
    for (std::size_t i = 0; i < effect->row().signals.size(); ++i) {
      const EffectSignal& signal = effect->row().signals[i];
      if (signal.part != nullptr) sums.*signal.part = &effect->pictures().signals[i];
    }
  }
  const auto composite =
      CompositePass::create(context_.device, context_.frame,
                            context_.libraries.at("composition/composite/composite"), sums);
  if (!composite) return composite.error();
  composite_ = *composite;
  return {};
}

rtapi::Result<ComposePass> ComposeStage::create_pass(const FrameParts& parts) const {
  return ComposePass::create(context_.device, context_.frame,
                             context_.libraries.at("composition/composite/composite"), parts);
}

rtapi::Status ComposeStage::take_strongest(const ActiveEffect& effect) {
  if (!effect.row().needs.strongest_lights) return {};
  return lights_.set_contact(filters_.composed(effect, 0), effect.row().shadows_alone
                                                               ? ContactCombination::kAlone
                                                               : context_.settings.contact);
}

rtapi::Status ComposeStage::create_whole() {
  FrameParts parts;
  for (const auto& effect : effects_.active()) {
    // The last of several stays, because alternatives stand behind what they are alternatives to.
    if (const auto s = take_strongest(*effect); !s) return s;
    for (std::size_t i = 0; i < effect->row().signals.size(); ++i) {
      const EffectSignal& signal = effect->row().signals[i];
      if (signal.part != nullptr) parts.*signal.part = &filters_.composed(*effect, i);
    }
  }
  parts.is_matte = is_matte(context_.scene, context_.settings, context_.effects);
  const auto compose = create_pass(parts);
  if (!compose) return compose.error();
  compose_ = *compose;
  if (!effects_.has_late()) return {};
  parts.reflection = nullptr;
  const auto unreflected = create_pass(parts);
  if (!unreflected) return unreflected.error();
  compose_unreflected_ = *unreflected;
  return {};
}

rtapi::Result<FrameParts> ComposeStage::parts_of(const std::vector<std::string>& signals) const {
  FrameParts parts;
  for (const std::string& name : signals) {
    bool is_part = false;
    for (const Effect& row : context_.effects) {
      for (std::size_t i = 0; i < row.signals.size(); ++i) {
        const EffectSignal& signal = row.signals[i];
        if (signal.name != name || signal.part == nullptr) continue;
        is_part = true;
        const ActiveEffect* effect = effects_.find(row.name);
        if (effect != nullptr) parts.*signal.part = &filters_.composed(*effect, i);
      }
    }
    if (!is_part) {
      return make_error(ErrorId::kFrameRenderer, "signal \"" + name + "\" is not composed");
    }
  }
  parts.is_matte = std::count(signals.begin(), signals.end(), "reflection") != 0 &&
                   is_matte(context_.scene, context_.settings, context_.effects);
  // Without indirect light the open sky would stand in for it.
  if (parts.indirect == nullptr) parts.indirect = &black_;
  return parts;
}

rtapi::Status ComposeStage::run_some(const std::vector<std::string>& signals) {
  if (!black_) {
    const auto black =
        context_.frame.create_picture(context_.device, "black", rtapi::Format::kR32G32B32A32Float);
    if (!black) return black.error();
    black_ = *black;
  }
  const auto parts = parts_of(signals);
  if (!parts) return parts.error();
  auto found = compose_some_.find(signals);
  if (found == compose_some_.end()) {
    const auto pass = create_pass(*parts);
    if (!pass) return pass.error();
    found = compose_some_.emplace(signals, *pass).first;
  }
  const auto done = context_.runner.execute(
      [&](rtapi::CommandList& list) { found->second.dispatch(list, context_.frame); });
  if (!done) return done.error();
  return {};
}

void ComposeStage::begin_frame() {
  if (context_.moment.cut && taa_) taa_->reset();
}

void ComposeStage::record(rtapi::CommandList& list) const {
  if (composite_) {
    CompositeConstants weights;
    for (const auto& effect : effects_.active()) {
      for (const EffectSignal& signal : effect->row().signals) {
        if (signal.part == &FrameParts::ambient) weights.ao_samples = effect->samples();
        if (signal.part == &FrameParts::sun_visibility) weights.sun_samples = effect->samples();
      }
    }
    composite_->dispatch(list, context_.frame, weights);
    return;
  }
  lights_.record_strongest(list);
  compose_->dispatch(list, context_.frame);
  for (const auto& effect : effects_.active()) effect->record_compose(list, effect->settings());
  effects_.record_keep(list);
}

std::uint64_t ComposeStage::bytes() const {
  std::uint64_t sum = picture_bytes(context_.frame.texture(kRadiance));
  if (compose_) sum += compose_->bytes();
  for (const auto& effect : effects_.active()) {
    if (compose_ && !effect->is_composed()) continue;
    for (const rtapi::Texture& picture : effect->pictures().signals) sum += picture_bytes(picture);
  }
  return sum;
}

rtapi::Status ComposeStage::run() {
  const auto s = context_.runner.run("composite", bytes(), [&](auto& list) { record(list); });
  if (!s) return s;
  if (taa_) {
    const auto taa = context_.runner.run("taa", taa_->bytes(),
                                         [&](auto& list) { taa_->dispatch(list, context_.frame); });
    if (!taa) return taa;
  }
  if (!enlarger_) return {};
  // Antialiasing writes two pictures in turns.
  if (const auto bound = enlarger_->bind(resolved()); !bound) return bound;
  return context_.runner.run("enlarge", enlarger_->bytes(),
                             [&](auto& list) { enlarger_->dispatch(list, context_.frame); });
}

void ComposeStage::record_unreflected(rtapi::CommandList& list) const {
  lights_.record_strongest(list);
  compose_unreflected_->dispatch(list, context_.frame);
}

rtapi::Status ComposeStage::run_unreflected() {
  return context_.runner.run("composite without reflections", compose_unreflected_->bytes(),
                             [&](auto& list) { record_unreflected(list); });
}

}  // namespace kaamos::effects
