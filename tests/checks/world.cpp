// SPDX-License-Identifier: MIT
#include "tests/checks/world.h"

#include <shaders/checks.h>
#include <shaders/queries.h>

#include <algorithm>

#include "tests/common/structures.h"
#include "tests/vulkan/support.h"

namespace kaamos::checks::test {

using namespace rtapi;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;

void World::SetUp() {
  if (std::string(GetParam()) == "vulkan") {
    if (const std::string why = kaamos::test::why_no_vulkan(); !why.empty()) {
      if (kaamos::test::vulkan_is_required()) FAIL() << why;
      GTEST_SKIP() << why;
    }
  }
  DeviceDesc desc = device_desc();
  desc.Backend = GetParam();
  desc.Checked = true;
  desc.OnMessage = [this](const Message& message) { messages_.push_back(message); };
  device_ = CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
  results_ = buffer(256, "results");
  local_ = upload(std::vector<uint32_t>(4, 7u), "local data");
  pipeline_ = make_pipeline();
}

Buffer World::buffer(uint64_t bytes, const std::string& name, bool structure) {
  BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  if (structure) desc.InitialState = ResourceStates::kRaytracingAccelerationStructure;
  desc.Name = name;
  keep_.push_back(device_.CreateBuffer(desc).value());
  return keep_.back();
}

std::vector<RaytracingGeometryDesc> World::triangles(uint32_t geometries) {
  vertices_ = upload(std::vector<float>{-1, -1, 0, 1, -1, 0, 0, 2, 0}, "floor.vb");
  RaytracingGeometryDesc geometry;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = 3;
  geometry.Triangles.VertexBuffer = {vertices_.GetGPUVirtualAddress(), 12};
  return std::vector<RaytracingGeometryDesc>(geometries, geometry);
}

RaytracingGeometryDesc World::box() {
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
  geometry.Flags = RaytracingGeometryFlags::kOpaque;
  const Buffer boxes = upload(std::vector<RaytracingAabb>{{-1, -1, 0, 1, 1, 1}}, "boxes");
  geometry.AABBs = {1, {boxes.GetGPUVirtualAddress(), sizeof(RaytracingAabb)}};
  return geometry;
}

BuildRaytracingAccelerationStructureInputs World::bottom_inputs(
    const std::vector<RaytracingGeometryDesc>& geometries, BuildFlags flags) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = static_cast<uint32_t>(geometries.size());
  inputs.pGeometryDescs = geometries.data();
  return inputs;
}

BuildRaytracingAccelerationStructureInputs World::top_inputs(
    const std::vector<RaytracingInstanceDesc>& instances) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = static_cast<uint32_t>(instances.size());
  if (!instances.empty()) {
    inputs.InstanceDescs = upload(instances, "instances").GetGPUVirtualAddress();
  }
  return inputs;
}

RaytracingInstanceDesc World::instance(const Buffer& bottom, uint32_t contribution) {
  RaytracingInstanceDesc desc;
  desc.InstanceContributionToHitGroupIndex = contribution;
  desc.AccelerationStructure = bottom.GetGPUVirtualAddress();
  return desc;
}

Buffer World::structure_for(const BuildRaytracingAccelerationStructureInputs& inputs,
                            const std::string& name) {
  const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
  return buffer(sizes.ResultDataMaxSizeInBytes, name, true);
}

void World::record_build(CommandList& commands, const Buffer& dest,
                         const BuildRaytracingAccelerationStructureInputs& inputs,
                         uint64_t source) {
  const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
  const Buffer scratch =
      buffer(std::max(sizes.ScratchDataSizeInBytes, sizes.UpdateScratchDataSizeInBytes), "scratch");
  commands.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = dest.GetGPUVirtualAddress(),
       .Inputs = inputs,
       .SourceAccelerationStructureData = source,
       .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
}

Buffer World::build(const BuildRaytracingAccelerationStructureInputs& inputs,
                    const std::string& name) {
  keep_.push_back(kaamos::test::build_structure(device_, queue_, inputs, name));
  return keep_.back();
}

void World::build_scene(uint32_t geometries, uint32_t contribution) {
  const auto descs = triangles(geometries);
  bottom_ = build(bottom_inputs(descs), "floor");
  top_ = build(top_inputs({instance(bottom_, contribution)}), "scene");
}

ShaderLibrary World::pipeline_library() {
  return LoadShaderLibrary(kaamos_shaders_checks()).value();
}

StateObject World::make_pipeline(const std::string& global, RaytracingPipelineFlags flags) {
  global_ = device_.CreateRootSignature(global).value();
  const RootSignature local = device_
                                  .CreateRootSignature(
                                      "RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t0, space = 1), "
                                      "RootConstants(num32BitConstants = 1, b0, space = 1)")
                                  .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{pipeline_library(),
                           {{"RayGen"},
                            {"RayGenTwo"},
                            {"RayGenWrites"},
                            {"RayGenCall"},
                            {"Hit"},
                            {"HitLocal"},
                            {"Intersect"},
                            {"Miss"},
                            {"Call"}}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Plain", .ClosestHitShaderImport = "Hit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "WithData", .ClosestHitShaderImport = "HitLocal"});
  desc.Add(HitGroupDesc{.HitGroupExport = "Boxes",
                        .Type = HitGroupType::kProceduralPrimitive,
                        .IntersectionShaderImport = "Intersect"});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  desc.Add(RaytracingPipelineConfig1{.MaxTraceRecursionDepth = 1, .Flags = flags});
  desc.Add(GlobalRootSignature{global_});
  desc.Associate(desc.Add(LocalRootSignature{local}), {"WithData"});
  return device_.CreateStateObject(desc).value();
}

TableSet World::make_tables(const StateObject& pipeline, const std::string& raygen,
                            const std::vector<std::string>& hits,
                            const std::vector<std::string>& misses) {
  TableSet set;
  set.tables = {ShaderTable(pipeline, "ray generation"), ShaderTable(pipeline, "miss"),
                ShaderTable(pipeline, "hit groups"), ShaderTable(pipeline, "callable")};
  set.tables[0].AddRecord(raygen).value();
  for (const auto& name : misses) set.tables[1].AddRecord(name).value();
  for (const auto& name : hits) {
    if (name == "WithData") {
      set.tables[2].AddRecord(name, {data(), LocalArgument::Constants(uint32_t{5})}).value();
    } else {
      set.tables[2].AddRecord(name).value();
    }
  }
  for (auto& table : set.tables) table.Build(device_).value();
  set.desc.RayGenerationShaderRecord = set.tables[0].GetRecord(0);
  set.desc.MissShaderTable = set.tables[1].GetTable();
  set.desc.HitGroupTable = set.tables[2].GetTable();
  return set;
}

void World::record_dispatch(CommandList& commands, const DispatchRaysDesc& desc) {
  commands.SetComputeRootSignature(global_);
  if (top_) commands.SetComputeRootShaderResourceView(0, top_.GetGPUVirtualAddress());
  commands.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
  commands.SetPipelineState1(pipeline_);
  commands.DispatchRays(desc);
}

void World::dispatch(const DispatchRaysDesc& desc) {
  CommandList commands = list();
  record_dispatch(commands, desc);
  const Status status = execute(commands);
  EXPECT_TRUE(status.ok()) << status.error().message;
}

void World::query(const std::string& shader) {
  const RootSignature signature =
      device_
          .CreateRootSignature(
              "SRV(t0), UAV(u0), DescriptorTable(SRV(t0, space = 1, numDescriptors = 2))")
          .value();
  const DescriptorHeap heap =
      device_
          .CreateDescriptorHeap(
              {DescriptorHeapType::kCbvSrvUav, 2, DescriptorHeapFlags::kShaderVisible, "queries"})
          .value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
  view.RaytracingAccelerationStructure.Location = top_.GetGPUVirtualAddress();
  device_.CreateShaderResourceView({}, view, heap.GetCPUDescriptorHandle(1)).value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_queries()).value();
  CommandList commands = list();
  commands.SetDescriptorHeaps({heap});
  commands.SetComputeRootSignature(signature);
  commands.SetComputeRootShaderResourceView(0, top_.GetGPUVirtualAddress());
  commands.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
  commands.SetComputeRootDescriptorTable(2, heap.GetGPUDescriptorHandle(0));
  if (shader == "PlainRayGen") {
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{library, {{shader}}});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
    desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
    desc.Add(GlobalRootSignature{signature});
    const StateObject pipeline = device_.CreateStateObject(desc).value();
    ShaderTable table(pipeline, "ray generation");
    table.AddRecord(shader).value();
    table.Build(device_).value();
    DispatchRaysDesc rays;
    rays.RayGenerationShaderRecord = table.GetRecord(0);
    commands.SetPipelineState1(pipeline);
    commands.DispatchRays(rays);
    execute(commands).value();
    return;
  }
  ComputePipelineStateDesc desc;
  desc.pRootSignature = signature;
  desc.CS = library;
  desc.EntryPoint = shader;
  const PipelineState pipeline = device_.CreateComputePipelineState(desc).value();
  commands.SetPipelineState(pipeline);
  commands.Dispatch(1, 1, 1);
  execute(commands).value();
}

void World::copy_bytes(const Buffer& dest, const Buffer& source) {
  const RootSignature signature = device_.CreateRootSignature("SRV(t1), UAV(u0)").value();
  ComputePipelineStateDesc desc;
  desc.pRootSignature = signature;
  desc.CS = pipeline_library();
  desc.EntryPoint = "CopyBytes";
  const PipelineState pipeline = device_.CreateComputePipelineState(desc).value();
  CommandList commands = list();
  commands.SetComputeRootSignature(signature);
  commands.SetComputeRootShaderResourceView(0, source.GetGPUVirtualAddress());
  commands.SetComputeRootUnorderedAccessView(1, dest.GetGPUVirtualAddress());
  commands.SetPipelineState(pipeline);
  commands.Dispatch(1, 1, 1);
  execute(commands).value();
}

// Leaves out KA0401 to KA0429: shaders also report what a test broke, and tests/checked_code tests
// that. Where a test breaks nothing, shaders must be silent too.
std::vector<std::string> World::told() {
  std::vector<std::string> out;
  for (const Message& m : messages_) {
    const bool by_code = m.Id.number > 400 && m.Id.number < 430;
    if (m.Id.number >= 400 && m.Id.number < 500 && !by_code) out.push_back(m.Text);
  }
  messages_.clear();
  return out;
}

void World::expect_one(const std::string& id, const std::vector<std::string>& parts) {
  const auto texts = told();
  ASSERT_EQ(texts.size(), 1u) << (texts.empty() ? "nothing" : texts[0] + "\n" + texts.back());
  EXPECT_EQ(texts[0].substr(0, id.size()), id) << texts[0];
  size_t position = 0;
  for (const std::string& part : parts) {
    const size_t found = texts[0].find(part, position);
    EXPECT_NE(found, std::string::npos) << "no \"" << part << "\" in: " << texts[0];
    if (found != std::string::npos) position = found;
  }
}

void World::expect_none() {
  for (const Message& m : messages_) {
    if (m.Id.number > 400 && m.Id.number < 430) ADD_FAILURE() << m.Text;
  }
  for (const std::string& text : told()) ADD_FAILURE() << text;
}

}  // namespace kaamos::checks::test
