// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/occluded_volume.h"

#include <shaders/occluded_volume.h>

#include <utility>

#include "effects/engine/picture.h"

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> occluded_volume_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_occluded_volume());
}

rtapi::Result<OccludedVolume> OccludedVolume::create(
    const rtapi::Device& device, const Frame& frame, const rtapi::ShaderLibrary& library,
    const rtapi::ShaderLibrary& gtao, const rtapi::ShaderLibrary& filter, PassViews& views,
    const OccludedVolumeSettings& settings) {
  OccludedVolume out;
  out.views_ = &views;
  const auto times = ComputePass::create(device, frame, library, "OccludeVolume");
  if (!times) return times.error();
  out.times_ = *times;
  const auto picture =
      frame.create_picture(device, "occlusion of the volume", rtapi::Format::kR32G32B32A32Float);
  if (!picture) return picture.error();
  out.picture_ = *picture;
  const auto own = frame.create_pass_views(device);
  if (!own) return own.error();
  out.occlusion_views_ = std::make_unique<PassViews>(*own);
  if (const auto s = out.occlusion_views_->set_unordered_access(0, out.picture_); !s) {
    return s.error();
  }
  if (const auto s = views.set_unordered_access(1, out.picture_); !s) return s.error();
  if (settings.occlusion.bent_normals != 0) {
    const auto bent = frame.create_picture(device, "bent normals of the volume",
                                           rtapi::Format::kR32G32B32A32Float);
    if (!bent) return bent.error();
    out.bent_ = *bent;
    if (const auto s = out.occlusion_views_->set_unordered_access(3, out.bent_); !s) {
      return s.error();
    }
    if (const auto s = views.set_unordered_access(2, out.bent_); !s) return s.error();
  }
  auto occlusion = ScreenSpaceAo::create(
      device, frame, ScreenSpaceAoKind::kGtao, gtao, filter, *out.occlusion_views_,
      PassArguments(*out.occlusion_views_, settings.occlusion).words);
  if (!occlusion) return occlusion.error();
  out.occlusion_ = std::move(*occlusion);
  return out;
}

void OccludedVolume::record(rtapi::CommandList& list, const Frame& frame,
                            const PassConstants& constants,
                            const OccludedVolumeSettings& settings) {
  PassConstants of_radius = constants;
  of_radius.radius = settings.radius;
  occlusion_.record(list, frame, of_radius,
                    PassArguments(*occlusion_views_, settings.occlusion).words);
  const std::uint32_t is_bent = settings.occlusion.bent_normals;
  times_.dispatch(list, frame, constants, PassArguments(*views_, is_bent), frame.width(),
                  frame.height());
}

std::uint64_t OccludedVolume::bytes() const {
  return occlusion_.bytes() + picture_bytes(picture_) + (bent_ ? picture_bytes(bent_) : 0);
}

}  // namespace kaamos::effects
