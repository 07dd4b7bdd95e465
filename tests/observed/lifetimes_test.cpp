// SPDX-License-Identifier: MIT
//
// Tests what resource.h and state_object.h promise about lifetimes.
#include <shaders/rays.h>

#include <cstring>

#include "tests/common/structures.h"
#include "tests/observed/world.h"

namespace {

using namespace rtapi;
using testing::HasSubstr;

class Lifetimes : public kaamos::observed::World {
 protected:
  void SetUp() override {
    World::SetUp();
    if (!IsSkipped() && !HasFatalFailure()) prepare();
  }
  void prepare() {
    scene_ = boxes({{0.5f, -0.5f, 1, 1.5f, 0.5f, 2}});
    constants_[0] = 20;
    pipeline_ =
        device_.CreateStateObject(describe({{"Trace"}, {"Miss"}, {"Report"}, {"OfMine"}})).value();
    messages_.clear();
  }
  StateObjectDesc describe(std::vector<ExportDesc> exports) {
    StateObjectDesc desc;
    desc.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
    desc.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_rays()).value(), std::move(exports)});
    desc.Add(RaytracingShaderConfig{4, 12});
    desc.Add(RaytracingPipelineConfig{1});
    desc.Add(GlobalRootSignature{root_});
    desc.Add(HitGroupDesc{.HitGroupExport = "Group",
                          .Type = HitGroupType::kProceduralPrimitive,
                          .ClosestHitShaderImport = "OfMine",
                          .IntersectionShaderImport = "Report"});
    return desc;
  }
  CommandList traced(const Tables& tables) {
    CommandList list = device_.CreateCommandList().value();
    bind(list);
    list.SetPipelineState1(pipeline_);
    list.DispatchRays(tables.desc(1));
    EXPECT_TRUE(list.Close());
    return list;
  }
  // Nothing runs, and the device lives.
  void expect_freed(CommandList list, const std::vector<std::string>& parts) {
    const Status status = queue_.ExecuteCommandLists({list});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().id.text(), "KA0856");
    for (const std::string& part : parts) EXPECT_THAT(status.error().message, HasSubstr(part));
    EXPECT_TRUE(device_.GetDeviceRemovedReason());
    EXPECT_EQ(read(out_)[16], 0u);
  }
  StateObject pipeline_;
};
INSTANTIATE_TEST_SUITE_P(Backends, Lifetimes, testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Lifetimes, AFreedTableIsNamed) {
  for (const bool checked : {false, true}) {
    if (checked) {
      open(true);
      prepare();
    }
    for (const uint32_t records : {1u, 100000u}) {  // small memory and large
      Tables tables = tables_of(pipeline_, "Trace", "Group");
      for (uint32_t i = 1; i < records; ++i) tables.hit.AddRecord("Group").value();
      tables.hit.Build(device_).value();
      const CommandList list = traced(tables);
      ASSERT_TRUE(queue_.ExecuteCommandLists({list}));
      EXPECT_EQ(read(out_)[16], 220u);
      out_ = zeros(1024, "out");
      const CommandList another = traced(tables);
      tables.hit.Build(device_).value();  // frees the one that the lists name
      // Memory of the same size may get the same address.
      const Buffer again = zeros(tables.hit.buffer().size(), "again");
      expect_freed(another, {"DispatchRays, command 0: HitGroupTable", "buffer \"hit table\"",
                             std::to_string(tables.hit.buffer().size()) + " bytes"});
      messages_.clear();
    }
  }
}

TEST_P(Lifetimes, FreedRootViewsAreNamed) {
  const Tables tables = tables_of(pipeline_, "Trace", "Group");
  Buffer scene = scene_;
  scene_ = {};
  scene_ = scene;
  CommandList list = traced(tables);
  scene = scene_ = {};
  expect_freed(list, {"DispatchRays, command 0: root parameter 1", "buffer \"scene\""});
  // A null view refers to nothing: every ray misses.
  list = traced(tables);
  ASSERT_TRUE(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(out_)[16], 7u);
}

TEST_P(Lifetimes, FreedInputsAndResultsOfBuildsAreNamed) {
  Buffer vertices = CreateUploadBuffer(device_, std::vector<float>(9), "vertices").value();
  RaytracingGeometryDesc geometry;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = 3;
  geometry.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), 12};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  Buffer dest = device_
                    .CreateBuffer({.SizeInBytes = 65536,
                                   .Flags = ResourceFlags::kAllowUnorderedAccess,
                                   .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                                   .Name = "dest"})
                    .value();
  Buffer scratch = zeros(65536, "scratch");
  const auto recorded = [&] {
    CommandList list = device_.CreateCommandList().value();
    list.BeginEvent("builds");
    list.BuildRaytracingAccelerationStructure(
        {.DestAccelerationStructureData = dest.GetGPUVirtualAddress(),
         .Inputs = inputs,
         .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
    list.EndEvent();
    EXPECT_TRUE(list.Close());
    return list;
  };
  CommandList list = recorded();
  EXPECT_TRUE(queue_.ExecuteCommandLists({list}));
  scratch = zeros(65536, "scratch");
  expect_freed(list, {"BuildRaytracingAccelerationStructure, command 1: scratch", "\"scratch\""});
  list = recorded();
  vertices = {};
  expect_freed(list, {"command 1: geometry 0 vertices", "buffer \"vertices\" of 36 bytes"});
  // Counts of 0 need no memory.
  geometry.Triangles.VertexCount = 0;
  geometry.Triangles.VertexBuffer.StartAddress = 0;
  list = recorded();
  EXPECT_TRUE(queue_.ExecuteCommandLists({list}));
  list = recorded();
  dest = {};
  expect_freed(list, {"command 1: dest", "buffer \"dest\""});
}

// None of the lists runs if one cannot.
TEST_P(Lifetimes, NothingIsSubmittedWithAFreedTable) {
  const Tables tables = tables_of(pipeline_, "Trace", "Group");
  const CommandList good = traced(tables);
  CommandList bad;
  {
    const Tables short_lived = tables_of(pipeline_, "Trace", "Group");
    bad = traced(short_lived);
  }
  EXPECT_FALSE(queue_.ExecuteCommandLists({good, bad}));
  EXPECT_EQ(read(out_)[16], 0u);
  EXPECT_TRUE(queue_.ExecuteCommandLists({good}));
  EXPECT_EQ(read(out_)[16], 220u);
}

// Freed between the call and the execution: there is nobody to return an error to.
TEST_P(Lifetimes, MemoryFreedWhileAQueueWaitsRemovesTheDevice) {
  const Fence fence = device_.CreateFence(0).value();
  auto tables = std::make_unique<Tables>(tables_of(pipeline_, "Trace", "Group"));
  const CommandList list = traced(*tables);
  ASSERT_TRUE(queue_.Wait(fence, 1));
  ASSERT_TRUE(queue_.ExecuteCommandLists({list}));
  tables.reset();
  Fence(fence).Signal(1).value();
  const Status reason = device_.GetDeviceRemovedReason();
  ASSERT_FALSE(reason);
  EXPECT_EQ(reason.error().id.text(), "KA0856");
  EXPECT_THAT(reason.error().message, HasSubstr("\"ray generation table\""));
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Id.text(), "KA0856");
}

// A list keeps alive what it was given as a handle.
TEST_P(Lifetimes, ResourcesGivenByHandleLiveAsLongAsTheList) {
  Buffer source = CreateUploadBuffer(device_, std::vector<uint32_t>{5, 6, 7, 8}, "source").value();
  CommandList list = device_.CreateCommandList().value();
  list.CopyBufferRegion(out_, 0, source, 0, 16);
  ASSERT_TRUE(list.Close());
  source = {};
  const Buffer other = CreateUploadBuffer(device_, std::vector<uint32_t>(4), "other").value();
  ASSERT_TRUE(queue_.ExecuteAndWait(list));
  const auto words = read(out_);
  EXPECT_EQ((std::vector<uint32_t>{words.begin(), words.begin() + 4}),
            (std::vector<uint32_t>{5, 6, 7, 8}));
}

// [DXR: AddToStateObject]
TEST_P(Lifetimes, IdentifiersOfAParentLiveAsLongAsWhatWasMadeFromIt) {
  StateObject object = pipeline_;
  pipeline_ = {};
  std::vector<const ShaderIdentifier*> pointers;
  std::vector<ShaderIdentifier> bytes;
  for (const char* name : {"Trace", "Miss", "Group"}) {
    pointers.push_back(object.GetShaderIdentifier(name));
    bytes.push_back(*pointers.back());
  }
  // Two generations; the parents end at once.
  for (const char* name : {"Query", "Another"}) {
    StateObjectDesc addition;
    addition.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
    addition.Add(DxilLibraryDesc{LoadShaderLibrary(kaamos_shaders_rays()).value(),
                                 {{.Name = name, .ExportToRename = "Query"}}});
    addition.Add(RaytracingShaderConfig{4, 12});
    addition.Add(RaytracingPipelineConfig{1});
    addition.Add(GlobalRootSignature{root_});
    object = device_.AddToStateObject(addition, object).value();
  }
  for (size_t i = 0; i < pointers.size(); ++i) EXPECT_EQ(*pointers[i], bytes[i]);
  // They are those of the new object, and a table of them runs.
  EXPECT_EQ(*object.GetShaderIdentifier("Group"), bytes[2]);
  std::vector<ShaderIdentifier> records(6);  // 64 bytes each
  for (size_t i = 0; i < 3; ++i) records[2 * i] = *pointers[i];
  const Buffer table = CreateUploadBuffer(device_, records, "table").value();
  const GpuVirtualAddress at = table.GetGPUVirtualAddress();
  DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = {at, 32};
  desc.MissShaderTable = {at + 64, 32, 32};
  desc.HitGroupTable = {at + 128, 32, 32};
  desc.Width = 1;
  CommandList list = device_.CreateCommandList().value();
  bind(list);
  list.SetPipelineState1(object);
  list.DispatchRays(desc);
  ASSERT_TRUE(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(out_)[16], 220u);
}

}  // namespace
