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
  bool is_mirror = true;       ///< all that lies in it is; else lamps are seen as lights there
};

/// The most planes that PlanarConstants can ask for: their pictures stand side by side.
inline constexpr std::uint32_t kMostMirrorPlanes = 8;

/// How planes' pictures are made. They are the same, but for pixels at edges.
enum class PlanarSource : std::uint32_t {
  kRays,   ///< a ray for each texel
  kDraws,  ///< draws of the mirrored scene, which are then shaded [Vulkan: needs graphics
           ///< pipelines]
};

/// Constants b0, space3.
struct PlanarConstants {
  float longest = 200.0f;                     ///< metres behind the plane that are seen
  SunAtHits sun_at_hits = SunAtHits::kByRay;  ///< ReflectionConstants::sun_at_hits
  PlanarSource source = PlanarSource::kRays;  ///< of planes' pictures
  std::uint32_t fallback = 2;  ///< of other surfaces: 0: none, 2: the environment map
  /// Rougher surfaces show the fallback: they mirror too much of what the picture of a plane lacks.
  float roughest = 0.5f;
  std::uint32_t most_planes = 4;  ///< at most kMostMirrorPlanes
  std::uint32_t taps = 16;        ///< directions of a rough surface
  std::uint32_t plane_count = 0;  ///< set by the pass
  std::uint32_t plane = 0;        ///< set by the pass
  std::uint32_t width = 0;        ///< of a plane's picture; 0: the frame's
  std::uint32_t height = 0;       ///< likewise
  std::uint32_t level = 0;        ///< set by the pass
  std::uint32_t draw = 0;         ///< set by the pass
  float clip_scale = 0;           ///< set by the pass
};

/// The planes that triangles of a scene's opaque surfaces lie in, at most constants.most_planes:
/// those of the most area, in which a surface counts as much as the square of its smoothness (1 -
/// roughness, the mean of its texture). Left out are surfaces beyond constants.roughest and planes
/// smaller than a thousandth of the square of the scene's size. They are taken where they are at
/// the beginning.
std::vector<MirrorPlane> find_mirror_planes(const Scene& scene,
                                            const PlanarConstants& constants = {});

/// The pass: each plane's picture, its mips, then a look-up. Register u0 of space3 is
/// no sum: radiance as reflections_pass has it. EffectNeeds::lights and volume are needed.
/// @errors KA3072 a picture that is larger than the frame's; those of EnvironmentFallback::create,
/// of RayPass::create and, for draws, of ScenePipeline::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_planar_reflections(const EffectScope& scope);
/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> planar_reflections_library();

}  // namespace kaamos::effects
