// SPDX-License-Identifier: MIT
#include "tests/shaders/scene.h"

#include <rtapi/upload.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "tests/common/structures.h"

namespace kaamos::shader_tests {
namespace {

// The geometries of a bottom level, whose inputs go to `memory`.
std::vector<rtapi::RaytracingGeometryDesc> describe(const rtapi::Device& device,
                                                    const SceneDescription& description,
                                                    const std::string& name, Scene& scene) {
  std::vector<rtapi::RaytracingGeometryDesc> out;
  for (const SceneGeometry& from : description.geometries) {
    if (from.bottom_level != name) continue;
    scene.memory.push_back(rtapi::CreateUploadBuffer(device, from.points, name).value());
    const uint64_t address = scene.memory.back().GetGPUVirtualAddress();
    rtapi::RaytracingGeometryDesc desc;
    desc.Flags = from.flags;
    if (from.is_boxes) {
      desc.Type = rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
      desc.AABBs = {from.points.size() / 6, {address, sizeof(rtapi::RaytracingAabb)}};
    } else {
      desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
      desc.Triangles.VertexCount = static_cast<uint32_t>(from.points.size() / 3);
      desc.Triangles.VertexBuffer = {address, 12};
    }
    out.push_back(desc);
  }
  return out;
}

}  // namespace

SceneDescription lone_primitive(bool is_box) {
  SceneGeometry geometry;
  geometry.bottom_level = is_box ? "the box" : "the triangle";
  geometry.is_boxes = is_box;
  geometry.points = is_box ? std::vector<float>{-1, -1, -1, 1, 1, 1}
                           : std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0};
  SceneInstance instance;
  instance.bottom_level = geometry.bottom_level;
  for (int i = 0; i < 3; ++i) instance.desc.Transform[i][i] = 1;
  instance.desc.InstanceMask = 0xFF;
  SceneDescription out;
  out.geometries.push_back(std::move(geometry));
  out.instances.push_back(std::move(instance));
  return out;
}

Scene build_scene(const rtapi::Device& device, const rtapi::CommandQueue& queue,
                  const SceneDescription& description) {
  Scene scene;
  std::vector<std::pair<std::string, rtapi::Buffer>> levels;
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (const SceneInstance& instance : description.instances) {
    auto level = std::find_if(levels.begin(), levels.end(),
                              [&](const auto& one) { return one.first == instance.bottom_level; });
    if (level == levels.end()) {
      const auto geometries = describe(device, description, instance.bottom_level, scene);
      levels.emplace_back(instance.bottom_level, test::build_bottom_level(device, queue, geometries,
                                                                          instance.bottom_level));
      level = std::prev(levels.end());
    }
    rtapi::RaytracingInstanceDesc desc = instance.desc;
    desc.AccelerationStructure = level->second.GetGPUVirtualAddress();
    instances.push_back(desc);
  }
  for (auto& [name, buffer] : levels) scene.memory.push_back(buffer);
  scene.top_level = test::build_top_level(device, queue, instances, "test scene");
  return scene;
}

}  // namespace kaamos::shader_tests
