// SPDX-License-Identifier: MIT
// Hit objects: a ray is traced, threads may be reordered, and only then a shader runs.
#include <shaders/reordering.h>

#include <cmath>

#include "../common/example.h"

using namespace rtapi;

namespace {

// Records of the hit group table.
enum Material : uint32_t { kMatte, kCheckered, kMirror };

struct Box {
  float center[3];
  float half_size[3];
  float turn;  // radians about y
  Material material;
  float color[3];
};
const std::vector<Box> kBoxes = {
    {{0, -0.5f, 0}, {8, 0.5f, 8}, 0, kCheckered, {0.8f, 0.79f, 0.75f}},
    {{-2.6f, 1, 0.6f}, {0.8f, 1, 0.8f}, 0.5f, kMatte, {0.8f, 0.3f, 0.2f}},
    {{-0.6f, 0.55f, -1.6f}, {0.55f, 0.55f, 0.55f}, 0.9f, kMatte, {0.25f, 0.5f, 0.8f}},
    {{2.6f, 0.8f, -0.9f}, {0.4f, 0.8f, 0.4f}, 0.2f, kMatte, {0.3f, 0.65f, 0.35f}},
    {{-1.8f, 1.8f, 3.2f}, {2.6f, 1.8f, 0.1f}, -0.25f, kMirror, {0.9f, 0.85f, 0.75f}},
    {{3.3f, 1.8f, 2.4f}, {2.4f, 1.8f, 0.1f}, 0.55f, kMirror, {0.8f, 0.87f, 0.92f}},
    {{0.7f, 0.6f, 0.6f}, {0.6f, 0.6f, 0.6f}, 0.35f, kMirror, {0.85f, 0.85f, 0.85f}},
};
const std::vector<float> kCube = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                  -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
// Clockwise, seen from outside.
const std::vector<uint32_t> kSides = {0, 2, 1, 1, 2, 3, 1, 3, 5, 5, 3, 7, 5, 7, 4, 4, 7, 6,
                                      4, 6, 0, 0, 6, 2, 2, 6, 3, 3, 6, 7, 4, 0, 5, 5, 0, 1};

RaytracingInstanceDesc InstanceOf(const Box& box, const Buffer& bottom_level) {
  RaytracingInstanceDesc instance = example::Instance(bottom_level, 0, 0, 0);
  const float c = std::cos(box.turn);
  const float s = std::sin(box.turn);
  const float turn[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      instance.Transform[row][column] = turn[row][column] * box.half_size[column];
    }
    instance.Transform[row][3] = box.center[row];
  }
  instance.InstanceContributionToHitGroupIndex = box.material;
  return instance;
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  const example::Mesh cube = example::CreateMesh(setup, kCube, kSides);
  const Buffer bottom_level =
      BuildBottomLevel(device, setup.queue, {cube.geometry}, "bottom level").value();
  std::vector<RaytracingInstanceDesc> instances;
  std::vector<float> colors;
  for (const Box& box : kBoxes) {
    instances.push_back(InstanceOf(box, bottom_level));
    colors.insert(colors.end(), box.color, box.color + 3);
  }
  const Buffer top_level = BuildTopLevel(device, setup.queue, instances, "top level").value();
  const Buffer box_colors = CreateUploadBuffer(device, colors, "box colors").value();

  const RootSignature root_signature =
      device.CreateRootSignature("SRV(t0), SRV(t1), DescriptorTable(UAV(u0))").value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_reordering()).value();
  const char* materials[] = {"Matte", "Checkered", "Mirror"};

  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library});
  for (const char* material : materials) {
    desc.Add(HitGroupDesc{.HitGroupExport = std::string(material) + "Group",
                          .ClosestHitShaderImport = material});
  }
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4 * 3 * sizeof(float)});
  // TraceRay and Invoke both come from the ray generation shader.
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();

  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("FollowMirrors").value();
  miss_table.AddRecord("Sky").value();
  for (const char* material : materials) {
    hit_table.AddRecord(std::string(material) + "Group").value();
  }
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({image.heap});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(1, box_colors.GetGPUVirtualAddress());
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

}  // namespace

int main(int argc, char** argv) {
  return example::Main(argc, argv, "14-reordering", Render);
}
