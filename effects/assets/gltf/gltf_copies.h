// SPDX-License-Identifier: MIT
// The places where a node's mesh stands; only gltf_*.cpp include it. [EXT_mesh_gpu_instancing]
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/gltf/gltf_reader.h"

namespace kaamos::effects {

/// One of a node's instances.
struct GltfCopy {
  std::string name;
  std::optional<glm::dmat4> transform = {};  // relative to the node; none: the node itself
};

/// Empty for a node without the extension.
/// @errors KA3020 as of read_floats, and attributes of different length.
Result<std::vector<GltfCopy>> read_gltf_copies(GltfReader& reader, const tinygltf::Node& node,
                                               const std::string& where);

}  // namespace kaamos::effects
