// SPDX-License-Identifier: MIT
// Which effects a frame has, and what each of them is made of.
#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

namespace {

constexpr rtapi::Format kSignalFormat = rtapi::Format::kR32G32B32A32Float;

bool needs_views(const Effect& effect, const EffectSettings& settings) {
  return effect.make || has_own_pictures(effect) || effect.needs.lights || effect.needs.volume ||
         std::any_of(settings.constants.begin(), settings.constants.end(),
                     [](std::uint32_t word) { return word != 0; });
}

}  // namespace

// Chosen, and so in this effect's place; null: nothing is.
const Effect* FrameRenderer::what_replaces(const Effect& effect) const {
  for (const Effect& other : effects_) {
    if (settings_.effects.count(other.name) == 0) continue;
    if (other.name == effect.replaced_by || other.alternative_to == effect.name) return &other;
  }
  return nullptr;
}

bool FrameRenderer::is_of_use(const Effect& effect, const EffectSettings& settings) const {
  if (settings.keep) return true;
  if (!settings.named && what_replaces(effect) != nullptr) return false;
  EffectNeeds needs = effect.needs;
  if (settings.named) needs.glossy = false;
  return scene_offers(scene_, needs) && (!needs.motion || settings_.moving);
}

bool FrameRenderer::renders(const std::string& effect) const {
  const Effect* row = find_effect(effects_, effect);
  const auto chosen = settings_.effects.find(effect);
  return row != nullptr && chosen != settings_.effects.end() && is_of_use(*row, chosen->second);
}

void FrameRenderer::find_active() {
  active_.clear();
  for (const Effect& effect : effects_) {
    if (!renders(effect.name)) continue;
    active_.push_back(std::make_unique<Active>());
    active_.back()->row = &effect;
    active_.back()->settings = settings_.effects.at(effect.name);
    // Without a denoiser nothing would fill the other pixels.
    if (!settings_.whole_frame) active_.back()->settings.pixel_step = 1;
  }
}

rtapi::Status FrameRenderer::create_views(const Frame& frame, const Active& effect,
                                          const std::vector<rtapi::Texture>& pictures,
                                          const GpuVolume& volume,
                                          std::optional<PassViews>& views) const {
  const EffectNeeds& needs = effect.row->needs;
  const auto created = frame.create_pass_views(device_);
  if (!created) return created.error();
  views = *created;
  if (needs.strongest_lights) {
    if (const auto s = views->set_unordered_access(0, direct_->strongest()); !s) return s;
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const EffectSignal& signal = effect.row->signals[i];
    if (signal.picture) continue;
    if (const auto s = views->set_unordered_access(signal.output, pictures[i]); !s) return s;
    if (!signal.is_visibility) continue;
    const auto s = views->set_unordered_access(signal.sharpness_output, effect.sharpness[i]);
    if (!s) return s;
  }
  if (needs.lights) {
    if (const auto s = lighting_->bind(*views); !s) return s;
  }
  if (needs.radiance) {
    if (const auto s = add_radiance(*views); !s) return s;
  }
  return needs.volume ? volume.bind(*views) : rtapi::Status{};
}

rtapi::Status FrameRenderer::create_pictures(Active& effect) const {
  for (const EffectSignal& signal : effect.row->signals) {
    effect.sharpness.emplace_back();
    if (signal.is_visibility && signal.sharpness_picture) {
      effect.sharpness.back() = frame_.texture(*signal.sharpness_picture);
    } else if (signal.is_visibility) {
      const auto created =
          frame_.create_picture(device_, signal.name + " sharpness sum", kSignalFormat);
      if (!created) return created.error();
      effect.sharpness.back() = *created;
    }
    if (signal.picture) {
      effect.pictures.push_back(frame_.texture(*signal.picture));
      continue;
    }
    const auto created = frame_.create_picture(
        device_, signal.is_sum ? signal.name + " sum" : signal.name, kSignalFormat);
    if (!created) return created.error();
    effect.pictures.push_back(*created);
  }
  return {};
}

rtapi::Result<std::unique_ptr<EffectPass>> FrameRenderer::make_own(const Active& effect,
                                                                   const EffectSettings& settings,
                                                                   PassViews& views) {
  const auto library = [this](const std::string& file) -> const rtapi::ShaderLibrary& {
    return libraries_.at(file);
  };
  auto own = effect.row->make({device_, queue_, frame_, scene_, gpu_, library, views, settings});
  if (!own) return own.error();
  if (const auto s = (*own)->begin_frame(moment_.camera); !s) return s.error();
  return own;
}

rtapi::Status FrameRenderer::create_own(Active& effect) {
  auto own = make_own(effect, effect.settings, *effect.views);
  if (!own) return own.error();
  effect.own = std::move(*own);
  effect.title = effect.row->about;
  return {};
}

// Null: there is none yet.
EffectPass* FrameRenderer::own_of(const Active& effect, const EffectSettings& settings) {
  const auto fits = [&](const EffectSettings& made) {
    return made.constants == settings.constants &&
           (effect.row->signals.front().is_sum || made.samples == settings.samples);
  };
  if (fits(effect.settings)) return effect.own.get();
  for (const auto& other : effect.others) {
    if (fits(other->settings)) return other->own.get();
  }
  return nullptr;
}

rtapi::Status FrameRenderer::find_own(Active& effect, const EffectSettings& settings) {
  if (!effect.own || own_of(effect, settings) != nullptr) return {};
  auto other = std::make_unique<OtherPasses>();
  other->settings = settings;
  const auto s = create_views(frame_, effect, effect.pictures, gpu_volume_, other->views);
  if (!s) return s;
  auto own = make_own(effect, settings, *other->views);
  if (!own) return own.error();
  other->own = std::move(*own);
  effect.others.push_back(std::move(other));
  return {};
}

rtapi::Status FrameRenderer::create_effect(Active& effect) {
  const Effect& row = *effect.row;
  effect.samples = effect.settings.samples;
  if (!has_passes(row)) return {};
  if (row.needs.strongest_lights && !direct_) {
    return make_error(ErrorId::kFrameRenderer,
                      "effect \"" + row.name + "\" needs local lights, which are not rendered");
  }
  if (const auto s = create_pictures(effect); !s) return s;
  if (needs_views(row, effect.settings)) {
    const auto s = create_views(frame_, effect, effect.pictures, gpu_volume_, effect.views);
    if (!s) return s;
  }
  if (const auto s = row.make ? create_own(effect) : create_pass(effect); !s) return s;
  if (row.compose.empty()) return {};
  const auto compose =
      ComputePass::create(device_, frame_, libraries_.at(row.library.file), row.compose);
  if (!compose) return compose.error();
  effect.compose = *compose;
  return {};
}

rtapi::Status FrameRenderer::create_pass(Active& effect) const {
  const Effect& row = *effect.row;
  const rtapi::ShaderLibrary& library = libraries_.at(row.library.file);
  const RayPassDesc desc = row.pass(library);
  effect.title = desc.name;
  const auto pass = RayPass::create(device_, frame_, gpu_, desc);
  if (!pass) return pass.error();
  effect.pass = *pass;
  if (sorter_ && !desc.key_generation.empty()) {
    const auto keys = RayPass::create(device_, frame_, gpu_, key_pass(desc));
    if (!keys) return keys.error();
    effect.keys = *keys;
  }
  return {};
}

}  // namespace kaamos::effects
