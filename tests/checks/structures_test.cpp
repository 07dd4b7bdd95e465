// SPDX-License-Identifier: MIT
//
// Acceleration structures: their lifetime, what builds read, barriers and states.
#include <cmath>
#include <limits>

#include "tests/checks/world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;
using BuildFlags = RaytracingAccelerationStructureBuildFlags;

class Structure : public World {
 protected:
  void SetUp() override {
    World::SetUp();
    if (IsSkipped()) return;
    build_scene();
    set_ = make_tables(pipeline_);
  }
  TableSet set_;
};

TEST_P(Structure, BuildTraceUpdateTraceWithBarriersIsSilent) {
  const auto descs = triangles();
  const auto inputs = bottom_inputs(descs, BuildFlags::kAllowUpdate);
  auto again = inputs;
  again.Flags = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
  bottom_ = structure_for(inputs, "floor");
  const auto instances = top_inputs({instance(bottom_)});
  top_ = structure_for(instances, "scene");
  CommandList commands = list();
  record_build(commands, bottom_, inputs);
  commands.ResourceBarrier(ResourceBarrier::Uav(bottom_));
  record_build(commands, top_, instances);
  commands.ResourceBarrier(ResourceBarrier::Uav(top_));
  record_dispatch(commands, set_.desc);
  commands.ResourceBarrier(ResourceBarrier::Uav());
  record_build(commands, bottom_, again, bottom_.GetGPUVirtualAddress());
  commands.ResourceBarrier(ResourceBarrier::Uav());
  record_build(commands, top_, instances);
  commands.ResourceBarrier(ResourceBarrier::Uav());
  record_dispatch(commands, set_.desc);
  ASSERT_TRUE(execute(commands).ok());
  expect_none();
}

// [AS-23]
TEST_P(Structure, PlacedOverAnotherResource) {
  const Heap heap = CreateHeap(device_, {.SizeInBytes = 262144, .Name = "frame"}).value();
  const auto place = [&](uint64_t offset, const char* name, bool structures) {
    BufferDesc desc{
        .SizeInBytes = 131072, .Flags = ResourceFlags::kAllowUnorderedAccess, .Name = name};
    if (structures) desc.InitialState = ResourceStates::kRaytracingAccelerationStructure;
    return CreatePlacedResource(heap, offset, desc).value();
  };
  const Buffer scene = place(0, "scene", true);
  const Buffer also = place(65536, "other scene", true);
  expect_none();
  { const Buffer beside = place(131072, "particles", false); }
  expect_one("KA0492", {"buffer \"other scene\", which is for acceleration structures, lies at "
                        "bytes 65536..196608",
                        "buffer \"particles\" at 131072..262144"});
}

TEST_P(Structure, MissingBarrierBetweenBuilds) {
  const auto descs = triangles();
  const auto inputs = bottom_inputs(descs);
  bottom_ = structure_for(inputs, "floor");
  const auto instances = top_inputs({instance(bottom_)});
  CommandList commands = list();
  record_build(commands, bottom_, inputs);
  record_build(commands, top_, instances);
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0450", {"a bottom level of the top level's build at byte 0 of buffer \"floor\"",
                        "is written by BuildRaytracingAccelerationStructure, command 0",
                        "Record ResourceBarrier::Uav for \"floor\"",
                        "(BuildRaytracingAccelerationStructure, command 1)"});
}

TEST_P(Structure, MissingBarrierBeforeTheDispatch) {
  const auto instances = top_inputs({instance(bottom_)});
  CommandList commands = list();
  record_build(commands, top_, instances);
  record_dispatch(commands, set_.desc);
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0450", {"ray generation shader \"RayGen\", t0 \"scene\" at byte 0 of buffer "
                        "\"scene\"",
                        "is written by BuildRaytracingAccelerationStructure, command 0"});
}

TEST_P(Structure, ScratchUsedTwiceWithoutABarrier) {
  const auto descs = triangles();
  const auto inputs = bottom_inputs(descs);
  const Buffer a = structure_for(inputs, "a");
  const Buffer b = structure_for(inputs, "b");
  const Buffer scratch = buffer(65536, "shared scratch");
  CommandList commands = list();
  for (const Buffer& dest : {a, b}) {
    commands.BuildRaytracingAccelerationStructure(
        {.DestAccelerationStructureData = dest.GetGPUVirtualAddress(),
         .Inputs = inputs,
         .ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress()});
  }
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0450", {"the scratch memory at byte 0 of buffer \"shared scratch\"",
                        "is scratch "
                        "memory of BuildRaytracingAccelerationStructure, command 0"});
}

TEST_P(Structure, InputThatIsStillACopyDestination) {
  auto descs = triangles();
  const Buffer moved = buffer(36, "moved.vb");
  descs[0].Triangles.VertexBuffer.StartAddress = moved.GetGPUVirtualAddress();
  const auto inputs = bottom_inputs(descs);
  CommandList commands = list();
  commands.CopyBufferRegion(moved, 0, vertices_, 0, 36);
  record_build(commands, structure_for(inputs, "floor"), inputs);
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0451",
             {"the build's vertex buffer is in buffer \"moved.vb\" (36 bytes), which is in state "
              "kCopyDest since CopyBufferRegion, command 0; it must be in state "
              "kNonPixelShaderResource"});
  CommandList right = list();
  right.CopyBufferRegion(moved, 0, vertices_, 0, 36);
  right.ResourceBarrier(ResourceBarrier::Transition(moved, ResourceStates::kCopyDest,
                                                    ResourceStates::kNonPixelShaderResource));
  record_build(right, structure_for(inputs, "floor"), inputs);
  ASSERT_TRUE(execute(right).ok());
  expect_none();
}

TEST_P(Structure, TransitionFromAnotherState) {
  const Buffer b = buffer(64, "work");
  CommandList commands = list();
  commands.ResourceBarrier(ResourceBarrier::Transition(b, ResourceStates::kUnorderedAccess,
                                                       ResourceStates::kCopySource));
  commands.ResourceBarrier(
      ResourceBarrier::Transition(b, ResourceStates::kUnorderedAccess, ResourceStates::kCopyDest));
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0452", {"StateBefore of buffer \"work\" (64 bytes) is kUnorderedAccess, but it is "
                        "in state kCopySource since ResourceBarrier, command 0"});
}

TEST_P(Structure, StaleTopLevel) {
  const auto descs = triangles();
  CommandList commands = list();
  record_build(commands, bottom_, bottom_inputs(descs));
  ASSERT_TRUE(execute(commands).ok());
  dispatch(set_.desc);
  expect_one("KA0463", {"ray generation shader \"RayGen\", t0 \"scene\" uses byte 0 of buffer "
                        "\"scene\"",
                        "whose instance 0 refers to the bottom level at byte 0 of "
                        "buffer \"floor\"",
                        "was built or updated after the top level"});
}

TEST_P(Structure, OverwrittenBottomLevel) {
  copy_bytes(bottom_, upload(std::vector<uint32_t>(64), "zeros"));
  dispatch(set_.desc);
  expect_one("KA0461", {"whose instance 0 refers to the bottom level at byte 0 of buffer "
                        "\"floor\"",
                        "was there, but its bytes have been overwritten"});
}

TEST_P(Structure, AnotherOneBuiltOverABottomLevel) {
  const auto descs = triangles();
  const auto inputs = bottom_inputs(descs);
  const auto sizes = device_.GetRaytracingAccelerationStructurePrebuildInfo(inputs).value();
  const Buffer both = buffer(sizes.ResultDataMaxSizeInBytes + 256, "both", true);
  CommandList commands = list();
  record_build(commands, both, inputs);
  ASSERT_TRUE(execute(commands).ok());
  top_ = build(top_inputs({instance(both)}), "scene");
  CommandList over = list();
  over.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = both.GetGPUVirtualAddress() + 256,
       .Inputs = inputs,
       .ScratchAccelerationStructureData = buffer(65536, "scratch").GetGPUVirtualAddress()});
  ASSERT_TRUE(execute(over).ok());
  dispatch(set_.desc);
  expect_one("KA0461",
             {"was there, but another one has been built or copied over it, at byte 256 of "
              "buffer \"both\""});
}

TEST_P(Structure, FreedBottomLevel) {
  std::erase(keep_, bottom_);
  bottom_ = {};
  dispatch(set_.desc);
  expect_one("KA0462", {"instance 0", "was there, but its buffer has been freed"});
}

TEST_P(Structure, NothingThereToTrace) {
  top_ = buffer(1024, "empty", true);
  dispatch(set_.desc);
  expect_one("KA0460",
             {"uses byte 0 of buffer \"empty\" (1024 bytes): an acceleration structure was "
              "never built there. Every ray misses"});
}

TEST_P(Structure, BottomLevelPassedToTraceRay) {
  top_ = bottom_;
  dispatch(set_.desc);
  expect_one("KA0464", {"which is a bottom level, but rays are traced against top levels"});
}

TEST_P(Structure, BytesCopiedStructure) {
  const Buffer copy = buffer(top_.size(), "copy", true);
  copy_bytes(copy, top_);
  top_ = copy;
  dispatch(set_.desc);
  expect_one("KA0465", {"was copied there as bytes from the one at byte 0 of buffer \"scene\"",
                        "use CopyRaytracingAccelerationStructure"});
}

TEST_P(Structure, UpdateWithOtherIndices) {
  auto descs = triangles();
  Buffer indices = upload(std::vector<uint32_t>{0, 1, 2}, "floor.ib");
  descs[0].Triangles.IndexFormat = Format::kR32Uint;
  descs[0].Triangles.IndexCount = 3;
  descs[0].Triangles.IndexBuffer = indices.GetGPUVirtualAddress();
  auto inputs = bottom_inputs(descs, BuildFlags::kAllowUpdate);
  const Buffer level = build(inputs, "floor");
  expect_none();
  indices.data<uint32_t>()[0] = 1;
  inputs.Flags = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
  CommandList commands = list();
  record_build(commands, level, inputs, level.GetGPUVirtualAddress());
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0470", {"geometry 0 of the update of byte 0 of buffer \"floor\"",
                        "has different indices from its build"});
}

TEST_P(Structure, ScratchInTheDestination) {
  const auto descs = triangles();
  const auto inputs = bottom_inputs(descs);
  const Buffer dest = structure_for(inputs, "floor");
  CommandList commands = list();
  commands.BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = dest.GetGPUVirtualAddress(),
       .Inputs = inputs,
       .ScratchAccelerationStructureData = dest.GetGPUVirtualAddress()});
  ASSERT_TRUE(execute(commands).ok());
  expect_one("KA0471", {"scratch (bytes 0..", "overlaps the destination"});
}

TEST_P(Structure, IndexPastTheVertices) {
  auto descs = triangles();
  const Buffer indices = upload(std::vector<uint32_t>{0, 1, 2, 0, 7, 2}, "floor.ib");
  descs[0].Triangles.IndexFormat = Format::kR32Uint;
  descs[0].Triangles.IndexCount = 6;
  descs[0].Triangles.IndexBuffer = indices.GetGPUVirtualAddress();
  build(bottom_inputs(descs), "floor");
  expect_one("KA0472", {"geometry 0 of the bottom level at byte 0 of buffer \"floor\"",
                        "index 7 of triangle 1 (element 4 of the indices at byte 0 of buffer "
                        "\"floor.ib\" (24 bytes)), but VertexCount is 3"});
}

TEST_P(Structure, NotANumberInY) {
  const auto descs = triangles();
  vertices_.data<float>()[4] = std::numeric_limits<float>::quiet_NaN();
  build(bottom_inputs(descs), "floor");
  expect_one("KA0473", {"vertex 1 (byte 0 of buffer \"floor.vb\" (36 bytes) + 1 * 12) has NaN in Y "
                        "or Z but a number in X"});
  vertices_.data<float>()[3] = std::numeric_limits<float>::quiet_NaN();
  build(bottom_inputs(descs), "floor");
  expect_none();  // NaN in X: inactive
}

TEST_P(Structure, InstanceFlagsAndStructures) {
  RaytracingInstanceDesc bad = instance(bottom_);
  bad.Flags = 12;
  build(top_inputs({bad}), "scene");
  expect_one("KA0474", {"instance 0 has both kForceOpaque and kForceNonOpaque"});
  build(top_inputs({instance(bottom_), instance(top_)}), "scene");
  expect_one("KA0476", {"instance 1 refers to byte 0 of buffer \"scene\"", "it is a top level"});
}

INSTANTIATE_TEST_SUITE_P(Embree, Structure, ::testing::Values("embree"));
INSTANTIATE_TEST_SUITE_P(Vulkan, Structure, ::testing::Values("vulkan"));

}  // namespace
}  // namespace kaamos::checks::test
