// SPDX-License-Identifier: MIT
//
// Shader tables with random bytes, strides and sizes, records with random arguments, random
// indices: nothing may crash, neither on Vulkan nor on the CPU. Addresses without memory may remove
// the device.
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>

#include <cstdlib>
#include <cstring>
#include <random>

#include "scene.h"
#include "tests/vulkan/support.h"
#include "twin_device.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kRecordBytes = 96;

constexpr char kShaders[] = R"(
#include "scene.hlsli"
ByteAddressBuffer words : register(t0, space1);
RWStructuredBuffer<uint2> pairs : register(u0, space1);
cbuffer Local : register(b0, space1) { uint4 constants; };
Texture2D<float4> pictures[4] : register(t1, space1);
Buffer<uint> typed : register(t5, space1);

uint random(inout uint state) {
  state = state * 747796405u + 2891336453u;
  const uint word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}
uint local(uint at) {
  pairs[at % 64].x = at;
  return words.Load(at & 0xFC) + pairs[at % 99].y + constants[at % 4] + typed[at % 9] +
         uint(pictures[NonUniformResourceIndex(at % 5)].Load(int3(at % 4, 0, 0)).x);
}
struct Data { uint state; uint depth; };

void more(inout Payload payload, uint kind) {
  uint state = payload.numbers.x;
  payload.numbers.y += local(random(state)) + kind;
  if (random(state) % 4 == 0) {
    Data data = { random(state), 0 };
    CallShader(random(state) % 3 == 0 ? random(state) : random(state) % 6, data);
    payload.numbers.y += data.state;
  }
  payload.numbers.x = state;
}
void shoot(inout Payload payload) {
  uint state = payload.numbers.x;
  RayDesc ray = test_ray(-10.0 + float(random(state) % 16));
  payload.numbers.x = random(state);
  TraceRay(scene, random(state) % 4 == 0 ? random(state) & 0x2FF & ~0x300 : 0, random(state),
           random(state) % 6, random(state) % 3, random(state) % 4 == 0 ? random(state) : random(state) % 6,
           ray, payload);
}
[shader("miss")] void MissB(inout Payload payload) { more(payload, 2); }
[shader("callable")] void Call(inout Data data) {
  data.state += local(data.state);
  if (++data.depth < 3) CallShader(data.state % 7, data);
}
[shader("callable")] void CallB(inout Data data) { data.state += local(data.state); }
[shader("closesthit")] void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  more(payload, 3);
  if (payload.numbers.x % 3 == 0 && ++payload.numbers.z < 3) shoot(payload);
}
[shader("anyhit")] void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  payload.numbers.x += local(payload.numbers.x);
  if (payload.numbers.x % 2 == 0) IgnoreHit();
}
struct Attributes { uint4 data; };
[shader("intersection")] void BoxReport() {
  Attributes attributes = (Attributes)0;
  attributes.data.x = local(PrimitiveIndex());
  ReportHit(20, attributes.data.x % 128, attributes);
}
[shader("closesthit")] void BoxHit(inout Payload payload, Attributes attributes) {
  more(payload, 5 + attributes.data.x);
}
[shader("raygeneration")] void Main() {
  const uint2 at = DispatchRaysIndex().xy;
  Payload payload = (Payload)0;
  payload.numbers.x = at.x * 7919 + at.y * 104729 + constants.x;
  shoot(payload);
  results.InterlockedAdd(4 * (at.x % 16), payload.numbers.y);
}
)";

class RandomTables {
 public:
  explicit RandomTables(uint32_t seed) : random_(seed) {
    hlsl::FrontendOptions options;
    options.path = "tables.hlsl";
    options.include_folders = {std::string(KAAMOS_SOURCE_DIR) + "/tests/hlsl"};
    options.text = kShaders;
    code_ = compile_vulkan(options);
    EXPECT_EQ(code_.error, "");
  }
  bool compiled() const { return code_.library != nullptr; }

  // Runs on a device of its own and returns the error that removed it, or "".
  std::string run(uint32_t dispatches);

 private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  // Null, or an address without memory.
  uint64_t noise() {
    if (below(40) == 0) return uint64_t{0x400000000000} + 16 * below(1u << 20);
    return below(8) == 0 ? random_() : 0;
  }
  StateObject pipeline(const Device& device, const RootSignature& root);
  void fill(std::byte* bytes, uint32_t size_bytes, const StateObject& object, const Buffer& buffer,
            const DescriptorHeap& heap);
  GpuVirtualAddressRangeAndStride range(const Buffer& table);

  std::mt19937_64 random_;
  Compiled code_;
};

StateObject RandomTables::pipeline(const Device& device, const RootSignature& root) {
  const auto local = device
                         .CreateRootSignature(
                             "RootFlags(LOCAL_ROOT_SIGNATURE), SRV(t0, space = 1),"
                             "UAV(u0, space = 1), RootConstants("
                             "num32BitConstants = 4, b0, space = 1),"
                             "DescriptorTable(SRV(t1, space = 1, "
                             "numDescriptors = 5))")
                         .value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{LoadShaderLibrary(code_.library).value(), {}});
  desc.Add(HitGroupDesc{
      .HitGroupExport = "A", .AnyHitShaderImport = "Any", .ClosestHitShaderImport = "Hit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "B", .ClosestHitShaderImport = "Hit"});
  desc.Add(HitGroupDesc{.HitGroupExport = "Box",
                        .Type = HitGroupType::kProceduralPrimitive,
                        .ClosestHitShaderImport = "BoxHit",
                        .IntersectionShaderImport = "BoxReport"});
  desc.Add(RaytracingShaderConfig{64, 32});
  desc.Add(RaytracingPipelineConfig{3});
  desc.Add(GlobalRootSignature{root});
  desc.Associate(desc.Add(LocalRootSignature{local}),
                 {"A", "B", "Box", "Main", "Miss", "MissB", "Call", "CallB"});
  return device.CreateStateObject(desc).value();
}

// Records with an identifier of any kind of shader, a null one, or noise; arguments that are right,
// zero or noise.
void RandomTables::fill(std::byte* bytes, uint32_t size_bytes, const StateObject& object,
                        const Buffer& buffer, const DescriptorHeap& heap) {
  const char* const names[] = {"A", "B", "Box", "Main", "Miss", "MissB", "Call", "CallB"};
  for (uint32_t at = 0; at + 32 <= size_bytes; at += 32) {
    uint64_t words[4];
    for (uint64_t& word : words) {
      const uint32_t kind = below(8);
      word = kind == 0   ? noise()
             : kind == 1 ? 0
             : kind < 5  ? heap.GetGPUDescriptorHandle(below(16)).ptr
                         : buffer.GetGPUVirtualAddress() + 16 * below(100);
    }
    std::memcpy(bytes + at, words, 32);
    if (at % kRecordBytes == 0 && below(6) != 0) {
      std::memcpy(bytes + at, object.GetShaderIdentifier(names[below(8)])->data(), 32);
      if (below(20) == 0) bytes[at + below(32)] ^= std::byte{4};
    }
  }
}

GpuVirtualAddressRangeAndStride RandomTables::range(const Buffer& table) {
  if (below(12) == 0) return {};
  const uint32_t start = 2 * kRecordBytes * below(4);
  const uint32_t stride = below(5) == 0 ? 32 * below(6) : kRecordBytes;
  return {table.GetGPUVirtualAddress() + start, 32 + below(3000), stride};
}

std::string RandomTables::run(uint32_t dispatches) {
  DeviceDesc desc;
  desc.Backend = "vulkan";
  const Device device = CreateDevice(desc).value();
  CommandQueue queue = device.CreateCommandQueue().value();
  const Scene scene = build_scene(device, queue, LoadShaderLibrary(code_.library).value());
  const RootSignature root = device.CreateRootSignature("SRV(t0), UAV(u0)").value();
  const StateObject object = pipeline(device, root);
  const Buffer out =
      device.CreateBuffer({.SizeInBytes = 65536, .Flags = ResourceFlags::kAllowUnorderedAccess})
          .value();
  const Buffer table =
      device.CreateBuffer({.SizeInBytes = 8192, .Heap = HeapType::kUpload}).value();
  const DescriptorHeap heap =
      device
          .CreateDescriptorHeap(
              {.NumDescriptors = 16, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  const uint64_t constants[2] = {random_(), random_()};
  ShaderTable ray_generation(object);
  ray_generation
      .AddRecord("Main", {LocalArgument::Address(out), LocalArgument::Address(out),
                          LocalArgument::Constants(constants),
                          LocalArgument::Table(heap.GetGPUDescriptorHandle(0))})
      .value();
  ray_generation.Build(device).value();
  for (uint32_t i = 0; i < dispatches; ++i) {
    fill(table.Map().value().data(), 8192, object, out, heap);
    CommandList list = device.CreateCommandList().value();
    list.SetDescriptorHeaps({heap});
    list.SetComputeRootSignature(root);
    list.SetPipelineState1(object);
    list.SetComputeRootShaderResourceView(0, scene.top_level.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(1, out.GetGPUVirtualAddress());
    DispatchRaysDesc dispatch;
    dispatch.RayGenerationShaderRecord = ray_generation.GetRecord(0);
    dispatch.MissShaderTable = range(table);
    dispatch.HitGroupTable = range(table);
    dispatch.CallableShaderTable = range(table);
    dispatch.Width = 1 + below(40);
    dispatch.Height = 1 + below(12);
    dispatch.Depth = 1;
    list.DispatchRays(dispatch);
    if (!list.Close()) continue;  // refused while recording
    const Status status = queue.ExecuteAndWait(list);
    if (!status) return status.error().message;
  }
  return "";
}

TEST(VulkanRandomTables, NothingCrashes) {
  KAAMOS_NEED_VULKAN();
  const char* full = std::getenv("KAAMOS_FULL");
  const uint32_t devices = full != nullptr && std::string(full) == "1" ? 100 : 5;
  uint32_t removed = 0;
  for (uint32_t i = 0; i < devices; ++i) {
    RandomTables tables(i + 1);
    ASSERT_TRUE(tables.compiled());
    const std::string error = tables.run(20);
    if (error.empty()) continue;
    ++removed;
    EXPECT_EQ(error.substr(0, 5), "KA089") << error;
  }
  EXPECT_LT(removed, devices / 2);  // else it tests little
}

}  // namespace
}  // namespace kaamos::test
