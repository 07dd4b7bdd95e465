// SPDX-License-Identifier: MIT
/// @file
/// Planar reflections: one more picture of the scene for each plane. [survey 6.1]
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "effects/engine/effect_pass.h"
#include "effects/light/lights/lighting.h"

namespace kaamos::effects {

/// A plane that mirrors, world space.
struct MirrorPlane {
  glm::dvec3 point{0.0};       ///< of it
  glm::dvec3 normal{0, 1, 0};  ///< unit; both sides mirror
  double area = 0;             ///< m^2, of what lies in it
};

/// The most planes of a frame.
inline constexpr std::size_t kMostMirrorPlanes = 4;

/// The planes of a scene's flat instances whose materials are mirrors (roughness up to 0.03, no
/// roughness texture), the largest first, at most kMostMirrorPlanes. Instances in one plane share
/// it. They are taken where they are at the beginning.
std::vector<MirrorPlane> find_mirror_planes(const Scene& scene);

/// Constants b0, space3. The last four words are the pass's own.
struct PlanarConstants {
  float longest = 200.0f;                     ///< metres behind the plane that are seen
  SunAtHits sun_at_hits = SunAtHits::kByRay;  ///< ReflectionConstants::sun_at_hits
  std::uint32_t plane_count = 0;              ///< set by the pass
  std::uint32_t fallback = 2;  ///< of other surfaces: 0: none, 2: the environment map
  std::uint32_t plane = 0;     ///< set by the pass
  std::uint32_t width = 0;     ///< of a plane's picture; 0: the frame's
  std::uint32_t height = 0;    ///< likewise
};

/// The pass: a ray for each texel of each plane's picture, then a look-up. Register u0 of space3 is
/// no sum: radiance as reflections_pass has it. EffectNeeds::lights and volume are needed.
/// @errors KA3072 a picture that is larger than the frame's; those of EnvironmentMap::create and of
/// RayPass::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_planar_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> planar_reflections_library();

}  // namespace kaamos::effects
