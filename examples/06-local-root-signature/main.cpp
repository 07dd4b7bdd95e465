// SPDX-License-Identifier: MIT
// A torus three times; each instance has its own record with vertices, indices and a material.
#include <shaders/records.h>

#include <cmath>

#include "../common/example.h"

using namespace rtapi;

struct Vertex {
  float position[3];
  float normal[3];
};

static void MakeTorus(uint32_t around, uint32_t across, std::vector<Vertex>& vertices,
                      std::vector<uint32_t>& indices) {
  const float turn = 6.2831853f;
  for (uint32_t i = 0; i < around; ++i) {
    for (uint32_t j = 0; j < across; ++j) {
      const float u = turn * static_cast<float>(i) / static_cast<float>(around);
      const float v = turn * static_cast<float>(j) / static_cast<float>(across);
      const float r = 0.7f + 0.3f * std::cos(v);
      vertices.push_back({{r * std::cos(u), r * std::sin(u), 0.3f * std::sin(v)},
                          {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)}});
      const uint32_t a = i * across + j;
      const uint32_t b = i * across + (j + 1) % across;
      const uint32_t c = (i + 1) % around * across + j;
      const uint32_t d = (i + 1) % around * across + (j + 1) % across;
      indices.insert(indices.end(), {a, b, c, c, b, d});
    }
  }
}

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  MakeTorus(64, 32, vertices, indices);
  const Buffer vertex_buffer = CreateUploadBuffer(device, vertices, "torus vertices").value();
  const Buffer index_buffer = CreateUploadBuffer(device, indices, "torus indices").value();
  RaytracingGeometryDesc geometry;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = static_cast<uint32_t>(vertices.size());
  geometry.Triangles.VertexBuffer = {vertex_buffer.GetGPUVirtualAddress(), sizeof(Vertex)};
  geometry.Triangles.IndexFormat = Format::kR32Uint;
  geometry.Triangles.IndexCount = static_cast<uint32_t>(indices.size());
  geometry.Triangles.IndexBuffer = index_buffer.GetGPUVirtualAddress();
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, {geometry}, "bottom level").value();

  std::vector<RaytracingInstanceDesc> instances;
  for (uint32_t i = 0; i < 3; ++i) {
    instances.push_back(
        example::Instance(bottom_level, -2.2f + 2.2f * static_cast<float>(i), 0, 0));
    instances.back().InstanceContributionToHitGroupIndex = i;  // selects record i
  }
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue, instances, "top level").value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), DescriptorTable(UAV(u0))").value();
  const RootSignature local_root_signature =
      device
          .CreateRootSignature(
              "RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t0, space = 1), SRV(t1, space = 1), "
              "RootConstants(num32BitConstants = 4, b0, space = 1)")
          .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_records()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "TorusGroup", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  desc.Associate(desc.Add(LocalRootSignature{local_root_signature}), {"TorusGroup"});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  struct Material {
    float color[3];
    float roughness;
  };
  const Material materials[] = {
      {{0.7f, 0.08f, 0.05f}, 0.5f}, {{0.05f, 0.4f, 0.1f}, 0.25f}, {{0.05f, 0.12f, 0.6f}, 0.1f}};
  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("Miss").value();
  for (const Material& material : materials) {
    hit_table
        .AddRecord("TorusGroup",
                   {LocalArgument::Address(vertex_buffer), LocalArgument::Address(index_buffer),
                    LocalArgument::Constants(material)})
        .value();
  }
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  GpuVirtualAddressRangeAndStride hit_groups = hit_table.GetTable();
  // A classic mistake: the stride of records without arguments. Checked mode says what it should
  // be.
  if (setup.broken == "stride") hit_groups.StrideInBytes = kShaderIdentifierSizeInBytes;

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(1, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_groups,
                     .Width = setup.width,
                     .Height = setup.height});
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "06-local-root-signature", Render, {"stride"});
}
