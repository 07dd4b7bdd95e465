// SPDX-License-Identifier: MIT
//
// The scene behind a RaytracingAccelerationStructure of an HLSL test, and the hit groups made from
// its library's exports. Without hit shaders the scene is empty and every ray misses.
//
// Instance 0 (InstanceID 7, mask 0x0F) has triangles, each with these corners at its own z:
//   (-4, -4, z), (-4, 4, z), (4, -4, z), front face towards -z
//   geometry 0: one triangle at z = -1 (world z -3)
//   geometry 1: primitive 0 at z = 1 (world z 13), primitive 1 at z = 0 (world z 5)
// Object to world: (2x + 2y + 1, 4y + 2, 8z + 5); back: (0.5X - 0.25Y, 0.25Y - 0.5, 0.125Z -
// 0.625). A ray from (-3, 2, 0) along +z hits at t 5 and 13 with barycentrics (0.5, 0.25); from z =
// -10 also geometry 0, first of all, at t 7.
//
// Instance 1 (InstanceID 9, mask 0xF0), only where the library has an intersection shader: boxes,
// primitive 1 from (-1, -1, -1) to (1, 1, 1), moved by (-3, 2, 20): its t along the same ray is
// 19 to 21. (Primitive 0 is far away.)
//
// Hit groups: closest-hit and any-hit exports whose names do not begin with "Box" form the triangle
// groups, ordered by name: group i has the i-th of each. The intersection exports form the box
// groups, together with the exports whose names begin with "Box". Records 0 to 3 are triangle
// groups (the last one repeats), records 4 to 7, where instance 1 begins, are box groups. Miss and
// callable tables hold their exports ordered by name.
#pragma once

#include <rtapi/rtapi.h>

namespace kaamos::test {

struct Scene {
  std::vector<rtapi::Buffer> buffers;  // keeps alive what the top level refers to
  rtapi::Buffer top_level;
};

Scene build_scene(const rtapi::Device& device, rtapi::CommandQueue& queue,
                  const rtapi::ShaderLibrary& library);

// Runs the library's ray generation export with `size` threads on the open list.
void dispatch_rays(const rtapi::Device& device, rtapi::CommandQueue& queue,
                   const rtapi::ShaderLibrary& library, const rtapi::RootSignature& root,
                   rtapi::CommandList& list, const uint32_t (&size)[3]);

}  // namespace kaamos::test
