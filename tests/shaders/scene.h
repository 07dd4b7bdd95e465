// SPDX-License-Identifier: MIT
//
// The scene that a test file describes, and the acceleration structures made of it.
//
//   #pragma kaamos geometry wall triangles opaque (-1,-1,0) (1,-1,0) (0,1,0)
//   #pragma kaamos geometry ball boxes (-1,-1,-1) (1,1,1)
//   #pragma kaamos instance wall at (0,0,5) id 7 mask 0x1 hit_group 1
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kaamos::shader_tests {

struct SceneGeometry {
  std::string bottom_level;  // geometries of one name make one bottom level, in order
  bool is_boxes = false;
  rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kNone;
  std::vector<float> points;  // x, y, z: three of a triangle, two of a box
};

struct SceneInstance {
  std::string bottom_level;
  rtapi::RaytracingInstanceDesc desc = {};
};

struct SceneDescription {
  std::vector<SceneGeometry> geometries;
  std::vector<SceneInstance> instances;
  std::string error;  // "line 12: ..."
};

// `text` is the source as it was written.
SceneDescription read_scene(std::string_view text);

struct Scene {
  std::vector<rtapi::Buffer> memory;  // everything but the top level
  rtapi::Buffer top_level;
};
// Throws rtapi::ResultError.
Scene build_scene(const rtapi::Device& device, const rtapi::CommandQueue& queue,
                  const SceneDescription& description);

}  // namespace kaamos::shader_tests
