// SPDX-License-Identifier: MIT
#include "effects/composition/enlarge/enlarge.h"

#include <shaders/enlarge.h>

#include <cmath>
#include <utility>

#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

std::uint32_t enlarged(std::uint32_t pixels, float factor) {
  return static_cast<std::uint32_t>(std::lround(static_cast<double>(pixels) * factor));
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> enlarge_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_enlarge());
}

rtapi::Result<Enlarger> Enlarger::create(const rtapi::Device& device, const Frame& frame,
                                         const rtapi::ShaderLibrary& library, float factor,
                                         const EnlargeConstants& constants) {
  Enlarger out;
  out.constants_ = constants;
  auto pass = ComputePass::create(device, frame, library, "Enlarge");
  if (!pass) return pass.error();
  out.pass_ = std::move(*pass);
  auto picture = create_picture(device, "enlarged", rtapi::Format::kR32G32B32A32Float,
                                enlarged(frame.width(), factor), enlarged(frame.height(), factor));
  if (!picture) return picture.error();
  out.result_ = std::move(*picture);
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = std::move(*views);
  if (const auto s = out.views_.set_unordered_access(1, out.result_); !s) return s.error();
  return out;
}

rtapi::Status Enlarger::bind(const rtapi::Texture& source) {
  return views_.set_unordered_access(0, source);
}

void Enlarger::dispatch(rtapi::CommandList& list, const Frame& frame) const {
  const rtapi::TextureDesc& desc = result_.GetDesc();
  pass_.dispatch(list, frame, {}, PassArguments(views_, constants_), desc.Width, desc.Height);
}

}  // namespace kaamos::effects
