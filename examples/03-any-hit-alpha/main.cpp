// SPDX-License-Identifier: MIT
// An opaque floor and a screen with holes; camera rays and shadow rays.
#include <shaders/alpha.h>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  const std::vector<uint32_t> quad = {0, 1, 2, 0, 2, 3};
  const example::Mesh floor = example::CreateMesh(setup, {-9, 0, -9, -9, 0, 9, 9, 0, 9, 9, 0, -9},
                                                  quad, RaytracingGeometryFlags::kOpaque);
  // Not opaque, so its any-hit shader runs for every potential hit.
  const example::Mesh screen =
      example::CreateMesh(setup, {-2, 0.3f, 0, -2, 2.6f, 0.6f, 2, 2.6f, 0.6f, 2, 0.3f, 0}, quad,
                          RaytracingGeometryFlags::kNone);
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, {floor.geometry, screen.geometry}, "bottom level")
          .value();
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue,
                                         {example::Instance(bottom_level, 0, 0, 0)}, "top level")
                               .value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_alpha()).value(), {}});
  desc.Add(
      HitGroupDesc{.HitGroupExport = "FloorPrimary", .ClosestHitShaderImport = "FloorClosestHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "FloorShadow"});  // no shader: the hit itself is enough
  desc.Add(HitGroupDesc{.HitGroupExport = "LeafPrimary",
                        .AnyHitShaderImport = "LeafAnyHitPrimary",
                        .ClosestHitShaderImport = "LeafClosestHit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "LeafShadow", .AnyHitShaderImport = "LeafAnyHitShadow"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 2});  // hit shaders trace a shadow
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  // The record is ray type + ray types * geometry, as TraceRay's arguments say.
  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("PrimaryMiss").value();
  miss_table.AddRecord("ShadowMiss").value();
  for (const char* group : {"FloorPrimary", "FloorShadow", "LeafPrimary", "LeafShadow"}) {
    hit_table.AddRecord(group).value();
  }
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(1, image.heap.GetGPUDescriptorHandleForHeapStart());
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
  return example::Main(argc, argv, "03-any-hit-alpha", Render);
}
