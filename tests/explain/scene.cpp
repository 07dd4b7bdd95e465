// SPDX-License-Identifier: MIT
#include "tests/explain/scene.h"

#include <shaders/explain.h>

#include <cstdlib>
#include <cstring>

#include "tests/common/structures.h"

namespace kaamos::explain_test {

using namespace rtapi;

namespace {

struct Vertex {
  float x, y, z;
};

RaytracingInstanceDesc instance(const Buffer& level, float x, float z, uint32_t id,
                                uint32_t contribution) {
  RaytracingInstanceDesc desc;
  desc.Transform[0][3] = x;
  desc.Transform[2][3] = z;
  desc.InstanceID = id;
  desc.InstanceMask = 0x01;
  desc.InstanceContributionToHitGroupIndex = contribution;
  desc.AccelerationStructure = level.GetGPUVirtualAddress();
  return desc;
}

}  // namespace

void Scene::SetUp() {
  DeviceDesc desc;
  desc.Backend = GetParam();
  const auto device = CreateDevice(desc);
  const char* required = std::getenv("KAAMOS_REQUIRE_VULKAN");
  if (!device && GetParam() == "vulkan" &&
      !(required != nullptr && std::strcmp(required, "1") == 0)) {
    GTEST_SKIP() << device.error().message;
  }
  ASSERT_TRUE(device) << device.error().message;
  device_ = *device;
  queue_ = device_.CreateCommandQueue().value();
  zeros_ = CreateUploadBuffer(device_, std::vector<float>(16), "zeros").value();
  colors_ = CreateUploadBuffer(device_, std::vector<float>{0.5f, 0.25f, 1, 1}, "colors").value();
  results_ =
      device_
          .CreateBuffer(
              {.SizeInBytes = 64, .Flags = ResourceFlags::kAllowUnorderedAccess, .Name = "results"})
          .value();
  build_structures();
  build_pipeline();
  build_tables();
}

void Scene::build_structures() {
  // Clockwise as seen along z, so these are front faces.
  vertices_ =
      CreateUploadBuffer(device_, std::vector<Vertex>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, "vertices")
          .value();
  boxes_ =
      CreateUploadBuffer(device_, std::vector<RaytracingAabb>{{0, 0, 0, 1, 1, 2}}, "boxes").value();
  RaytracingGeometryDesc triangle;
  triangle.Triangles.VertexFormat = Format::kR32G32B32Float;
  triangle.Triangles.VertexCount = 3;
  triangle.Triangles.VertexBuffer = {vertices_.GetGPUVirtualAddress(), sizeof(Vertex)};
  leaf_ = kaamos::test::build_bottom_level(device_, queue_, {triangle}, "leaf");
  triangle.Flags = RaytracingGeometryFlags::kOpaque;
  triangle_ = kaamos::test::build_bottom_level(device_, queue_, {triangle}, "triangle");
  RaytracingGeometryDesc box;
  box.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  box.Flags = RaytracingGeometryFlags::kOpaque;
  box.AABBs = {1, {boxes_.GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  box_ = kaamos::test::build_bottom_level(device_, queue_, {box}, "box");

  std::vector<RaytracingInstanceDesc> instances = {
      instance(leaf_, 0, 1, 10, 0),     instance(leaf_, 0, 2, 11, 0),
      instance(triangle_, 0, 3, 12, 2), instance(triangle_, 0, 4, 13, 2),
      instance(triangle_, 0, 5, 14, 2), instance(triangle_, 0, 6, 15, 2),
      instance(triangle_, 0, 7, 16, 2), instance(box_, 10, 2, 17, 4)};
  instances[2].InstanceMask = 0x02;
  instances[3].Flags =
      static_cast<uint32_t>(RaytracingInstanceFlags::kTriangleFrontCounterclockwise);
  top_level_ = kaamos::test::build_top_level(device_, queue_, instances);
}

void Scene::build_pipeline() {
  root_ = device_.CreateRootSignature("SRV(t0), UAV(u0)").value();
  const RootSignature leaf =
      device_
          .CreateRootSignature(
              "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants=2, b0, space=1)")
          .value();
  const RootSignature wall = device_
                                 .CreateRootSignature(
                                     "RootFlags(LOCAL_ROOT_SIGNATURE), "
                                     "DescriptorTable(SRV(t0, space=1, numDescriptors=1))")
                                 .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_explain()).value()});
  desc.Add(HitGroupDesc{.HitGroupExport = "Leaf", .AnyHitShaderImport = "LeafAnyHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "LeafForShadows", .AnyHitShaderImport = "LeafShadow"});
  desc.Add(HitGroupDesc{.HitGroupExport = "Wall", .ClosestHitShaderImport = "WallHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "Sphere",
                        .Type = HitGroupType::kProceduralPrimitive,
                        .ClosestHitShaderImport = "SphereHit",
                        .IntersectionShaderImport = "SphereIntersection"});
  desc.Add(RaytracingShaderConfig{16, 8});
  desc.Add(RaytracingPipelineConfig{2});
  desc.Add(GlobalRootSignature{root_});
  desc.Associate(desc.Add(LocalRootSignature{leaf}), {"Leaf", "LeafForShadows"});
  desc.Associate(desc.Add(LocalRootSignature{wall}), {"Wall"});
  pipeline_ = device_.CreateStateObject(desc).value();
}

void Scene::build_tables() {
  heap_ =
      device_
          .CreateDescriptorHeap(
              {.NumDescriptors = 3, .Flags = DescriptorHeapFlags::kShaderVisible, .Name = "views"})
          .value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Buffer.NumElements = 1;
  view.Buffer.StructureByteStride = 16;
  device_.CreateShaderResourceView(colors_, view, heap_.GetCPUDescriptorHandle(2)).value();

  struct LeafArguments {
    float cutout;
    uint32_t id;
  };
  const auto leaf = [](float cutout, uint32_t id) {
    return LocalArgument::Constants(LeafArguments{cutout, id});
  };
  ShaderTable generation(pipeline_, "ray generation"), miss(pipeline_, "miss"),
      hit(pipeline_, "hit groups"), callable(pipeline_, "callables");
  generation.AddRecord("ExplainRayGen").value();
  miss.AddRecord("SkyMiss").value();
  miss.AddRecord("ShadowMiss").value();
  // instance contribution + geometry * 2 + ray contribution
  hit.AddRecord("Leaf", {leaf(0.5f, 7)}).value();
  hit.AddRecord("LeafForShadows", {leaf(0.5f, 7)}).value();
  hit.AddRecord("Wall", {LocalArgument::Table(heap_.GetGPUDescriptorHandle(2))}).value();
  hit.AddNullRecord();
  hit.AddRecord("Sphere").value();
  callable.AddRecord("Tint").value();
  ShaderTable* all[] = {&generation, &miss, &hit, &callable};
  for (int i = 0; i < 4; ++i) {
    all[i]->Build(device_).value();
    tables_[i] = all[i]->buffer();
  }
  dispatch_.RayGenerationShaderRecord = generation.GetRecord(0);
  dispatch_.MissShaderTable = miss.GetTable();
  dispatch_.HitGroupTable = hit.GetTable();
  dispatch_.CallableShaderTable = callable.GetTable();
  dispatch_.Width = 4;
}

CommandList Scene::record() {
  CommandList list = device_.CreateCommandList().value();
  list.CopyBufferRegion(results_, 0, zeros_, 0, 64);
  list.ResourceBarrier(ResourceBarrier::Uav());
  list.SetDescriptorHeaps({heap_});
  list.SetComputeRootSignature(root_);
  list.SetComputeRootShaderResourceView(0, top_level_.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
  list.SetPipelineState1(pipeline_);
  list.DispatchRays(dispatch_);
  return list;
}

std::vector<float> Scene::results() {
  const auto bytes = ReadbackBuffer(device_, queue_, results_).value();
  std::vector<float> values(16);
  std::memcpy(values.data(), bytes.data(), 64);
  return values;
}

TableDescription Scene::describe_tables() {
  TableDescriptionDesc desc;
  desc.Dispatch = dispatch_;
  desc.TopLevel = top_level_.GetGPUVirtualAddress();
  desc.RayTypes = {{"surface", 0, 2, 0}, {"shadow", 1, 2, 1}};
  return DescribeShaderTables(device_, pipeline_, desc).value();
}

}  // namespace kaamos::explain_test
