// SPDX-License-Identifier: MIT
//
// The API from end to end on the Embree backend, with shaders written in C++ against abi.h. It
// covers what the recording backend of the other tests cannot show.
#include <cstring>

#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/library_builder.h"

#include <rtapi/rtapi.h>

namespace rtapi::testing {
namespace {

using shader::BindingType;
using shader::Invocation;
using shader::Stage;

// Reads a root argument of type T through the slot of a binding, as compiled shaders do.
template <class T>
T Argument(const Invocation& in, uint32_t binding) {
  const shader::BindingSlot& slot = in.slots[binding];
  const uint8_t* base = slot.local ? in.local_arguments : in.dispatch->root_arguments;
  T value;
  std::memcpy(&value, base + slot.argument_offset, sizeof value);
  return value;
}

constexpr uint32_t kScene = 0, kOutput = 1, kConstant = 2;

struct Payload {
  uint32_t value = 0;
};

// Traces a ray from (x + 0.25, 0.25, -1) along z and writes its payload to output[x].
void RayGeneration(Invocation& in) {
  Payload payload{0xFFFFFFFFu};
  shader::TraceRayArguments ray = {};
  ray.acceleration_structure = Argument<uint64_t>(in, kScene);
  ray.instance_inclusion_mask = 0xFF;
  ray.payload_bytes = sizeof payload;
  const float x = static_cast<float>(in.index[0]) + 0.25f;
  in.dispatch->services->trace_ray(in, ray, &payload, shader::RayLanes{x, 0.25f, -1, 0},
                                   shader::RayLanes{0, 0, 1, 100});
  auto* out = reinterpret_cast<uint32_t*>(Argument<uint64_t>(in, kOutput));
  out[in.index[0]] = payload.value;
}
void Miss(Invocation& in, void* payload) {
  static_cast<Payload*>(payload)->value = Argument<uint32_t>(in, kConstant);
}
void Hit(Invocation& in, void* payload, const void*) {
  static_cast<Payload*>(payload)->value = Argument<uint32_t>(in, kConstant) + in.ray->instance_id;
}

class EmbreeTest : public ::testing::Test {
 protected:
  EmbreeTest() {
    device_ = CreateDevice({.Backend = "embree", .Threads = 2}).value();
    queue_ = device_.CreateCommandQueue().value();
    builder_.Binding("scene", BindingType::kAccelerationStructure, 0);
    builder_.Binding("output", BindingType::kRawBuffer, 0, 0, 1, 0, true);
    builder_.Binding("constant", BindingType::kConstantBuffer, 0, 0, 1, 4);
    auto add = [&](const char* name, Stage stage, auto* function, std::vector<uint32_t> used) {
      auto& e = builder_.Export(name, stage, std::move(used));
      e.entry = reinterpret_cast<shader::AnyFn>(function);
      e.payload_bytes = e.payload_storage_bytes = sizeof(Payload);
      e.flags = stage == Stage::kRayGeneration ? shader::kExportTraces : 0u;
    };
    add("RayGeneration", Stage::kRayGeneration, &RayGeneration, {kScene, kOutput});
    add("Miss", Stage::kMiss, &Miss, {kConstant});
    add("Hit", Stage::kClosestHit, &Hit, {kConstant});
  }
  Buffer MakeBuffer(uint64_t bytes, ResourceStates state = ResourceStates::kCommon) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes,
                       .Flags = ResourceFlags::kAllowUnorderedAccess,
                       .InitialState = state})
        .value();
  }
  Buffer Build(CommandList& list, BuildRaytracingAccelerationStructureInputs inputs) {
    const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
    Buffer result = MakeBuffer(sizes.ResultDataMaxSizeInBytes,
                               ResourceStates::kRaytracingAccelerationStructure);
    Buffer scratch = MakeBuffer(std::max<uint64_t>(256, sizes.ScratchDataSizeInBytes));
    scratch_.push_back(scratch);
    BuildRaytracingAccelerationStructureDesc desc;
    desc.Inputs = inputs;
    desc.DestAccelerationStructureData = result.GetGPUVirtualAddress();
    desc.ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress();
    list.BuildRaytracingAccelerationStructure(desc);
    list.ResourceBarrier(ResourceBarrier::Uav(result));
    return result;
  }

  Device device_;
  CommandQueue queue_;
  LibraryBuilder builder_{"embree_test"};
  std::vector<Buffer> scratch_;
};

TEST_F(EmbreeTest, TracesThroughTablesBuiltFromALinkedStateObject) {
  auto local = device_.CreateRootSignature(
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants=1, b0)");
  auto global = device_.CreateRootSignature("SRV(t0), UAV(u0)");
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{builder_.Build()});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  desc.Add(HitGroupDesc{.HitGroupExport = "group", .ClosestHitShaderImport = "Hit"});
  desc.Add(GlobalRootSignature{global.value()});
  desc.Associate(desc.Add(LocalRootSignature{local.value()}), {"Miss", "group"});
  auto pipeline = device_.CreateStateObject(desc);
  ASSERT_TRUE(pipeline.ok()) << MessageOf(pipeline);

  ShaderTable raygen(*pipeline), miss(*pipeline), hits(*pipeline);
  raygen.AddRecord("RayGeneration").value();
  miss.AddRecord("Miss", {LocalArgument::Constants(7u)}).value();
  hits.AddRecord("group", {LocalArgument::Constants(100u)}).value();
  hits.AddRecord("group", {LocalArgument::Constants(200u)}).value();
  for (ShaderTable* t : {&raygen, &miss, &hits}) ASSERT_TRUE(t->Build(device_).ok());

  // One triangle spans x in 0..1; its instances stand at x = 0 and 2 and use records 0 and 1.
  auto vertices = CreateUploadBuffer(device_, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  auto list = device_.CreateCommandList().value();
  const RaytracingGeometryDesc geometry = {
      .Triangles = {.VertexFormat = Format::kR32G32B32Float,
                    .VertexCount = 3,
                    .VertexBuffer = {vertices->GetGPUVirtualAddress(), 12}}};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  const Buffer bottom = Build(list, inputs);
  std::vector<RaytracingInstanceDesc> instances(2);
  for (uint32_t i = 0; i < 2; ++i) {
    instances[i].Transform[0][3] = 2.0f * static_cast<float>(i);
    instances[i].InstanceID = 5 * i;
    instances[i].InstanceContributionToHitGroupIndex = i;
    instances[i].AccelerationStructure = bottom.GetGPUVirtualAddress();
  }
  auto instance_buffer = CreateUploadBuffer(device_, instances);
  BuildRaytracingAccelerationStructureInputs top_inputs;
  top_inputs.NumDescs = 2;
  top_inputs.InstanceDescs = instance_buffer->GetGPUVirtualAddress();
  const Buffer top = Build(list, top_inputs);

  const Buffer output = MakeBuffer(4 * sizeof(uint32_t));
  list.SetComputeRootSignature(*global);
  list.SetPipelineState1(*pipeline);
  list.SetComputeRootShaderResourceView(0, top.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, output.GetGPUVirtualAddress());
  DispatchRaysDesc rays;
  rays.RayGenerationShaderRecord = raygen.GetRecord(0);
  rays.MissShaderTable = miss.GetTable();
  rays.HitGroupTable = hits.GetTable();
  rays.Width = 4;
  list.DispatchRays(rays);
  EXPECT_OK(queue_.ExecuteAndWait(list));

  const auto bytes = ReadbackBuffer(device_, queue_, output).value();
  uint32_t values[4];
  std::memcpy(values, bytes.data(), sizeof values);
  EXPECT_EQ(values[0], 100u);
  EXPECT_EQ(values[1], 7u);
  EXPECT_EQ(values[2], 205u);
  EXPECT_EQ(values[3], 7u);
}

TEST_F(EmbreeTest, TexturesRoundTrip) {
  const Texture texture = device_
                              .CreateTexture({.Width = 5,
                                              .Height = 3,
                                              .DepthOrArraySize = 2,
                                              .MipLevels = 2,
                                              .Format = Format::kR16G16Float})
                              .value();
  std::vector<std::byte> texels(5 * 3 * 4);
  for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::byte>(i);
  ASSERT_TRUE(UploadTexture(device_, queue_, texture, 2, texels).ok());
  EXPECT_EQ(ReadbackTexture(device_, queue_, texture, 2).value(), texels);
  const auto mip = ReadbackTexture(device_, queue_, texture, 3).value();
  EXPECT_EQ(mip, std::vector<std::byte>(2 * 1 * 4));
  EXPECT_ERROR(UploadTexture(device_, queue_, texture, 2, std::span(texels).first(59)), "KA0817",
               "59 bytes");
}

TEST_F(EmbreeTest, DefaultBuffersRoundTrip) {
  const std::vector<uint32_t> numbers = {1, 2, 3};
  auto buffer = CreateDefaultBuffer(device_, queue_, std::as_bytes(std::span(numbers)));
  ASSERT_TRUE(buffer.ok()) << MessageOf(buffer);
  const auto bytes = ReadbackBuffer(device_, queue_, *buffer).value();
  EXPECT_EQ(std::memcmp(bytes.data(), numbers.data(), 12), 0);
}

}  // namespace
}  // namespace rtapi::testing
