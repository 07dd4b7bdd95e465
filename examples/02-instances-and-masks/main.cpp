// SPDX-License-Identifier: MIT
// Many instances of one bottom level; InstanceMask and InstanceInclusionMask choose which ones rays
// see.
#include <shaders/masks.h>

#include <cmath>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  const example::Mesh pyramid = example::CreateMesh(
      setup, {-0.5f, 0, -0.5f, 0.5f, 0, -0.5f, 0.5f, 0, 0.5f, -0.5f, 0, 0.5f, 0, 1, 0},
      {0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0});
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, {pyramid.geometry}, "bottom level").value();

  // A 5 x 5 field with masks 1 and 2 like the squares of a chess board, each instance turned a bit
  // more.
  std::vector<RaytracingInstanceDesc> instances;
  for (uint32_t i = 0; i < 25; ++i) {
    const float angle = 0.25f * static_cast<float>(i);
    const float x = static_cast<float>(i % 5) - 2;
    const float z = static_cast<float>(i / 5) - 2;
    RaytracingInstanceDesc instance = example::Instance(bottom_level, x * 1.1f, 0, z * 1.5f);
    instance.Transform[0][0] = std::cos(angle);
    instance.Transform[0][2] = std::sin(angle);
    instance.Transform[2][0] = -std::sin(angle);
    instance.Transform[2][2] = std::cos(angle);
    instance.InstanceID = i;  // 24 bits for the application to use as it likes
    instance.InstanceMask = i % 2 == 0 ? 1 : 2;
    instances.push_back(instance);
  }
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue, instances, "top level").value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_masks()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "PyramidGroup", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  hit_table.AddRecord("PyramidGroup").value();
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
  return example::Main(argc, argv, "02-instances-and-masks", Render);
}
