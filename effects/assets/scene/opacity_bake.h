// SPDX-License-Identifier: MIT
/// @file
/// Opacity micromaps from the alpha of a texture. In four states they are conservative: where a
/// micro-triangle is opaque or transparent, the alpha test of every one of its points says the
/// same, so that pictures do not change; the rest is unknown. [DXR: Opacity micromaps]
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "effects/assets/scene/material.h"
#include "effects/assets/scene/texture_image.h"

namespace kaamos::effects {

/// An alpha test as shaders make it: a hole where `factor` times the texture's alpha is below
/// `cutoff`. Textures are read at level 0, filtered or not.
struct AlphaTest {
  const TextureImage* image = nullptr;  ///< null: alpha is 1 everywhere
  Sampler sampler;                      ///< its wrap and filters count
  /// u' = dot(m.xy, uv) + offset.x, v' = dot(m.zw, uv) + offset.y.
  ///@{
  glm::vec4 uv_matrix{1, 0, 0, 1};
  glm::vec2 uv_offset{0};
  ///@}
  float factor = 1.0f;  ///< MaterialConstants::base_color.a
  float cutoff = 0.5f;  ///< MaterialConstants::alpha_cutoff
};

/// How finely triangles are divided.
struct BakeOptions {
  bool two_states = false;       ///< nothing is unknown: what a micro-triangle mostly is
  std::uint32_t max_level = 7;   ///< 4^level micro-triangles at most, 0 to 12
  float texels_per_edge = 0.5f;  ///< the level has micro-triangles with edges of up to so many
};

/// One micromap of an array, laid out as rtapi::RaytracingOpacityMicromapDesc.
struct BakedMicromap {
  std::uint32_t byte_offset = 0;  ///< in BakedMicromaps::bits
  std::uint16_t level = 0;        ///< 4^level micro-triangles
  std::uint16_t format = 2;       ///< 1: two states, 2: four
};
static_assert(sizeof(BakedMicromap) == 8);

/// The micromaps of triangles. Triangles with the same texture coordinates share one.
struct BakedMicromaps {
  std::vector<std::uint8_t> bits;        ///< the states, in DXR's order
  std::vector<BakedMicromap> micromaps;  ///< of the array; may be empty
  /// By triangle: an element of `micromaps`, or -1 - s where all of it has state s.
  std::vector<std::int32_t> indices;
  /// Parts of the triangles' areas by state: transparent, opaque, unknown-transparent,
  /// unknown-opaque. Every triangle counts the same.
  std::array<double, 4> shares{};
};

/// Bakes the micromaps of triangles with these texture coordinates. The order of the corners is
/// that of the triangles' vertices.
BakedMicromaps bake_micromaps(std::span<const std::array<glm::vec2, 3>> triangles,
                              const AlphaTest& test, const BakeOptions& options = {});

}  // namespace kaamos::effects
