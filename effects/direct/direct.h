// SPDX-License-Identifier: MIT
// Main lighting: the light of the local lights at each pixel. [effects-spec A22, B2.12]
#pragma once

#include <rtapi/rtapi.h>

#include "effects/frame/compute_pass.h"
#include "effects/frame/frame.h"
#include "effects/lights/lighting.h"

namespace kaamos::effects {

rtapi::Result<rtapi::ShaderLibrary> direct_library();

class DirectLighting {
 public:
  /// Errors: those of the device.
  static rtapi::Result<DirectLighting> create(const rtapi::Device& device, const Frame& frame,
                                              const Lighting& lighting,
                                              const rtapi::ShaderLibrary& library);
  /// All lights with their shadow maps; or all but the two strongest of each pixel, which are named
  /// in strongest() and wait for add_strongest.
  void dispatch(rtapi::CommandList& list, const Frame& frame, bool leave_out_strongest) const;
  /// total() = direct() + the two lights, times their contact shadow.
  void add_strongest(rtapi::CommandList& list, const Frame& frame) const;
  /// The contact shadow that add_strongest reads: visibility, r point light, g spot light.
  rtapi::Status set_contact(const rtapi::Texture& contact);

  /// Of all that the two passes read and write besides the G-buffer, the lights' lists and maps
  /// too.
  std::uint64_t bytes() const { return views_.bytes(); }

  const rtapi::Texture& direct() const { return direct_; }        ///< R32G32B32A32_FLOAT
  const rtapi::Texture& strongest() const { return strongest_; }  ///< R32G32_UINT
  const rtapi::Texture& total() const { return total_; }          ///< R32G32B32A32_FLOAT

 private:
  rtapi::Texture direct_, strongest_, total_;
  ComputePass main_, add_;
  PassViews views_;
};

}  // namespace kaamos::effects
