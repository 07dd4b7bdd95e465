// SPDX-License-Identifier: MIT
#include "tests/observed/world.h"

#include <cstring>

namespace kaamos::observed {

using namespace rtapi;

namespace {

constexpr char kRootSignature[] =
    "RootFlags(CBV_SRV_UAV_HEAP_DIRECTLY_INDEXED), UAV(u0), SRV(t0),"
    "RootConstants(b0, num32BitConstants = 4),"
    "DescriptorTable(SRV(t0, space = 1, numDescriptors = 8),"
    "UAV(u0, space = 1, numDescriptors = 8)),"
    "StaticSampler(s0, space = 2, filter = FILTER_MIN_MAG_MIP_POINT)";

}  // namespace

void World::SetUp() {
  test::OnBackends::SetUp();
  if (IsSkipped() || HasFatalFailure()) return;
  open();
}

void World::open(bool checked) {
  keep_.clear();
  scene_ = {};
  messages_.clear();
  DeviceDesc desc;
  desc.Backend = GetParam();
  desc.Checked = checked;
  desc.OnMessage = [this](const Message& message) { messages_.push_back(message); };
  device_ = CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
  root_ = device_.CreateRootSignature(kRootSignature).value();
  views_ = device_
               .CreateDescriptorHeap(
                   {.NumDescriptors = kViewCount, .Flags = DescriptorHeapFlags::kShaderVisible})
               .value();
  out_ = zeros(1024, "out");
}

Buffer World::zeros(uint64_t bytes, const std::string& name) {
  return device_
      .CreateBuffer({.SizeInBytes = bytes,
                     .Flags = ResourceFlags::kAllowUnorderedAccess,
                     .InitialState = ResourceStates::kUnorderedAccess,
                     .Name = name})
      .value();
}

std::vector<uint32_t> World::read(const Buffer& words) {
  const auto bytes = ReadbackBuffer(device_, queue_, words).value();
  std::vector<uint32_t> out(bytes.size() / 4);
  std::memcpy(out.data(), bytes.data(), out.size() * 4);
  return out;
}

Buffer World::build(const BuildRaytracingAccelerationStructureInputs& inputs,
                    const std::string& name) {
  return rtapi::BuildAccelerationStructure(device_, queue_, inputs, name).value();
}

Buffer World::boxes(const std::vector<RaytracingAabb>& boxes,
                    RaytracingAccelerationStructureBuildFlags flags) {
  const Buffer input = CreateUploadBuffer(device_, boxes, "boxes").value();
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry.AABBs = {boxes.size(), {input.GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  return instance_of(build(inputs, "bottom"));
}

Buffer World::triangle() {
  const std::vector<float> corners = {-1, -1, 5, 1, -1, 5, 0, 1, 5};
  const Buffer input = CreateUploadBuffer(device_, corners, "corners").value();
  RaytracingGeometryDesc geometry;
  geometry.Triangles.VertexBuffer = {input.GetGPUVirtualAddress(), 12};
  geometry.Triangles.VertexCount = 3;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  return instance_of(test::build_bottom_level(device_, queue_, {geometry}));
}

Buffer World::instance_of(const Buffer& bottom_level) {
  keep_.push_back(bottom_level);
  RaytracingInstanceDesc instance;
  for (int i = 0; i < 3; ++i) instance.Transform[i][i] = 1;
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  return test::build_top_level(device_, queue_, {instance}, "scene");
}

void World::bind(CommandList& list) {
  list.SetDescriptorHeaps({views_});
  list.SetComputeRootSignature(root_);
  list.SetComputeRootUnorderedAccessView(kOut, out_.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(kScene, scene_.GetGPUVirtualAddress());
  list.SetComputeRoot32BitConstants(kConstants, 4, constants_, 0);
  list.SetComputeRootDescriptorTable(kViews, views_.GetGPUDescriptorHandle(0));
}

void World::dispatch(const ShaderLibrary& library, const char* entry) {
  const PipelineState pipeline =
      device_.CreateComputePipelineState({root_, library, entry, entry}).value();
  CommandList list = device_.CreateCommandList().value();
  bind(list);
  list.SetPipelineState(pipeline);
  list.Dispatch(1, 1, 1);
  queue_.ExecuteAndWait(list).value();
}

DispatchRaysDesc World::Tables::desc(uint32_t width) const {
  DispatchRaysDesc out;
  out.RayGenerationShaderRecord = ray_generation.GetRecord(0);
  out.MissShaderTable = miss.GetTable();
  out.HitGroupTable = hit.GetTable();
  out.Width = width;
  return out;
}

World::Tables World::tables_of(const StateObject& pipeline, const std::string& ray_generation,
                               const std::string& hit_group) {
  Tables out(pipeline);
  out.ray_generation.AddRecord(ray_generation).value();
  out.miss.AddRecord("Miss").value();
  out.hit.AddRecord(hit_group).value();
  for (ShaderTable* table : {&out.ray_generation, &out.miss, &out.hit}) {
    table->Build(device_).value();
  }
  return out;
}

}  // namespace kaamos::observed
