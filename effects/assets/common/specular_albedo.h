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

/// integrate_specular_albedo (albedo_integral.h) at the corners of a grid over sqrt(cosine), which
/// runs fastest, and roughness, both from 0 to 1.
const std::vector<glm::vec2>& split_albedo_table();

/// SpecularAlbedo of effects/shaders/brdf.hlsli: interpolated from the table.
glm::vec3 specular_albedo(const glm::vec3& f0, float roughness, float cosine);

}  // namespace kaamos::effects
