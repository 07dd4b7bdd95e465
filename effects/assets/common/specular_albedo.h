// SPDX-License-Identifier: MIT
/// @file
/// Directional albedo of the specular lobe: the part of uniform light that GGX with Schlick's
/// Fresnel term reflects towards a view direction. The diffuse lobe has the rest.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace kaamos::effects {

/// Size of split_albedo_table. effects/shaders/frame.hlsli has the same numbers.
///@{
inline constexpr std::uint32_t kSpecularAlbedoCosines = 32;
inline constexpr std::uint32_t kSpecularAlbedoRoughnesses = 32;
///@}

/// Integral over the hemisphere, split into what F0 is multiplied by (x) and what is added (y).
/// `cosine` is that of the view direction with the normal, 0 to 1; `roughness` is perceptual, 0
/// (a mirror) to 1. Single scattering: what facets reflect onto other facets is lost. The error is
/// below 0.0025, and below 0.001 where the cosine is at least 0.1.
glm::dvec2 integrate_specular_albedo(double cosine, double roughness);

/// integrate_specular_albedo at the corners of a grid over sqrt(cosine), which runs fastest, and
/// roughness, both from 0 to 1. It is made at the first call, in some 40 ms.
const std::vector<glm::vec2>& split_albedo_table();

/// SpecularAlbedo of effects/shaders/brdf.hlsli: interpolated from the table.
glm::vec3 specular_albedo(const glm::vec3& f0, float roughness, float cosine);

}  // namespace kaamos::effects
