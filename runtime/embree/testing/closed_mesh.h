// SPDX-License-Identifier: MIT
//
// A closed mesh for tests of shared edges and vertices.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace kaamos::embree::testing {

using Point = std::array<float, 3>;
using Triangle = std::array<Point, 3>;

// A bumpy sphere around the origin, star-shaped as seen from there: eight faces of n * n triangles.
// Its axes pass through vertices, and the planes between them run along edges.
inline std::vector<Triangle> closed_mesh(int n, float scale) {
  const auto on_sphere = [&](float x, float y, float z) {
    const float length = std::sqrt(x * x + y * y + z * z) * (1 + 0.1f * std::sin(9 * x + 5 * y));
    return Point{scale * (x / length), scale * (y / length), scale * (z / length)};
  };
  std::vector<Triangle> mesh;
  for (int face = 0; face < 8; ++face) {
    const float sx = (face & 1) != 0 ? -1.0f : 1.0f;
    const float sy = (face & 2) != 0 ? -1.0f : 1.0f;
    const float sz = (face & 4) != 0 ? -1.0f : 1.0f;
    const auto at = [&](int i, int j) {
      const auto fraction = [&](int k) { return static_cast<float>(k) / static_cast<float>(n); };
      return on_sphere(sx * fraction(i), sy * fraction(j), sz * fraction(n - i - j));
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        mesh.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) mesh.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return mesh;
}

}  // namespace kaamos::embree::testing
