// SPDX-License-Identifier: MIT
#include "effects/composition/composite/composite.h"

#include <shaders/composite.h>

#include <iterator>

namespace kaamos::effects {

static constexpr std::uint32_t kFirstSum = 5;  // u, space3

rtapi::Result<rtapi::ShaderLibrary> composite_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_composite());
}

rtapi::Result<CompositePass> CompositePass::create(const rtapi::Device& device, const Frame& frame,
                                                   const rtapi::ShaderLibrary& library,
                                                   const FrameParts& sums) {
  const auto created = ComputePass::create(device, frame, library, "Composite");
  if (!created) return created.error();
  CompositePass pass;
  pass.pass_ = *created;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  pass.views_ = *views;
  const rtapi::Texture* const pictures[] = {sums.sun_visibility, sums.ambient};
  for (std::uint32_t i = 0; i < std::size(pictures); ++i) {
    if (pictures[i] == nullptr) continue;
    const auto s = pass.views_.set_unordered_access(kFirstSum + i, *pictures[i]);
    if (!s) return s.error();
  }
  return pass;
}

void CompositePass::dispatch(rtapi::CommandList& list, const Frame& frame,
                             const CompositeConstants& constants) const {
  PassConstants pass;
  pass.first_sample = constants.ao_samples;
  pass.sample_count = constants.sun_samples;
  pass_.dispatch(list, frame, pass, PassArguments(views_), frame.width(), frame.height());
}

// As in the shader, which heeds it without reflections only.
static constexpr std::uint32_t kIsMatte = 64, kHasBentNormal = 128, kBentNormalRegister = 7;

rtapi::Result<ComposePass> ComposePass::create(const rtapi::Device& device, const Frame& frame,
                                               const rtapi::ShaderLibrary& library,
                                               const FrameParts& parts) {
  ComposePass out;
  const auto pass = ComputePass::create(device, frame, library, "ComposeFrame");
  if (!pass) return pass.error();
  out.pass_ = *pass;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  // In the order of the registers and of the shader's bits.
  const rtapi::Texture* const pictures[] = {parts.sun_visibility, parts.ambient,
                                            parts.local_lights,   parts.indirect,
                                            parts.reflection,     parts.sun_tint};
  for (std::uint32_t i = 0; i < std::size(pictures); ++i) {
    if (pictures[i] == nullptr) continue;
    out.has_ |= 1u << i;
    if (const auto s = out.views_.set_unordered_access(i, *pictures[i]); !s) return s.error();
  }
  if (parts.is_matte) out.has_ |= kIsMatte;
  if (parts.bent_normal != nullptr) {
    out.has_ |= kHasBentNormal;
    const auto s = out.views_.set_unordered_access(kBentNormalRegister, *parts.bent_normal);
    if (!s) return s.error();
  }
  return out;
}

void ComposePass::dispatch(rtapi::CommandList& list, const Frame& frame) const {
  pass_.dispatch(list, frame, {}, PassArguments(views_, has_), frame.width(), frame.height());
}

}  // namespace kaamos::effects
