// SPDX-License-Identifier: MIT
// Inline ray tracing: a compute pipeline, a RayQuery, and no hit groups or shader tables.
#include <shaders/ray_query.h>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  // Opaque triangles are committed directly; the fence and the boxes become candidates.
  const std::vector<uint32_t> two_triangles = {0, 1, 2, 0, 2, 3};
  const example::Mesh ground =
      example::CreateMesh(setup, {-20, 0, -20, -20, 0, 20, 20, 0, 20, 20, 0, -20}, two_triangles);
  const example::Mesh fence =
      example::CreateMesh(setup, {-4, 0, 0, -4, 1.6f, 0, 4, 1.6f, 0, 4, 0, 0}, two_triangles,
                          RaytracingGeometryFlags::kNone);
  const std::vector<RaytracingAabb> box = {{-1, -1, -1, 1, 1, 1}};
  const Buffer box_buffer = CreateUploadBuffer(device, box, "box").value();
  RaytracingGeometryDesc sphere;
  sphere.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  sphere.AABBs = {box.size(), {box_buffer.GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  const Buffer ground_level =
      BuildBottomLevel(setup.device, setup.queue, {ground.geometry}, "bottom level").value();
  const Buffer fence_level =
      BuildBottomLevel(setup.device, setup.queue, {fence.geometry}, "bottom level").value();
  const Buffer sphere_level =
      BuildBottomLevel(setup.device, setup.queue, {sphere}, "bottom level").value();

  // InstanceID says what was hit; a query knows nothing else about it.
  std::vector<RaytracingInstanceDesc> instances = {example::Instance(ground_level, 0, 0, 0),
                                                   example::Instance(fence_level, 0, 0, -1)};
  instances[1].InstanceID = 1;
  for (int i = 0; i < 5; ++i) {
    const float x = 1.6f * static_cast<float>(i) - 3.2f;
    const float radius = 0.5f + 0.08f * static_cast<float>(i);
    instances.push_back(
        example::Instance(sphere_level, x, radius, i % 2 == 0 ? 1.2f : -2.2f, radius));
    instances.back().InstanceID = 2;
  }
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue, instances, "top level").value();

  const RootSignature root_signature =
      device
          .CreateRootSignature(
              "SRV(t0), DescriptorTable(UAV(u0)), RootConstants(num32BitConstants = 2, b0)")
          .value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_ray_query()).value();
  const PipelineState pipeline =
      device.CreateComputePipelineState({root_signature, library, "Main", "ray query"}).value();
  struct Constants {
    uint32_t size[2];
  };
  const Constants constants = {{setup.width, setup.height}};

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(1, image.heap.GetGPUDescriptorHandleForHeapStart());
  list.SetComputeRoot32BitConstants(2, constants);
  list.SetPipelineState(pipeline);
  list.Dispatch((setup.width + 7) / 8, (setup.height + 7) / 8, 1);
  setup.queue.ExecuteAndWait(list).value();
  return image.texture;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "09-ray-query", Render);
}
