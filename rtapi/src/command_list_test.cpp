// SPDX-License-Identifier: MIT
#include <cstring>

#include <rtapi/shader_table.h>

#include "rtapi/testing/state_object_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;

class CommandListTest : public StateObjectTest {
 protected:
  CommandListTest() {
    list_ = device_.CreateCommandList().value();
    queue_ = device_.CreateCommandQueue().value();
  }
  // The id of the first error of what `record` does on a fresh list, or "ok".
  template <class F>
  Status Record(F&& record) {
    CommandList list = device_.CreateCommandList().value();
    record(list);
    return list.Close();
  }
  template <class Command>
  const Command& Executed(size_t i) {
    return std::get<Command>(null_log().executed.at(i));
  }
  Buffer MakeBuffer(uint64_t bytes, HeapType heap = HeapType::kDefault, std::string name = "b",
                    ResourceFlags flags = ResourceFlags::kNone) {
    return device_
        .CreateBuffer({.SizeInBytes = bytes, .Heap = heap, .Flags = flags, .Name = std::move(name)})
        .value();
  }

  CommandList list_;
  CommandQueue queue_;
};

TEST_F(CommandListTest, OpenAndClosed) {
  EXPECT_TRUE(list_.is_open());
  EXPECT_OK(list_.Close());
  EXPECT_FALSE(list_.is_open());
  EXPECT_ERROR(list_.Close(), "KA0800");
  list_.Dispatch(1, 1, 1);
  EXPECT_EQ(list_.GetErrors().at(0).id, "KA0800");
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
  EXPECT_EQ(u32(0, 0), 0u);  // the snapshot of the first dispatch
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
               "KA0808", "0..4", "has 3");
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
  EXPECT_ERROR(with((1u << 30) + 1, 1, 1), "KA0814");
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

// --- barriers ---

TEST_F(CommandListTest, Barriers) {
  auto buffer = MakeBuffer(64, HeapType::kDefault, "buf");
  auto upload = MakeBuffer(64, HeapType::kUpload, "up");
  const auto read = ResourceStates::kNonPixelShaderResource;
  const auto common = ResourceStates::kCommon;
  auto barrier = [&](const ResourceBarrier& b) {
    return Record([&](CommandList& l) { l.ResourceBarrier(b); });
  };
  EXPECT_OK(barrier(ResourceBarrier::Uav()));
  EXPECT_OK(barrier(ResourceBarrier::Uav(buffer)));
  EXPECT_OK(barrier(ResourceBarrier::Transition(buffer, common, read)));
  EXPECT_ERROR(barrier(ResourceBarrier::Transition(buffer, read, read)), "KA0802", "\"buf\"");
  EXPECT_ERROR(barrier(ResourceBarrier::Transition({}, common, read)), "KA0904");
  EXPECT_ERROR(barrier(ResourceBarrier::Transition(upload, common, read)), "KA0802", "one state");
  EXPECT_ERROR(barrier(ResourceBarrier::Transition(buffer, common, read, 1)), "KA0802",
               "subresource 1");
  ResourceBarrier odd;
  odd.Type = static_cast<ResourceBarrierType>(7);
  EXPECT_ERROR(barrier(odd), "KA0802", "type 7");
}

TEST_F(CommandListTest, AS_22_NoTransitionOfStructures) {
  auto buffer = MakeBuffer(64);
  auto structure =
      device_
          .CreateBuffer({.SizeInBytes = 256,
                         .Flags = ResourceFlags::kAllowUnorderedAccess,
                         .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                         .Name = "tlas"})
          .value();
  const auto as = ResourceStates::kRaytracingAccelerationStructure;
  EXPECT_ERROR(
      Record([&](CommandList& l) {
        l.ResourceBarrier(ResourceBarrier::Transition(structure, as, ResourceStates::kCommon));
      }),
      "KA0803", "\"tlas\"");
  EXPECT_ERROR(
      Record([&](CommandList& l) {
        l.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kCommon, as));
      }),
      "KA0803");
  EXPECT_OK(Record([&](CommandList& l) { l.ResourceBarrier(ResourceBarrier::Uav(structure)); }));
}

// --- copies ---

TEST_F(CommandListTest, BufferCopies) {
  auto up = MakeBuffer(16, HeapType::kUpload, "up");
  auto gpu = MakeBuffer(16, HeapType::kDefault, "gpu");
  auto back = MakeBuffer(16, HeapType::kReadback, "back");
  for (int i = 0; i < 16; ++i) up.data<uint8_t>()[static_cast<size_t>(i)] = static_cast<uint8_t>(i);
  list_.CopyBufferRegion(gpu, 4, up, 0, 8);
  list_.CopyResource(back, gpu);
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok());
  EXPECT_EQ(back.data<uint8_t>()[3], 0);
  EXPECT_EQ(back.data<uint8_t>()[11], 7);
  auto copy = [&](const Buffer& d, uint64_t at, const Buffer& s, uint64_t from, uint64_t n) {
    return Record([&](CommandList& l) { l.CopyBufferRegion(d, at, s, from, n); });
  };
  EXPECT_ERROR(copy(gpu, 9, up, 0, 8), "KA0817", "dest", "\"gpu\"");
  EXPECT_ERROR(copy(gpu, 0, up, 9, 8), "KA0817", "source", "\"up\"");
  EXPECT_ERROR(copy(gpu, UINT64_MAX, up, 0, 2), "KA0817");
  EXPECT_ERROR(copy(gpu, 0, up, 2, UINT64_MAX), "KA0817");
  EXPECT_ERROR(copy(gpu, 0, gpu, 4, 8), "KA0818");
  EXPECT_OK(copy(gpu, 0, gpu, 8, 8));
  EXPECT_ERROR(copy(up, 0, gpu, 0, 8), "KA0821", "upload");
  EXPECT_ERROR(copy(gpu, 0, back, 0, 8), "KA0821", "readback");
  EXPECT_ERROR(copy({}, 0, back, 0, 8), "KA0904", "dest");
  EXPECT_ERROR(Record([&](CommandList& l) { l.CopyResource(gpu, MakeBuffer(8)); }), "KA0819");
}

class TextureCopyTest : public CommandListTest {
 protected:
  Texture MakeTexture(Format format = Format::kR8G8B8A8Unorm, uint16_t mips = 1) {
    return device_
        .CreateTexture({.Width = 8, .Height = 4, .MipLevels = mips, .Format = format, .Name = "t"})
        .value();
  }
  static PlacedSubresourceFootprint Footprint(uint64_t offset, uint32_t pitch = 256) {
    return {offset, {Format::kR8G8B8A8Unorm, 8, 4, 1, pitch}};
  }
  Status Copy(const TextureCopyLocation& dest, uint32_t x, uint32_t y,
              const TextureCopyLocation& source, const Box* box = nullptr) {
    return Record([&](CommandList& l) { l.CopyTextureRegion(dest, x, y, 0, source, box); });
  }
};

TEST_F(TextureCopyTest, BufferToTexture) {
  auto buffer = MakeBuffer(2048, HeapType::kUpload);
  auto texture = MakeTexture();
  const Box box = {2, 1, 0, 6, 3, 1};
  list_.CopyTextureRegion({texture, 0}, 4, 2, 0, {buffer, Footprint(512)}, &box);
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok()) << list_.GetErrors().at(0).message;
  const auto& c = Executed<runtime::CopyTextureCommand>(0);
  EXPECT_EQ(c.extent[0], 4u);
  EXPECT_EQ(c.extent[1], 2u);
  EXPECT_EQ(c.source.origin[0], 2u);
  EXPECT_EQ(c.dest.origin[0], 4u);
  EXPECT_EQ(c.source.offset, 512u);
  EXPECT_EQ(c.source.row_pitch, 256u);
  EXPECT_EQ(c.source.slice_pitch, 1024u);
}

TEST_F(TextureCopyTest, Errors) {
  auto buffer = MakeBuffer(2048, HeapType::kUpload, "pixels");
  auto texture = MakeTexture();
  EXPECT_ERROR(Copy({texture, 1}, 0, 0, {buffer, Footprint(0)}), "KA0817", "subresource 1");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(100)}), "KA0820", "512");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(0, 100)}), "KA0820");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(0, 0)}), "KA0820");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(1536)}), "KA0817", "\"pixels\"");
  EXPECT_ERROR(Copy({texture, 0}, 1, 0, {buffer, Footprint(0)}), "KA0817", "axis 0");
  EXPECT_ERROR(Copy({texture, 0}, 0xFFFFFFFF, 0, {buffer, Footprint(0)}), "KA0817");
  const Box box = {0, 0, 0, 9, 1, 1};
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(0)}, &box), "KA0817");
  EXPECT_ERROR(Copy({buffer, Footprint(0)}, 0, 0, {buffer, Footprint(0)}), "KA0819", "buffers");
  EXPECT_ERROR(Copy({MakeTexture(Format::kR32Float), 0}, 0, 0, {texture, 0}), "KA0819", "family");
  EXPECT_OK(Copy({MakeTexture(Format::kR8G8B8A8UnormSrgb), 0}, 0, 0, {texture, 0}));
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {texture, 0}), "KA0818");
  EXPECT_ERROR(Copy({Texture(), 0}, 0, 0, {texture, 0}), "KA0904");
  auto whole = [&](const Resource& d, const Resource& s) {
    return Record([&](CommandList& l) { l.CopyResource(d, s); });
  };
  EXPECT_OK(whole(MakeTexture(), texture));
  EXPECT_ERROR(whole(MakeTexture(Format::kR8G8B8A8Unorm, 2), texture), "KA0819", "mip");
  EXPECT_ERROR(whole(texture, buffer), "KA0819");
}

TEST_F(CommandListTest, ClearsNeedTheSameViewTwice) {
  auto buffer = MakeBuffer(64, HeapType::kDefault, "buf", ResourceFlags::kAllowUnorderedAccess);
  auto other = MakeBuffer(64, HeapType::kDefault, "other", ResourceFlags::kAllowUnorderedAccess);
  auto heap =
      device_
          .CreateDescriptorHeap({.NumDescriptors = 2, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  const UnorderedAccessViewDesc view = {.Format = Format::kR32Uint,
                                        .ViewDimension = UavDimension::kBuffer};
  auto cpu = heap.GetCPUDescriptorHandle(0);
  auto gpu = heap.GetGPUDescriptorHandle(0);
  ASSERT_TRUE(device_.CreateUnorderedAccessView(buffer, view, cpu).ok());
  const uint32_t values[4] = {7, 0, 0, 0};
  auto clear = [&](GpuDescriptorHandle g, CpuDescriptorHandle c, const Resource& r,
                   const uint32_t* v) {
    return Record([&](CommandList& l) {
      l.SetDescriptorHeaps({heap});
      l.ClearUnorderedAccessViewUint(g, c, r, v);
    });
  };
  EXPECT_OK(clear(gpu, cpu, buffer, values));
  EXPECT_ERROR(clear(gpu, {5}, buffer, values), "KA0822", "CPU handle");
  EXPECT_ERROR(clear({5}, cpu, buffer, values), "KA0822", "GPU handle");
  EXPECT_ERROR(clear(gpu, cpu, other, values), "KA0822", "\"other\"");
  EXPECT_ERROR(clear(gpu, cpu, buffer, nullptr), "KA0822", "null");
  EXPECT_ERROR(clear(gpu, heap.GetCPUDescriptorHandle(1), buffer, values), "KA0822",
               "no unordered access view");
}

TEST_F(CommandListTest, EventsAreBalanced) {
  list_.BeginEvent("pass");
  EXPECT_ERROR(list_.Close(), "KA0824", "1 BeginEvent");
  EXPECT_ERROR(Record([](CommandList& l) { l.EndEvent(); }), "KA0824");
}

}  // namespace
}  // namespace rtapi::testing
