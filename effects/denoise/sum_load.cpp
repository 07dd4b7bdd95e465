// SPDX-License-Identifier: MIT
#include "effects/denoise/sum_load.h"

#include "effects/denoise/denoise.h"

namespace kaamos::effects {

rtapi::Result<SumLoad> SumLoad::create(const rtapi::Device& device, const Frame& frame,
                                       const DenoiseLibraries& libraries, const rtapi::Texture& sum,
                                       const rtapi::Texture& into, std::uint32_t step) {
  const bool scalar = sum.GetDesc().Format == rtapi::Format::kR32Float;
  const auto& library = step == 2 ? libraries.upscale : libraries.spatial;
  const char* const name = step == 2 ? (scalar ? "UpscaleScalar" : "UpscaleColor")
                                     : (scalar ? "LoadScalar" : "LoadColor");
  const auto pass = libraries.pipelines->get(device, frame, library, name);
  if (!pass) return pass.error();
  auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  if (const auto s = views->set_unordered_access(1, into); !s) return s.error();
  if (const auto s = views->set_unordered_access(scalar ? 2 : 0, sum); !s) return s.error();
  SumLoad out;
  out.sum_ = sum;
  out.pass_ = *pass;
  out.views_ = *views;
  return out;
}

void SumLoad::record(rtapi::CommandList& list, const Frame& frame, float scale,
                     std::uint32_t pixel_offset) const {
  DenoiseConstants constants;
  constants.scale = scale;
  constants.pixel_offset = pixel_offset;
  pass_->dispatch(list, frame, {}, PassArguments(views_, constants), frame.width(), frame.height());
}

}  // namespace kaamos::effects
