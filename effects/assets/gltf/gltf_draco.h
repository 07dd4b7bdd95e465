// SPDX-License-Identifier: MIT
// Meshes compressed by Draco, where the build has the library; only gltf_*.cpp include it.
// [KHR_draco_mesh_compression]
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"

namespace tinygltf {
class Model;
}

namespace kaamos::effects {

/// False: the build has no Draco, and decode_draco decodes nothing.
bool can_read_draco();

/// A primitive whose values come from a stream of Draco's.
struct DracoPrimitive {
  std::size_t mesh;
  std::size_t primitive;
  int view;                                         // the bufferView that holds the stream
  std::map<std::string, std::uint32_t> attributes;  // ids in the stream, by name
  std::string where;                                // for messages
};

/// Decodes the streams, and gives each primitive accessors of its own that hold what came out.
/// @errors KA3020 damaged streams, and those with more than the primitive's accessors have.
Status decode_draco(tinygltf::Model& model, std::span<const DracoPrimitive> primitives,
                    std::vector<std::string>& warnings);

}  // namespace kaamos::effects
