// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_extensions.h"

#include <algorithm>
#include <array>

#include "effects/assets/gltf/gltf_draco.h"
#include "effects/assets/gltf/gltf_meshopt.h"
#include "effects/assets/gltf/gltf_webp.h"

namespace kaamos::effects {
namespace {

constexpr std::array<std::string_view, 11> kRead = {"EXT_mesh_gpu_instancing",
                                                    "KHR_lights_punctual",
                                                    "KHR_materials_emissive_strength",
                                                    "KHR_materials_ior",
                                                    "KHR_materials_pbrSpecularGlossiness",
                                                    "KHR_materials_specular",
                                                    "KHR_materials_transmission",
                                                    "KHR_materials_unlit",
                                                    "KHR_mesh_quantization",
                                                    "KHR_texture_transform",
                                                    "MSFT_lod"};

/// Extensions that optional libraries read.
struct Optional {
  std::string_view name;
  std::string_view package;  // Debian's name of the library
  bool (*can_read)();
};

constexpr std::array kOptional = {
    Optional{"EXT_meshopt_compression", "libmeshoptimizer-dev", &can_read_meshopt},
    Optional{"KHR_draco_mesh_compression", "libdraco-dev", &can_read_draco},
    Optional{"EXT_texture_webp", "libwebp-dev", &can_read_webp},
};

const Optional* optional_of(std::string_view name) {
  const auto row = std::find_if(kOptional.begin(), kOptional.end(),
                                [&](const Optional& optional) { return optional.name == name; });
  return row == kOptional.end() ? nullptr : &*row;
}

struct Unread {
  std::string_view name;
  std::string_view loss;  // a sentence's end
};

constexpr std::array kUnread = {
    Unread{"EXT_mesh_manifold", "no picture depends on it"},
    Unread{"EXT_meshopt_compression", "the uncompressed copy is read"},
    Unread{"EXT_texture_avif", "textures are read from their PNG or JPEG"},
    Unread{"EXT_texture_webp", "textures are read from their PNG or JPEG"},
    Unread{"KHR_animation_pointer", "what it moves stands still"},
    Unread{"KHR_draco_mesh_compression", "the uncompressed copy is read"},
    Unread{"KHR_materials_anisotropy", "highlights are round"},
    Unread{"KHR_materials_clearcoat", "surfaces have no clear coat"},
    Unread{"KHR_materials_diffuse_transmission", "no light shines through thin surfaces"},
    Unread{"KHR_materials_dispersion", "glass does not split colours"},
    Unread{"KHR_materials_iridescence", "surfaces do not iridesce"},
    Unread{"KHR_materials_sheen", "cloth has no sheen"},
    Unread{"KHR_materials_variants", "each mesh shows its own material"},
    Unread{"KHR_materials_volume", "glass has no thickness and no colour inside"},
    Unread{"KHR_meshopt_compression", "the uncompressed copy is read"},
    Unread{"KHR_texture_basisu", "textures are read from their PNG or JPEG"},
    Unread{"KHR_xmp_json_ld", "no picture depends on it"},
    Unread{"MSFT_texture_dds", "textures are read from their PNG or JPEG"},
};

}  // namespace

bool is_gltf_extension_read(std::string_view name) {
  if (const Optional* optional = optional_of(name)) return optional->can_read();
  return std::find(kRead.begin(), kRead.end(), name) != kRead.end();
}

std::string gltf_remedy(std::string_view name) {
  const Optional* optional = optional_of(name);
  if (!optional || optional->can_read()) return {};
  return " (install " + std::string(optional->package) + " and build Kaamos again to read it)";
}

Status check_required_extensions(const std::vector<std::string>& required) {
  for (const std::string& name : required)
    // A mesh has a material whether it has variants or not.
    if (!is_gltf_extension_read(name) && name != "KHR_materials_variants")
      return make_error(ErrorId::kGltf, "requires the extension " + name +
                                            ", which is not supported" + gltf_remedy(name) +
                                            ": export the file without it");
  return {};
}

void warn_of_extensions(const std::vector<std::string>& used, std::vector<std::string>& warnings) {
  std::vector<std::string> names = used;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const std::string& name : names) {
    if (is_gltf_extension_read(name)) continue;
    const auto row = std::find_if(kUnread.begin(), kUnread.end(),
                                  [&](const Unread& unread) { return unread.name == name; });
    warnings.push_back(
        "the extension " + name + " is not read: " +
        (row == kUnread.end() ? "what it describes is left out" : std::string(row->loss)) +
        gltf_remedy(name));
  }
}

}  // namespace kaamos::effects
