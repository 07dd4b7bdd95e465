// SPDX-License-Identifier: MIT
//
// The triangles of a glTF file as geometries of one bottom level.
#pragma once

#include <string>
#include <vector>

#include "tests/shaders/scene.h"

namespace kaamos::shader_tests {

// Appends a geometry for each primitive of each mesh that a node of the file shows, in the space of
// the file's scene; opaque unless its material is alpha tested. Returns what is wrong with the
// file, or nothing.
std::string read_gltf(const std::string& path, const std::string& bottom_level,
                      std::vector<SceneGeometry>& out);

}  // namespace kaamos::shader_tests
