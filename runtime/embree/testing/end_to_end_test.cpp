// SPDX-License-Identifier: MIT
//
// rtapi on this backend, from CreateDevice to the bytes that come back; the shaders are written
// against the ABI.
#include <gtest/gtest.h>
#include <rtapi/device.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>

#include <cmath>
#include <cstring>

#include "rtapi/testing/library_builder.h"

namespace kaamos::embree {
namespace {

using rtapi::testing::LibraryBuilder;
using shader::BindingType;
using shader::Invocation;
using shader::Stage;

constexpr uint32_t kWidth = 64;
constexpr uint32_t kHeight = 48;

enum Binding : uint32_t { kScene, kOutput, kConstant };

template <typename T>
T argument(const Invocation& invocation, Binding binding) {
  const shader::BindingSlot& slot = invocation.slots[binding];
  const uint8_t* base =
      slot.local ? invocation.local_arguments : invocation.dispatch->root_arguments;
  T value;
  std::memcpy(&value, base + slot.argument_offset, sizeof(value));
  return value;
}

void ray_generation(Invocation& invocation) {
  shader::TraceRayArguments ray = {};
  shader::RayDesc along_z = {};
  ray.acceleration_structure = argument<uint64_t>(invocation, kScene);
  ray.instance_inclusion_mask = 0xFF;
  ray.multiplier_for_geometry_contribution = 1;
  along_z.origin[0] = (static_cast<float>(invocation.index[0]) + 0.5f) / kWidth;
  along_z.origin[1] = (static_cast<float>(invocation.index[1]) + 0.5f) / kHeight;
  along_z.direction[2] = 1;
  along_z.t_max = 10;
  uint32_t color = 0;
  invocation.dispatch->services->trace_ray(invocation, ray, &color, origin_t_min(along_z),
                                           direction_t_max(along_z));
  auto* output = reinterpret_cast<uint32_t*>(argument<uint64_t>(invocation, kOutput));
  output[invocation.index[1] * invocation.dispatch->dimensions[0] + invocation.index[0]] = color;
}

void write_constant(Invocation& invocation, void* payload, const void*) {
  const auto color = argument<uint32_t>(invocation, kConstant);
  std::memcpy(payload, &color, sizeof(color));
}

void fault(Invocation&) {
  auto* volatile nowhere = reinterpret_cast<uint32_t*>(uint64_t{0x10000});
  *nowhere = 1;
}

class EndToEnd : public ::testing::Test {
 protected:
  EndToEnd() {
    builder_.Binding("scene", BindingType::kAccelerationStructure, 0);
    builder_.Binding("output", BindingType::kStructuredBuffer, 0, 0, 1, 4, true);
    builder_.Binding("constant", BindingType::kConstantBuffer, 0, 0, 1, 4);
    const auto entry = [](auto function) { return reinterpret_cast<shader::AnyFn>(function); };
    builder_.Export("RayGen", Stage::kRayGeneration, {kScene, kOutput}).entry =
        entry(ray_generation);
    auto& hit = builder_.Export("Hit", Stage::kClosestHit, {kConstant});
    hit.entry = entry(write_constant);
    hit.attribute_bytes = 8;
    hit.payload_bytes = 4;
    auto& miss = builder_.Export("Miss", Stage::kMiss);
    miss.entry = entry(+[](Invocation&, void* payload) { std::memset(payload, 0x11, 4); });
    miss.payload_bytes = 4;
    builder_.Export("Fault", Stage::kRayGeneration).entry = entry(fault);
    rtapi::DeviceDesc desc;
    desc.CollectStatistics = true;
    device_ = rtapi::CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    global_ = device_.CreateRootSignature("SRV(t0), UAV(u0)").value();
    make_state_object();
  }

  void make_state_object() {
    rtapi::StateObjectDesc desc;
    desc.Add(rtapi::DxilLibraryDesc{builder_.Build()});
    desc.Add(rtapi::HitGroupDesc{.HitGroupExport = "Group", .ClosestHitShaderImport = "Hit"});
    desc.Add(rtapi::RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
    desc.Add(rtapi::RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
    desc.Add(rtapi::GlobalRootSignature{global_});
    const auto local = desc.Add(rtapi::LocalRootSignature{
        device_
            .CreateRootSignature(
                "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants=1, b0)")
            .value()});
    desc.Associate(local, {"Group"});
    state_object_ = device_.CreateStateObject(desc).value();
  }

  rtapi::Buffer structure_buffer(uint64_t bytes) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes,
                       .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess,
                       .InitialState = rtapi::ResourceStates::kRaytracingAccelerationStructure,
                       .Name = "structure"})
        .value();
  }
  rtapi::Buffer scratch_buffer(uint64_t bytes) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes,
                       .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess,
                       .InitialState = rtapi::ResourceStates::kUnorderedAccess,
                       .Name = "scratch"})
        .value();
  }

  rtapi::Buffer build(rtapi::CommandList& list,
                      const rtapi::BuildRaytracingAccelerationStructureInputs& inputs) {
    const auto info = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
    rtapi::Buffer result = structure_buffer(info.ResultDataMaxSizeInBytes);
    kept_.push_back(result);
    kept_.push_back(scratch_buffer(info.ScratchDataSizeInBytes));
    rtapi::BuildRaytracingAccelerationStructureDesc desc;
    desc.DestAccelerationStructureData = result.GetGPUVirtualAddress();
    desc.ScratchAccelerationStructureData = kept_.back().GetGPUVirtualAddress();
    desc.Inputs = inputs;
    list.BuildRaytracingAccelerationStructure(desc);
    list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
    return result;
  }

  // Two triangles that share the unit square, one geometry each.
  rtapi::Buffer build_scene(rtapi::CommandList& list) {
    const std::vector<float> vertices = {0, 0, 2, 0, 1, 2, 1, 0, 2, 1, 1, 3, 1, 0, 3, 0, 1, 3};
    kept_.push_back(rtapi::CreateUploadBuffer(device_, vertices).value());
    std::vector<rtapi::RaytracingGeometryDesc> geometries(2);
    for (uint32_t i = 0; i < 2; ++i) {
      geometries[i].Flags = rtapi::RaytracingGeometryFlags::kOpaque;
      geometries[i].Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
      geometries[i].Triangles.VertexCount = 3;
      geometries[i].Triangles.VertexBuffer = {kept_.back().GetGPUVirtualAddress() + 36 * i, 12};
    }
    rtapi::BuildRaytracingAccelerationStructureInputs inputs;
    inputs.Type = rtapi::RaytracingAccelerationStructureType::kBottomLevel;
    inputs.NumDescs = 2;
    inputs.pGeometryDescs = geometries.data();
    std::vector<rtapi::RaytracingInstanceDesc> instances(1);
    instances[0].AccelerationStructure = build(list, inputs).GetGPUVirtualAddress();
    kept_.push_back(rtapi::CreateUploadBuffer(device_, instances).value());
    inputs = {};
    inputs.NumDescs = 1;
    inputs.InstanceDescs = kept_.back().GetGPUVirtualAddress();
    return build(list, inputs);
  }

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  LibraryBuilder builder_;
  rtapi::RootSignature global_;
  rtapi::StateObject state_object_;
  std::vector<rtapi::Buffer> kept_;
};

TEST_F(EndToEnd, ADispatchWritesWhatItsRecordsSay) {
  auto list = device_.CreateCommandList().value();
  const rtapi::Buffer scene = build_scene(list);
  const rtapi::Buffer output = scratch_buffer(kWidth * kHeight * 4);
  rtapi::ShaderTable ray_generation_table(state_object_);
  rtapi::ShaderTable hits(state_object_);
  rtapi::ShaderTable misses(state_object_);
  ray_generation_table.AddRecord("RayGen").value();
  hits.AddRecord("Group", {rtapi::LocalArgument::Constants(uint32_t{0xAAAA})}).value();
  hits.AddRecord("Group", {rtapi::LocalArgument::Constants(uint32_t{0xBBBB})}).value();
  misses.AddRecord("Miss").value();
  for (auto* table : {&ray_generation_table, &hits, &misses}) table->Build(device_).value();

  list.SetComputeRootSignature(global_);
  list.SetPipelineState1(state_object_);
  list.SetComputeRootShaderResourceView(0, scene.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, output.GetGPUVirtualAddress());
  rtapi::DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = ray_generation_table.GetRecord(0);
  desc.HitGroupTable = hits.GetTable();
  desc.MissShaderTable = misses.GetTable();
  desc.Width = kWidth;
  desc.Height = kHeight;
  list.DispatchRays(desc);
  const rtapi::Status status = queue_.ExecuteAndWait(list);
  ASSERT_TRUE(status.ok()) << status.error().message;

  const auto bytes = rtapi::ReadbackBuffer(device_, queue_, output).value();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      uint32_t color;
      std::memcpy(&color, &bytes[4 * (y * kWidth + x)], sizeof(color));
      const float diagonal =
          (static_cast<float>(x) + 0.5f) / kWidth + (static_cast<float>(y) + 0.5f) / kHeight;
      if (std::abs(diagonal - 1) < 1e-4f) continue;
      EXPECT_EQ(color, diagonal < 1 ? 0xAAAAu : 0xBBBBu) << x << "," << y;
    }
  }
  EXPECT_EQ(device_.GetStatistics().TraceRayCalls, uint64_t{kWidth} * kHeight);
  EXPECT_EQ(device_.GetStatistics().Hits, uint64_t{kWidth} * kHeight);
}

TEST_F(EndToEnd, AFaultRemovesTheDeviceAndTheProcessGoesOn) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer reports the access itself";
#endif
  rtapi::ShaderTable table(state_object_);
  table.AddRecord("Fault").value();
  table.Build(device_).value();
  auto list = device_.CreateCommandList().value();
  list.SetComputeRootSignature(global_);
  list.SetPipelineState1(state_object_);
  rtapi::DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = table.GetRecord(0);
  list.BeginEvent("the pass that fails");
  list.DispatchRays(desc);
  list.EndEvent();
  const rtapi::Status status = queue_.ExecuteAndWait(list);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("\"Fault\""), std::string::npos) << status.error().message;
  EXPECT_NE(status.error().message.find("the pass that fails"), std::string::npos);
  EXPECT_FALSE(device_.GetDeviceRemovedReason().ok());
  EXPECT_FALSE(device_.CreateCommandList().ok());
  EXPECT_TRUE(rtapi::CreateDevice().ok());
}

}  // namespace
}  // namespace kaamos::embree
