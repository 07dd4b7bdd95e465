// SPDX-License-Identifier: MIT
/// @file
/// Writes scenes as .glb files that any glTF viewer reads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The bytes of a .glb that the Khronos glTF validator accepts: meshes, materials with their
/// pictures as PNG, instances, cameras, lights, the sun as the first directional light; and in
/// `extras` what glTF has no place for (README.md lists it): sky, exposure, the sun's and the
/// lamps' sizes, instance masks. load_gltf brings all of it back. What moves is written as it is at
/// time 0, without its animations.
/// @errors KA3022 a scene that validate() refuses; KA3021 more than 4 GB.
Result<std::vector<std::uint8_t>> encode_glb(const Scene& scene);

/// Writes the file; an earlier one at `path` stays as it was on any error.
/// @errors those of encode_glb and write_file.
Status write_glb(const std::string& path, const Scene& scene);

}  // namespace kaamos::effects
