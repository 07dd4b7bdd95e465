// SPDX-License-Identifier: MIT
//
// States of textures and of indirect arguments, and dispatches whose tables come from a buffer.
#include <cstring>
#include <utility>

#include "tests/checks/world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;

// --- ExecuteIndirect ---

class Indirect : public World {
 protected:
  void SetUp() override {
    World::SetUp();
    if (IsSkipped()) return;
    build_scene();
    set_ = make_tables(pipeline_);
    IndirectArgumentDesc rays;
    rays.Type = IndirectArgumentType::kDispatchRays;
    signature_ =
        device_.CreateCommandSignature({sizeof(DispatchRaysDesc), {rays}}, RootSignature()).value();
    arguments_ = buffer(2 * sizeof(DispatchRaysDesc), "arguments");
  }
  // The same list writes the arguments into their buffer.
  void run(const std::vector<DispatchRaysDesc>& dispatches, bool barrier = true) {
    CommandList commands = list();
    commands.CopyBufferRegion(arguments_, 0, upload(dispatches, "new arguments"), 0,
                              dispatches.size() * sizeof(DispatchRaysDesc));
    if (barrier) {
      commands.ResourceBarrier(ResourceBarrier::Transition(arguments_, ResourceStates::kCopyDest,
                                                           ResourceStates::kIndirectArgument));
    }
    commands.SetComputeRootSignature(global_);
    commands.SetComputeRootShaderResourceView(0, top_.GetGPUVirtualAddress());
    commands.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
    commands.SetPipelineState1(pipeline_);
    commands.ExecuteIndirect(signature_, static_cast<uint32_t>(dispatches.size()), arguments_, 0);
    const Status status = execute(commands);
    EXPECT_TRUE(status.ok()) << status.error().message;
  }
  TableSet set_;
  CommandSignature signature_;
  Buffer arguments_;
};

TEST_P(Indirect, TablesAreProvenWhenTheyAreKnown) {
  run({set_.desc, set_.desc});
  expect_none();
  DispatchRaysDesc wrong = set_.desc;
  wrong.MissShaderTable = {};
  const Buffer scene = std::exchange(top_, build(top_inputs({}), "nothing"));
  run({set_.desc, wrong});
  expect_one("KA0430", {"miss table record 0", "there is no such table",
                        "(DispatchRays 1 of ExecuteIndirect, command 2)"});
  top_ = scene;
  wrong = set_.desc;
  wrong.HitGroupTable = set_.desc.MissShaderTable;
  run({wrong});
  expect_one("KA0433", {"hit group table record 0 holds \"Miss\", which is a miss export",
                        "(DispatchRays 0 of ExecuteIndirect, command 2)"});
}

TEST_P(Indirect, ArgumentsInTheWrongState) {
  run({set_.desc}, false);
  expect_one("KA0451", {"the buffer of indirect arguments is in buffer \"arguments\"",
                        "which is in state kCopyDest since CopyBufferRegion, command 0; it must be "
                        "in state kIndirectArgument",
                        "(ExecuteIndirect, command 1)"});
}

TEST_P(Indirect, TablesThatADispatchOfItWrites) {
  set_ = make_tables(pipeline_, "RayGenWrites");
  TableSet second = make_tables(pipeline_);
  run({set_.desc, second.desc});
  expect_none();
  // The first dispatch writes into the miss table of the second.
  std::vector<std::byte> miss(64);
  std::memcpy(miss.data(), second.tables[1].buffer().data<std::byte>().data(), 32);
  results_ = buffer(256, "results and a table");
  CommandList fill = list();
  fill.CopyBufferRegion(results_, 0, upload(miss, "miss"), 0, 64);
  ASSERT_TRUE(execute(fill).ok());
  second.desc.MissShaderTable = {results_.GetGPUVirtualAddress(), 32, 32};
  run({set_.desc, second.desc});
  const auto texts = told();
  size_t found = 0;
  for (const std::string& text : texts) {
    if (text.substr(0, 6) != "KA0441") continue;
    ++found;
    EXPECT_NE(text.find("shader table changed while it was used: the miss table is bytes 0..32 of "
                        "buffer \"results and a table\""),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("(ExecuteIndirect, command 2)"), std::string::npos) << text;
  }
  EXPECT_EQ(found, 1u);
}

TEST_P(Indirect, ATableThatItsOwnDispatchWrites) {
  set_ = make_tables(pipeline_, "RayGenWrites");
  results_ = buffer(256, "results and a table");
  CommandList fill = list();
  fill.CopyBufferRegion(results_, 0, set_.tables[1].buffer(), 0, 32);
  ASSERT_TRUE(execute(fill).ok());
  set_.desc.MissShaderTable = {results_.GetGPUVirtualAddress(), 32, 32};
  dispatch(set_.desc);
  bool found = false;
  for (const std::string& text : told()) found = found || text.substr(0, 6) == "KA0441";
  EXPECT_TRUE(found);
}

INSTANTIATE_TEST_SUITE_P(Embree, Indirect, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Indirect, ::testing::Values("vulkan"));

// --- textures ---

class Textures : public World {
 protected:
  void SetUp() override {
    World::SetUp();
    if (IsSkipped()) return;
    DescriptorHeapDesc heap;
    heap.NumDescriptors = 2;
    heap.Flags = DescriptorHeapFlags::kShaderVisible;
    heap_ = device_.CreateDescriptorHeap(heap).value();
    signature_ = device_
                     .CreateRootSignature(
                         "DescriptorTable(UAV(u1)), DescriptorTable(SRV(t2)), "
                         "UAV(u0)")
                     .value();
    paint_ = pipeline("Paint");
    look_ = pipeline("Look");
  }
  PipelineState pipeline(const char* entry) {
    ComputePipelineStateDesc desc;
    desc.pRootSignature = signature_;
    desc.CS = pipeline_library();
    desc.EntryPoint = entry;
    return device_.CreateComputePipelineState(desc).value();
  }
  // The view to write covers the first mip, the view to read the last one.
  void create(ResourceStates state, uint16_t mips = 1) {
    TextureDesc desc;
    desc.Width = desc.Height = 4;
    desc.MipLevels = mips;
    desc.Format = Format::kR32Float;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = state;
    desc.Name = "wall";
    texture_ = device_.CreateTexture(desc).value();
    UnorderedAccessViewDesc uav;
    uav.ViewDimension = UavDimension::kTexture2D;
    uav.Format = Format::kR32Float;
    device_.CreateUnorderedAccessView(texture_, uav, heap_.GetCPUDescriptorHandle(0)).value();
    ShaderResourceViewDesc srv;
    srv.ViewDimension = SrvDimension::kTexture2D;
    srv.Format = Format::kR32Float;
    srv.Texture2D.MostDetailedMip = mips - 1u;
    srv.Texture2D.MipLevels = 1;
    device_.CreateShaderResourceView(texture_, srv, heap_.GetCPUDescriptorHandle(1)).value();
  }
  void record(CommandList& commands, const PipelineState& pipeline) {
    commands.SetDescriptorHeaps({&heap_, 1});
    commands.SetComputeRootSignature(signature_);
    commands.SetComputeRootDescriptorTable(0, heap_.GetGPUDescriptorHandle(0));
    commands.SetComputeRootDescriptorTable(1, heap_.GetGPUDescriptorHandle(1));
    commands.SetComputeRootUnorderedAccessView(2, results_.GetGPUVirtualAddress());
    commands.SetPipelineState(pipeline);
    commands.Dispatch(1, 1, 1);
  }
  void transition(CommandList& commands, ResourceStates before, ResourceStates after,
                  uint32_t subresource = kResourceBarrierAllSubresources) {
    commands.ResourceBarrier(ResourceBarrier::Transition(texture_, before, after, subresource));
  }
  void run(CommandList& commands) { EXPECT_TRUE(execute(commands).ok()); }

  DescriptorHeap heap_;
  RootSignature signature_;
  PipelineState paint_, look_;
  Texture texture_;
};

constexpr auto kUav = ResourceStates::kUnorderedAccess;
constexpr auto kRead = ResourceStates::kNonPixelShaderResource;

TEST_P(Textures, RightStatesAreSilent) {
  create(kUav);
  CommandList commands = list();
  record(commands, paint_);
  transition(commands, kUav, kRead);
  record(commands, look_);
  run(commands);
  // A state that a transition set outlasts the list.
  CommandList next = list();
  record(next, look_);
  transition(next, kRead, kUav);
  record(next, paint_);
  run(next);
  // Reads promote a texture from the common state; it decays back when the list ends.
  create(ResourceStates::kCommon);
  CommandList read = list();
  record(read, look_);
  run(read);
  CommandList later = list();
  transition(later, ResourceStates::kCommon, kUav);
  record(later, paint_);
  run(later);
  expect_none();
}

TEST_P(Textures, ReadWhileForWriting) {
  create(kUav);
  CommandList commands = list();
  record(commands, paint_);
  record(commands, look_);
  run(commands);
  expect_one("KA0451",
             {"compute shader \"Look\", t2 \"seen\" is in texture \"wall\", which is in state "
              "kUnorderedAccess since it was created; it must be in state kNonPixelShaderResource. "
              "Record ResourceBarrier::Transition from kUnorderedAccess to "
              "kNonPixelShaderResource first.",
              "(Dispatch, command 1)"});
}

TEST_P(Textures, WriteInTheCommonState) {
  create(ResourceStates::kCommon);
  CommandList commands = list();
  record(commands, paint_);
  run(commands);
  expect_one("KA0451", {"compute shader \"Paint\", u1 \"picture\" is in texture \"wall\", which is "
                        "in state kCommon since it was created; it must be in state "
                        "kUnorderedAccess"});
}

TEST_P(Textures, AcrossLists) {
  create(kUav);
  CommandList first = list();
  transition(first, kUav, kRead);
  run(first);
  CommandList second = list();
  record(second, paint_);
  run(second);
  expect_one("KA0451", {"texture \"wall\", which is in state kNonPixelShaderResource since "
                        "ResourceBarrier, command 0"});
}

TEST_P(Textures, TransitionFromAnotherState) {
  create(kUav);
  CommandList commands = list();
  transition(commands, ResourceStates::kCopyDest, kRead);
  run(commands);
  expect_one("KA0452", {"StateBefore kCopyDest is given for texture \"wall\", which is in state "
                        "kUnorderedAccess since it was created. Pass the state that it is in."});
}

TEST_P(Textures, AnotherNameIsWhatMessagesUse) {
  create(kUav);
  texture_.SetName("floor");
  CommandList commands = list();
  transition(commands, ResourceStates::kCopyDest, kRead);
  run(commands);
  expect_one("KA0452", {"StateBefore kCopyDest is given for texture \"floor\""});
}

TEST_P(Textures, SubresourcesHaveStatesOfTheirOwn) {
  create(kUav, 2);
  CommandList commands = list();
  transition(commands, kUav, kRead, 1);
  record(commands, paint_);
  record(commands, look_);
  transition(commands, kRead, kUav, 1);
  transition(commands, kUav, kRead);
  record(commands, look_);
  run(commands);
  expect_none();
  create(kUav, 2);
  CommandList other = list();
  transition(other, kUav, kRead, 0);
  record(other, look_);
  run(other);
  expect_one("KA0451", {"t2 \"seen\" is in subresource 1 (mip 1, array element 0) of texture "
                        "\"wall\", which is in state kUnorderedAccess since it was created"});
  CommandList all = list();
  transition(all, kUav, kRead);
  run(all);
  expect_one("KA0452", {"StateBefore kUnorderedAccess is given for subresource 0 (mip 0, array "
                        "element 0) of texture \"wall\", which is in state "
                        "kNonPixelShaderResource since ResourceBarrier, command 0"});
}

// --- enhanced barriers ---

GlobalBarrier scopes(BarrierAccess before, BarrierAccess after) {
  return {BarrierSync::kAll, BarrierSync::kAll, before, after};
}

TEST_P(Textures, LayoutsOfEnhancedBarriers) {
  create(kUav, 2);
  const auto change = [&](CommandList& commands, BarrierLayout before, BarrierLayout after,
                          BarrierSubresourceRange range = {}) {
    commands.Barrier(TextureBarrier{scopes(BarrierAccess::kCommon, BarrierAccess::kCommon), before,
                                    after, texture_, range});
  };
  CommandList right = list();
  record(right, paint_);
  change(right, BarrierLayout::kUnorderedAccess, BarrierLayout::kShaderResource, {1, 1, 0, 1});
  record(right, paint_);
  record(right, look_);
  change(right, BarrierLayout::kUndefined, BarrierLayout::kDirectQueueCommon);
  record(right, look_);
  record(right, paint_);
  run(right);
  expect_none();
  CommandList wrong = list();
  change(wrong, BarrierLayout::kUnorderedAccess, BarrierLayout::kShaderResource);
  run(wrong);
  expect_one("KA0452", {"LayoutBefore, which is kUnorderedAccess, is given for subresource 0",
                        "texture \"wall\"", "Pass the layout that it is in."});
  CommandList other = list();
  record(other, paint_);
  run(other);
  expect_one("KA0451", {"it must be in kUnorderedAccess. Record a TextureBarrier whose LayoutAfter "
                        "allows that first."});
}

TEST_P(Indirect, AccessesOfEnhancedBarriers) {
  const auto write_and = [&](BarrierAccess after, bool global = false) {
    CommandList commands = list();
    commands.CopyBufferRegion(arguments_, 0, upload(std::vector{set_.desc}, "new arguments"), 0,
                              sizeof(DispatchRaysDesc));
    const GlobalBarrier barrier = scopes(BarrierAccess::kCopyDest, after);
    if (global) {
      commands.Barrier(barrier);
    } else {
      commands.Barrier(BufferBarrier{barrier, arguments_});
    }
    commands.SetComputeRootSignature(global_);
    commands.SetComputeRootShaderResourceView(0, top_.GetGPUVirtualAddress());
    commands.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
    commands.SetPipelineState1(pipeline_);
    commands.ExecuteIndirect(signature_, 1, arguments_, 0);
    ASSERT_TRUE(execute(commands).ok());
  };
  write_and(BarrierAccess::kIndirectArgument);
  write_and(BarrierAccess::kCommon);
  write_and(BarrierAccess::kIndirectArgument, true);
  expect_none();
  write_and(BarrierAccess::kCopySource);
  expect_one("KA0451",
             {"buffer \"arguments\" (208 bytes), which is visible to kCopySource since Barrier, "
              "command 1; it must be to kIndirectArgument. Record a BufferBarrier whose "
              "AccessAfter allows that first."});
}

INSTANTIATE_TEST_SUITE_P(Embree, Textures, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Textures, ::testing::Values("vulkan"));

}  // namespace
}  // namespace kaamos::checks::test
