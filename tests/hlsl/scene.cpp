// SPDX-License-Identifier: MIT
#include "scene.h"

#include <algorithm>
#include <string>
#include <vector>

#include "tests/common/structures.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kRecordsPerKind = 4;

// The exports of a stage, ordered by name.
std::vector<std::string> exports_of(const ShaderLibrary& library, ShaderStage stage) {
  std::vector<std::string> names;
  for (const ShaderExportInfo& e : library.GetExports()) {
    if (e.Stage == stage) names.push_back(e.Name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> hit_exports(const ShaderLibrary& library, ShaderStage stage, bool box) {
  std::vector<std::string> names = exports_of(library, stage);
  std::erase_if(names, [box](const std::string& name) { return name.starts_with("Box") != box; });
  return names;
}

RaytracingGeometryDesc triangles(Scene& scene, const Device& device,
                                 const std::vector<float>& depths) {
  std::vector<float> corners;
  for (const float z : depths) corners.insert(corners.end(), {-4, -4, z, -4, 4, z, 4, -4, z});
  scene.buffers.push_back(CreateUploadBuffer(device, corners).value());
  RaytracingGeometryDesc geometry;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = static_cast<uint32_t>(depths.size()) * 3;
  geometry.Triangles.VertexBuffer = {scene.buffers.back().GetGPUVirtualAddress(), 12};
  return geometry;
}

RaytracingInstanceDesc triangle_instance(Scene& scene, const Device& device, CommandQueue& queue) {
  const RaytracingGeometryDesc back = triangles(scene, device, {-1});
  const RaytracingGeometryDesc front = triangles(scene, device, {1, 0});
  const bool is_readable = device.GetDesc().ShaderModel >= ShaderModel::k6_10;
  scene.buffers.push_back(
      BuildBottomLevel(device, queue, std::vector{back, front}, "triangles",
                       is_readable ? RaytracingAccelerationStructureBuildFlags::kAllowDataAccess
                                   : RaytracingAccelerationStructureBuildFlags::kNone)
          .value());
  RaytracingInstanceDesc instance;
  const float transform[3][4] = {{2, 2, 0, 1}, {0, 4, 0, 2}, {0, 0, 8, 5}};
  std::copy_n(&transform[0][0], 12, &instance.Transform[0][0]);
  instance.InstanceID = 7;
  instance.InstanceMask = 0x0F;
  instance.AccelerationStructure = scene.buffers.back().GetGPUVirtualAddress();
  return instance;
}

RaytracingInstanceDesc box_instance(Scene& scene, const Device& device, CommandQueue& queue) {
  const std::vector<RaytracingAabb> boxes = {{100, 100, 100, 101, 101, 101}, {-1, -1, -1, 1, 1, 1}};
  scene.buffers.push_back(CreateUploadBuffer(device, boxes).value());
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry.AABBs = {boxes.size(),
                    {scene.buffers.back().GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  scene.buffers.push_back(build_bottom_level(device, queue, {geometry}));
  RaytracingInstanceDesc instance;
  instance.Transform[0][3] = -3;
  instance.Transform[1][3] = 2;
  instance.Transform[2][3] = 20;
  instance.InstanceID = 9;
  instance.InstanceMask = 0xF0;
  instance.InstanceContributionToHitGroupIndex = kRecordsPerKind;
  instance.AccelerationStructure = scene.buffers.back().GetGPUVirtualAddress();
  return instance;
}

std::string name_at(const std::vector<std::string>& names, size_t index) {
  return index < names.size() ? names[index] : std::string();
}

// Returns the names of the groups that it added.
std::vector<std::string> add_hit_groups(StateObjectDesc& desc, const ShaderLibrary& library,
                                        bool box) {
  const auto closest = hit_exports(library, ShaderStage::kClosestHit, box);
  const auto any = hit_exports(library, ShaderStage::kAnyHit, box);
  std::vector<std::string> intersections;
  if (box) intersections = exports_of(library, ShaderStage::kIntersection);
  const size_t count = box ? intersections.size() : std::max(closest.size(), any.size());
  std::vector<std::string> groups;
  for (size_t i = 0; i < count; ++i) {
    groups.push_back((box ? "test box group " : "test group ") + std::to_string(i));
    desc.Add(
        HitGroupDesc{.HitGroupExport = groups.back(),
                     .Type = box ? HitGroupType::kProceduralPrimitive : HitGroupType::kTriangles,
                     .AnyHitShaderImport = name_at(any, i),
                     .ClosestHitShaderImport = name_at(closest, i),
                     .IntersectionShaderImport = name_at(intersections, i)});
  }
  return groups;
}

void add_hit_records(ShaderTable& table, const std::vector<std::string>& groups) {
  for (size_t i = 0; i < kRecordsPerKind; ++i) {
    if (groups.empty()) {
      table.AddNullRecord();
    } else {
      table.AddRecord(groups[std::min(i, groups.size() - 1)]).value();
    }
  }
}

GpuVirtualAddressRangeAndStride table_of(const Device& device, const ShaderLibrary& library,
                                         ShaderStage stage, ShaderTable& table) {
  for (const std::string& name : exports_of(library, stage)) table.AddRecord(name).value();
  if (table.record_count() == 0) return {};
  table.Build(device).value();
  return table.GetTable();
}

}  // namespace

Scene build_scene(const Device& device, CommandQueue& queue, const ShaderLibrary& library) {
  Scene scene;
  std::vector<RaytracingInstanceDesc> instances;
  const bool box = !exports_of(library, ShaderStage::kIntersection).empty();
  if (box || !exports_of(library, ShaderStage::kClosestHit).empty() ||
      !exports_of(library, ShaderStage::kAnyHit).empty()) {
    instances.push_back(triangle_instance(scene, device, queue));
  }
  if (box) instances.push_back(box_instance(scene, device, queue));
  scene.top_level = build_top_level(device, queue, instances);
  return scene;
}

void dispatch_rays(const Device& device, CommandQueue& queue, const ShaderLibrary& library,
                   const RootSignature& root, CommandList& list, const uint32_t (&size)[3]) {
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library, {}});
  desc.Add(RaytracingShaderConfig{128, 32});
  desc.Add(RaytracingPipelineConfig{4});
  desc.Add(GlobalRootSignature{root});
  const auto triangle_groups = add_hit_groups(desc, library, false);
  const auto box_groups = add_hit_groups(desc, library, true);
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen(pipeline), miss(pipeline), hit(pipeline), callable(pipeline);
  for (const std::string& name : exports_of(library, ShaderStage::kRayGeneration)) {
    raygen.AddRecord(name).value();
  }
  raygen.Build(device).value();
  add_hit_records(hit, triangle_groups);
  add_hit_records(hit, box_groups);
  hit.Build(device).value();
  DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = raygen.GetRecord(0);
  dispatch.HitGroupTable = hit.GetTable();
  dispatch.MissShaderTable = table_of(device, library, ShaderStage::kMiss, miss);
  dispatch.CallableShaderTable = table_of(device, library, ShaderStage::kCallable, callable);
  dispatch.Width = size[0];
  dispatch.Height = size[1];
  dispatch.Depth = size[2];
  list.SetPipelineState1(pipeline);
  list.DispatchRays(dispatch);
  queue.ExecuteAndWait(list).value();
}

}  // namespace kaamos::test
