// SPDX-License-Identifier: MIT
#include "tests/verify/picture.h"

#include <rtapi/upload.h>
#include <shaders/picture.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "tests/common/structures.h"

namespace kaamos::hlsl {

extern const std::pair<std::string_view, std::string_view> kVerifySources[];

}  // namespace kaamos::hlsl

namespace kaamos::verify {

namespace {

using namespace rtapi;

RaytracingGeometryDesc triangles(const Buffer& vertices, size_t count) {
  RaytracingGeometryDesc out;
  out.Type = RaytracingGeometryType::kTriangles;
  out.Flags = RaytracingGeometryFlags::kOpaque;
  out.Triangles.VertexFormat = Format::kR32G32B32Float;
  out.Triangles.VertexCount = static_cast<uint32_t>(3 * count);
  out.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), sizeof(Point)};
  return out;
}

RaytracingInstanceDesc instance(const Buffer& bottom_level, uint32_t id, const Transform& transform,
                                uint32_t contribution = 0) {
  RaytracingInstanceDesc out;
  for (int row = 0; row < 3; ++row) {
    std::copy(transform[row].begin(), transform[row].end(), out.Transform[row]);
  }
  out.InstanceID = id;
  out.InstanceContributionToHitGroupIndex = contribution;
  out.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  return out;
}

// Buffers live as long as what is traced.
struct Scene {
  std::vector<Buffer> buffers;
  Buffer top_level;
};

Scene build_scene(const Device& device, const CommandQueue& queue) {
  Scene out;
  const auto bottom_level = [&](const Buffer& input, const RaytracingGeometryDesc& geometry) {
    out.buffers.push_back(input);
    out.buffers.push_back(test::build_bottom_level(device, queue, {geometry}));
    return out.buffers.back();
  };
  const std::vector<Triangle> floor(kFloor.begin(), kFloor.end()), tilted = {kTilted};
  const Buffer floor_vertices = CreateUploadBuffer(device, floor).value();
  const Buffer tilted_vertices = CreateUploadBuffer(device, tilted).value();
  const std::vector<RaytracingAabb> boxes = {
      {-kRadius, -kRadius, -kRadius, kRadius, kRadius, kRadius}};
  const Buffer box = CreateUploadBuffer(device, boxes).value();
  RaytracingGeometryDesc sphere;
  sphere.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  sphere.Flags = RaytracingGeometryFlags::kOpaque;
  sphere.AABBs = {1, {box.GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  const std::vector<RaytracingInstanceDesc> instances = {
      instance(bottom_level(floor_vertices, triangles(floor_vertices, 2)), kFloorId, kFloorToWorld),
      instance(bottom_level(tilted_vertices, triangles(tilted_vertices, 1)), kTriangleId,
               kTiltedToWorld),
      instance(bottom_level(box, sphere), kSphereId, kSphereToWorld, 1)};
  out.top_level = test::build_top_level(device, queue, instances);
  return out;
}

StateObject make_pipeline(const Device& device, const ShaderLibrary& library,
                          const RootSignature& global) {
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library, {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Triangles", .ClosestHitShaderImport = "TriangleHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "Sphere",
                        .Type = HitGroupType::kProceduralPrimitive,
                        .ClosestHitShaderImport = "SphereHit",
                        .IntersectionShaderImport = "FindSphere"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16, .MaxAttributeSizeInBytes = 8});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 2});
  desc.Add(GlobalRootSignature{global});
  const RootSignature local =
      device
          .CreateRootSignature(
              "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants=1, b0, space=1)")
          .value();
  desc.Associate(desc.Add(LocalRootSignature{local}), {"Sphere"});
  return device.CreateStateObject(desc).value();
}

}  // namespace

std::string picture_source() {
  return std::string(hlsl::kVerifySources[0].second);
}

ShaderLibrary built_in_library() {
  return LoadShaderLibrary(kaamos_shaders_picture()).value();
}

std::vector<Texel> trace_picture(const Device& device, const ShaderLibrary& library) {
  const CommandQueue queue = device.CreateCommandQueue().value();
  const Scene scene = build_scene(device, queue);
  const Buffer picture =
      CreateDefaultBuffer(device, queue, std::vector<std::byte>(kTexels * sizeof(Texel)),
                          ResourceFlags::kAllowUnorderedAccess)
          .value();
  const RootSignature global =
      device.CreateRootSignature("SRV(t0), UAV(u0), RootConstants(num32BitConstants=7, b0)")
          .value();
  const StateObject pipeline = make_pipeline(device, library, global);

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  miss_table.AddRecord("LightIsSeen").value();
  hit_table.AddRecord("Triangles").value();
  hit_table.AddRecord("Sphere", {LocalArgument::Constants(kRadius)}).value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) table->Build(device).value();

  // Vectors of a constant buffer begin at multiples of 16 bytes.
  std::array<float, 7> camera = {};
  std::copy(kEye.begin(), kEye.end(), camera.begin());
  std::copy(kLight.begin(), kLight.end(), camera.begin() + 4);
  CommandList list = device.CreateCommandList().value();
  list.SetComputeRootSignature(global);
  list.SetComputeRootShaderResourceView(0, scene.top_level.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, picture.GetGPUVirtualAddress());
  list.SetComputeRoot32BitConstants(2, camera);
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_table.GetTable(),
                     .Width = kWidth,
                     .Height = kHeight});
  queue.ExecuteAndWait(list).value();
  const std::vector<std::byte> bytes = ReadbackBuffer(device, queue, picture).value();
  std::vector<Texel> out(kTexels);
  std::memcpy(out.data(), bytes.data(), std::min(bytes.size(), out.size() * sizeof(Texel)));
  return out;
}

}  // namespace kaamos::verify
