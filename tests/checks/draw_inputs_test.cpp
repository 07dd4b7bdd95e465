// SPDX-License-Identifier: MIT
//
// Tests the checks of what draws read: vertices, indices, root arguments, indirect arguments.
#include <cstring>

#include "tests/checks/draw_world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;

class DrawInputs : public DrawWorld {
 protected:
  // Corners of the whole target, front facing, at depth 0.5; 16 bytes each.
  std::vector<float> corners() const { return {-1, 1, 0.5f, 1, 3, 1, 0.5f, 1, -1, -3, 0.5f, 1}; }
  GraphicsPipelineStateDesc from_buffer() const { return desc("Constant", "FromBuffer"); }
  // Draws `count` vertices of the buffer.
  void draw_vertices(CommandList& list, const VertexBufferView& view, uint32_t count,
                     uint32_t first = 0) {
    list.IASetVertexBuffers(1, view);
    list.SetPipelineState(make(from_buffer()));
    list.DrawInstanced(count, 1, first, 0);
  }
  void draw_indexed(CommandList& list, const std::vector<uint32_t>& values, int32_t base = 0,
                    uint32_t count = 3) {
    list.IASetVertexBuffers(1, vertices(upload(corners(), "corners"), 16));
    const IndexBufferView view = indices(upload(values, "indices"), Format::kR32Uint);
    list.IASetIndexBuffer(&view);
    list.SetPipelineState(make(from_buffer()));
    list.DrawIndexedInstanced(count, 1, 0, base, 0);
  }
};

TEST_F(DrawInputs, Clean) {
  CommandList list = begin();
  draw_vertices(list, vertices(upload(corners(), "corners"), 16), 3);
  run(list);
  expect_none();
  CommandList indexed = begin();
  draw_indexed(indexed, {7, 8, 9}, -7);
  run(indexed);
  expect_none();
}

TEST_F(DrawInputs, VerticesBeyondTheBuffer) {
  CommandList list = begin();
  draw_vertices(list, vertices(upload(corners(), "corners"), 16), 5, 1);
  run(list);
  expect_one("KA0448", {"draw 0, pipeline \"plain\": vertex 3 ends at byte 64 of slot 1",
                        "buffer \"corners\" (48 bytes), stride 16: room for 3",
                        "3 of 5 are outside and read 0"});
}

TEST_F(DrawInputs, IndicesOfVerticesBeyondTheBuffer) {
  CommandList list = begin();
  draw_indexed(list, {0, 1, 2, 0, 1, 70112}, 0, 6);
  run(list);
  expect_one("KA0448", {"index 70112 (number 5 of the buffer) is vertex 70112, which ends at byte "
                        "1121808 of slot 1",
                        "room for 3", "1 of 6 are outside"});
  CommandList based = begin();
  draw_indexed(based, {0, 1, 2}, 1);
  run(based);
  expect_one("KA0448", {"index 2 (number 2 of the buffer) + BaseVertexLocation 1 is vertex 3"});
}

TEST_F(DrawInputs, InstanceDataBeyondTheBuffer) {
  GraphicsPipelineStateDesc instanced = desc("Constant", "PerInstance");
  instanced.InputLayout.push_back({.SemanticName = "SHIFT",
                                   .Format = Format::kR32G32B32A32Float,
                                   .InputSlot = 2,
                                   .InputSlotClass = InputClassification::kPerInstanceData,
                                   .InstanceDataStepRate = 2});
  const auto draw_instances = [&](uint32_t count) {
    CommandList list = begin();
    list.IASetVertexBuffers(1, vertices(upload(corners(), "corners"), 16));
    list.IASetVertexBuffers(2, vertices(upload(std::vector<float>(8, 0.0f), "shifts"), 16));
    list.SetPipelineState(make(instanced));
    list.DrawInstanced(3, count, 0, 0);
    run(list);
  };
  draw_instances(4);
  expect_none();
  draw_instances(5);
  expect_one("KA0448", {"element 2 of instance data ends at byte 48 of slot 2",
                        "buffer \"shifts\" (32 bytes)", "1 of 3 are outside"});
}

TEST_F(DrawInputs, IndicesBeyondTheBuffer) {
  CommandList list = begin();
  draw_indexed(list, {0, 1, 2}, 0, 6);
  run(list);
  expect_one("KA0449", {"indices 0..6 are used, but the view has 3", "buffer \"indices\""});
}

TEST_F(DrawInputs, NoIndexBuffer) {
  CommandList list = begin();
  list.IASetVertexBuffers(1, vertices(upload(corners(), "corners"), 16));
  list.SetPipelineState(make(from_buffer()));
  list.DrawIndexedInstanced(3, 1, 0, 0, 0);
  run(list);
  const std::vector<std::string> all = told();
  ASSERT_EQ(all.size(), 2u) << ::testing::PrintToString(all);
  EXPECT_NE(all[0].find("KA0449"), std::string::npos) << all[0];
  EXPECT_NE(all[0].find("no index buffer is set, so that all 3 indices are 0"), std::string::npos);
  EXPECT_NE(all[1].find("KA0458"), std::string::npos) << all[1];  // one point
}

TEST_F(DrawInputs, NoVertexBuffer) {
  CommandList list = begin();
  list.IASetVertexBuffers(0, vertices(upload(corners(), "corners"), 16));  // slot 1 is read
  list.SetPipelineState(make(from_buffer()));
  list.DrawInstanced(3, 1, 0, 0);
  run(list);
  const std::vector<std::string> all = told();
  ASSERT_FALSE(all.empty());
  EXPECT_NE(all[0].find("KA0453"), std::string::npos) << all[0];
  EXPECT_NE(all[0].find("reads slot 1, which has no vertex buffer"), std::string::npos) << all[0];
}

TEST_F(DrawInputs, MisalignedVertices) {
  const Buffer buffer = upload(std::vector<float>(16, 0.5f), "corners");
  CommandList list = begin();
  list.IASetVertexBuffers(1, VertexBufferView{buffer.GetGPUVirtualAddress() + 2, 60, 16});
  list.SetPipelineState(make(from_buffer()));
  list.DrawInstanced(3, 1, 0, 0);
  run(list);
  const std::vector<std::string> all = told();
  ASSERT_FALSE(all.empty());
  EXPECT_NE(all[0].find("KA0454"), std::string::npos) << all[0];
  EXPECT_NE(all[0].find("components of 4 bytes"), std::string::npos) << all[0];
}

TEST_F(DrawInputs, StrideOfZero) {
  CommandList list = begin();
  draw_vertices(list, vertices(upload(corners(), "corners"), 0), 3);
  run(list);
  const std::vector<std::string> all = told();
  ASSERT_EQ(all.size(), 2u) << ::testing::PrintToString(all);
  EXPECT_NE(all[0].find("KA0491"), std::string::npos) << all[0];
  EXPECT_NE(all[1].find("KA0458"), std::string::npos) << all[1];
  EXPECT_NE(all[0].find("every vertex reads the first element"), std::string::npos) << all[0];
}

TEST_F(DrawInputs, StripCutsThatDoNotFit) {
  const auto draw_cut = [&](IndexBufferStripCutValue cut, PrimitiveTopology topology) {
    CommandList list = begin();
    list.IASetPrimitiveTopology(topology);
    list.IASetVertexBuffers(1, vertices(upload(corners(), "corners"), 16));
    const IndexBufferView view =
        indices(upload(std::vector<uint16_t>{0, 1, 2}, "indices"), Format::kR16Uint);
    list.IASetIndexBuffer(&view);
    GraphicsPipelineStateDesc cuts = from_buffer();
    cuts.IBStripCutValue = cut;
    list.SetPipelineState(make(cuts));
    list.DrawIndexedInstanced(3, 1, 0, 0, 0);
    run(list);
  };
  draw_cut(IndexBufferStripCutValue::k0xFFFF, PrimitiveTopology::kTriangleStrip);
  expect_none();
  draw_cut(IndexBufferStripCutValue::k0xFFFFFFFF, PrimitiveTopology::kTriangleStrip);
  expect_one("KA0455", {"IBStripCutValue is k0xFFFFFFFF, but indices are R16_UINT"});
  draw_cut(IndexBufferStripCutValue::k0xFFFF, PrimitiveTopology::kTriangleList);
  expect_one("KA0455", {"the topology is a list"});
}

TEST_F(DrawInputs, BuffersInAnotherState) {
  const Buffer buffer =
      device_
          .CreateBuffer(
              {.SizeInBytes = 48, .InitialState = ResourceStates::kCopyDest, .Name = "copied"})
          .value();
  const auto draw_copied = [&](bool barrier) {
    CommandList list = begin();
    list.CopyBufferRegion(buffer, 0, upload(corners(), "corners"), 0, 48);
    if (barrier) {
      list.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kCopyDest,
                                                       ResourceStates::kVertexAndConstantBuffer));
    }
    draw_vertices(list, vertices(buffer, 16), 3);
    run(list);
  };
  draw_copied(true);
  expect_none();
  draw_copied(false);
  expect_one("KA0451", {"the vertex buffer of slot 1 is in buffer \"copied\"", "kCopyDest",
                        "kVertexAndConstantBuffer"});
}

TEST_F(DrawInputs, RootArgumentsThatAreNotSet) {
  CommandList list = begin();
  const RootSignature other =
      device_
          .CreateRootSignature(
              "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), UAV(u0), DescriptorTable(SRV(t0)), "
              "RootConstants(num32BitConstants=4, b0)")
          .value();
  GraphicsPipelineStateDesc stores = desc("Counts");
  stores.pRootSignature = other;
  list.SetGraphicsRootSignature(other);
  const float tint[4] = {1, 0, 0, 0.5f};
  list.SetGraphicsRoot32BitConstants(2, 4, tint, 0);
  draw(list, stores);
  list.SetGraphicsRootUnorderedAccessView(0, stored_.GetGPUVirtualAddress());
  draw(list, stores);
  run(list);
  std::vector<std::string> all = told();
  std::erase_if(all, [](const std::string& text) { return text.find("KA0483") == text.npos; });
  ASSERT_EQ(all.size(), 1u) << ::testing::PrintToString(all);
  EXPECT_NE(all[0].find("draw 0, pipeline \"plain\": root parameter 0, from which pixel shader "
                        "\"Counts\" reads u0 \"stored\", is not set; it was set before "
                        "SetGraphicsRootSignature set another signature"),
            std::string::npos)
      << all[0];
}

TEST_F(DrawInputs, UploadBufferOverwrittenTooEarly) {
  const Buffer corners_buffer = upload(corners(), "corners");
  const auto submit = [&](bool overwrites) {
    CommandList list = begin();
    draw_vertices(list, vertices(corners_buffer, 16), 3);
    list.Close().value();
    Fence fence = device_.CreateFence().value();
    queue_.Wait(fence, 1).value();
    queue_.ExecuteCommandLists({list}).value();
    const float nearer = 0.25f;
    if (overwrites) std::memcpy(corners_buffer.Map().value().data() + 8, &nearer, sizeof nearer);
    fence.Signal(1).value();
    ASSERT_EQ(fence.GetCompletedValue(), 1u);
  };
  submit(false);
  expect_none();
  submit(true);
  expect_one("KA0488", {"draw 0, pipeline \"plain\": the vertex buffer of slot 1 is bytes 0..48 of "
                        "buffer \"corners\"",
                        "changed after ExecuteCommandLists and before the draw ran"});
}

class DrawIndirect : public DrawWorld {
 protected:
  void run_indirect(const std::vector<DrawArguments>& arguments, uint32_t count, uint32_t most,
                    bool shows = true) {
    IndirectArgumentDesc argument;
    argument.Type = IndirectArgumentType::kDraw;
    const CommandSignature signature =
        device_.CreateCommandSignature({sizeof(DrawArguments), {argument}}, RootSignature())
            .value();
    CommandList list = begin();
    if (!shows) list.RSSetScissorRects(Rect{0, 0, 0, 0});
    list.SetPipelineState(make(desc()));
    list.ExecuteIndirect(signature, most, upload(arguments, "arguments"), 0,
                         upload(std::vector<uint32_t>{count}, "count"), 0);
    run(list);
  }
};

TEST_F(DrawIndirect, CountAboveTheMaximum) {
  run_indirect({{3, 1, 0, 0}, {3, 1, 0, 0}}, 1, 2);
  expect_none();
  run_indirect({{3, 1, 0, 0}, {3, 1, 0, 0}}, 9, 1);
  expect_one("KA0485", {"the count buffer says 9, but MaxCommandCount is 1"});
}

TEST_F(DrawIndirect, AbsurdArguments) {
  run_indirect({{0x80000000u, 1, 0, 0}}, 1, 1, false);
  std::vector<std::string> all = told();
  std::erase_if(all, [](const std::string& text) { return text.find("KA0486") == text.npos; });
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].find("command 0 draws 2147483648 vertices and 1 instance"), std::string::npos)
      << all[0];
}

}  // namespace
}  // namespace kaamos::checks::test
