// SPDX-License-Identifier: MIT
#include "tests/support/harness.h"

#include <shaders/support.h>

#include "tests/vulkan/support.h"

namespace kaamos::support {

using namespace rtapi;

namespace {

constexpr char kRootSignature[] =
    "UAV(u0), RootConstants(b0, num32BitConstants = 2), SRV(t0), SRV(t1),"
    "DescriptorTable(SRV(t0, space = 1, numDescriptors = 5),"
    "UAV(u0, space = 1, numDescriptors = 2), CBV(b0, space = 1),"
    "UAV(u2, space = 1, numDescriptors = 3)),"
    "DescriptorTable(Sampler(s0, space = 1)),"
    "StaticSampler(s1, space = 1, filter = FILTER_MIN_MAG_MIP_POINT)";
constexpr char kLocalSignature[] =
    "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, space = 2, num32BitConstants = 2),"
    "SRV(t0, space = 2)";
enum Parameter : uint32_t { kOut, kRootConstants, kBuffer, kTopLevel, kViews, kSamplers };

}  // namespace

std::vector<uint32_t> numbers(uint32_t first, uint32_t step, uint32_t count) {
  std::vector<uint32_t> out(count);
  for (uint32_t i = 0; i < count; ++i) out[i] = first + i * step;
  return out;
}

void Call::SetUp() {
  if (GetParam() == "vulkan") {
    if (const std::string why = test::why_no_vulkan(); !why.empty()) {
      if (test::vulkan_is_required()) FAIL() << why;
      GTEST_SKIP() << "no device: " << why;
    }
  }
  DeviceDesc desc;
  desc.Backend = GetParam();
  open(desc);
}

void Call::open(const DeviceDesc& desc) {
  keep_.clear();
  device_ = CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
  root_ = device_.CreateRootSignature(kRootSignature).value();
  local_ = device_.CreateRootSignature(kLocalSignature).value();
  DescriptorHeapDesc heap;
  heap.NumDescriptors = kSlots;
  heap.Flags = DescriptorHeapFlags::kShaderVisible;
  views_ = device_.CreateDescriptorHeap(heap).value();
  heap.Type = DescriptorHeapType::kSampler;
  heap.NumDescriptors = 1;
  samplers_ = device_.CreateDescriptorHeap(heap).value();
  out_ = buffer(4 * 64);
  words_ = upload(numbers(50));
}

Buffer Call::upload(const std::vector<uint32_t>& words) {
  keep_.push_back(CreateUploadBuffer(device_, words, "words").value());
  return keep_.back();
}

Buffer Call::buffer(uint64_t bytes, ResourceStates state) {
  BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = state;
  keep_.push_back(device_.CreateBuffer(desc).value());
  return keep_.back();
}

std::vector<uint32_t> Call::read(const Buffer& words) {
  const auto bytes = ReadbackBuffer(device_, queue_, words).value();
  std::vector<uint32_t> out(bytes.size() / 4);
  std::memcpy(out.data(), bytes.data(), out.size() * 4);
  return out;
}

Texture Call::texture(uint32_t width) {
  TextureDesc desc;
  desc.Width = width;
  desc.Height = 1;
  desc.Format = Format::kR8G8B8A8Unorm;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  return device_.CreateTexture(desc).value();
}

Texture Call::texture_of(uint32_t first) {
  const Texture result = texture();
  const std::vector<uint32_t> texels = numbers(first);
  UploadTexture(device_, queue_, result, 0, std::as_bytes(std::span<const uint32_t>(texels)))
      .value();
  return result;
}

ShaderLibrary Call::library() {
  return LoadShaderLibrary(kaamos_shaders_support()).value();
}

void Call::bind(CommandList& list) {
  list.SetDescriptorHeaps({views_, samplers_});
  list.SetComputeRootSignature(root_);
  list.SetComputeRootUnorderedAccessView(kOut, out_.GetGPUVirtualAddress());
  list.SetComputeRoot32BitConstants(kRootConstants, 2, constants_, 0);
  list.SetComputeRootShaderResourceView(kBuffer, words_.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(kViews, views_.GetGPUDescriptorHandle(0));
  list.SetComputeRootDescriptorTable(kSamplers, samplers_.GetGPUDescriptorHandle(0));
}

std::vector<uint32_t> Call::compute(const char* entry) {
  const PipelineState pipeline =
      device_.CreateComputePipelineState({root_, library(), entry, entry}).value();
  CommandList list = device_.CreateCommandList().value();
  bind(list);
  list.SetPipelineState(pipeline);
  list.Dispatch(1, 1, 1);
  queue_.ExecuteAndWait(list).value();
  auto all = read(out_);
  all.resize(kCount);
  return all;
}

Result<Buffer> Call::build(const BuildRaytracingAccelerationStructureInputs& inputs,
                           const Buffer* update_of) {
  auto structure = BuildAccelerationStructure(device_, queue_, inputs, "structure",
                                              update_of != nullptr ? *update_of : Buffer());
  if (structure) keep_.push_back(*structure);
  return structure;
}

Result<Buffer> Call::bottom_level(uint32_t primitives, bool boxes,
                                  RaytracingAccelerationStructureBuildFlags flags,
                                  const Buffer* update_of, float shift) {
  std::vector<float> values;
  for (uint32_t i = 0; i < primitives; ++i) {
    const float x = static_cast<float>(i) + shift;
    if (boxes) {
      values.insert(values.end(), {x - 0.3f, -0.3f, -0.3f, x + 0.3f, 0.3f, 0.3f});
    } else {
      values.insert(values.end(), {x - 0.3f, -0.3f, 0, x + 0.3f, -0.3f, 0, x, 0.4f, 0});
    }
  }
  keep_.push_back(CreateUploadBuffer(device_, values, "primitives").value());
  RaytracingGeometryDesc geometry;
  if (boxes) {
    geometry.Type = RaytracingGeometryType::kProceduralPrimitiveAabbs;
    geometry.AABBs.AABBCount = primitives;
    geometry.AABBs.AABBs = {keep_.back().GetGPUVirtualAddress(), 24};
  } else {
    geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
    geometry.Triangles.VertexCount = primitives * 3;
    geometry.Triangles.VertexBuffer = {keep_.back().GetGPUVirtualAddress(), 12};
  }
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  return build(inputs, update_of);
}

Result<Buffer> Call::top_level(const Buffer& bottom_level) {
  RaytracingInstanceDesc instance;
  for (int i = 0; i < 3; ++i) instance.Transform[i][i] = 1;
  instance.InstanceID = 4;
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom_level.GetGPUVirtualAddress();
  keep_.push_back(
      CreateUploadBuffer(device_, std::vector<RaytracingInstanceDesc>{instance}, "one").value());
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kTopLevel;
  inputs.NumDescs = 1;
  inputs.InstanceDescs = keep_.back().GetGPUVirtualAddress();
  return build(inputs);
}

StateObjectDesc Call::describe(const Rays& rays) {
  StateObjectDesc desc;
  DxilLibraryDesc exports{library(), {}};
  for (const std::string& name : {rays.ray_generation, std::string("Miss"), rays.closest_hit,
                                  rays.any_hit, rays.intersection}) {
    if (!name.empty()) exports.Exports.push_back({name});
  }
  for (const std::string& name : rays.callables) exports.Exports.push_back({name});
  desc.Add(exports);
  HitGroupDesc group;
  group.HitGroupExport = "Group";
  group.Type =
      rays.intersection.empty() ? HitGroupType::kTriangles : HitGroupType::kProceduralPrimitive;
  group.ClosestHitShaderImport = rays.closest_hit;
  group.AnyHitShaderImport = rays.any_hit;
  group.IntersectionShaderImport = rays.intersection;
  desc.Add(group);
  desc.Add(RaytracingShaderConfig{8, 8});
  desc.Add(RaytracingPipelineConfig{rays.recursion});
  desc.Add(GlobalRootSignature{root_});
  if (rays.local_arguments) desc.Associate(desc.Add(LocalRootSignature{local_}), {"Group"});
  return desc;
}

std::vector<uint32_t> Call::trace(const Rays& rays, const Buffer& top_level) {
  return trace(rays, device_.CreateStateObject(describe(rays)).value(), top_level);
}

std::vector<uint32_t> Call::trace(const Rays& rays, const StateObject& pipeline,
                                  const Buffer& top_level) {
  std::vector<ShaderTable> tables;
  for (int i = 0; i < 4; ++i) tables.emplace_back(pipeline);
  tables[0].AddRecord(rays.ray_generation).value();
  tables[1].AddRecord("Miss").value();
  if (rays.local_arguments) {
    const uint32_t constants[2] = {1000, 0};
    tables[2]
        .AddRecord("Group", {LocalArgument::Constants(constants),
                             LocalArgument::Address(words_.GetGPUVirtualAddress())})
        .value();
  } else {
    tables[2].AddRecord("Group").value();
  }
  for (const std::string& name : rays.callables) tables[3].AddRecord(name).value();
  for (ShaderTable& table : tables) table.Build(device_).value();
  CommandList list = device_.CreateCommandList().value();
  bind(list);
  list.SetPipelineState1(pipeline);
  list.SetComputeRootShaderResourceView(kTopLevel, top_level.GetGPUVirtualAddress());
  DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = tables[0].GetRecord(0);
  desc.MissShaderTable = tables[1].GetTable();
  desc.HitGroupTable = tables[2].GetTable();
  desc.CallableShaderTable = tables[3].GetTable();
  desc.Width = kCount;
  list.DispatchRays(desc);
  queue_.ExecuteAndWait(list).value();
  auto all = read(out_);
  all.resize(kCount);
  return all;
}

}  // namespace kaamos::support
