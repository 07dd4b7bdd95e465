// SPDX-License-Identifier: MIT
//
// Cube maps: which face a direction hits, and where. [D3D11.3 7.18.11]
#pragma once

#include <cmath>
#include <cstdint>

namespace kaamos::shader {

// Faces are in the order +x, -x, +y, -y, +z, -z; u points right and v down, both in [0, 1].
struct CubePlace {
  uint32_t face;
  double u;
  double v;
};

namespace cube {

// For each face the axes that u and v follow, and their signs, as seen from inside.
struct Face {
  int major, u_axis, v_axis;
  double major_sign, u_sign, v_sign;
};
inline constexpr Face kFaces[6] = {
    {0, 2, 1, 1, -1, -1}, {0, 2, 1, -1, 1, -1}, {1, 0, 2, 1, 1, 1},
    {1, 0, 2, -1, 1, -1}, {2, 0, 1, 1, 1, -1},  {2, 0, 1, -1, -1, -1},
};

// On a tie z wins over y, and y over x.
template <class T>
uint32_t face_of(const T d[3]) {
  const T x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]);
  const int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
  return static_cast<uint32_t>(2 * axis) + (d[axis] < 0 ? 1u : 0u);
}

}  // namespace cube

// The zero direction and NaN hit the middle of a face.
inline CubePlace cube_place(const double direction[3]) {
  const uint32_t face = cube::face_of(direction);
  const cube::Face& f = cube::kFaces[face];
  const double major = std::abs(direction[f.major]);
  const double u = f.u_sign * direction[f.u_axis] / major;
  const double v = f.v_sign * direction[f.v_axis] / major;
  return {face, u >= -1 && u <= 1 ? (u + 1) * 0.5 : 0.5, v >= -1 && v <= 1 ? (v + 1) * 0.5 : 0.5};
}

// The inverse; u and v may be outside of the face.
inline void cube_direction(const CubePlace& place, double direction[3]) {
  const cube::Face& f = cube::kFaces[place.face];
  direction[f.major] = f.major_sign;
  direction[f.u_axis] = f.u_sign * (2 * place.u - 1);
  direction[f.v_axis] = f.v_sign * (2 * place.v - 1);
}

}  // namespace kaamos::shader
