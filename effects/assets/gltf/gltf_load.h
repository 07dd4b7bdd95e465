// SPDX-License-Identifier: MIT
/// @file
/// Loads glTF 2.0 files (.gltf with its parts, or .glb) as scenes.
///
/// It reads triangle lists, strips and fans, indexed or not, with every component type, normalised
/// and sparse; vertex colours; morph targets at rest; node hierarchies and instances of a node;
/// metallic-roughness and unlit materials; local lights; perspective and orthographic cameras; and
/// skins, either in the pose of the file or, on request, as skins and animations. Whatever it
/// ignores is named in the warnings: README.md has the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// A scene from a file.
struct LoadedScene {
  Scene scene;                        ///< passes validate()
  std::vector<std::string> warnings;  ///< what was left out, one sentence each
  /// The file says itself what its sky, sun and exposure are, as files of write_glb do: nothing was
  /// added, and nothing needs to be.
  bool complete = false;
};

/// Options for reading a file.
struct GltfOptions {
  /// Skinned meshes keep their bind pose, joints and weights, nodes their hierarchy, and the first
  /// animation drives all instances: for a StructureManager. Else everything stands in the pose of
  /// the file, as create_gpu_scene needs it.
  bool animated = false;
};

/// Loads a .gltf or .glb file; which of the two it is shows in its first bytes. The scene passes
/// validate(). Where the file has none, it gets a camera that frames it, a sun and a sky; the first
/// directional light is the sun. Files of write_glb say all of that themselves, in `extras`
/// (README.md). [glTF 2.0]
/// @errors KA3020; they name the file, the place in it, the actual and the allowed value: missing
/// or cut files, bad JSON, ids and byte ranges outside what is there, positions that are not
/// finite, node cycles, a required extension that is not supported, no triangles.
Result<LoadedScene> load_gltf(const std::string& path, const GltfOptions& options = {});

/// The same from memory. `name` stands for the file in messages; external parts are looked for in
/// `folder`.
/// @errors as of load_gltf.
Result<LoadedScene> load_gltf_memory(std::span<const std::uint8_t> bytes, const std::string& name,
                                     const std::string& folder = ".",
                                     const GltfOptions& options = {});

}  // namespace kaamos::effects
