// SPDX-License-Identifier: MIT
/// @file
/// Ambient occlusion that is traced once, into texels on the triangles of what stands still.
/// [survey 7; Yuksel, Keyser & House 2010, Mesh Colors]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>

#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

/// EffectSettings::constants of make_baked_ao. They hold for the pass's life.
struct BakedAoConstants {
  float texel = 0.1f;       ///< metres between texels along a triangle's edges, above 0
  std::uint32_t rays = 64;  ///< of a texel
  /// Texels that a scene has at most, besides one for each triangle. `texel` is doubled until that
  /// holds.
  std::uint32_t most_texels = 1 << 18;
};

/// Parts of an edge of `edge` metres between texels, at most 1,024; 0: one texel in the middle,
/// where the edge is shorter than half a texel.
std::uint32_t baked_cells(double edge, double texel);

/// Visibility within EffectSettings::radius: register u0 of space3 is no sum. What moves, glass and
/// lamps' shapes neither occlude nor are occluded. A record with another radius bakes anew.
/// @errors KA3049 a texel that is no length; those of the device.
rtapi::Result<std::unique_ptr<EffectPass>> make_baked_ao(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> baked_ao_library();

}  // namespace kaamos::effects
