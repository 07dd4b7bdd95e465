// SPDX-License-Identifier: MIT
// From the bytes of a .gltf or .glb file to the parser's model; only gltf_*.cpp include it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"

namespace tinygltf {
class Model;
}

namespace kaamos::effects {

/// The message about a file that breaks a rule which gltf_document.cpp does not check.
inline constexpr char kGltfRefused[] =
    "cannot be parsed as glTF 2.0: a member has a type or value that glTF does not allow; the "
    "Khronos glTF validator says which";

/// Reads a whole file. `images`: encoded bytes by image of the file, empty unless they came by URI.
/// @errors KA3020.
Status parse_gltf(std::span<const std::uint8_t> bytes, const std::string& folder,
                  tinygltf::Model& model, std::vector<std::vector<std::uint8_t>>& images,
                  std::vector<std::string>& warnings);

}  // namespace kaamos::effects
