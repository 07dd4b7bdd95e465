// SPDX-License-Identifier: MIT
// Villages in a partitioned top level: each frame writes what it changes, and nothing else.
#include <shaders/villages.h>

#include <rtapi/rtas_operations.h>

#include <algorithm>
#include <cstring>

#include "../common/example.h"

using namespace rtapi;
using WriteArgs = RtasPartitionedTlasWriteInstanceArgs;
using TranslateArgs = RtasPartitionedTlasTranslatePartitionArgs;

namespace {

constexpr uint32_t kVillages = 4;  // a partition each
constexpr uint32_t kHouses = 16;   // in a village
constexpr uint32_t kInstances = kVillages * kHouses + 2;
constexpr uint32_t kGround = kVillages * kHouses;  // instances of the global partition
constexpr uint32_t kTower = kGround + 1;
constexpr uint32_t kFrames = 4;

WriteArgs Place(const Buffer& bottom_level, uint32_t index, uint32_t partition, float x, float z,
                float scale) {
  WriteArgs args;
  const float place[3] = {x, 0, z};
  for (int row = 0; row < 3; ++row) {
    args.Transform[row][row] = scale;
    args.Transform[row][3] = place[row];
  }
  args.InstanceIndex = index;
  args.PartitionIndex = partition;
  args.InstanceID = std::min(partition, kVillages);
  args.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  return args;
}

// What changes in a frame.
struct Changes {
  std::vector<WriteArgs> writes;
  std::vector<TranslateArgs> translations;
};

// A partitioned top level, its inputs and the memory that its operations use.
struct Villages {
  RtasPartitionedTlasInputsDesc inputs;
  Buffer top_level;
  Buffer scratch;
  std::vector<Buffer> arguments;  // alive until the operations have run
};

Villages CreateVillages(const Device& device) {
  Villages result;
  result.inputs.Flags = RtasPartitionedTlasFlags::kEnablePartitionTranslation;
  result.inputs.InstanceCount = kInstances;
  result.inputs.PartitionCount = kVillages;
  result.inputs.MaxInstancePerPartitionCount = kHouses;
  result.inputs.MaxInstanceInGlobalPartitionCount = 2;
  RtasOperationInputs inputs;
  inputs.Type = RtasOperationType::kPartitionedTlas;
  inputs.pPartitionedTLASInputsDesc = &result.inputs;
  const RtasOperationPrebuildInfo sizes = device.GetRTASOperationPrebuildInfo(inputs);
  const auto memory = [&](uint64_t bytes, const char* name) {
    return device
        .CreateBuffer({.SizeInBytes = bytes,
                       .Flags = ResourceFlags::kAllowUnorderedAccess,
                       .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                       .Name = name})
        .value();
  };
  result.top_level = memory(sizes.ResultDataMaxSizeInBytes, "partitioned top level");
  result.scratch = memory(sizes.ScratchDataSizeInBytes, "scratch");
  return result;
}

// Records the operation that makes a frame's changes: in place, but for the first one, which begins
// with nothing.
void Record(const Device& device, CommandList& list, const Changes& changes, bool is_first,
            Villages& villages) {
  const auto upload = [&](const auto& values, const char* name) {
    villages.arguments.push_back(CreateUploadBuffer(device, values, name).value());
    return villages.arguments.back().GetGPUVirtualAddress();
  };
  using Type = RtasPartitionedTlasOperationType;
  std::vector<RtasPartitionedTlasOperation> operations;
  if (!changes.writes.empty()) {
    operations.push_back({Type::kWriteInstance,
                          static_cast<uint32_t>(changes.writes.size()),
                          {upload(changes.writes, "writes"), 0}});
  }
  if (!changes.translations.empty()) {
    operations.push_back({Type::kTranslatePartition,
                          static_cast<uint32_t>(changes.translations.size()),
                          {upload(changes.translations, "translations"), 0}});
  }
  RtasPartitionedTlasOperationData data;
  data.DestAccelerationStructureData = villages.top_level.GetGPUVirtualAddress();
  data.SourceAccelerationStructureData = is_first ? 0 : data.DestAccelerationStructureData;
  data.ScratchAccelerationStructureData = villages.scratch.GetGPUVirtualAddress();
  data.IndirectPartitionedTlasOps = upload(operations, "operations");
  data.IndirectPartitionedTlasOpCount =
      upload(std::vector<uint32_t>{static_cast<uint32_t>(operations.size())}, "operation count");
  RtasOperationInputs inputs;
  inputs.Type = RtasOperationType::kPartitionedTlas;
  inputs.pPartitionedTLASInputsDesc = &villages.inputs;
  const RtasOperationDesc operation = {.pInputs = &inputs, .pPartitionedTlasOperationData = &data};
  list.ExecuteIndirectRTASOperations({&operation, 1});
  list.ResourceBarrier(ResourceBarrier::Uav(villages.top_level));
}

// The first frame writes all instances. Then the tower moves on with every frame, the second
// village rises in the third frame, and in the last one higher, as the third village follows it.
std::vector<Changes> Film(const Buffer& house, const Buffer& ground) {
  std::vector<Changes> frames(kFrames);
  for (uint32_t i = 0; i < kVillages * kHouses; ++i) {
    const uint32_t village = i / kHouses;
    const auto x = static_cast<float>(i % 4) * 1.5f + (village % 2 == 0 ? -7.5f : 3.0f);
    const auto z = static_cast<float>(i / 4 % 4) * 1.5f + (village / 2 == 0 ? -5.0f : 3.0f);
    frames[0].writes.push_back(Place(house, i, village, x, z, 0.55f));
  }
  frames[0].writes.push_back(Place(ground, kGround, kRtasPartitionIndexGlobalPartition, 0, 0, 1));
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    WriteArgs tower = Place(house, kTower, kRtasPartitionIndexGlobalPartition,
                            -6 + 4 * static_cast<float>(frame), 0.5f, 0.9f);
    tower.Transform[1][1] = 2.5f;
    tower.InstanceID = kVillages + 1;
    frames[frame].writes.push_back(tower);
  }
  frames[2].translations = {{1, {0, 1.2f, 0}}};
  frames[3].translations = {{1, {0, 2.4f, 0}}, {2, {0, 1.2f, 0}}};
  return frames;
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const example::Image image = example::CreateImage(setup);

  const example::Mesh house_mesh = example::CreateMesh(
      setup,
      {-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1, -1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1, 0, 2, 0},
      {0, 4, 5, 0, 5, 1, 1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3,
       3, 7, 4, 3, 4, 0, 4, 8, 5, 5, 8, 6, 6, 8, 7, 7, 8, 4});
  const example::Mesh ground_mesh = example::CreateMesh(
      setup, {-30, 0, -30, -30, 0, 30, 30, 0, 30, 30, 0, -30}, {0, 1, 2, 0, 2, 3});
  const Buffer house =
      BuildBottomLevel(device, setup.queue, {house_mesh.geometry}, "house").value();
  const Buffer ground =
      BuildBottomLevel(device, setup.queue, {ground_mesh.geometry}, "ground").value();

  const RootSignature root_signature =
      device
          .CreateRootSignature(
              "SRV(t0), DescriptorTable(UAV(u0)), RootConstants(b0, num32BitConstants = 1)")
          .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_villages()).value(), {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Surface", .ClosestHitShaderImport = "ClosestHit"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 12});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 2});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();
  ShaderTable raygen_table(pipeline), miss_table(pipeline), hit_table(pipeline);
  raygen_table.AddRecord("RayGen").value();
  miss_table.AddRecord("PrimaryMiss").value();
  miss_table.AddRecord("ShadowMiss").value();
  hit_table.AddRecord("Surface").value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  Villages villages = CreateVillages(device);
  const std::vector<Changes> film = Film(house, ground);
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    CommandList list = device.CreateCommandList().value();
    Record(device, list, film[frame], frame == 0, villages);
    list.SetDescriptorHeaps({image.heap});
    list.SetComputeRootSignature(root_signature);
    list.SetComputeRootShaderResourceView(0, villages.top_level.GetGPUVirtualAddress());
    list.SetComputeRootDescriptorTable(1, image.heap.GetGPUDescriptorHandleForHeapStart());
    list.SetComputeRoot32BitConstant(2, frame, 0);
    list.SetPipelineState1(pipeline);
    list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                       .MissShaderTable = miss_table.GetTable(),
                       .HitGroupTable = hit_table.GetTable(),
                       .Width = (setup.width + 1) / 2,
                       .Height = (setup.height + 1) / 2});
    setup.queue.ExecuteAndWait(list).value();
  }
  return image.texture;
}

}  // namespace

int main(int argc, char** argv) {
  // Operations on partitioned top levels are experimental: a device has them where it is asked.
  const DeviceDesc experimental = {.ShaderModel = ShaderModel::k6_10,
                                   .IndirectRtasOperations = true};
  return example::Main(argc, argv, "16-partitioned-top-level", Render, {}, experimental);
}
