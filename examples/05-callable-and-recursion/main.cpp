// SPDX-License-Identifier: MIT
// Recursion up to MaxTraceRecursionDepth, and callable shaders in a table of their own.
#include <shaders/mirrors.h>

#include "../common/example.h"

using namespace rtapi;

// A box with its triangles grouped by axis, four for each; front faces point outwards.
static example::Mesh MakeBox(const example::Setup& setup, float x0, float y0, float z0, float x1,
                             float y1, float z1) {
  const std::vector<float> corners = {x0, y0, z0, x1, y0, z0, x0, y1, z0, x1, y1, z0,
                                      x0, y0, z1, x1, y0, z1, x0, y1, z1, x1, y1, z1};
  return example::CreateMesh(setup, corners, {0, 4, 2, 4, 6, 2, 1, 3, 5, 3, 7, 5,    // x
                                              0, 1, 4, 1, 5, 4, 2, 6, 3, 6, 7, 3,    // y
                                              0, 2, 1, 2, 3, 1, 4, 5, 6, 6, 5, 7});  // z
}

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  const example::Mesh boxes[] = {
      MakeBox(setup, -8, -0.1f, -8, 8, 0, 8),        // floor
      MakeBox(setup, -3, 0, 2.5f, 3, 2.6f, 2.7f),    // mirror behind
      MakeBox(setup, -3.2f, 0, -2, -3, 2.6f, 2.5f),  // mirror on the left
      MakeBox(setup, -0.6f, 0, -0.4f, 0.4f, 1.3f, 0.6f),
      MakeBox(setup, 1.2f, 0, 0.2f, 1.8f, 0.7f, 0.8f),
  };
  const uint32_t callable_of_box[] = {0, 1, 1, 2, 2};
  std::vector<RaytracingGeometryDesc> geometries;
  for (const example::Mesh& box : boxes) {
    geometries.push_back(box.geometry);
  }
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, geometries, "bottom level").value();
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue,
                                         {example::Instance(bottom_level, 0, 0, 0)}, "top level")
                               .value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  const RootSignature local_root_signature =
      device
          .CreateRootSignature(
              "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants = 1, b0, space = "
              "1)")
          .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_mirrors()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "BoxGroup", .ClosestHitShaderImport = "BoxClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 6});
  desc.Add(GlobalRootSignature{root_signature});
  desc.Associate(desc.Add(LocalRootSignature{local_root_signature}), {"BoxGroup"});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline),
      callable_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  for (const uint32_t callable : callable_of_box) {
    hit_table.AddRecord("BoxGroup", {LocalArgument::Constants(callable)}).value();
  }
  for (const char* name : {"Chequers", "Mirror", "Stripes"}) {
    callable_table.AddRecord(name).value();
  }
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table, &callable_table}) {
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
                     .CallableShaderTable = callable_table.GetTable(),
                     .Width = setup.width,
                     .Height = setup.height});
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "05-callable-and-recursion", Render);
}
