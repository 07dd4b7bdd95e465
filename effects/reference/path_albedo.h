// SPDX-License-Identifier: MIT
/// @file
/// Directional albedo of the reference's specular lobe, tabulated by quadrature.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace kaamos::effects {

/// Size of the table. Mirrored in path_material.hlsli.
///@{
inline constexpr std::uint32_t kAlbedoCosines = 64;
inline constexpr std::uint32_t kAlbedoRoughnesses = 32;
///@}
/// Up to this roughness a surface is a mirror, which needs no table.
inline constexpr float kPathMirrorRoughness = 0.03f;

/// Returns x and y of the part f0 * x + y of even light that a GGX lobe reflects: single
/// scattering, Smith's height-correlated shadowing, Schlick's Fresnel term. `cosine`: of the view,
/// above 0; `roughness`: perceptual, above kPathMirrorRoughness. `steps`: along each of two axes of
/// the quadrature.
glm::dvec2 specular_parts(double roughness, double cosine, std::uint32_t steps = 32);

/// The same for all: rows by the square root of the roughness's place between kPathMirrorRoughness
/// and 1, in each the square root of the cosine, both evenly from 0 to 1.
std::vector<glm::vec2> specular_albedo_table();

}  // namespace kaamos::effects
