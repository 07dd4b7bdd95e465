// SPDX-License-Identifier: MIT
// Reads the samplers, pictures and materials of a glTF file.
#include <stb/stb_image.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_extensions.h"
#include "effects/assets/gltf/gltf_reader.h"
#include "effects/assets/gltf/gltf_webp.h"

namespace kaamos::effects {
namespace {

/// Largest side of a picture. Current GPUs take as much, and it bounds what a broken header can
/// request.
constexpr int kMaxImageSide = 16384;
/// Glass that is rougher would blur what is behind it.
constexpr float kSmoothGlass = 0.1f;

Wrap wrap_of(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::kClamp;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::kMirror;
  return Wrap::kRepeat;
}

Sampler sampler_of(const tinygltf::Sampler& from) {
  Sampler to;
  to.wrap_u = wrap_of(from.wrapS);
  to.wrap_v = wrap_of(from.wrapT);
  if (from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) to.mag_filter = Filter::kNearest;
  switch (from.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      to.min_filter = Filter::kNearest;
      to.mipmapped = false;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
      to.mipmapped = false;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
      to.min_filter = to.mip_filter = Filter::kNearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
      to.mip_filter = Filter::kNearest;
      break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
      to.min_filter = Filter::kNearest;
      break;
    default:
      break;
  }
  return to;
}

float number(double value, float fallback) {
  return std::isfinite(value) ? static_cast<float>(value) : fallback;
}

float factor(double value, float fallback) {
  return std::clamp(number(value, fallback), 0.0f, 1.0f);
}

double member(const tinygltf::Value& object, const char* key, std::size_t i, double fallback) {
  if (!object.Has(key)) return fallback;
  const tinygltf::Value& value = object.Get(key);
  if (value.IsNumber()) return value.GetNumberAsDouble();
  if (!value.IsArray() || i >= value.ArrayLen()) return fallback;
  const tinygltf::Value& item = value.Get(static_cast<int>(i));
  return item.IsNumber() ? item.GetNumberAsDouble() : fallback;
}

/// u' = T * R * S * uv. [KHR_texture_transform]
void texture_transform(const tinygltf::ExtensionMap& extensions, std::uint32_t slot,
                       MaterialConstants& to) {
  const auto found = extensions.find("KHR_texture_transform");
  if (found == extensions.end() || !found->second.IsObject()) return;
  const tinygltf::Value& t = found->second;
  const double angle = member(t, "rotation", 0, 0.0);
  const double sx = member(t, "scale", 0, 1.0), sy = member(t, "scale", 1, 1.0);
  const double c = std::cos(angle), s = std::sin(angle);
  to.uv_matrix[slot] =
      glm::vec4(number(c * sx, 1), number(s * sy, 0), number(-s * sx, 0), number(c * sy, 1));
  to.uv_offset[slot] =
      glm::vec2(number(member(t, "offset", 0, 0.0), 0), number(member(t, "offset", 1, 0.0), 0));
}

/// A texture that an extension of a material names; index -1: none.
tinygltf::TextureInfo texture_of(const tinygltf::Material& material, const char* extension,
                                 const char* name) {
  tinygltf::TextureInfo out;
  const auto found = material.extensions.find(extension);
  if (found == material.extensions.end() || !found->second.Has(name)) return out;
  const tinygltf::Value& info = found->second.Get(name);
  if (!info.IsObject()) return out;
  out.index = static_cast<int>(member(info, "index", 0, -1.0));
  out.texCoord = static_cast<int>(member(info, "texCoord", 0, 0.0));
  if (info.Has("extensions") && info.Get("extensions").IsObject()) {
    const tinygltf::Value& extensions = info.Get("extensions");
    for (const std::string& key : extensions.Keys()) out.extensions[key] = extensions.Get(key);
  }
  return out;
}

/// [KHR_materials_ior, KHR_materials_specular]
void read_reflectance(const tinygltf::Material& from, MaterialConstants& to) {
  if (const auto ior = from.extensions.find("KHR_materials_ior");
      ior != from.extensions.end() && ior->second.IsObject()) {
    const double n = member(ior->second, "ior", 0, 1.5);
    // 0 stands for endlessly large, as converted specular-glossiness materials have it.
    const double root = n == 0.0 ? 1.0 : (n - 1.0) / (n + 1.0);
    if (n == 0.0 || n >= 1.0) to.dielectric_f0 = number(root * root, 0.04f);
  }
  const auto specular = from.extensions.find("KHR_materials_specular");
  if (specular == from.extensions.end() || !specular->second.IsObject()) return;
  to.specular = factor(member(specular->second, "specularFactor", 0, 1.0), 1.0f);
  for (int i = 0; i < 3; ++i)
    to.specular_color[i] = std::max(0.0f, number(member(specular->second, "specularColorFactor",
                                                        static_cast<std::size_t>(i), 1.0),
                                                 1.0f));
}

constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";

/// No metal, of the specular colour's reflectance. [KHR_materials_pbrSpecularGlossiness]
void read_glossiness(const tinygltf::Value& from, MaterialConstants& to) {
  for (int i = 0; i < 4; ++i)
    to.base_color[i] =
        factor(member(from, "diffuseFactor", static_cast<std::size_t>(i), 1.0), 1.0f);
  for (int i = 0; i < 3; ++i)
    to.specular_color[i] =
        factor(member(from, "specularFactor", static_cast<std::size_t>(i), 1.0), 1.0f);
  to.metallic = 0.0f;
  to.roughness = 1.0f - factor(member(from, "glossinessFactor", 0, 1.0), 1.0f);
  to.specular = to.dielectric_f0 = 1.0f;
}

/// The image of a texture; below 0: none that can be read. A PNG or JPEG comes before a WebP
/// picture that stands for the same. [EXT_texture_webp]
int source_of(const tinygltf::Texture& texture) {
  const auto webp = texture.extensions.find("EXT_texture_webp");
  if (texture.source >= 0 || !can_read_webp() || webp == texture.extensions.end() ||
      !webp->second.IsObject())
    return texture.source;
  return static_cast<int>(std::clamp(member(webp->second, "source", 0, -1.0), -1.0, 1e9));
}

/// The kind of a picture that is not read, by its first bytes; empty: unknown.
std::string picture_kind(std::span<const std::uint8_t> bytes) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                               std::min<std::size_t>(bytes.size(), 16));
  if (is_webp(bytes) && !can_read_webp()) return "a WebP picture (EXT_texture_webp)";
  if (start.starts_with("\xABKTX 20")) return "a KTX2 picture (KHR_texture_basisu)";
  if (start.starts_with("DDS ")) return "a DDS picture (MSFT_texture_dds)";
  if (start.substr(std::min<std::size_t>(4, start.size())).starts_with("ftypavif"))
    return "an AVIF picture (EXT_texture_avif)";
  return {};
}

class MaterialReader {
 public:
  explicit MaterialReader(GltfReader& reader) : reader_(reader), model_(reader.model) {}
  Status run();

 private:
  struct TextureUse {
    TextureSlot slot;
    int texture;
    int tex_coord;
    const tinygltf::ExtensionMap& extensions;
  };
  struct ImageUse {
    std::int32_t image;     // in Scene::images
    std::uint32_t sampler;  // in Scene::samplers
  };
  static int tex_coord_of(const TextureUse& use);
  static GltfReader::UvSets uv_sets_of(std::span<const TextureUse> uses);
  Status material(const tinygltf::Material& from, std::size_t id);
  Status texture(const TextureUse& use, const GltfReader::UvSets& sets, const std::string& where,
                 MaterialConstants& to);
  void transmission(const tinygltf::Material& from, const std::string& where,
                    MaterialConstants& to);
  Status glossiness(const tinygltf::Material& from, const std::string& where,
                    MaterialConstants& to);
  Result<std::optional<ImageUse>> image_of(int texture, bool srgb, const std::string& where);
  Status slide(const tinygltf::Node& node, std::size_t id);
  Result<std::int32_t> image(int source, bool srgb, const std::string& where);
  Result<TextureImage> decode(int source, const std::string& where) const;
  Status alpha(const tinygltf::Material& from, const std::string& where, MaterialConstants& to);
  void make_mips();

  GltfReader& reader_;
  const tinygltf::Model& model_;
  std::map<std::pair<int, bool>, std::int32_t> image_ids_;
  std::map<std::pair<int, float>, std::int32_t> roughness_ids_;  // by source and glossiness
  std::map<std::int32_t, float> cutoffs_;
};

Result<TextureImage> MaterialReader::decode(int source, const std::string& where) const {
  const std::size_t id = static_cast<std::size_t>(source);
  const tinygltf::Image& from = model_.images[id];
  std::span<const std::uint8_t> bytes = reader_.encoded_images[id];
  const std::string place = where + ", " + gltf_part("image", id, from.name);
  if (from.bufferView >= 0) {
    const Result<std::span<const std::uint8_t>> view =
        buffer_view_bytes(model_, from.bufferView, place);
    if (!view.ok()) return view.error();
    bytes = view.value();
  } else if (bytes.empty()) {
    return make_error(ErrorId::kGltf, place + ": cannot read the file \"" + from.uri +
                                          "\": it must lie beside the glTF file");
  }
  const int size =
      static_cast<int>(std::min<std::size_t>(bytes.size(), std::numeric_limits<int>::max()));
  int width = 0, height = 0, channels = 0;
  if (const std::string kind = picture_kind(bytes); !kind.empty())
    return make_error(ErrorId::kGltf, place + ": is " + kind + ", PNG and JPEG are read" +
                                          (is_webp(bytes) ? gltf_remedy("EXT_texture_webp") : ""));
  if (is_webp(bytes)) {
    const std::optional<WebpHeader> header = read_webp_header(bytes);
    if (!header) return make_error(ErrorId::kGltf, place + ": is damaged (WebP)");
    if (header->is_animated)
      return make_error(ErrorId::kGltf,
                        place + ": is an animated WebP picture, still ones are read");
    width = header->width;
    height = header->height;
  } else if (size == 0 || !stbi_info_from_memory(bytes.data(), size, &width, &height, &channels)) {
    return make_error(ErrorId::kGltf, place + ": is neither a readable PNG nor a readable JPEG");
  }
  if (width > kMaxImageSide || height > kMaxImageSide)
    return make_error(ErrorId::kGltf, place + ": is " + std::to_string(width) + " x " +
                                          std::to_string(height) + " pixels, a side of " +
                                          std::to_string(kMaxImageSide) + " is allowed");
  TextureImage to;
  to.name = !from.name.empty()  ? from.name
            : !from.uri.empty() ? from.uri
                                : "image " + std::to_string(id);
  if (is_webp(bytes)) {
    if (!decode_webp(bytes, to)) return make_error(ErrorId::kGltf, place + ": is damaged (WebP)");
    return to;
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) {
    const char* reason = stbi_failure_reason();
    return make_error(ErrorId::kGltf,
                      place + ": is damaged (" + (reason ? reason : "no reason given") + ")");
  }
  to.width = static_cast<std::uint32_t>(width);
  to.height = static_cast<std::uint32_t>(height);
  to.mips.emplace_back(pixels.get(), pixels.get() + std::size_t{to.width} * to.height * 4);
  return to;
}

Result<std::int32_t> MaterialReader::image(int source, bool srgb, const std::string& where) {
  const auto key = std::make_pair(source, srgb);
  if (const auto found = image_ids_.find(key); found != image_ids_.end()) return found->second;
  Result<TextureImage> decoded = decode(source, where);
  if (!decoded.ok()) return decoded.error();
  decoded.value().srgb = srgb;
  reader_.scene.images.push_back(std::move(decoded.value()));
  return image_ids_[key] = static_cast<std::int32_t>(reader_.scene.images.size() - 1);
}

/// The extension may select another UV set than the texture itself. [KHR_texture_transform:
/// texCoord]
int MaterialReader::tex_coord_of(const TextureUse& use) {
  const auto found = use.extensions.find("KHR_texture_transform");
  if (found == use.extensions.end() || !found->second.IsObject()) return use.tex_coord;
  return static_cast<int>(member(found->second, "texCoord", 0, use.tex_coord));
}

/// The first two sets that the textures use, because a vertex has two.
GltfReader::UvSets MaterialReader::uv_sets_of(std::span<const TextureUse> uses) {
  std::optional<int> first;
  // Tangents are those of the coordinates of the normal texture.
  for (const TextureUse& use : uses)
    if (use.slot == kNormalTexture && use.texture >= 0) first = std::max(0, tex_coord_of(use));
  GltfReader::UvSets sets;
  for (const TextureUse& use : uses) {
    if (use.texture < 0) continue;
    const int set = std::max(0, tex_coord_of(use));
    if (!first) first = set;
    if (set != *first && sets.second < 0) sets.second = set;
  }
  sets.first = first.value_or(0);
  return sets;
}

Status MaterialReader::texture(const TextureUse& use, const GltfReader::UvSets& sets,
                               const std::string& where, MaterialConstants& to) {
  if (use.texture < 0) return {};
  const int set = std::max(0, tex_coord_of(use));
  if (set != sets.first && set != sets.second) {
    reader_.warn(where + ", texture " + std::to_string(use.texture) + ": uses TEXCOORD_" +
                 std::to_string(set) + ", and the material's others TEXCOORD_" +
                 std::to_string(sets.first) + " and TEXCOORD_" + std::to_string(sets.second) +
                 "; a vertex has two sets, so the texture is left out");
    return {};
  }
  if (set != sets.first) to.second_uv |= 1u << use.slot;
  const TextureSlot slot = use.slot;
  const bool srgb =
      slot == kBaseColorTexture || slot == kEmissiveTexture || slot == kSpecularColorTexture;
  const Result<std::optional<ImageUse>> from = image_of(use.texture, srgb, where);
  if (!from.ok()) return from.error();
  if (!from.value()) return {};
  to.image[slot] = from.value()->image;
  to.sampler[slot] = from.value()->sampler;
  texture_transform(use.extensions, slot, to);
  return {};
}

/// Empty, with a warning, where the texture has no image that is read here.
Result<std::optional<MaterialReader::ImageUse>> MaterialReader::image_of(int id, bool srgb,
                                                                         const std::string& where) {
  if (static_cast<std::size_t>(id) >= model_.textures.size())
    return make_error(ErrorId::kGltf, where + ": names texture " + std::to_string(id) + " of " +
                                          std::to_string(model_.textures.size()));
  const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(id)];
  const std::string place = where + ", texture " + std::to_string(id);
  const int source = source_of(texture);
  if (source < 0) {
    std::string kind;
    for (const auto& [name, value] : texture.extensions)
      kind += (kind.empty() ? "" : ", ") + name + gltf_remedy(name);
    reader_.warn(place + ": has no PNG or JPEG source" + (kind.empty() ? "" : ", only " + kind) +
                 "; the texture is left out");
    return std::optional<ImageUse>();
  }
  if (static_cast<std::size_t>(source) >= model_.images.size())
    return make_error(ErrorId::kGltf, place + ": names image " + std::to_string(source) + " of " +
                                          std::to_string(model_.images.size()));
  if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) >= model_.samplers.size())
    return make_error(ErrorId::kGltf, place + ": names sampler " + std::to_string(texture.sampler) +
                                          " of " + std::to_string(model_.samplers.size()));
  const Result<std::int32_t> decoded = image(source, srgb, place);
  if (!decoded.ok()) return decoded.error();
  return std::optional(ImageUse{
      decoded.value(), texture.sampler < 0 ? 0 : static_cast<std::uint32_t>(texture.sampler) + 1});
}

/// Reads the slide that the node's light throws, as a picture of the scene's; its colours are sRGB.
Status MaterialReader::slide(const tinygltf::Node& node, std::size_t id) {
  const std::string where = gltf_part("node", id, node.name);
  const auto projection = read_projection_extras(node.extras, where, reader_.warnings);
  if (!projection) return {};
  const auto from = image_of(projection->texture, true, where);
  if (!from.ok()) return from.error();
  if (!from.value()) return {};
  reader_.slides[id] = {.image = static_cast<std::uint32_t>(from.value()->image),
                        .sampler = from.value()->sampler,
                        .up = projection->up};
  return {};
}

Status MaterialReader::alpha(const tinygltf::Material& from, const std::string& where,
                             MaterialConstants& to) {
  const std::int32_t id = to.image[kBaseColorTexture];
  const bool alpha_texture =
      id != kNoTexture && has_alpha(reader_.scene.images[static_cast<std::size_t>(id)]);
  if (from.alphaMode == "MASK") {
    to.flags |= kMaterialMask | kMaterialAlphaTested;
    to.alpha_cutoff = number(from.alphaCutoff, 0.5f);
  } else if (from.alphaMode == "BLEND") {
    // Leaves that are blended are cut: they cast shadows, which glass does not.
    const bool is_cut = alpha_texture && to.base_color.a == 1.0f &&
                        is_cut_out(reader_.scene.images[static_cast<std::size_t>(id)]);
    to.flags |= kMaterialBlend | (is_cut ? kMaterialAlphaTested : 0u);
  } else if (from.alphaMode != "OPAQUE" && !from.alphaMode.empty()) {
    return make_error(ErrorId::kGltf, where + ": alphaMode is \"" + from.alphaMode +
                                          "\", OPAQUE, MASK and BLEND are allowed");
  }
  if ((to.flags & kMaterialAlphaTested) && alpha_texture) cutoffs_.emplace(id, to.alpha_cutoff);
  return {};
}

/// What light passes through becomes thin glass that covers the rest. Glass here shows what is
/// behind it in its own colours, so that a coloured pane covers as much as its brightest component
/// does not let through. [KHR_materials_transmission]
void MaterialReader::transmission(const tinygltf::Material& from, const std::string& where,
                                  MaterialConstants& to) {
  const auto found = from.extensions.find("KHR_materials_transmission");
  if (found == from.extensions.end() || !found->second.IsObject()) return;
  const float share =
      (1.0f - to.metallic) * factor(member(found->second, "transmissionFactor", 0, 0.0), 0.0f);
  if (!(share > 0.0f)) return;
  if (texture_of(from, "KHR_materials_transmission", "transmissionTexture").index >= 0) {
    reader_.warn(where +
                 ", KHR_materials_transmission: its texture is not read, and the surface is as "
                 "opaque as alphaMode says");
    return;
  }
  if (to.flags & kMaterialAlphaTested) {
    reader_.warn(where +
                 ", KHR_materials_transmission: the surface has holes, and is opaque beside them");
    return;
  }
  const float tint = std::max({to.base_color.r, to.base_color.g, to.base_color.b});
  const float opacity = (to.flags & kMaterialBlend) ? to.base_color.a : 1.0f;
  // What covers nothing would be no glass.
  to.base_color.a = std::max(1.0f / 64.0f, opacity * (1.0f - share * tint));
  to.flags |= kMaterialBlend;
  if (to.base_color.r != tint || to.base_color.g != tint || to.base_color.b != tint ||
      to.image[kBaseColorTexture] != kNoTexture)
    reader_.warn_once(
        "KHR_materials_transmission: glass colours what it reflects, not what shines through it");
  if (to.roughness > kSmoothGlass)
    reader_.warn_once("KHR_materials_transmission: rough glass is as clear as smooth glass");
}

/// Makes roughness of the glossiness that the specular picture has as alpha.
Status MaterialReader::glossiness(const tinygltf::Material& from, const std::string& where,
                                  MaterialConstants& to) {
  const tinygltf::TextureInfo info = texture_of(from, kGlossiness, "specularGlossinessTexture");
  if (info.index < 0 || to.image[kSpecularColorTexture] == kNoTexture) return {};
  const int source = source_of(model_.textures[static_cast<std::size_t>(info.index)]);
  const float glossiness = 1.0f - to.roughness;
  const auto [found, is_new] = roughness_ids_.try_emplace({source, glossiness}, 0);
  if (is_new) {
    Result<TextureImage> picture = decode(source, where);
    if (!picture.ok()) return picture.error();
    picture.value().name += " (roughness)";
    picture.value().srgb = false;
    std::vector<std::uint8_t>& texels = picture.value().mips[0];
    for (std::size_t i = 0; i + 3 < texels.size(); i += 4) {
      const auto rough = static_cast<std::uint8_t>(
          std::lround(255.0f - glossiness * static_cast<float>(texels[i + 3])));
      texels[i] = texels[i + 1] = texels[i + 2] = rough;
      texels[i + 3] = 255;
    }
    found->second = static_cast<std::int32_t>(reader_.scene.images.size());
    reader_.scene.images.push_back(std::move(picture.value()));
  }
  to.roughness = 1.0f;
  to.image[kMetallicRoughnessTexture] = found->second;
  to.sampler[kMetallicRoughnessTexture] = to.sampler[kSpecularColorTexture];
  to.uv_matrix[kMetallicRoughnessTexture] = to.uv_matrix[kSpecularColorTexture];
  to.uv_offset[kMetallicRoughnessTexture] = to.uv_offset[kSpecularColorTexture];
  if (to.second_uv >> kSpecularColorTexture & 1u) to.second_uv |= 1u << kMetallicRoughnessTexture;
  return {};
}

Status MaterialReader::material(const tinygltf::Material& from, std::size_t id) {
  const std::string where = gltf_part("material", id, from.name);
  Material out;
  out.name = from.name.empty() ? "material " + std::to_string(id) : from.name;
  MaterialConstants& to = out.constants;
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  for (int i = 0; i < 4 && static_cast<std::size_t>(i) < pbr.baseColorFactor.size(); ++i)
    to.base_color[i] = factor(pbr.baseColorFactor[static_cast<std::size_t>(i)], 1.0f);
  double strength = 1.0;
  if (const auto found = from.extensions.find("KHR_materials_emissive_strength");
      found != from.extensions.end() && found->second.IsObject())
    strength = member(found->second, "emissiveStrength", 0, 1.0);
  for (int i = 0; i < 3 && static_cast<std::size_t>(i) < from.emissiveFactor.size(); ++i)
    to.emissive[i] =
        std::max(0.0f, number(from.emissiveFactor[static_cast<std::size_t>(i)] * strength, 0.0f));
  to.metallic = factor(pbr.metallicFactor, 1.0f);
  to.roughness = factor(pbr.roughnessFactor, 1.0f);
  to.normal_scale = number(from.normalTexture.scale, 1.0f);
  if (from.doubleSided) to.flags |= kMaterialDoubleSided;
  to.flags |= read_material_model(from.extras, where, reader_.warnings);
  read_reflectance(from, to);
  const auto glossy = from.extensions.find(kGlossiness);
  const bool is_glossy = glossy != from.extensions.end() && glossy->second.IsObject();
  if (is_glossy) read_glossiness(glossy->second, to);
  if (from.extensions.contains("KHR_materials_unlit")) {
    to.flags |= kMaterialUnlit;
    to.emissive = glm::vec3(0.0f);
  }
  // Textures of extensions, as tinygltf has those of glTF itself.
  const tinygltf::TextureInfo none;
  const tinygltf::TextureInfo color =
      is_glossy ? texture_of(from, kGlossiness, "diffuseTexture") : pbr.baseColorTexture;
  const tinygltf::TextureInfo rough = is_glossy ? none : pbr.metallicRoughnessTexture;
  const tinygltf::TextureInfo specular =
      is_glossy ? none : texture_of(from, "KHR_materials_specular", "specularTexture");
  const tinygltf::TextureInfo specular_color =
      is_glossy ? texture_of(from, kGlossiness, "specularGlossinessTexture")
                : texture_of(from, "KHR_materials_specular", "specularColorTexture");
  const auto use = [](TextureSlot slot, const auto& info) {
    return TextureUse{slot, info.index, info.texCoord, info.extensions};
  };
  const TextureUse uses[] = {
      use(kBaseColorTexture, color),           use(kMetallicRoughnessTexture, rough),
      use(kNormalTexture, from.normalTexture), use(kEmissiveTexture, from.emissiveTexture),
      use(kSpecularTexture, specular),         use(kSpecularColorTexture, specular_color)};
  const GltfReader::UvSets sets = uv_sets_of(uses);
  for (const TextureUse& one : uses) {
    // An unlit material has a base colour, and nothing else of it counts.
    if ((to.flags & kMaterialUnlit) && one.slot != kBaseColorTexture) continue;
    const Status status = texture(one, sets, where, to);
    if (!status.ok()) return status;
  }
  reader_.uv_sets.push_back(sets);
  if (from.occlusionTexture.index >= 0 && !(to.flags & kMaterialUnlit))
    reader_.warn_once("occlusion textures are not read: occlusion is computed");
  Status status = is_glossy ? glossiness(from, where, to) : Status();
  if (status.ok()) status = alpha(from, where, to);
  if (status.ok() && !(to.flags & kMaterialUnlit)) transmission(from, where, to);
  if (status.ok()) reader_.scene.materials.push_back(std::move(out));
  return status;
}

void MaterialReader::make_mips() {
  for (std::size_t id = 0; id < reader_.scene.images.size(); ++id) {
    const auto cutoff = cutoffs_.find(static_cast<std::int32_t>(id));
    generate_mips(reader_.scene.images[id],
                  cutoff == cutoffs_.end() ? std::nullopt : std::optional<float>(cutoff->second));
  }
}

Status MaterialReader::run() {
  reader_.scene.samplers.push_back(Sampler{});
  for (const tinygltf::Sampler& sampler : model_.samplers)
    reader_.scene.samplers.push_back(sampler_of(sampler));
  for (std::size_t id = 0; id < model_.materials.size(); ++id) {
    const Status status = material(model_.materials[id], id);
    if (!status.ok()) return status;
  }
  Material fallback;
  fallback.name = "default";
  // glTF's default material is fully metallic and would look black under a sky, so geometry without
  // a material is shown as white plaster.
  fallback.constants.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
  reader_.scene.materials.push_back(fallback);
  for (std::size_t id = 0; id < model_.nodes.size(); ++id) {
    const Status status = slide(model_.nodes[id], id);
    if (!status.ok()) return status;
  }
  make_mips();
  return {};
}

}  // namespace

Status read_gltf_materials(GltfReader& reader) {
  return MaterialReader(reader).run();
}

}  // namespace kaamos::effects
