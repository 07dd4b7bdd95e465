// SPDX-License-Identifier: MIT
/// @file
/// Light of the volume at each surface, times ground-truth ambient occlusion from the depth
/// picture. [GDC 2018 talk; Northlight deck: Indirect Diffuse Illumination]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/compute_pass.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"

namespace kaamos::effects {

/// Settings of the search for occluders.
struct OccludedVolumeSettings {
  GtaoConstants occlusion;                   ///< of the technique
  float radius = kDefaultScreenSpaceRadius;  ///< how far occluders reach, metres; 0: none
};

/// The shaders of occluded_volume.hlsl that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> occluded_volume_library();

/// The passes over one frame.
class OccludedVolume {
 public:
  /// Makes the passes and their pictures. `views` must hold the result, R32G32B32A32_FLOAT, at
  /// register u0, and the volume [GpuVolume::bind]; other registers are set here. It must outlive
  /// the passes. `settings`: those of record. `library`: of occluded_volume.hlsl; `gtao` and
  /// `filter`: those of ScreenSpaceAo.
  /// @errors those of ScreenSpaceAo::create and of the device.
  static rtapi::Result<OccludedVolume> create(const rtapi::Device& device, const Frame& frame,
                                              const rtapi::ShaderLibrary& library,
                                              const rtapi::ShaderLibrary& gtao,
                                              const rtapi::ShaderLibrary& filter, PassViews& views,
                                              const OccludedVolumeSettings& settings);
  /// [ScreenSpaceAo::begin_frame]
  /// @errors those of PassViews::set_unordered_access.
  rtapi::Status begin_frame() { return occlusion_.begin_frame(); }

  /// Records the whole picture, behind the G-buffer: irradiance over pi.
  void record(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
              const OccludedVolumeSettings& settings);
  /// Bytes of the pictures between the passes.
  std::uint64_t bytes() const;

 private:
  OccludedVolume() = default;

  PassViews* views_ = nullptr;
  std::unique_ptr<PassViews> occlusion_views_;  // stays where the occlusion's passes look for it
  rtapi::Texture picture_, bent_;
  ScreenSpaceAo occlusion_;
  ComputePass times_;
};

}  // namespace kaamos::effects
