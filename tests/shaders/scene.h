// SPDX-License-Identifier: MIT
//
// The scene that a test file describes, and the acceleration structures made of it.
//
//   #pragma kaamos geometry wall triangles opaque (-1,-1,0) (1,-1,0) (0,1,0)
//   #pragma kaamos geometry ball boxes (-1,-1,-1) (1,1,1)
//   #pragma kaamos gltf room "room.glb"
//   #pragma kaamos instance wall at (0,0,5) id 7 mask 0x1 hit_group 1
//   #pragma kaamos record Glass (0.9, 0.9, 1.0) (7)
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

// A record of a shader table: a hit group, a miss or a callable shader, and its local arguments.
struct SceneRecord {
  std::string export_name;
  std::vector<std::vector<uint32_t>> constants;  // of each parameter
};

struct SceneDescription {
  std::vector<SceneGeometry> geometries;
  std::vector<SceneInstance> instances;
  std::vector<SceneRecord> records;
  std::vector<std::string> files;  // glTF files that were read
  std::string error;               // "line 12: ..."
};

// `text` is the source as it was written; paths of glTF files count from `folder`.
SceneDescription read_scene(std::string_view text, const std::string& folder = {});

// What `CallHitGroup` (kaamos/test.hlsli) hits: a triangle of (0,0,0), (0,1,0) and (1,0,0), or a
// box from -1 to 1.
SceneDescription lone_primitive(bool is_box);

struct Scene {
  std::vector<rtapi::Buffer> memory;  // everything but the top level
  rtapi::Buffer top_level;
};
// Throws rtapi::ResultError.
Scene build_scene(const rtapi::Device& device, const rtapi::CommandQueue& queue,
                  const SceneDescription& description);

}  // namespace kaamos::shader_tests
