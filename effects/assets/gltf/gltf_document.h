// SPDX-License-Identifier: MIT
// The JSON of a glTF file, checked before the parser sees it: what is wrong has a sentence that
// says where. gltf_extensions.h judges the extensions that it names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/gltf/gltf_draco.h"
#include "effects/assets/gltf/gltf_meshopt.h"

namespace kaamos::effects {

/// Indices that the parser must not see: it refuses their accessor, because it has no bufferView
/// and so is all zeros, or sparse.
struct HiddenIndices {
  std::size_t mesh;
  std::size_t primitive;
  int accessor;
};

/// The document for the parser to read in place of the file's JSON.
struct GltfDocument {
  std::optional<std::string> json;    // none: the file's own
  std::vector<HiddenIndices> hidden;  // to be put back into what the parser made
  std::vector<DracoPrimitive> draco;  // to be decoded; empty where the build has no Draco
  std::vector<MeshoptView> meshopt;   // likewise, before them
  // byteLength of the buffers that lie in files of their own, which may be longer, in their order.
  std::vector<std::size_t> named_bytes;
};

/// Checks versions, extensions, required members, their types, and the sizes of buffers.
/// `binary_bytes`: of the binary chunk of a .glb; none: the file has no such chunk.
/// @errors KA3020 the first broken rule, named by place and value.
Result<GltfDocument> check_gltf_document(std::string_view json,
                                         std::optional<std::size_t> binary_bytes,
                                         std::vector<std::string>& warnings);

}  // namespace kaamos::effects
