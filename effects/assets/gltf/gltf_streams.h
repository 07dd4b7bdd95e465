// SPDX-License-Identifier: MIT
// What the JSON of a glTF file says of its compressed streams; only gltf_*.cpp include it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "effects/assets/gltf/gltf_draco.h"
#include "effects/assets/gltf/gltf_meshopt.h"

namespace kaamos::effects {

/// Reads EXT_meshopt_compression of a bufferView of `view_bytes` bytes. The types of its members
/// and the buffer that it names have been checked.
/// @errors KA3020 sizes, strides, modes and filters that the extension does not allow.
Result<MeshoptView> read_meshopt_view(const nlohmann::json& extension, std::size_t view,
                                      std::int64_t view_bytes, const std::string& where);

/// Reads KHR_draco_mesh_compression of a primitive, but for the numbers of mesh and primitive. The
/// types of its members and the bufferView that it names have been checked.
/// @errors KA3020 modes that the extension does not allow, ids that are negative or too large.
Result<DracoPrimitive> read_draco_primitive(const nlohmann::json& primitive,
                                            const nlohmann::json& extension,
                                            const std::string& where);

}  // namespace kaamos::effects
