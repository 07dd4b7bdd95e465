// SPDX-License-Identifier: MIT
// A-SVGF: samples of the frame before, taken again to tell what has changed from noise.
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

rtapi::Status FrameRenderer::create_gradients() {
  if (settings_.denoise.method != DenoiseMethod::kAdaptiveSvgf || !settings_.moving) return {};
  auto created = TemporalGradients::create(device_, frame_, gpu_, denoise_libraries(libraries_));
  if (!created) return created.error();
  gradients_ = std::move(*created);
  std::size_t count = 0;
  for (const auto& effect : active_) {
    if (!effect->row->repeats || !effect->row->pass || count == kMostGradients) continue;
    if (const auto s = add_gradient(*effect); !s) return s;
    ++count;
  }
  return {};
}

rtapi::Status FrameRenderer::add_gradient(Active& effect) {
  const Frame& past = gradients_->past();
  std::vector<rtapi::Texture> pictures;
  for (std::size_t i = 0; i < effect.pictures.size(); ++i) {
    const EffectSignal& signal = effect.row->signals[i];
    if (signal.picture) {
      pictures.push_back(past.texture(*signal.picture));
      continue;
    }
    const auto picture =
        past.create_picture(device_, signal.name + " again", effect.pictures[i].GetDesc().Format);
    if (!picture) return picture.error();
    pictures.push_back(*picture);
  }
  if (effect.views) {
    const auto s = create_views(past, effect, pictures, gpu_volume_, effect.past_views);
    if (!s) return s;
  }
  const auto channel = gradients_->add(device_, frame_, effect.pictures[0], pictures[0]);
  if (!channel) return channel.error();
  effect.gradient = *channel;
  return {};
}

rtapi::Status FrameRenderer::run_gradients(const std::string& name, std::uint64_t bytes,
                                           const std::function<void(rtapi::CommandList&)>& record) {
  if (const auto s = run_compute(name, bytes, record); !s) return s;
  statistics_.back().is_gradient = true;
  return {};
}

// Behind the G-buffer.
rtapi::Status FrameRenderer::begin_gradients() {
  if (!gradients_) return {};
  if (moment_.cut) gradients_->forget();
  if (const auto s = gradients_->follow(device_, frame_); !s) return s;
  // A pixel must have had rays for every effect.
  std::uint32_t step = 1, offset = 0;
  for (const auto& effect : active_) {
    if (!effect->gradient || effect->settings.pixel_step == 1) continue;
    step = effect->settings.pixel_step;
    offset = pixel_offset(effect->settings, past_index_);
  }
  return run_gradients("past samples", gradients_->bytes(),
                       [&](auto& list) { gradients_->record_samples(list, frame_, step, offset); });
}

rtapi::Status FrameRenderer::repeat_samples(const Active& effect) {
  if (!effect.gradient) return {};
  const EffectSettings& settings = effect.settings;
  const PassConstants constants = {.first_sample = first_sample(settings, past_index_),
                                   .sample_count = settings.samples,
                                   .radius = settings.radius};
  const PassArguments arguments =
      effect.past_views ? PassArguments(*effect.past_views, settings.constants) : PassArguments{};
  return run_gradients(effect.title + " again", 0, [&](auto& list) {
    if (gradients_->has_past()) gradients_->record_again(list, effect.pass, constants, arguments);
  });
}

// Behind the effects, before their signals are denoised.
rtapi::Status FrameRenderer::finish_gradients() {
  if (!gradients_) return {};
  past_index_ = moment_.index;
  return run_gradients("temporal gradients", gradients_->bytes(), [&](auto& list) {
    if (gradients_->has_past()) gradients_->record_changes(list, frame_);
    gradients_->record_keep(list, frame_);
  });
}

}  // namespace kaamos::effects
