// SPDX-License-Identifier: MIT
/// @file
/// Main lighting: the light of the local lights at each pixel. [survey 5.3.1]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"
#include "effects/light/lights/lighting.h"

namespace kaamos::effects {

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> direct_library();

/// The way a light's shadow map and its contact shadow become its visibility. [survey 5.3.1]
enum class ContactCombination : std::uint32_t {
  kProduct,  ///< as Control does; where both see the same penumbra, it counts twice
  kMinimum,  ///< the darker of the two; where they see different occluders, one of them counts
  kAlone,    ///< the shadow map does not count; for visibility that is whole without it
};

/// The lights that main lighting looks at for a pixel. What it finds is the same. [Northlight deck:
/// Light Culling; survey 5.3.1]
enum class LightCulling : std::uint32_t {
  kClusters,  ///< those of the pixel's cluster
  kFrustum,   ///< all whose reach touches the camera's frustum
};

/// The two passes of the local lights: all of them, or the two strongest of each pixel later, when
/// their contact shadows are known.
class DirectLighting {
 public:
  /// Makes the two passes and their pictures of the frame's size. `lighting` is that of the frame.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without the passes.
  static rtapi::Result<DirectLighting> create(const rtapi::Device& device, const Frame& frame,
                                              const Lighting& lighting,
                                              const rtapi::ShaderLibrary& library);
  /// Records the first pass: all lights with their shadow maps; or all but the two strongest of
  /// each pixel, which are named in strongest() and wait for add_strongest.
  void dispatch(rtapi::CommandList& list, const Frame& frame, bool leave_out_strongest,
                LightCulling culling = LightCulling::kClusters) const;
  /// Records the second pass: total() = direct() + the two lights, each with shadow map and contact
  /// shadow.
  void add_strongest(rtapi::CommandList& list, const Frame& frame,
                     ContactCombination combination = ContactCombination::kProduct) const;
  /// Sets the contact shadow that add_strongest reads: visibility from 0 to 1, r of the point
  /// light, g of the spot light. It must outlive the dispatches.
  /// @errors those of PassViews::set_unordered_access.
  rtapi::Status set_contact(const rtapi::Texture& contact);

  /// Bytes of all that the two passes read and write besides the G-buffer, the lights' lists and
  /// maps too.
  std::uint64_t bytes() const { return views_.bytes(); }

  /// R32G32B32A32_FLOAT: radiance of the lights that dispatch took.
  const rtapi::Texture& direct() const { return direct_; }
  /// R32G32_UINT: the strongest point light and the strongest spot light of each pixel.
  const rtapi::Texture& strongest() const { return strongest_; }
  /// The lights that LightCulling::kFrustum found in the last dispatch: a word with their count,
  /// then their numbers.
  const rtapi::Buffer& lights_in_view() const { return in_view_; }
  /// R32G32B32A32_FLOAT: radiance of all local lights.
  const rtapi::Texture& total() const { return total_; }

 private:
  rtapi::Texture direct_, strongest_, total_;
  rtapi::Buffer in_view_;
  ComputePass cull_, main_, add_;
  PassViews views_;
};

}  // namespace kaamos::effects
