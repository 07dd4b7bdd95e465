// SPDX-License-Identifier: MIT
//
// Graphics pipelines, draws and clears, and timestamps: a row of kCount pixels.
#include "tests/support/harness.h"

namespace {

using namespace rtapi;
using namespace kaamos::support;

class Canvas : public Call {
 protected:
  void SetUp() override {
    Call::SetUp();
    if (!device_) return;
    signature_ =
        device_.CreateRootSignature("RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT)").value();
  }

  Result<Texture> target(Format format, ResourceFlags flags, ResourceStates state) {
    TextureDesc desc;
    desc.Width = kCount;
    desc.Height = 1;
    desc.Format = format;
    desc.Flags = flags;
    desc.InitialState = state;
    return device_.CreateTexture(desc);
  }
  // Makes both targets and their views.
  Status make_targets() {
    auto color =
        target(Format::kR32Uint, ResourceFlags::kAllowRenderTarget, ResourceStates::kRenderTarget);
    if (!color) return color.error();
    auto depth = target(Format::kR32Typeless, ResourceFlags::kAllowDepthStencil,
                        ResourceStates::kDepthWrite);
    if (!depth) return depth.error();
    color_ = *color;
    depth_ = *depth;
    DescriptorHeapDesc heap;
    heap.NumDescriptors = 1;
    heap.Type = DescriptorHeapType::kRtv;
    rtvs_ = device_.CreateDescriptorHeap(heap).value();
    heap.Type = DescriptorHeapType::kDsv;
    dsvs_ = device_.CreateDescriptorHeap(heap).value();
    rtv_ = rtvs_.GetCPUDescriptorHandle(0);
    dsv_ = dsvs_.GetCPUDescriptorHandle(0);
    if (auto s = device_.CreateRenderTargetView(color_, rtv_); !s) return s;
    return device_.CreateDepthStencilView(depth_, {.Format = Format::kD32Float}, dsv_);
  }
  Result<PipelineState> pipeline(const char* vertex_shader) {
    GraphicsPipelineStateDesc desc;
    desc.pRootSignature = signature_;
    desc.VS = {library(), vertex_shader};
    desc.PS = {library(), "PixelNumber"};
    desc.RTVFormats = {Format::kR32Uint};
    desc.DSVFormat = Format::kD32Float;
    if (std::string(vertex_shader) == "FromVertexBuffer") {
      desc.InputLayout = {{.SemanticName = "POSITION", .Format = Format::kR32G32Float}};
    }
    return device_.CreateGraphicsPipelineState(desc);
  }
  // Clears both targets, draws, and returns the row of colours.
  template <class F>
  std::vector<uint32_t> draw(const PipelineState& pipeline, F&& record) {
    CommandList list = device_.CreateCommandList().value();
    const float nines[4] = {9, 9, 9, 9};
    list.ClearRenderTargetView(rtv_, nines);
    list.ClearDepthStencilView(dsv_, ClearFlags::kDepth, 1, 0);
    list.SetPipelineState(pipeline);
    list.SetGraphicsRootSignature(signature_);
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
    list.RSSetViewports(Viewport{0, 0, kCount, 1, 0, 1});
    list.RSSetScissorRects(Rect{0, 0, kCount, 1});
    list.OMSetRenderTargets(1, &rtv_, false, &dsv_);
    record(list);
    queue_.ExecuteAndWait(list).value();
    return colors();
  }
  std::vector<uint32_t> colors() {
    const auto bytes = ReadbackTexture(device_, queue_, color_, 0).value();
    std::vector<uint32_t> out(kCount);
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }

  RootSignature signature_;
  Texture color_;
  Texture depth_;
  DescriptorHeap rtvs_;
  DescriptorHeap dsvs_;
  CpuDescriptorHandle rtv_;
  CpuDescriptorHandle dsv_;
};

class Draws : public Canvas {};
INSTANTIATE_TEST_SUITE_P(Backends, Draws, testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Draws, CreateGraphicsPipelineState) {
  KAAMOS_SUPPORTED(pipeline("CoverAll"));
}

TEST_P(Draws, CreateRenderTargetView) {
  KAAMOS_SUPPORTED(make_targets());
  RenderTargetViewDesc other;
  other.Format = Format::kR8G8B8A8Unorm;
  EXPECT_FALSE(device_.CreateRenderTargetView(color_, other, rtv_).ok());
}

TEST_P(Draws, CreateDepthStencilView) {
  KAAMOS_SUPPORTED(make_targets());
  KAAMOS_SUPPORTED(device_.CreateDepthStencilView(
      depth_, {.Format = Format::kD32Float, .Flags = DsvFlags::kReadOnlyDepth}, dsv_));
}

TEST_P(Draws, ClearRenderTargetView) {
  KAAMOS_SUPPORTED(make_targets());
  CommandList list = device_.CreateCommandList().value();
  const float five[4] = {5, 0, 0, 0};
  const float seven[4] = {7, 0, 0, 0};
  const Rect some = {2, 0, 4, 1};
  list.ClearRenderTargetView(rtv_, five);
  list.ClearRenderTargetView(rtv_, seven, {&some, 1});
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(colors(), (std::vector<uint32_t>{5, 5, 7, 7, 5, 5, 5, 5}));
}

TEST_P(Draws, ClearDepthStencilView) {
  KAAMOS_SUPPORTED(make_targets());
  CommandList list = device_.CreateCommandList().value();
  list.ClearDepthStencilView(dsv_, ClearFlags::kDepth, 0.25f, 0);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  const auto bytes = ReadbackTexture(device_, queue_, depth_, 0).value();
  float depth = 0;
  std::memcpy(&depth, bytes.data() + 7 * sizeof depth, sizeof depth);
  EXPECT_EQ(depth, 0.25f);
}

TEST_P(Draws, DrawInstanced) {
  KAAMOS_SUPPORTED(make_targets());
  const auto made = pipeline("CoverAll");
  KAAMOS_SUPPORTED(made);
  // The nearest instance is the first.
  EXPECT_EQ(draw(*made, [](CommandList& list) { list.DrawInstanced(3, 3, 0, 0); }), numbers(100));
}

TEST_P(Draws, DrawIndexedInstanced) {
  KAAMOS_SUPPORTED(make_targets());
  const auto made = pipeline("FromVertexBuffer");
  KAAMOS_SUPPORTED(made);
  const float corners[4][2] = {{9, 9}, {-1, 1}, {3, 1}, {-1, -3}};
  std::vector<uint32_t> words(8);
  std::memcpy(words.data(), corners, sizeof corners);
  const Buffer vertices = upload(words);
  const Buffer indices = upload({0, 1, 2});
  const IndexBufferView view = {indices.GetGPUVirtualAddress(), 12, Format::kR32Uint};
  EXPECT_EQ(draw(*made,
                 [&](CommandList& list) {
                   list.IASetVertexBuffers(
                       0, VertexBufferView{vertices.GetGPUVirtualAddress(), sizeof corners, 8});
                   list.IASetIndexBuffer(&view);
                   list.DrawIndexedInstanced(3, 1, 0, 1, 0);
                 }),
            numbers(700));
}

TEST_P(Draws, ExecuteIndirect_draws) {
  KAAMOS_SUPPORTED(make_targets());
  const auto made = pipeline("CoverAll");
  KAAMOS_SUPPORTED(made);
  CommandSignatureDesc desc;
  desc.ByteStride = sizeof(DrawArguments);
  IndirectArgumentDesc argument;
  argument.Type = IndirectArgumentType::kDraw;
  desc.ArgumentDescs = {argument};
  const CommandSignature signature = device_.CreateCommandSignature(desc).value();
  const Buffer arguments = upload({3, 1, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(
      draw(*made, [&](CommandList& list) { list.ExecuteIndirect(signature, 2, arguments, 0); }),
      numbers(100));
}

KAAMOS_CALLS(Queries);

TEST_P(Queries, EndQuery) {
  const auto heap = device_.CreateQueryHeap({.Count = 2});
  KAAMOS_SUPPORTED(heap);
  CommandList list = device_.CreateCommandList().value();
  list.EndQuery(*heap, QueryType::kTimestamp, 1);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
}

TEST_P(Queries, ResolveQueryData) {
  const auto heap = device_.CreateQueryHeap({.Count = 4});
  KAAMOS_SUPPORTED(heap);
  const Buffer ticks = buffer(5 * 8);
  const Buffer large = buffer(64 << 20);
  CommandList list = device_.CreateCommandList().value();
  list.EndQuery(*heap, QueryType::kTimestamp, 0);
  list.CopyBufferRegion(large, 0, large, 32 << 20, 32 << 20);
  list.EndQuery(*heap, QueryType::kTimestamp, 1);
  // Twice, so that the later one counts.
  list.EndQuery(*heap, QueryType::kTimestamp, 0);
  list.EndQuery(*heap, QueryType::kTimestamp, 2);
  list.ResolveQueryData(*heap, QueryType::kTimestamp, 0, 3, ticks, 8);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  const auto bytes = ReadbackBuffer(device_, queue_, ticks).value();
  uint64_t t[5];
  std::memcpy(t, bytes.data(), sizeof t);
  EXPECT_EQ(t[0], 0u);
  EXPECT_GT(t[2], 0u);
  EXPECT_LE(t[2], t[1]);
  EXPECT_LE(t[1], t[3]);
  EXPECT_EQ(t[4], 0u);

  // The next list copies, and measures it: 32 MiB take more than a tick, and less than a minute.
  CommandList next = device_.CreateCommandList().value();
  next.EndQuery(*heap, QueryType::kTimestamp, 0);
  next.CopyBufferRegion(large, 0, large, 32 << 20, 32 << 20);
  next.EndQuery(*heap, QueryType::kTimestamp, 1);
  next.ResolveQueryData(*heap, QueryType::kTimestamp, 0, 2, ticks, 0);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(next));
  const auto again = ReadbackBuffer(device_, queue_, ticks).value();
  uint64_t span[2];
  std::memcpy(span, again.data(), sizeof span);
  EXPECT_GE(span[0], t[3]);
  ASSERT_GT(span[1], span[0]);
  const double frequency = static_cast<double>(queue_.GetTimestampFrequency().value());
  EXPECT_LT(static_cast<double>(span[1] - span[0]) / frequency, 60);
}

TEST_P(Queries, BeginQuery) {
  for (const QueryHeapType type : {QueryHeapType::kOcclusion, QueryHeapType::kPipelineStatistics}) {
    const auto heap = device_.CreateQueryHeap({.Type = type, .Count = 2});
    KAAMOS_SUPPORTED(heap);
    const QueryType query =
        type == QueryHeapType::kOcclusion ? QueryType::kOcclusion : QueryType::kPipelineStatistics;
    const Buffer found = buffer(2 * sizeof(QueryDataPipelineStatistics));
    CommandList list = device_.CreateCommandList().value();
    list.BeginQuery(*heap, query, 0);
    list.BeginQuery(*heap, query, 1);
    list.EndQuery(*heap, query, 0);
    list.EndQuery(*heap, query, 1);
    list.ResolveQueryData(*heap, query, 0, 2, found, 0);
    KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
    for (const uint32_t word : read(found)) EXPECT_EQ(word, 0u);
  }
}

TEST_P(Queries, SetPredication) {
  const Buffer values = upload({0, 0, 5, 0});
  const Buffer source = upload({7, 8});
  const Buffer out = buffer(8);
  CommandList list = device_.CreateCommandList().value();
  list.SetPredication(values, 0, PredicationOp::kEqualZero);
  list.CopyBufferRegion(out, 0, source, 0, 4);
  list.SetPredication(values, 8, PredicationOp::kEqualZero);
  list.CopyBufferRegion(out, 4, source, 4, 4);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(out), (std::vector<uint32_t>{0, 8}));
}

TEST_P(Queries, QueryThatWasNotEnded) {
  std::vector<std::string> messages;
  DeviceDesc desc;
  desc.Backend = GetParam();
  desc.OnMessage = [&](const Message& m) { messages.push_back(m.Text); };
  open(desc);
  const auto heap = device_.CreateQueryHeap({.Count = 4});
  KAAMOS_SUPPORTED(heap);
  const Buffer out = buffer(24);
  CommandList list = device_.CreateCommandList().value();
  list.CopyBufferRegion(out, 0, upload(numbers(1, 1, 6)), 0, 24);
  list.EndQuery(*heap, QueryType::kTimestamp, 2);
  list.ResolveQueryData(*heap, QueryType::kTimestamp, 1, 3, out, 0);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  const auto words = read(out);
  EXPECT_EQ(words[0] | words[1] | words[4] | words[5], 0u);
  EXPECT_NE(words[2] | words[3], 0u);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("KA0899"), std::string::npos) << messages[0];
  EXPECT_NE(messages[0].find("query 1"), std::string::npos) << messages[0];
}

}  // namespace
