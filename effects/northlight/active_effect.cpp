// SPDX-License-Identifier: MIT
#include "effects/northlight/active_effect.h"

#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"
#include "effects/surfaces/ray_order/ray_order.h"

namespace kaamos::effects {

namespace {

constexpr rtapi::Format kSignalFormat = rtapi::Format::kR32G32B32A32Float;
constexpr std::uint32_t kKeptRadianceRegister = 19;  // u, space3

bool needs_views(const Effect& effect, const EffectSettings& settings) {
  return effect.make || has_own_pictures(effect) || effect.needs.lights || effect.needs.volume ||
         std::any_of(settings.constants.begin(), settings.constants.end(),
                     [](std::uint32_t word) { return word != 0; });
}

}  // namespace

ActiveEffect::ActiveEffect(FrameContext& context, const Effect& row)
    : context_(context), row_(row), settings_(context.settings.effects.at(row.name)) {
  // Without a denoiser nothing would fill the other pixels.
  if (!context.settings.whole_frame) settings_.pixel_step = 1;
  samples_ = settings_.samples;
  title_ = row.about;
}

rtapi::Status ActiveEffect::create(const EffectInputs& inputs) {
  inputs_ = &inputs;
  if (!has_passes()) return {};
  if (row_.needs.strongest_lights && inputs.lights.main() == nullptr) {
    return make_error(ErrorId::kFrameRenderer,
                      "effect \"" + row_.name + "\" needs local lights, which are not rendered");
  }
  needs_views_ = needs_views(row_, settings_);
  if (const auto s = create_pictures(); !s) return s;
  if (const auto s = add_passes(settings_); !s) return s;
  if (row_.compose.empty()) return {};
  const auto compose = ComputePass::create(context_.device, context_.frame,
                                           context_.libraries.at(row_.library.file), row_.compose);
  if (!compose) return compose.error();
  compose_ = *compose;
  return {};
}

rtapi::Status ActiveEffect::create_pictures() {
  const auto create = [this](std::optional<FrameTexture> of_frame, const std::string& name,
                             std::vector<rtapi::Texture>& to) -> rtapi::Status {
    if (of_frame) {
      to.push_back(context_.frame.texture(*of_frame));
      return {};
    }
    const auto created = context_.frame.create_picture(context_.device, name, kSignalFormat);
    if (!created) return created.error();
    to.push_back(*created);
    return {};
  };
  for (const EffectSignal& signal : row_.signals) {
    if (!signal.is_visibility) {
      sharpness_.emplace_back();
    } else if (const auto s =
                   create(signal.sharpness_picture, signal.name + " sharpness sum", sharpness_);
               !s) {
      return s;
    }
    const std::string name = signal.is_sum ? signal.name + " sum" : signal.name;
    if (const auto s = create(signal.picture, name, pictures_); !s) return s;
  }
  return {};
}

rtapi::Result<PassViews> ActiveEffect::create_views(
    const Frame& frame, const std::vector<rtapi::Texture>& pictures) const {
  return create_views(frame, pictures, inputs_->lights.gpu_volume());
}

rtapi::Result<PassViews> ActiveEffect::create_views(const Frame& frame,
                                                    const std::vector<rtapi::Texture>& pictures,
                                                    const GpuVolume& volume) const {
  const EffectNeeds& needs = row_.needs;
  auto views = frame.create_pass_views(context_.device);
  if (!views) return views;
  if (needs.strongest_lights) {
    const auto s = views->set_unordered_access(0, inputs_->lights.main()->strongest());
    if (!s) return s.error();
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const EffectSignal& signal = row_.signals[i];
    if (signal.picture) continue;
    if (const auto s = views->set_unordered_access(signal.output, pictures[i]); !s) {
      return s.error();
    }
    if (!signal.is_visibility) continue;
    const auto s = views->set_unordered_access(signal.sharpness_output, sharpness_[i]);
    if (!s) return s.error();
  }
  if (needs.lights) {
    if (const auto s = inputs_->lights.lighting()->bind(*views); !s) return s.error();
  }
  if (needs.radiance) {
    const auto s = views->set_unordered_access(kKeptRadianceRegister, inputs_->kept_radiance);
    if (!s) return s.error();
  }
  if (needs.volume) {
    if (const auto s = volume.bind(*views); !s) return s.error();
  }
  return views;
}

rtapi::Result<std::unique_ptr<EffectPass>> ActiveEffect::make(const EffectScope& scope) {
  if (!scope.settings.trace_only && row_.make) return row_.make(scope);
  const rtapi::ShaderLibrary& library = context_.libraries.at(row_.library.file);
  const RayPassDesc desc = scope.settings.trace_only ? row_.trace(library) : row_.pass(library);
  if (!scope.settings.trace_only) title_ = desc.name;
  auto rays = RayEffect::create(scope, desc, inputs_->is_sorted && !scope.settings.trace_only);
  if (!rays) return rays.error();
  return std::unique_ptr<EffectPass>(std::move(*rays));
}

rtapi::Status ActiveEffect::add_passes(const EffectSettings& settings) {
  auto out = std::make_unique<Passes>();
  out->settings = settings;
  if (needs_views_ || settings.trace_only) {
    const LightStage& lights = inputs_->lights;
    const auto views = create_views(context_.frame, pictures_,
                                    settings.trace_only ? lights.no_volume() : lights.gpu_volume());
    if (!views) return views.error();
    out->views = *views;
  }
  const auto library = [this](const std::string& file) -> const rtapi::ShaderLibrary& {
    return context_.libraries.at(file);
  };
  auto pass = make({context_.device, context_.runner.queue(), context_.frame, context_.scene,
                    context_.gpu, library, out->views, settings});
  if (!pass) return pass.error();
  if (const auto s = (*pass)->begin_frame(context_.moment.camera); !s) return s;
  out->pass = std::move(*pass);
  passes_.push_back(std::move(out));
  return {};
}

// One pass of rays takes all settings when it is recorded; others may be made from them.
bool ActiveEffect::fits(const Passes& made, const EffectSettings& settings) const {
  if (made.settings.trace_only != settings.trace_only) return false;
  if (made.pass->rays() != nullptr) return true;
  return made.settings.constants == settings.constants &&
         (row_.signals.front().is_sum || made.settings.samples == settings.samples);
}

const ActiveEffect::Passes* ActiveEffect::find(const EffectSettings& settings) const {
  const auto found = std::find_if(passes_.begin(), passes_.end(),
                                  [&](const auto& made) { return fits(*made, settings); });
  return found == passes_.end() ? nullptr : found->get();
}

rtapi::Status ActiveEffect::prepare(const EffectSettings& settings) {
  if (find(settings) != nullptr) return {};
  if (settings.trace_only && !row_.trace) {
    return make_error(ErrorId::kFrameRenderer,
                      "effect \"" + row_.name + "\" has no pass that only traces");
  }
  return add_passes(settings);
}

rtapi::Status ActiveEffect::begin_frame() {
  for (const auto& made : passes_) {
    if (const auto s = made->pass->begin_frame(context_.moment.camera); !s) return s;
  }
  return {};
}

PassConstants ActiveEffect::complete(PassConstants constants,
                                     const EffectSettings& settings) const {
  constants.radius = settings.radius;
  constants.pixel_step = settings.pixel_step;
  constants.pixel_offset = pixel_offset(settings, context_.moment.index);
  return constants;
}

void ActiveEffect::record(rtapi::CommandList& list, const EffectSettings& settings,
                          PassConstants constants) const {
  find(settings)->pass->record(list, settings, complete(constants, settings));
}

void ActiveEffect::record_compose(rtapi::CommandList& list, const EffectSettings& settings) const {
  if (!compose_) return;
  const Frame& frame = context_.frame;
  compose_->dispatch(list, frame, {}, pass_arguments(find(settings)->views, settings),
                     frame.width(), frame.height());
}

SampledWork ActiveEffect::work(const RaySorter* sorter) const {
  SampledWork out;
  out.title = title_;
  out.first_sample = first_sample(settings_, context_.moment.index);
  out.samples = settings_.samples;
  const RayEffect* rays = this->rays();
  if (rays == nullptr) {
    out.record = [this](rtapi::CommandList& list, const PassConstants& constants, std::uint32_t) {
      record(list, settings_, constants);
    };
    return out;
  }
  out.rows = traced_rows(complete({}, settings_), context_.frame.height());
  out.rows_per_band = context_.settings.rows;
  out.record = [this, rays](rtapi::CommandList& list, const PassConstants& constants,
                            std::uint32_t row_count) {
    rays->record_rows(list, settings_, complete(constants, settings_), row_count);
  };
  if (sorter == nullptr || !rays->has_keys()) return out;
  out.order = [this, rays, sorter](PassConstants& constants) -> rtapi::Status {
    // Sorting orders all pixels, so it does not apply at half resolution.
    if (settings_.pixel_step != 1) return {};
    const auto took = context_.runner.execute([&](rtapi::CommandList& list) {
      rays->record_keys(list, settings_, complete(constants, settings_));
      sorter->sort(list, context_.frame, context_.settings.order);
    });
    if (!took) return took.error();
    constants.sorted = 1;
    return {};
  };
  return out;
}

std::uint64_t ActiveEffect::bytes() const {
  std::uint64_t sum = 0;
  if (!passes_.empty()) sum += passes_.front()->views.bytes() + passes_.front()->pass->bytes();
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (row_.signals[i].picture) sum += picture_bytes(pictures_[i]);
  }
  return sum;
}

}  // namespace kaamos::effects
