// SPDX-License-Identifier: MIT
// The frame's radiance before it has reflections, for effects that find them in the picture.
#include <algorithm>

#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kKeptRadianceRegister = 19;  // u, space3

}  // namespace

rtapi::Status FrameRenderer::create_radiance() {
  if (std::none_of(active_.begin(), active_.end(),
                   [](const auto& effect) { return is_late(*effect); })) {
    return {};
  }
  const auto kept =
      KeptRadiance::create(device_, frame_, libraries_.at("composition/composite/composite"));
  if (!kept) return kept.error();
  kept_ = *kept;
  return forget_radiance();
}

rtapi::Status FrameRenderer::forget_radiance() {
  const auto done = execute([&](rtapi::CommandList& list) { kept_->record_nothing(list, frame_); });
  if (!done) return done.error();
  return {};
}

rtapi::Status FrameRenderer::add_radiance(PassViews& views) const {
  return views.set_unordered_access(kKeptRadianceRegister, kept_->picture());
}

void FrameRenderer::record_unreflected(rtapi::CommandList& list) const {
  record_strongest_lights(list);
  compose_unreflected_->dispatch(list, frame_);
}

rtapi::Status FrameRenderer::find_radiance() {
  if (!has_effects_) {
    const auto rendered = render();
    if (!rendered) return rendered.error();
  }
  const auto done = execute([&](rtapi::CommandList& list) { record_unreflected(list); });
  if (!done) return done.error();
  return {};
}

void FrameRenderer::record_early(rtapi::CommandList& list) {
  if (is_early_done_) return;
  filters_.record_some(list, frame_, false);
  record_unreflected(list);
  is_early_done_ = true;
}

void FrameRenderer::record_filters(rtapi::CommandList& list) {
  if (!is_early_done_) filters_.record_some(list, frame_, false);
  filters_.record_some(list, frame_, true);
  is_early_done_ = false;
}

}  // namespace kaamos::effects
