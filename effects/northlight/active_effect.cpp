// SPDX-License-Identifier: MIT
#include "effects/northlight/active_effect.h"

#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"
#include "effects/northlight/signal_filters.h"
#include "effects/surfaces/ray_order/ray_order.h"

namespace kaamos::effects {

namespace {

constexpr rtapi::Format kSharpnessFormat = rtapi::Format::kR32G32B32A32Float;
constexpr std::uint32_t kKeptRadianceRegister = 19;  // u, space3

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
  if (const auto s = create_pictures(); !s) return s;
  if (const auto s = add_passes(settings_); !s) return s;
  if (row_.compose.empty()) return {};
  const auto compose = ComputePass::create(context_.device, context_.frame,
                                           context_.libraries.at(row_.library.file), row_.compose);
  if (!compose) return compose.error();
  compose_ = *compose;
  return {};
}

rtapi::Status ActiveEffect::remake() {
  passes_.clear();
  return has_passes() ? add_passes(settings_) : rtapi::Status{};
}

rtapi::Status ActiveEffect::create_pictures() {
  if (!reads_sharpness(context_.settings)) {
    // Shaders name it all the same.
    const auto none =
        effects::create_picture(context_.device, "no sharpness", kSharpnessFormat, 1, 1);
    if (!none) return none.error();
    no_sharpness_ = *none;
  }
  auto created = create_pictures(context_.frame, "");
  if (!created) return created.error();
  pictures_ = std::move(*created);
  return {};
}

rtapi::Result<SignalPictures> ActiveEffect::create_pictures(const Frame& frame,
                                                            const std::string& ending) const {
  SignalPictures out;
  for (const EffectSignal& signal : row_.signals) {
    const std::string name = (signal.is_sum ? signal.name + " sum" : signal.name) + ending;
    const auto picture = frame.create_picture(context_.device, name, signal.format);
    if (!picture) return picture.error();
    out.signals.push_back(*picture);
    out.sharpness.emplace_back();
    if (!signal.is_visibility || !reads_sharpness(context_.settings)) continue;
    const auto sharpness = frame.create_picture(
        context_.device, signal.name + " sharpness sum" + ending, kSharpnessFormat);
    if (!sharpness) return sharpness.error();
    out.sharpness.back() = *sharpness;
  }
  return out;
}

rtapi::Result<PassViews> ActiveEffect::create_views(const Frame& frame,
                                                    const SignalPictures& pictures) const {
  return create_views(frame, pictures, inputs_->lights.gpu_volume());
}

rtapi::Result<PassViews> ActiveEffect::create_views(const Frame& frame,
                                                    const SignalPictures& pictures,
                                                    const GpuVolume& volume) const {
  const EffectNeeds& needs = row_.needs;
  auto views = frame.create_pass_views(context_.device);
  if (!views) return views;
  if (needs.strongest_lights) {
    const auto s = views->set_unordered_access(0, inputs_->lights.main()->strongest());
    if (!s) return s.error();
  }
  for (std::size_t i = 0; i < row_.signals.size(); ++i) {
    const EffectSignal& signal = row_.signals[i];
    const auto sum = views->set_unordered_access(signal.output, pictures.signals[i]);
    if (!sum) return sum.error();
    if (!signal.is_visibility) continue;
    const rtapi::Texture& sharpness = pictures.sharpness[i] ? pictures.sharpness[i] : no_sharpness_;
    const auto s = views->set_unordered_access(signal.sharpness_output, sharpness);
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
  const LightStage& lights = inputs_->lights;
  const auto views = create_views(context_.frame, pictures_,
                                  settings.trace_only ? lights.no_volume() : lights.gpu_volume());
  if (!views) return views.error();
  out->views = *views;
  const auto library = [this](const std::string& file) -> const rtapi::ShaderLibrary& {
    return context_.libraries.at(file);
  };
  auto pass = make({context_.device, context_.runner.queue(), context_.frame, context_.scene,
                    context_.gpu, library, out->views, settings, *inputs_->shared});
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
  constants.sharpness = reads_sharpness(context_.settings) ? 1 : 0;
  return constants;
}

void ActiveEffect::record(rtapi::CommandList& list, const EffectSettings& settings,
                          PassConstants constants) const {
  find(settings)->pass->record(list, settings, complete(constants, settings));
}

void ActiveEffect::record_compose(rtapi::CommandList& list, const EffectSettings& settings) const {
  if (!compose_) return;
  const Frame& frame = context_.frame;
  compose_->dispatch(list, frame, {}, PassArguments(find(settings)->views, settings.constants),
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
  return passes_.empty() ? 0 : passes_.front()->views.bytes() + passes_.front()->pass->bytes();
}

}  // namespace kaamos::effects
