// SPDX-License-Identifier: MIT
#include "effects/composition/composite/kept_radiance.h"

namespace kaamos::effects {

rtapi::Result<KeptRadiance> KeptRadiance::create(const rtapi::Device& device, const Frame& frame,
                                                 const rtapi::ShaderLibrary& library) {
  KeptRadiance out;
  const auto keep = ComputePass::create(device, frame, library, "KeepRadiance");
  if (!keep) return keep.error();
  out.keep_ = *keep;
  const auto forget = ComputePass::create(device, frame, library, "ForgetRadiance");
  if (!forget) return forget.error();
  out.forget_ = *forget;
  const auto picture =
      frame.create_picture(device, "kept radiance", rtapi::Format::kR32G32B32A32Float);
  if (!picture) return picture.error();
  out.picture_ = *picture;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  if (const auto s = out.views_.set_unordered_access(0, out.picture_); !s) return s.error();
  return out;
}

void KeptRadiance::record(rtapi::CommandList& list, const Frame& frame) const {
  keep_.dispatch(list, frame, {}, PassArguments(views_), frame.width(), frame.height());
}

void KeptRadiance::record_nothing(rtapi::CommandList& list, const Frame& frame) const {
  forget_.dispatch(list, frame, {}, PassArguments(views_), frame.width(), frame.height());
}

}  // namespace kaamos::effects
