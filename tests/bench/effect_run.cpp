// SPDX-License-Identifier: MIT
#include "effect_run.h"

namespace kaamos::bench {

using namespace effects;

EffectRun::EffectRun(const std::string& effect, Fixtures& fixtures, RayOrder order)
    : effect_(effect) {
  rtapi::DeviceDesc desc;
  desc.Threads = fixtures.threads();
  FrameSettings settings;
  settings.width = fixtures.options().width;
  settings.height = fixtures.options().height;
  settings.effects = choose_effects({effect});
  settings.whole_frame = need_whole_frame(settings.effects);
  settings.order = order;
  settings.volume.given = std::make_shared<IndirectVolume>();
  renderer_ =
      FrameRenderer::create(rtapi::CreateDevice(desc).value(), fixtures.scene().scene, settings)
          .value();
  renderer_->run(effect, 1).value();  // the G-buffer and the lights are there then
  list_ = renderer_->device().CreateCommandList().value();
  sort();
}

void EffectRun::sort() {
  list_.Reset().value();
  renderer_->effects().record_sort(list_, effect_);
  renderer_->queue().ExecuteAndWait(list_).value();
}

void EffectRun::trace(bool sorted, uint32_t samples) {
  list_.Reset().value();
  renderer_->record(list_, effect_, {.samples = samples, .is_sorted = sorted});
  renderer_->queue().ExecuteAndWait(list_).value();
}

}  // namespace kaamos::bench
