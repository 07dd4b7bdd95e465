// SPDX-License-Identifier: MIT
#include <cstring>

#include <rtapi/shader_table.h>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/testing/command_list_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;

TEST_F(CommandListTest, OpenAndClosed) {
  EXPECT_TRUE(list_.is_open());
  EXPECT_OK(list_.Close());
  EXPECT_FALSE(list_.is_open());
  EXPECT_ERROR(list_.Close(), "KA0800");
  list_.Dispatch(1, 1, 1);
  EXPECT_EQ(list_.GetErrors().at(0).id.text(), "KA0800");
  EXPECT_OK(list_.Reset());
  EXPECT_TRUE(list_.is_open());
  EXPECT_TRUE(list_.GetErrors().empty());
}

TEST_F(CommandListTest, EmptyHandlesNeverCrash) {
  CommandList list;
  EXPECT_ERROR(list.Close(), "KA0904");
  EXPECT_ERROR(list.Reset(), "KA0904");
  list.ResourceBarrier(ResourceBarrier::Uav());
  list.SetDescriptorHeaps({});
  list.SetComputeRootSignature({});
  list.SetComputeRoot32BitConstant(0, 1, 0);
  list.SetComputeRootConstantBufferView(0, 0);
  list.SetComputeRootDescriptorTable(0, {});
  list.SetPipelineState({});
  list.SetPipelineState1({});
  list.DispatchRays({});
  list.Dispatch(1, 1, 1);
  list.BuildRaytracingAccelerationStructure({});
  list.CopyBufferRegion({}, 0, {}, 0, 1);
  list.CopyResource({}, {});
  list.ClearUnorderedAccessViewUint({}, {}, {}, nullptr);
  list.BeginEvent("x");
  list.EndEvent();
  EXPECT_TRUE(list.GetErrors().empty());
}

TEST_F(CommandListTest, EveryErrorIsKeptAndTheFirstReturned) {
  list_.SetPipelineState({});
  list_.EndEvent();
  list_.SetComputeRootSignature({});
  EXPECT_EQ(list_.GetErrors().size(), 3u);
  EXPECT_ERROR(list_.Close(), "KA0904", "SetPipelineState");
  EXPECT_ERROR(queue_.ExecuteCommandLists({list_}), "KA0823", "3 errors");
}

TEST_F(CommandListTest, RootArgumentsLieWhereTheSignatureSays) {
  auto buffer = MakeBuffer(1024);
  auto heap =
      device_
          .CreateDescriptorHeap({.NumDescriptors = 4, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  LibraryBuilder b;
  b.Export("Kernel", Stage::kCompute);
  auto signature = Global(
      "RootConstants(num32BitConstants=3, b0), CBV(b1), "
      "DescriptorTable(SRV(t0)), SRV(t5), UAV(u0)");
  auto pso =
      device_.CreateComputePipelineState({.pRootSignature = signature, .CS = b.Build()}).value();
  list_.SetDescriptorHeaps({heap});
  list_.SetComputeRootSignature(signature);
  list_.SetPipelineState(pso);
  struct Two {
    uint32_t x, y;
  };
  const Two two = {11, 12};
  list_.SetComputeRoot32BitConstants(0, 2, &two, 1);
  list_.SetComputeRootConstantBufferView(1, buffer.GetGPUVirtualAddress() + 256);
  list_.SetComputeRootDescriptorTable(2, heap.GetGPUDescriptorHandle(3));
  list_.SetComputeRootShaderResourceView(3, buffer.GetGPUVirtualAddress() + 4);
  list_.Dispatch(1, 2, 3);
  list_.SetComputeRoot32BitConstant(0, 10, 0);
  list_.SetComputeRootShaderResourceView(3, 0);  // null
  list_.Dispatch(1, 1, 1);
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok()) << MessageOf(list_.Close());
  auto u32 = [&](size_t command, size_t at) {
    uint32_t v;
    std::memcpy(
        &v, Executed<runtime::DispatchCommand>(command).state.root_arguments->bytes.data() + at, 4);
    return v;
  };
  auto u64 = [&](size_t command, size_t at) {
    uint64_t v;
    std::memcpy(
        &v, Executed<runtime::DispatchCommand>(command).state.root_arguments->bytes.data() + at, 8);
    return v;
  };
  EXPECT_EQ(u32(0, 0), 0u);  // the first dispatch keeps its snapshot
  EXPECT_EQ(u32(0, 4), 11u);
  EXPECT_EQ(u32(0, 8), 12u);
  EXPECT_EQ(u64(0, 16), buffer.GetGPUVirtualAddress() + 256);
  EXPECT_EQ(u64(0, 24), heap.GetGPUDescriptorHandle(3).ptr);
  EXPECT_EQ(u64(0, 32), buffer.GetGPUVirtualAddress() + 4);
  EXPECT_EQ(u32(1, 0), 10u);
  EXPECT_EQ(u32(1, 4), 11u);
  EXPECT_EQ(u64(1, 32), 0u);
  EXPECT_EQ(Executed<runtime::DispatchCommand>(0).groups[2], 3u);
  EXPECT_NE(Executed<runtime::DispatchCommand>(0).state.view_heap, nullptr);
  EXPECT_EQ(Executed<runtime::DispatchCommand>(0).state.sampler_heap, nullptr);
}

TEST_F(CommandListTest, RootArgumentErrors) {
  auto signature = Global(
      "RootConstants(num32BitConstants=3, b0), SRV(t0), DescriptorTable(UAV(u0)), "
      "CBV(b9)");
  auto with = [&](auto&& f) {
    return Record([&](CommandList& l) {
      l.SetComputeRootSignature(signature);
      f(l);
    });
  };
  const uint32_t values[4] = {};
  EXPECT_ERROR(Record([&](CommandList& l) { l.SetComputeRoot32BitConstant(0, 1, 0); }), "KA0805");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRoot32BitConstant(4, 1, 0); }), "KA0807",
               "parameter 4", "has 4");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRoot32BitConstant(1, 1, 0); }), "KA0807",
               "type 3");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRoot32BitConstant(0, 1, 3); }), "KA0808");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRoot32BitConstants(0, 4, values, 0); }),
               "KA0808", "0..4", "has only 3");
  EXPECT_ERROR(
      with([&](CommandList& l) { l.SetComputeRoot32BitConstants(0, 2, values, 0xFFFFFFFF); }),
      "KA0808");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRoot32BitConstants(0, 1, nullptr, 0); }),
               "KA0808", "null");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRootShaderResourceView(1, 0x1234); }),
               "KA0809", "no live buffer");
  auto buffer = MakeBuffer(64);
  EXPECT_ERROR(with([&](CommandList& l) {
                 l.SetComputeRootShaderResourceView(1, buffer.GetGPUVirtualAddress() + 2);
               }),
               "KA0809", "multiple of 4");
  EXPECT_ERROR(with([&](CommandList& l) {
                 l.SetComputeRootConstantBufferView(3, buffer.GetGPUVirtualAddress() + 16);
               }),
               "KA0809", "256");
  EXPECT_ERROR(with([&](CommandList& l) { l.SetComputeRootDescriptorTable(2, {64}); }), "KA0810",
               "SetDescriptorHeaps");
  EXPECT_ERROR(Record([&](CommandList& l) { l.SetComputeRootSignature(Local("")); }), "KA0536");
}

TEST_F(CommandListTest, ROOT_17_TableHandlesBelongToTheHeapsThatAreSet) {
  const DescriptorHeapDesc desc = {.NumDescriptors = 4,
                                   .Flags = DescriptorHeapFlags::kShaderVisible};
  auto one = device_.CreateDescriptorHeap(desc).value();
  auto two = device_.CreateDescriptorHeap(desc).value();
  auto signature = Global("DescriptorTable(SRV(t0)), DescriptorTable(Sampler(s0))");
  for (GpuDescriptorHandle bad : {two.GetGPUDescriptorHandle(0), one.GetGPUDescriptorHandle(4),
                                  GpuDescriptorHandle{one.GetGPUDescriptorHandle(0).ptr + 8}}) {
    EXPECT_ERROR(Record([&](CommandList& l) {
                   l.SetDescriptorHeaps({one});
                   l.SetComputeRootSignature(signature);
                   l.SetComputeRootDescriptorTable(0, bad);
                 }),
                 "KA0810");
  }
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetDescriptorHeaps({one});
                 l.SetComputeRootSignature(signature);
                 l.SetComputeRootDescriptorTable(1, one.GetGPUDescriptorHandle(0));
               }),
               "KA0810", "sampler");
}

TEST_F(CommandListTest, HeapsAreShaderVisibleAndOneOfEachType) {
  auto hidden = device_.CreateDescriptorHeap({.NumDescriptors = 1}).value();
  auto visible =
      device_
          .CreateDescriptorHeap({.NumDescriptors = 1, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  EXPECT_ERROR(Record([&](CommandList& l) { l.SetDescriptorHeaps({hidden}); }), "KA0804");
  EXPECT_ERROR(Record([&](CommandList& l) { l.SetDescriptorHeaps({visible, visible}); }), "KA0804");
  EXPECT_ERROR(Record([&](CommandList& l) { l.SetDescriptorHeaps({DescriptorHeap()}); }), "KA0904");
}

// --- DispatchRays ---

class DispatchRaysTest : public CommandListTest {
 protected:
  DispatchRaysTest() {
    StateObjectDesc desc = Base();
    signature_ = Global("SRV(t0)");
    desc.Add(GlobalRootSignature{signature_});
    so_ = Make(desc).value();
    ShaderTable table(so_, "raygen table");
    table.AddRecord("RayGen").value();
    EXPECT_TRUE(table.Build(device_).ok());
    table_ = table.buffer();
    rays_.RayGenerationShaderRecord = table.GetRecord(0);
  }
  Status Dispatch() {
    return Record([&](CommandList& l) {
      l.SetComputeRootSignature(signature_);
      l.SetPipelineState1(so_);
      l.DispatchRays(rays_);
    });
  }
  RootSignature signature_;
  StateObject so_;
  Buffer table_;
  DispatchRaysDesc rays_;
};

TEST_F(DispatchRaysTest, SO_45_RecordsTheStackSizeOfTheMoment) {
  ASSERT_TRUE(so_.SetPipelineStackSize(1000).ok());
  list_.SetComputeRootSignature(signature_);
  list_.SetPipelineState1(so_);
  list_.DispatchRays(rays_);
  ASSERT_TRUE(so_.SetPipelineStackSize(2000).ok());
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok());
  EXPECT_EQ(Executed<runtime::DispatchRaysCommand>(0).pipeline_stack_bytes, 1000u);
  EXPECT_EQ(so_.GetPipelineStackSize(), 2000u);
}

TEST_F(DispatchRaysTest, DSP_06_SO_70_PipelineIsSet) {
  EXPECT_ERROR(Record([&](CommandList& l) { l.DispatchRays(rays_); }), "KA0811",
               "SetPipelineState1");
  LibraryBuilder b;
  b.Export("Kernel", Stage::kCompute);
  auto pso =
      device_.CreateComputePipelineState({.pRootSignature = signature_, .CS = b.Build()}).value();
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetComputeRootSignature(signature_);
                 l.SetPipelineState1(so_);
                 l.SetPipelineState(pso);  // replaces it
                 l.DispatchRays(rays_);
               }),
               "KA0811");
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetPipelineState(pso);
                 l.SetPipelineState1(so_);
                 l.Dispatch(1, 1, 1);
               }),
               "KA0811");
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetPipelineState1(Make(Base(StateObjectType::kCollection)).value());
               }),
               "KA0811", "collection");
}

TEST_F(DispatchRaysTest, ROOT_14_SignatureIsThatOfARayGenerationShader) {
  EXPECT_OK(Dispatch());
  signature_ = Global("SRV(t0)");  // an equal one
  EXPECT_OK(Dispatch());
  signature_ = Global("SRV(t1)");
  EXPECT_ERROR(Dispatch(), "KA0812");
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetPipelineState1(so_);
                 l.DispatchRays(rays_);
               }),
               "KA0812", "no compute root signature");
}

TEST_F(DispatchRaysTest, DSP_07_TablesAreAligned) {
  const uint64_t start = table_.GetGPUVirtualAddress();
  rays_.MissShaderTable = {start, 32, 32};
  EXPECT_OK(Dispatch());
  rays_.MissShaderTable.StartAddress = start + 32;
  EXPECT_ERROR(Dispatch(), "KA0813", "MissShaderTable", "multiple of 64");
  rays_.MissShaderTable = {};
  rays_.RayGenerationShaderRecord.StartAddress += 32;
  EXPECT_ERROR(Dispatch(), "KA0813", "RayGenerationShaderRecord");
  rays_.RayGenerationShaderRecord = {};
  EXPECT_ERROR(Dispatch(), "KA0813", "at least 32");
}

TEST_F(DispatchRaysTest, SBT_14_Strides) {
  for (uint64_t stride : {16u, 48u, 4128u}) {
    rays_.HitGroupTable = {table_.GetGPUVirtualAddress(), 32, stride};
    EXPECT_ERROR(Dispatch(), "KA0813", "HitGroupTable", std::to_string(stride));
  }
  for (uint64_t stride : {0u, 32u, 4096u}) {
    rays_.HitGroupTable = {table_.GetGPUVirtualAddress(), 32, stride};
    EXPECT_OK(Dispatch());
  }
}

TEST_F(DispatchRaysTest, TablesLieInLiveMemory) {
  rays_.CallableShaderTable = {table_.GetGPUVirtualAddress(), 1 << 20, 32};
  EXPECT_ERROR(Dispatch(), "KA0815", "CallableShaderTable", "\"raygen table\"");
  rays_.CallableShaderTable = {0x40, 32, 32};
  EXPECT_ERROR(Dispatch(), "KA0815");
  rays_.CallableShaderTable = {0, 0, 0};  // SBT_32
  EXPECT_OK(Dispatch());
}

TEST_F(DispatchRaysTest, DSP_01_ThreadsUpTo2To30) {
  auto with = [&](uint32_t w, uint32_t h, uint32_t d) {
    rays_.Width = w;
    rays_.Height = h;
    rays_.Depth = d;
    return Dispatch();
  };
  EXPECT_OK(with(1u << 30, 1, 1));
  EXPECT_OK(with(1, 1u << 15, 1u << 15));
  EXPECT_OK(with(0, 5, 5));  // DSP_02
  EXPECT_ERROR(with((1u << 30) + 1, 1, 1), "KA0814", "2^30 threads");
  EXPECT_ERROR(with(0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF), "KA0814");
  EXPECT_ERROR(with(1u << 10, 1u << 10, (1u << 10) + 1), "KA0814");
}

TEST_F(CommandListTest, DispatchLimits) {
  LibraryBuilder b;
  b.Export("Kernel", Stage::kCompute);
  auto signature = Global("");
  auto pso =
      device_.CreateComputePipelineState({.pRootSignature = signature, .CS = b.Build()}).value();
  auto dispatch = [&](uint32_t x) {
    return Record([&](CommandList& l) {
      l.SetComputeRootSignature(signature);
      l.SetPipelineState(pso);
      l.Dispatch(x, 1, 1);
    });
  };
  EXPECT_OK(dispatch(65535));
  EXPECT_OK(dispatch(0));
  EXPECT_ERROR(dispatch(65536), "KA0814", "65535");
  EXPECT_ERROR(Record([&](CommandList& l) {
                 l.SetPipelineState(pso);
                 l.Dispatch(1, 1, 1);
               }),
               "KA0812", "\"Kernel\"");
}

TEST_F(CommandListTest, ClearStateUnsetsWhatIsSet) {
  list_.BeginEvent("a");
  list_.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list_.ClearState();
  list_.EndEvent();
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_EQ(null_log().executed.size(), 2u);  // what was recorded stays
  EXPECT_ERROR(Record([](CommandList& l) {
                 l.ClearState();
                 l.Dispatch(1, 1, 1);
               }),
               "KA0811");
  list_.ClearState();
  ASSERT_EQ(list_.GetErrors().size(), 1u);
  EXPECT_EQ(list_.GetErrors()[0].id.text(), "KA0800");
}

// Undefined in D3D12; drivers leave registers as they are.
TEST(InvalidCallsTest, AnotherRootSignatureKeepsWhatHasTheSameIndexAndType) {
  for (const InvalidCalls calls : {InvalidCalls::kDropCall, InvalidCalls::kFailList}) {
    const Device device = CreateNullDevice({.InvalidCalls = calls});
    const bool keeps = calls == InvalidCalls::kDropCall;
    CommandList list = device.CreateCommandList().value();
    const RootSignature one =
        device.CreateRootSignature("RootConstants(num32BitConstants=2, b0), UAV(u0), UAV(u1)")
            .value();
    const RootSignature other =
        device.CreateRootSignature("RootConstants(num32BitConstants=3, b0), UAV(u5), CBV(b1)")
            .value();
    const Buffer buffer =
        device.CreateBuffer({.SizeInBytes = 256, .Flags = ResourceFlags::kAllowUnorderedAccess})
            .value();
    const uint32_t values[] = {7, 8, 9};
    list.SetComputeRootSignature(one);
    list.SetComputeRoot32BitConstants(0, 2, values, 0);
    list.SetComputeRootUnorderedAccessView(1, buffer.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(2, buffer.GetGPUVirtualAddress());
    list.SetComputeRootSignature(other);
    const auto& state = list.impl()->compute;
    uint32_t constants[3];
    uint64_t views[2];
    std::memcpy(constants, state.arguments->bytes.data(), sizeof constants);
    std::memcpy(views, state.arguments->bytes.data() + 16, sizeof views);
    EXPECT_EQ(constants[0], keeps ? 7u : 0u);
    EXPECT_EQ(constants[1], keeps ? 8u : 0u);
    EXPECT_EQ(constants[2], 0u);
    EXPECT_EQ(views[0], keeps ? buffer.GetGPUVirtualAddress() : 0u);
    EXPECT_EQ(views[1], 0u) << "another type";
    EXPECT_EQ(state.views.size(), keeps ? 1u : 0u);
    EXPECT_EQ(state.set_parameters, 0u) << "checked mode tells of what was not set again";
  }
}

TEST(InvalidCallsTest, DroppedCallsAreToldAndTheRestOfTheListRuns) {
  std::vector<Message> messages;
  const Device device =
      CreateNullDevice({.InvalidCalls = InvalidCalls::kDropCall,
                        .OnMessage = [&](const Message& m) { messages.push_back(m); }});
  CommandList list = device.CreateCommandList().value();
  const CommandQueue queue = device.CreateCommandQueue().value();
  const Buffer upload = device.CreateBuffer({.SizeInBytes = 64, .Heap = HeapType::kUpload}).value();
  const size_t before = null_log().executed.size();
  list.Dispatch(1, 1, 1);          // KA0811: no pipeline
  list.DrawInstanced(3, 1, 0, 0);  // KA0811
  list.ResourceBarrier(ResourceBarrier::Transition(upload, ResourceStates::kGenericRead,
                                                   ResourceStates::kCopyDest));  // KA0802
  list.BeginEvent("rest");
  list.EndEvent();
  EXPECT_OK(list.Close());
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].Id.text(), "KA0811");
  EXPECT_EQ(messages[0].Severity, MessageSeverity::kError);
  EXPECT_EQ(messages[2].Id.text(), "KA0802");
  EXPECT_OK(queue.ExecuteCommandLists({list}));
  EXPECT_EQ(null_log().executed.size() - before, 2u);
  // A view that reaches past its buffer is cut.
  messages.clear();
  EXPECT_OK(list.Reset());
  list.IASetVertexBuffers(3, VertexBufferView{upload.GetGPUVirtualAddress() + 48, 64, 4});
  EXPECT_OK(list.Close());
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].Id.text(), "KA0741");
  EXPECT_EQ(list.impl()->draw_state->vertex_buffers[3].SizeInBytes, 16u);
  // The address of a root descriptor of another type is set.
  messages.clear();
  const RootSignature root =
      device.CreateRootSignature("UAV(u0), DescriptorTable(SRV(t0))").value();
  EXPECT_OK(list.Reset());
  list.SetComputeRootSignature(root);
  list.SetComputeRootShaderResourceView(0, upload.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(1, upload.GetGPUVirtualAddress());
  EXPECT_EQ(messages.size(), 2u);
  uint64_t arguments[2];
  std::memcpy(arguments, list.impl()->compute.arguments->bytes.data(), sizeof arguments);
  EXPECT_EQ(arguments[0], upload.GetGPUVirtualAddress());
  EXPECT_EQ(arguments[1], 0u) << "a table is no address";
  // A target that nothing was written to is not set.
  const DescriptorHeap rtvs =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  const CpuDescriptorHandle unwritten = rtvs.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &unwritten);
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[2].Id.text(), "KA0731");
  EXPECT_OK(list.Close());
  // Arguments of copies fail the list there too.
  EXPECT_OK(list.Reset());
  list.CopyBufferRegion(upload, 65, upload, 0, 1);
  EXPECT_FALSE(list.Close().ok());
  // A list that is executed open removes the device.
  EXPECT_OK(list.Reset());
  EXPECT_ERROR(queue.ExecuteCommandLists({list}), "KA0823", "open");
  EXPECT_ERROR(device.GetDeviceRemovedReason(), "KA0823");
}

}  // namespace
}  // namespace rtapi::testing
