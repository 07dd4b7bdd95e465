// SPDX-License-Identifier: MIT
#include "effects/composition/taa/taa.h"

#include <shaders/taa.h>

#include <string>

namespace kaamos::effects {
namespace {

float radical_inverse(std::uint32_t base, std::uint32_t index) {
  double digit = 1.0, value = 0.0;
  for (; index > 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return static_cast<float>(value);
}

}  // namespace

glm::vec2 taa_jitter(std::uint32_t index) {
  const std::uint32_t i = index % kTaaJitterPeriod + 1;  // point 0 is a corner of the pixel
  return {radical_inverse(2, i) - 0.5f, radical_inverse(3, i) - 0.5f};
}

rtapi::Result<rtapi::ShaderLibrary> taa_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_taa());
}

rtapi::Result<TemporalAntialiasing> TemporalAntialiasing::create(
    const rtapi::Device& device, const Frame& frame, const rtapi::ShaderLibrary& library,
    const TaaConstants& constants) {
  TemporalAntialiasing out;
  out.constants_ = constants;
  const auto pass = ComputePass::create(device, frame, library, "Resolve");
  if (!pass) return pass.error();
  out.pass_ = *pass;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const std::string number = std::to_string(i);
    const auto picture =
        frame.create_picture(device, "taa " + number, rtapi::Format::kR32G32B32A32Float);
    if (!picture) return picture.error();
    out.pictures_[i] = *picture;
    const auto surface =
        frame.create_picture(device, "taa surface " + number, rtapi::Format::kR32G32B32A32Float);
    if (!surface) return surface.error();
    out.surfaces_[i] = *surface;
  }
  for (std::uint32_t i = 0; i < 2; ++i) {
    const auto views = frame.create_pass_views(device);
    if (!views) return views.error();
    out.views_[i] = *views;
    const rtapi::Texture* const bound[] = {&out.pictures_[1 - i], &out.pictures_[i],
                                           &out.surfaces_[1 - i], &out.surfaces_[i]};
    for (std::uint32_t u = 0; u < 4; ++u) {
      if (const auto s = out.views_[i].set_unordered_access(u, *bound[u]); !s) return s.error();
    }
  }
  return out;
}

void TemporalAntialiasing::dispatch(rtapi::CommandList& list, const Frame& frame) {
  written_ = 1 - written_;
  TaaConstants constants = constants_;
  constants.history_valid = frames_ > 0 ? 1 : 0;
  pass_.dispatch(list, frame, {}, PassArguments(views_[written_], constants), frame.width(),
                 frame.height());
  ++frames_;
}

}  // namespace kaamos::effects
