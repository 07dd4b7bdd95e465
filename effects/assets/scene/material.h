// SPDX-License-Identifier: MIT
/// @file
/// Materials, textures and samplers as the effects' shaders read them. They are bindless: one
/// element of a structured buffer per material, and an unbounded array of textures. [Northlight
/// deck: Bindless Access to Materials]
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace kaamos::effects {

/// Slot of a texture within a material.
enum TextureSlot : std::uint32_t {
  kBaseColorTexture,          ///< sRGB; alpha is opacity
  kMetallicRoughnessTexture,  ///< linear; G roughness, B metallic
  kNormalTexture,             ///< linear; tangent space, +Y up
  kEmissiveTexture,           ///< sRGB
  kSpecularTexture,           ///< linear; alpha scales `specular`
  kSpecularColorTexture,      ///< sRGB; scales `specular_color`
  kTextureSlotCount
};

/// Bits of MaterialConstants::flags. [glTF 2.0: material]
enum MaterialFlags : std::uint32_t {
  kMaterialMask = 1u << 0,         ///< alphaMode MASK: fully open below alpha_cutoff
  kMaterialBlend = 1u << 1,        ///< alphaMode BLEND
  kMaterialDoubleSided = 1u << 2,  ///< back faces are shaded, with the normal turned
  /// Any-hit shaders of visibility rays test alpha against alpha_cutoff. Set for MASK, and for
  /// BLEND whose base colour texture is cut out (cutoff 0.5: shadow and AO rays know only open or
  /// closed). What else has BLEND is glass.
  kMaterialAlphaTested = 1u << 3,
  /// Shows its base colour as it is, whatever light falls on it: upload_scene makes it emission, of
  /// a radiance that the exposure takes back, and takes reflection away. [KHR_materials_unlit]
  kMaterialUnlit = 1u << 4,
  /// What a model of its own would show better than the unified one, which all effects but
  /// effects/materials take for it. At most one of them.
  ///@{
  kMaterialSkin = 1u << 5,
  kMaterialEye = 1u << 6,
  kMaterialHair = 1u << 7,
  ///@}
};

/// A texture slot without an image.
inline constexpr std::int32_t kNoTexture = -1;

/// One element of the materials' StructuredBuffer; HLSL packs it without gaps, as C++ does.
/// Colours are linear.
struct MaterialConstants {
  glm::vec4 base_color{1.0f};  ///< factor; alpha is opacity
  glm::vec3 emissive{0.0f};    ///< factor, may exceed 1
  float metallic = 0.0f;       ///< factor, 0..1
  float roughness = 1.0f;      ///< factor, perceptual (alpha = roughness^2), 0..1
  float alpha_cutoff = 0.5f;   ///< open where alpha < alpha_cutoff
  float normal_scale = 1.0f;   ///< scales x and y of the normal texture
  std::uint32_t flags = 0;     ///< MaterialFlags
  /// What is no metal reflects dielectric_f0 times specular_color, at most 1, times `specular` of
  /// light that comes straight at it, and `specular` of light that grazes it.
  /// [KHR_materials_specular]
  ///@{
  glm::vec3 specular_color{1.0f};
  float specular = 1.0f;        ///< 0..1
  float dielectric_f0 = 0.04f;  ///< ((ior - 1) / (ior + 1))^2, 0..1 [KHR_materials_ior]
  ///@}
  std::uint32_t second_uv = 0;  ///< bit per TextureSlot: read with Mesh::second_uv
  /// Index into Scene::images per TextureSlot, or kNoTexture.
  std::array<std::int32_t, kTextureSlotCount> image{kNoTexture, kNoTexture, kNoTexture,
                                                    kNoTexture, kNoTexture, kNoTexture};
  /// Index into Scene::samplers per TextureSlot; 0 where there is no texture.
  std::array<std::uint32_t, kTextureSlotCount> sampler{};
  /// KHR_texture_transform per TextureSlot: u' = dot(m.xy, uv) + offset.x, v' = dot(m.zw, uv) +
  /// offset.y.
  std::array<glm::vec4, kTextureSlotCount> uv_matrix{glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1),
                                                     glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1),
                                                     glm::vec4(1, 0, 0, 1), glm::vec4(1, 0, 0, 1)};
  std::array<glm::vec2, kTextureSlotCount> uv_offset{};  ///< see uv_matrix
  /// Level of detail at which the image is one texel, log2(width * height) / 2, per TextureSlot.
  /// upload_scene sets it.
  std::array<float, kTextureSlotCount> one_texel_level{};
};
static_assert(sizeof(MaterialConstants) == 288);
static_assert(offsetof(MaterialConstants, image) == 72);
static_assert(offsetof(MaterialConstants, uv_matrix) == 120);
static_assert(offsetof(MaterialConstants, uv_offset) == 216);
static_assert(offsetof(MaterialConstants, one_texel_level) == 264);

/// A material with its name, which the GPU does not see.
struct Material {
  std::string name;             ///< for people and for overrides
  MaterialConstants constants;  ///< what shaders read
};

/// The rule for texels outside of an image. [glTF 2.0: sampler]
enum class Wrap : std::uint8_t { kRepeat, kMirror, kClamp };
/// The way in which texels, or mip levels, are mixed. [glTF 2.0: sampler]
enum class Filter : std::uint8_t { kNearest, kLinear };

/// glTF's sampler words; the defaults are glTF's.
struct Sampler {
  /// Along u and v.
  ///@{
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  ///@}
  Filter min_filter = Filter::kLinear;  ///< where the image is reduced
  Filter mag_filter = Filter::kLinear;  ///< where it is enlarged
  Filter mip_filter = Filter::kLinear;  ///< between levels
  bool mipmapped = true;                ///< false: only level 0 is read

  /// True if all members are equal.
  friend bool operator==(const Sampler&, const Sampler&) = default;
};

}  // namespace kaamos::effects
