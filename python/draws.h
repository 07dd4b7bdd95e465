// SPDX-License-Identifier: MIT
//
// Draws into textures.
#pragma once

#include <string>
#include <vector>

#include "python/session.h"

namespace kaamos::python {

struct Draw {
  std::string vertex;  // exports; an empty pixel shader: only depth
  std::string pixel;
  uint32_t vertices = 3;
  uint32_t instances = 1;
  std::string topology = "triangles";  // or "triangle strip", "lines", "line strip", "points"
  std::string cull = "none";           // or "back", "front"
  std::string blend = "none";          // or "alpha", "add"
  bool wireframe = false;
  std::vector<float> clear;  // four numbers, or empty: draws over what is there
  bool depth = false;        // a depth buffer of the draw's own, which begins at 1; the nearer wins
};

// Targets have one size. Throws py::value_error for words that are not among the above.
void draw(Session& session, const Library& library, const Draw& what,
          const std::vector<ArrayTexture>& targets, const Bindings& given);

}  // namespace kaamos::python
