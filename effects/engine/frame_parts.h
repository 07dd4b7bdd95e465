// SPDX-License-Identifier: MIT
/// @file
/// The pictures of effects that make up a frame's radiance.
#pragma once

#include <rtapi/rtapi.h>

namespace kaamos::effects {

/// The pictures that the whole frame is put together from: R32G32B32A32_FLOAT, null where an effect
/// was not rendered.
struct FrameParts {
  const rtapi::Texture* sun_visibility = nullptr;  ///< 0 to 1
  /// Colour that glass gives to the sun's light; none: it casts no shadow.
  const rtapi::Texture* sun_tint = nullptr;
  const rtapi::Texture* ambient = nullptr;       ///< where there is no `indirect`: dims the sky
  const rtapi::Texture* bent_normal = nullptr;   ///< beside `ambient`: from where the sky is seen
  const rtapi::Texture* local_lights = nullptr;  ///< radiance
  const rtapi::Texture* indirect = nullptr;      ///< irradiance over pi
  const rtapi::Texture* reflection = nullptr;    ///< radiance over the specular albedo
  /// Without `reflection`: surfaces are so rough that they reflect about what they get from all
  /// sides, `indirect` or the sky.
  bool is_matte = false;
};

}  // namespace kaamos::effects
