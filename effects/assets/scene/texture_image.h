// SPDX-License-Identifier: MIT
/// @file
/// Pictures of materials: 8-bit RGBA with a mip chain.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace kaamos::effects {

/// RGBA, 8 bits each, row 0 on top (glTF's v = 0). `srgb`: colour is stored sRGB-encoded and is
/// decoded when sampled (alpha never is).
struct TextureImage {
  std::string name;          ///< for messages
  std::uint32_t width = 0;   ///< texels of level 0
  std::uint32_t height = 0;  ///< texels of level 0
  bool srgb = false;         ///< colour is sRGB-encoded
  /// mips[0] has width * height * 4 bytes; each level halves both sides (rounded down, at least 1).
  std::vector<std::vector<std::uint8_t>> mips;
};

/// Colour of one texel of one level, decoded to linear. Coordinates must lie in that level.
glm::vec4 texel(const TextureImage& image, std::uint32_t level, std::uint32_t x, std::uint32_t y);

/// True where at least one texel of level 0 is not fully opaque.
bool has_alpha(const TextureImage& image);

/// True where all but a twentieth of the texels of level 0 are either opaque or clear, to 8 of 255,
/// as those of leaves and fences are.
bool is_cut_out(const TextureImage& image);

/// Part of the texels of a level whose alpha times `scale` reaches `cutoff`.
float alpha_coverage(const TextureImage& image, std::uint32_t level, float cutoff,
                     float scale = 1.0f);

/// Replaces levels 1.. by averages of level 0. Colours are averaged linear, weighted by alpha so
/// that hidden texels do not bleed. With `alpha_cutoff`, alpha of each level is scaled so that the
/// share of texels passing the test stays that of level 0: leaves do not thin out with distance
/// [Castano 2010, Computing Alpha Mipmaps].
void generate_mips(TextureImage& image, std::optional<float> alpha_cutoff = std::nullopt);

}  // namespace kaamos::effects
