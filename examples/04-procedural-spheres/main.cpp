// SPDX-License-Identifier: MIT
// A bottom level of boxes and an intersection shader that finds spheres in them.
#include <shaders/spheres.h>

#include <cmath>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  struct Sphere {
    float x, y, z, radius;
  };
  std::vector<Sphere> spheres;
  std::vector<RaytracingAabb> boxes;
  for (int i = 0; i < 60; ++i) {
    // A spiral that grows outwards.
    const float t = static_cast<float>(i) / 60;
    const float angle = 14 * t;
    const Sphere s = {3.2f * t * std::cos(angle), 1.6f * t * std::sin(angle),
                      2 * std::sin(angle * 2), 0.12f + 0.35f * t};
    spheres.push_back(s);
    boxes.push_back({s.x - s.radius, s.y - s.radius, s.z - s.radius, s.x + s.radius, s.y + s.radius,
                     s.z + s.radius});
  }
  const Buffer sphere_buffer = CreateUploadBuffer(device, spheres, "spheres").value();
  const Buffer box_buffer = CreateUploadBuffer(device, boxes, "boxes").value();
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  geometry.AABBs = {boxes.size(), {box_buffer.GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, {geometry}, "bottom level").value();
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue,
                                         {example::Instance(bottom_level, 0, 0.6f, 0)}, "top level")
                               .value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), SRV(t1), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_spheres()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "SphereGroup",
                        .Type = HitGroupType::kProceduralPrimitive,
                        .ClosestHitShaderImport = "SphereClosestHit",
                        .IntersectionShaderImport = "SphereIntersection"});
  desc.Add(HitGroupDesc{.HitGroupExport = "SphereShadowGroup",
                        .Type = HitGroupType::kProceduralPrimitive,
                        .IntersectionShaderImport = "SphereIntersection"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12, .MaxAttributeSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 2});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  miss_table.AddRecord("ShadowMiss").value();
  hit_table.AddRecord("SphereGroup").value();
  hit_table.AddRecord("SphereShadowGroup").value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(1, sphere_buffer.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(2, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_table.GetTable(),
                     .Width = setup.width,
                     .Height = setup.height});
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "04-procedural-spheres", Render);
}
