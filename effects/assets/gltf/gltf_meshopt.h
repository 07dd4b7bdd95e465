// SPDX-License-Identifier: MIT
// Buffer views compressed by meshoptimizer, where the build has the library; only gltf_*.cpp
// include it. [EXT_meshopt_compression]
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "effects/assets/common/errors.h"

namespace tinygltf {
class Model;
}

namespace kaamos::effects {

/// False: the build has no meshoptimizer, and decode_meshopt decodes nothing.
bool can_read_meshopt();

enum class MeshoptMode : std::uint8_t { kAttributes, kTriangles, kIndices };
enum class MeshoptFilter : std::uint8_t { kNone, kOctahedral, kQuaternion, kExponential };

/// A buffer view whose bytes come from a stream of meshoptimizer's. `count` times `stride` are its
/// bytes, and the stride is one that the mode and the filter allow.
struct MeshoptView {
  std::size_t view;
  int buffer;  // that holds the stream
  std::size_t offset_bytes;
  std::size_t size_bytes;
  std::size_t count;
  std::size_t stride;
  MeshoptMode mode;
  MeshoptFilter filter;
  std::string where;  // for messages
};

/// Decodes the streams, and points each view at what came out.
/// @errors KA3020 streams that are damaged or outside their buffer.
Status decode_meshopt(tinygltf::Model& model, std::span<const MeshoptView> views);

}  // namespace kaamos::effects
