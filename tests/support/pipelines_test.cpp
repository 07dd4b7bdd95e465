// SPDX-License-Identifier: MIT
#include "tests/support/harness.h"

namespace {

using namespace rtapi;
using namespace kaamos::support;

const std::vector<uint32_t> kTwoHits = {104, 114, 7, 7, 7, 7, 7, 7};

KAAMOS_CALLS(Pipelines);

TEST_P(Pipelines, CreateStateObject) {
  const auto pipeline = device_.CreateStateObject(describe({}));
  KAAMOS_SUPPORTED(pipeline);
  EXPECT_NE(pipeline->GetShaderIdentifier("Group"), nullptr);
}

TEST_P(Pipelines, Collections) {
  Rays rays;
  StateObjectDesc part = describe(rays);
  part.Type = StateObjectType::kCollection;
  const auto collection = device_.CreateStateObject(part);
  KAAMOS_SUPPORTED(collection);
  StateObjectDesc whole;
  whole.Add(ExistingCollectionDesc::Of(*collection));
  whole.Add(RaytracingShaderConfig{8, 8});
  whole.Add(RaytracingPipelineConfig{1});
  const auto pipeline = device_.CreateStateObject(whole);
  KAAMOS_SUPPORTED(pipeline);
  EXPECT_EQ(trace(rays, *pipeline, top_level(bottom_level(2).value()).value()), kTwoHits);
}

TEST_P(Pipelines, AddToStateObject) {
  Rays rays;
  StateObjectDesc first = describe(rays);
  first.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
  const auto parent = device_.CreateStateObject(first);
  KAAMOS_SUPPORTED(parent);
  StateObjectDesc addition;
  addition.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
  addition.Add(DxilLibraryDesc{library(), {{"HitAgain"}}});
  HitGroupDesc group;
  group.HitGroupExport = "Another";
  group.ClosestHitShaderImport = "HitAgain";
  addition.Add(group);
  addition.Add(RaytracingShaderConfig{8, 8});
  addition.Add(RaytracingPipelineConfig{1});
  addition.Add(GlobalRootSignature{root_});
  const auto grown = device_.AddToStateObject(addition, *parent);
  KAAMOS_SUPPORTED(grown);
  EXPECT_NE(grown->GetShaderIdentifier("Another"), nullptr);
  EXPECT_EQ(trace(rays, *grown, top_level(bottom_level(2).value()).value()), kTwoHits);
}

TEST_P(Pipelines, LocalRootSignature) {
  Rays rays;
  rays.closest_hit = "HitWithRecord";
  rays.local_arguments = true;
  EXPECT_EQ(trace(rays, top_level(bottom_level(2).value()).value()),
            (std::vector<uint32_t>{1050, 1051, 7, 7, 7, 7, 7, 7}));
}

TEST_P(Pipelines, CreateComputePipelineState) {
  KAAMOS_SUPPORTED(device_.CreateComputePipelineState({root_, library(), "Atomically", ""}));
  EXPECT_EQ(compute("Atomically")[0], 28u);
}

TEST_P(Pipelines, SetPipelineStackSize) {
  StateObject pipeline = device_.CreateStateObject(describe({})).value();
  pipeline.SetPipelineStackSize(4096);
  EXPECT_EQ(pipeline.GetPipelineStackSize(), 4096u);
}

KAAMOS_CALLS(Commands);

TEST_P(Commands, DispatchRays) {
  Rays rays;
  rays.ray_generation = "WriteIndex";
  EXPECT_EQ(trace(rays, top_level(bottom_level(1).value()).value()), numbers(0));
}

TEST_P(Commands, Dispatch) {
  EXPECT_EQ(compute("ThroughGroupMemory"), numbers(7, ~0u));
}

TEST_P(Commands, ExecuteIndirect) {
  CommandSignatureDesc desc;
  desc.ByteStride = sizeof(DispatchArguments);
  desc.ArgumentDescs = {{.Type = IndirectArgumentType::kDispatch}};
  const auto signature = device_.CreateCommandSignature(desc);
  KAAMOS_SUPPORTED(signature);
  CommandList list = device_.CreateCommandList().value();
  bind(list);
  list.SetPipelineState(
      device_.CreateComputePipelineState({root_, library(), "Atomically", ""}).value());
  list.ExecuteIndirect(*signature, 2, upload({3, 1, 1, 1, 2, 1}), 0);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(out_)[0], 276u + 2 * 28u);  // threads 0..23, and 0..7 twice
}

TEST_P(Commands, RootConstants) {
  EXPECT_EQ(compute("FromRootConstants"), numbers(2, 3));
}

TEST_P(Commands, RootDescriptors) {
  EXPECT_EQ(compute("FromRootBuffer"), numbers(51));
}

TEST_P(Commands, ResourceBarrier) {
  CommandList list = device_.CreateCommandList().value();
  const Buffer words = buffer(32);
  list.ResourceBarrier(ResourceBarrier::Transition(words, ResourceStates::kUnorderedAccess,
                                                   ResourceStates::kCopyDest));
  list.CopyBufferRegion(words, 0, upload(numbers(1)), 0, 32);
  list.ResourceBarrier(ResourceBarrier::Uav());
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(words), numbers(1));
}

TEST_P(Commands, Events) {
  CommandList list = device_.CreateCommandList().value();
  list.BeginEvent("a part");
  list.EndEvent();
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
}

TEST_P(Commands, Fences) {
  const Fence fence = device_.CreateFence().value();
  KAAMOS_SUPPORTED(queue_.Signal(fence, 5));
  KAAMOS_SUPPORTED(fence.Wait(5));
  EXPECT_EQ(fence.GetCompletedValue(), 5u);
}

TEST_P(Commands, GetStatistics) {
  DeviceDesc desc;
  desc.Backend = GetParam();
  desc.CollectStatistics = true;
  open(desc);
  trace({}, top_level(bottom_level(2).value()).value());
  if (device_.GetStatistics().TraceRayCalls == 0)
    GTEST_SKIP() << "not supported: it counts nothing";
  EXPECT_EQ(device_.GetStatistics().TraceRayCalls, kCount);
  EXPECT_EQ(device_.GetStatistics().Hits, 2u);
}

KAAMOS_CALLS(Stages);

TEST_P(Stages, ClosestHitAndMiss) {
  EXPECT_EQ(trace({}, top_level(bottom_level(2).value()).value()), kTwoHits);
}

TEST_P(Stages, AnyHit) {
  Rays rays;
  rays.any_hit = "IgnoreOdd";
  EXPECT_EQ(trace(rays, top_level(bottom_level(3).value()).value()),
            (std::vector<uint32_t>{104, 7, 124, 7, 7, 7, 7, 7}));
}

TEST_P(Stages, Intersection) {
  Rays rays;
  rays.intersection = "Box";
  rays.closest_hit = "HitBox";
  EXPECT_EQ(trace(rays, top_level(bottom_level(3, true).value()).value()),
            (std::vector<uint32_t>{203, 204, 205, 7, 7, 7, 7, 7}));
}

TEST_P(Stages, Callable) {
  Rays rays;
  rays.ray_generation = "CallTwo";
  rays.callables = {"AddOne", "Double"};
  EXPECT_EQ(trace(rays, top_level(bottom_level(1).value()).value()),
            (std::vector<uint32_t>{1, 2, 3, 6, 5, 10, 7, 14}));
}

TEST_P(Stages, Recursion) {
  Rays rays;
  rays.closest_hit = "HitAgain";
  rays.recursion = 4;
  EXPECT_EQ(trace(rays, top_level(bottom_level(1).value()).value()),
            (std::vector<uint32_t>{4, 7, 7, 7, 7, 7, 7, 7}));
}

}  // namespace
