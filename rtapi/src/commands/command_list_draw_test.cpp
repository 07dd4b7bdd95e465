// SPDX-License-Identifier: MIT
//
// Tests what draws and clears record, and what lists refuse.
#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/resources/resource_impl.h"
#include "rtapi/testing/graphics_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;

class DrawTest : public GraphicsTest {
 protected:
  DrawTest() {
    rtvs_ = device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 9})
                .value();
    dsvs_ = device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 2})
                .value();
    desc_ = Desc();
    pipeline_ = Make(desc_).value();
  }
  // Everything that a draw needs, but no target.
  void Prepare(CommandList& list) {
    list.SetGraphicsRootSignature(desc_.pRootSignature);
    list.SetPipelineState(pipeline_);
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  }
  CpuDescriptorHandle Rtv(uint32_t i) { return rtvs_.GetCPUDescriptorHandle(i); }
  CpuDescriptorHandle Dsv(uint32_t i) { return dsvs_.GetCPUDescriptorHandle(i); }
  Texture MakeColor() {
    return MakeTarget(Format::kR8G8B8A8Unorm, ResourceFlags::kAllowRenderTarget);
  }

  DescriptorHeap rtvs_;
  DescriptorHeap dsvs_;
  GraphicsPipelineStateDesc desc_;
  PipelineState pipeline_;
};

TEST_F(DrawTest, DrawsTakeASnapshotOfWhatIsSet) {
  const Texture color = MakeColor();
  EXPECT_OK(device_.CreateRenderTargetView(color, Rtv(0)));
  const Buffer buffer = MakeBuffer(256);
  Prepare(list_);
  const CpuDescriptorHandle target = Rtv(0);
  list_.OMSetRenderTargets(1, &target);
  list_.RSSetViewports(Viewport{0, 0, 16, 16, 0, 1});
  list_.RSSetScissorRects(Rect{0, 0, 8, 8});
  list_.IASetVertexBuffers(3, VertexBufferView{buffer.GetGPUVirtualAddress() + 16, 64, 12});
  list_.DrawInstanced(3, 2, 10, 20);
  list_.RSSetScissorRects(Rect{1, 1, 2, 2});
  const float factor[4] = {0.25f, 0.5f, 0.75f, 0};
  list_.OMSetBlendFactor(factor);
  const IndexBufferView indices = {buffer.GetGPUVirtualAddress(), 12, Format::kR16Uint};
  list_.IASetIndexBuffer(&indices);
  list_.DrawIndexedInstanced(6, 1, 2, -4, 5);
  list_.OMSetBlendFactor(nullptr);
  list_.OMSetStencilRef(0x1FE);
  list_.IASetIndexBuffer(nullptr);
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  const auto& first = Executed<runtime::DrawCommand>(0);
  EXPECT_FALSE(first.indexed);
  EXPECT_EQ(first.arguments.IndexCountPerInstance, 3u);
  EXPECT_EQ(first.arguments.InstanceCount, 2u);
  EXPECT_EQ(first.arguments.StartIndexLocation, 10u);
  EXPECT_EQ(first.arguments.StartInstanceLocation, 20u);
  EXPECT_EQ(first.state->scissors[0].right, 8);
  EXPECT_EQ(first.state->viewport_count, 1u);
  EXPECT_EQ(first.state->vertex_buffers[3].StrideInBytes, 12u);
  EXPECT_EQ(first.state->targets.color_count, 1u);
  EXPECT_EQ(first.state->targets.color[0].texture, color.impl()->memory);
  EXPECT_EQ(first.state->blend_factor[1], 1.0f);
  EXPECT_EQ(first.state->front_stencil, 0);
  const auto& second = Executed<runtime::DrawCommand>(1);
  EXPECT_TRUE(second.indexed);
  EXPECT_EQ(second.arguments.BaseVertexLocation, -4);
  EXPECT_EQ(second.state->scissors[0].right, 2);
  EXPECT_EQ(second.state->blend_factor[1], 0.5f);
  EXPECT_EQ(second.state->index_buffer.SizeInBytes, 12u);
  const auto& third = Executed<runtime::DrawCommand>(2);
  EXPECT_EQ(third.state->blend_factor[0], 1.0f);
  EXPECT_EQ(third.state->front_stencil, 0xFE);
  EXPECT_EQ(third.state->back_stencil, 0xFE);
  EXPECT_EQ(third.state->index_buffer.BufferLocation, 0u);
}

TEST_F(DrawTest, RAS_131_DescriptorsAreReadWhenTheCallIsRecorded) {
  const Texture before = MakeColor();
  const Texture after = MakeColor();
  EXPECT_OK(device_.CreateRenderTargetView(before, Rtv(0)));
  Prepare(list_);
  const CpuDescriptorHandle target = Rtv(0);
  list_.OMSetRenderTargets(1, &target);
  EXPECT_OK(device_.CreateRenderTargetView(after, Rtv(0)));
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_EQ(Executed<runtime::DrawCommand>(0).state->targets.color[0].texture,
            before.impl()->memory);
}

TEST_F(DrawTest, RAS_131_TexturesMustLiveUntilTheListHasExecuted) {
  Texture color = MakeColor();
  EXPECT_OK(device_.CreateRenderTargetView(color, Rtv(0)));
  Prepare(list_);
  const CpuDescriptorHandle target = Rtv(0);
  list_.OMSetRenderTargets(1, &target);
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  color = {};
  EXPECT_ERROR(queue_.ExecuteCommandLists({list_}), "KA0856", "render target 0", "target");
  EXPECT_ERROR(Record([&](CommandList& list) { list.OMSetRenderTargets(1, &target); }), "KA0731",
               "freed");
}

TEST_F(DrawTest, VertexBuffersMustLiveUntilTheListHasExecuted) {
  desc_.VS.Library = Vertex({Value("A", 0, 1)}, {Position()});
  desc_.InputLayout = {{.SemanticName = "A", .Format = Format::kR32Float, .InputSlot = 2}};
  pipeline_ = Make(desc_).value();
  Buffer buffer = MakeBuffer(256, HeapType::kDefault, "vertices");
  Prepare(list_);
  list_.IASetVertexBuffers(2, VertexBufferView{buffer.GetGPUVirtualAddress(), 64, 4});
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  buffer = {};
  EXPECT_ERROR(queue_.ExecuteCommandLists({list_}), "KA0856", "vertex buffer 2", "vertices");
}

// Even if the memory is freed before the draw is recorded.
TEST_F(DrawTest, BuffersAreLookedUpWhenTheyAreSet) {
  Buffer buffer = MakeBuffer(256, HeapType::kDefault, "indices");
  Prepare(list_);
  const IndexBufferView view = {buffer.GetGPUVirtualAddress(), 12, Format::kR16Uint};
  list_.IASetIndexBuffer(&view);
  buffer = {};
  list_.DrawInstanced(3, 1, 0, 0);  // does not use it
  list_.DrawIndexedInstanced(3, 1, 0, 0, 0);
  list_.DrawIndexedInstanced(3, 1, 0, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_ERROR(queue_.ExecuteCommandLists({list_}), "KA0856", "DrawIndexedInstanced, command 1",
               "index buffer", "indices");
}

TEST_F(DrawTest, RAS_140_GraphicsAndComputeArgumentsAreSeparate) {
  LibraryBuilder b;
  b.Export("Kernel", Stage::kCompute);
  const RootSignature constants = Global("RootConstants(num32BitConstants=1, b0)");
  const PipelineState kernel =
      device_.CreateComputePipelineState({.pRootSignature = constants, .CS = b.Build()}).value();
  desc_.pRootSignature = constants;
  pipeline_ = Make(desc_).value();
  Prepare(list_);
  list_.SetGraphicsRoot32BitConstant(0, 11, 0);
  list_.SetComputeRootSignature(constants);
  list_.SetComputeRoot32BitConstant(0, 22, 0);
  list_.DrawInstanced(3, 1, 0, 0);
  list_.SetPipelineState(kernel);
  list_.Dispatch(1, 1, 1);
  list_.SetPipelineState(pipeline_);
  list_.DrawInstanced(3, 1, 0, 0);
  list_.SetGraphicsRootSignature(constants);  // the same one keeps its arguments
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_EQ(Executed<runtime::DrawCommand>(0).bindings.root_arguments->bytes[0], 11);
  EXPECT_EQ(Executed<runtime::DispatchCommand>(1).state.root_arguments->bytes[0], 22);
  EXPECT_EQ(Executed<runtime::DrawCommand>(2).bindings.root_arguments->bytes[0], 11);
  EXPECT_EQ(Executed<runtime::DrawCommand>(3).bindings.root_arguments->bytes[0], 11);
}

TEST_F(DrawTest, RAS_143_AFreshListCannotDraw) {
  EXPECT_ERROR(Record([](CommandList& list) { list.DrawInstanced(3, 1, 0, 0); }), "KA0811",
               "graphics pipeline");
  EXPECT_ERROR(Record([&](CommandList& list) {
                 list.SetPipelineState(pipeline_);
                 list.DrawInstanced(3, 1, 0, 0);
               }),
               "KA0812", "no graphics root signature");
  EXPECT_ERROR(Record([&](CommandList& list) {
                 list.SetPipelineState(pipeline_);
                 list.SetGraphicsRootSignature(desc_.pRootSignature);
                 list.DrawIndexedInstanced(3, 1, 0, 0, 0);
               }),
               "KA0740", "IASetPrimitiveTopology");
  EXPECT_ERROR(Record([&](CommandList& list) {
                 Prepare(list);
                 list.Dispatch(1, 1, 1);
               }),
               "KA0811", "compute pipeline");
}

TEST_F(DrawTest, RAS_146_WhatASignatureSetsIsNullAfterwards) {
  const RootSignature constants = Global("RootConstants(num32BitConstants=2, b0)");
  desc_.pRootSignature = constants;
  pipeline_ = Make(desc_).value();
  using Type = IndirectArgumentType;
  const CommandSignature signature =
      device_
          .CreateCommandSignature(
              {.ByteStride = 52,
               .ArgumentDescs = {{.Type = Type::kConstant, .Constant = {0, 1, 1}},
                                 {.Type = Type::kVertexBufferView, .VertexBuffer = {3}},
                                 {.Type = Type::kDrawIndexed}}},
              constants)
          .value();
  const Buffer buffer = MakeBuffer(256);
  Prepare(list_);
  list_.SetGraphicsRoot32BitConstant(0, 11, 0);
  list_.SetGraphicsRoot32BitConstant(0, 22, 1);
  for (const uint32_t slot : {3u, 4u}) {
    list_.IASetVertexBuffers(slot, VertexBufferView{buffer.GetGPUVirtualAddress(), 64, 4});
  }
  list_.ExecuteIndirect(signature, 2, buffer, 0);
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  const auto& indirect = Executed<runtime::ExecuteIndirectCommand>(0);
  EXPECT_EQ(indirect.layout->work, runtime::IndirectWork::kDrawIndexed);
  EXPECT_NE(indirect.linked_graphics, nullptr);
  EXPECT_NE(indirect.draw_state->vertex_buffers[3].BufferLocation, 0u);
  EXPECT_EQ(indirect.state.root_arguments->bytes[4], 22);
  const auto& after = Executed<runtime::DrawCommand>(1);
  EXPECT_EQ(after.bindings.root_arguments->bytes[0], 11);
  EXPECT_EQ(after.bindings.root_arguments->bytes[4], 0);
  EXPECT_EQ(after.state->vertex_buffers[3].BufferLocation, 0u);
  EXPECT_NE(after.state->vertex_buffers[4].BufferLocation, 0u);
  EXPECT_ERROR(Record([&](CommandList& list) {
                 list.SetGraphicsRootSignature(constants);
                 list.SetPipelineState(pipeline_);
                 list.ExecuteIndirect(signature, 1, buffer, 0);
               }),
               "KA0740");
}

TEST_F(DrawTest, RAS_144_CountsOfZeroDrawNothing) {
  Prepare(list_);
  list_.DrawInstanced(0, 1, 0, 0);
  list_.DrawInstanced(3, 0, 0, 0);
  list_.DrawIndexedInstanced(0, 1, 0, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_TRUE(null_log().executed.empty());
}

TEST_F(DrawTest, WhatIsSetIsChecked) {
  const Buffer buffer = MakeBuffer(256);
  const uint64_t address = buffer.GetGPUVirtualAddress();
  const auto vertex = [&](uint32_t slot, VertexBufferView view) {
    return Record([&](CommandList& list) { list.IASetVertexBuffers(slot, view); });
  };
  EXPECT_OK(vertex(31, {address, 256, 2048}));
  EXPECT_OK(vertex(0, {0, 0, 0}));
  EXPECT_ERROR(vertex(32, {address, 256, 16}), "KA0741", "32");
  EXPECT_ERROR(vertex(0, {address, 256, 2049}), "KA0741", "2049");
  EXPECT_ERROR(vertex(0, {address, 257, 16}), "KA0741", "257 bytes");
  const auto index = [&](IndexBufferView view) {
    return Record([&](CommandList& list) { list.IASetIndexBuffer(&view); });
  };
  EXPECT_OK(index({address + 2, 100, Format::kR16Uint}));
  EXPECT_ERROR(index({address + 2, 100, Format::kR32Uint}), "KA0741", "multiple of 4");
  EXPECT_ERROR(index({address, 100, Format::kR8Uint}), "KA0741", "format 62");
  EXPECT_ERROR(index({1, 100, Format::kR16Uint}), "KA0741");
  const auto viewport = [&](Viewport v) {
    return Record([&](CommandList& list) { list.RSSetViewports(v); });
  };
  EXPECT_OK(viewport({0.25f, 0, -256, -16, 1, 0}));
  EXPECT_ERROR(viewport({0, 0, 40000, 16, 0, 1}), "KA0742", "40000");
  EXPECT_ERROR(viewport({0, 0, NAN, 16, 0, 1}), "KA0742", "finite");
  EXPECT_ERROR(viewport({0, 0, 16, 16, 0, 1.5f}), "KA0742", "1.5");
  EXPECT_ERROR(Record([](CommandList& list) { list.RSSetViewports(std::vector<Viewport>(17)); }),
               "KA0742", "17");
  EXPECT_ERROR(Record([](CommandList& list) { list.RSSetScissorRects(std::vector<Rect>(17)); }),
               "KA0742", "17");
  EXPECT_OK(
      Record([](CommandList& list) { list.IASetPrimitiveTopology(PrimitiveTopology::kLineList); }));
  EXPECT_ERROR(Record([](CommandList& list) {
                 list.IASetPrimitiveTopology(static_cast<PrimitiveTopology>(11));
               }),
               "KA0721", "topology 11");
  EXPECT_ERROR(Record([](CommandList& list) {
                 list.IASetPrimitiveTopology(static_cast<PrimitiveTopology>(6));
               }),
               "KA0740", "6");
}

TEST_F(DrawTest, TargetsAreChecked) {
  const CpuDescriptorHandle unwritten = Rtv(3);
  const auto set = [&](const CpuDescriptorHandle* color, const CpuDescriptorHandle* depth) {
    return Record(
        [&](CommandList& list) { list.OMSetRenderTargets(color ? 1 : 0, color, false, depth); });
  };
  EXPECT_ERROR(set(&unwritten, nullptr), "KA0731", "no view was made");
  const CpuDescriptorHandle depth = Dsv(0);
  EXPECT_ERROR(set(&depth, nullptr), "KA0731", "is in a DSV heap");
  const CpuDescriptorHandle wild = {12345};
  EXPECT_ERROR(set(nullptr, &wild), "KA0731", "not in a live descriptor heap");
  EXPECT_ERROR(Record([&](CommandList& list) { list.OMSetRenderTargets(9, &unwritten); }), "KA0742",
               "9");
  EXPECT_ERROR(Record([](CommandList& list) { list.OMSetRenderTargets(1, nullptr); }), "KA0742",
               "null");
  EXPECT_OK(device_.CreateRenderTargetView({}, RenderTargetViewDesc(), unwritten));
  EXPECT_OK(set(&unwritten, nullptr));  // a null descriptor
}

TEST_F(DrawTest, HandlesMayBeARange) {
  const Texture a = MakeColor();
  const Texture b = MakeColor();
  EXPECT_OK(device_.CreateRenderTargetView(a, Rtv(4)));
  EXPECT_OK(device_.CreateRenderTargetView(b, Rtv(5)));
  Prepare(list_);
  const CpuDescriptorHandle first = Rtv(4);
  list_.OMSetRenderTargets(2, &first, true);
  list_.DrawInstanced(3, 1, 0, 0);
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  EXPECT_EQ(Executed<runtime::DrawCommand>(0).state->targets.color[1].texture, b.impl()->memory);
}

TEST_F(DrawTest, RAS_132_ViewsNameOneMipAndSomeSlices) {
  const Texture cube =
      MakeTarget(Format::kR8G8B8A8Unorm, ResourceFlags::kAllowRenderTarget, 16, 16, 6, 5);
  const auto clear = [&](const RenderTargetViewDesc& desc) {
    EXPECT_OK(device_.CreateRenderTargetView(cube, desc, Rtv(0)));
    const float red[4] = {1, 0, 0, 1};
    list_.ClearRenderTargetView(Rtv(0), red);
  };
  clear({});
  clear({.ViewDimension = RtvDimension::kTexture2DArray,
         .Texture2DArray = {.MipSlice = 2, .FirstArraySlice = 3, .ArraySize = 1}});
  clear({.Format = Format::kR8G8B8A8UnormSrgb,
         .ViewDimension = RtvDimension::kTexture2D,
         .Texture2DArray = {.MipSlice = 1}});
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  const auto view = [&](size_t i) { return Executed<runtime::ClearTargetCommand>(i).view; };
  EXPECT_EQ(view(0).slice_count, 6u);
  EXPECT_EQ(view(0).width, 16u);
  EXPECT_EQ(view(1).mip, 2u);
  EXPECT_EQ(view(1).first_slice, 3u);
  EXPECT_EQ(view(1).slice_count, 1u);
  EXPECT_EQ(view(1).height, 4u);
  EXPECT_EQ(view(2).slice_count, 1u);
  EXPECT_EQ(view(2).format, Format::kR8G8B8A8UnormSrgb);
}

TEST_F(DrawTest, ViewsAreChecked) {
  const Texture color = MakeColor();
  const Texture plain = MakeTarget(Format::kR8G8B8A8Unorm, ResourceFlags::kNone);
  const Texture typeless = MakeTarget(Format::kR8G8B8A8Typeless, ResourceFlags::kAllowRenderTarget);
  EXPECT_ERROR(device_.CreateRenderTargetView(plain, Rtv(0)), "KA0730", "kAllowRenderTarget");
  EXPECT_ERROR(device_.CreateRenderTargetView(typeless, Rtv(0)), "KA0730", "typed format");
  EXPECT_OK(device_.CreateRenderTargetView(typeless, {.Format = Format::kR8G8B8A8Uint}, Rtv(0)));
  EXPECT_OK(device_.CreateRenderTargetView(color, {.Format = Format::kR8G8B8A8Uint}, Rtv(0)));
  EXPECT_ERROR(device_.CreateRenderTargetView(color, {.Format = Format::kR8G8B8A8Snorm}, Rtv(0)),
               "KA0730", "format 31");
  EXPECT_ERROR(device_.CreateRenderTargetView(color, Dsv(0)), "KA0731", "kRtv");
  EXPECT_ERROR(device_.CreateDepthStencilView(color, Dsv(0)), "KA0730", "kAllowDepthStencil");
  EXPECT_ERROR(
      device_.CreateRenderTargetView(
          color, {.ViewDimension = RtvDimension::kTexture2D, .Texture2DArray = {.MipSlice = 1}},
          Rtv(0)),
      "KA0730", "mip 1");
  EXPECT_ERROR(device_.CreateRenderTargetView(color,
                                              {.ViewDimension = RtvDimension::kTexture2DArray,
                                               .Texture2DArray = {.FirstArraySlice = 1}},
                                              Rtv(0)),
               "KA0730", "array elements");
  EXPECT_ERROR(device_.CreateRenderTargetView(
                   color, {.ViewDimension = static_cast<RtvDimension>(9)}, Rtv(0)),
               "KA0730", "dimension 9");
  EXPECT_ERROR(
      device_.CreateRenderTargetView(color, {.ViewDimension = RtvDimension::kTexture1D}, Rtv(0)),
      "KA0730", "2-D", "1-D");
  const Texture depth = MakeTarget(Format::kR32Typeless, ResourceFlags::kAllowDepthStencil);
  EXPECT_OK(device_.CreateDepthStencilView(depth, Dsv(0)));
  EXPECT_OK(device_.CreateDepthStencilView(
      depth, {.Format = Format::kD32Float, .Flags = DsvFlags::kReadOnlyDepth}, Dsv(0)));
  EXPECT_ERROR(device_.CreateDepthStencilView(depth, {.Format = Format::kR32Float}, Dsv(0)),
               "KA0730", "depth format");
}

TEST_F(DrawTest, RAS_134_RectanglesAreCutToTheView) {
  const Texture color = MakeColor();
  EXPECT_OK(device_.CreateRenderTargetView(color, Rtv(0)));
  const float red[4] = {1, 0, 0, 1};
  const Rect rects[] = {{-5, 2, 4, 100}, {4, 4, 4, 8}, {20, 0, 30, 4}};
  list_.ClearRenderTargetView(Rtv(0), red, rects);
  list_.ClearRenderTargetView(Rtv(0), red, std::span(rects).subspan(1));
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  ASSERT_EQ(null_log().executed.size(), 1u);  // nothing is left of the second
  const auto& clear = Executed<runtime::ClearTargetCommand>(0);
  EXPECT_FALSE(clear.whole);
  ASSERT_EQ(clear.rects.size(), 1u);
  EXPECT_EQ(clear.rects[0].left, 0);
  EXPECT_EQ(clear.rects[0].bottom, 16);
}

TEST_F(DrawTest, RAS_136_DepthClearsAreChecked) {
  const Texture depth = MakeTarget(Format::kD24UnormS8Uint, ResourceFlags::kAllowDepthStencil);
  EXPECT_OK(device_.CreateDepthStencilView(depth, Dsv(0)));
  const auto clear = [&](ClearFlags flags, float value) {
    return Record([&](CommandList& list) { list.ClearDepthStencilView(Dsv(0), flags, value, 7); });
  };
  EXPECT_OK(clear(ClearFlags::kDepth | ClearFlags::kStencil, 1));
  EXPECT_OK(clear(ClearFlags::kStencil, NAN));
  EXPECT_ERROR(clear(ClearFlags::kDepth, 1.5f), "KA0743", "1.5");
  EXPECT_ERROR(clear(ClearFlags::kDepth, NAN), "KA0743", "0 to 1");
  EXPECT_ERROR(clear(ClearFlags{}, 1), "KA0743", "flags 0");
  EXPECT_ERROR(Record([&](CommandList& list) { list.ClearRenderTargetView(Rtv(0), nullptr); }),
               "KA0743", "null");
}

TEST_F(DrawTest, TexturesOfTargetsAreChecked) {
  const auto make = [&](Format format, ResourceFlags flags,
                        ResourceDimension dimension = ResourceDimension::kTexture2D) {
    return device_.CreateTexture({.Dimension = dimension, .Format = format, .Flags = flags});
  };
  using F = ResourceFlags;
  EXPECT_OK(make(Format::kD32Float, F::kAllowDepthStencil | F::kDenyShaderResource));
  EXPECT_OK(make(Format::kR24G8Typeless, F::kAllowDepthStencil));
  EXPECT_ERROR(make(Format::kD32Float, F::kNone), "KA0909", "kAllowDepthStencil");
  EXPECT_ERROR(make(Format::kR8Unorm, F::kAllowDepthStencil), "KA0909", "depth format");
  EXPECT_ERROR(make(Format::kD32Float, F::kAllowDepthStencil | F::kAllowRenderTarget), "KA0909");
  EXPECT_ERROR(make(Format::kD32Float, F::kAllowDepthStencil | F::kAllowUnorderedAccess), "KA0909");
  EXPECT_ERROR(make(Format::kR8Unorm, F::kDenyShaderResource), "KA0909", "kDenyShaderResource");
  EXPECT_ERROR(make(Format::kD32Float, F::kAllowDepthStencil, ResourceDimension::kTexture3D),
               "KA0909", "2-D");
  EXPECT_OK(make(Format::kR8Unorm, F::kAllowRenderTarget, ResourceDimension::kTexture1D));
  EXPECT_OK(make(Format::kR8Unorm, F::kAllowRenderTarget, ResourceDimension::kTexture3D));
  EXPECT_ERROR(make(Format::kR9G9B9E5Sharedexp, F::kAllowRenderTarget), "KA0726");
  EXPECT_OK(make(Format::kR8G8B8A8Typeless, F::kAllowRenderTarget | F::kAllowUnorderedAccess));
}

TEST_F(DrawTest, RAS_71_ShadersReadDepthThroughTheFamily) {
  const DescriptorHeap views = device_.CreateDescriptorHeap({.NumDescriptors = 1}).value();
  const auto view = [&](Format own, Format seen, ResourceFlags more = ResourceFlags::kNone) {
    const Texture depth = MakeTarget(own, ResourceFlags::kAllowDepthStencil | more);
    return device_.CreateShaderResourceView(
        Resource(depth), {.Format = seen, .ViewDimension = SrvDimension::kTexture2D},
        views.GetCPUDescriptorHandle(0));
  };
  EXPECT_OK(view(Format::kR32Typeless, Format::kR32Float));
  EXPECT_OK(view(Format::kR16Typeless, Format::kR16Unorm));
  EXPECT_OK(view(Format::kR24G8Typeless, Format::kR24UnormX8Typeless));
  EXPECT_OK(view(Format::kR24G8Typeless, Format::kX24TypelessG8Uint));
  EXPECT_OK(view(Format::kR32G8X24Typeless, Format::kR32FloatX8X24Typeless));
  EXPECT_ERROR(view(Format::kR32Typeless, Format::kD32Float), "KA0626", "typeless");
  EXPECT_ERROR(view(Format::kD32Float, Format::kR32Float), "KA0626");
  EXPECT_ERROR(view(Format::kR32Typeless, Format::kR32Float, ResourceFlags::kDenyShaderResource),
               "KA0627", "kDenyShaderResource");
}

TEST_F(DrawTest, TargetHeapsAreOfTheHost) {
  EXPECT_ERROR(device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv,
                                             .NumDescriptors = 1,
                                             .Flags = DescriptorHeapFlags::kShaderVisible}),
               "KA0621", "kShaderVisible");
  const Texture color = MakeColor();
  EXPECT_OK(device_.CreateRenderTargetView(color, Rtv(0)));
  EXPECT_OK(device_.CopyDescriptorsSimple(1, Rtv(1), Rtv(0), DescriptorHeapType::kRtv));
  const CpuDescriptorHandle copied = Rtv(1);
  EXPECT_OK(Record([&](CommandList& list) { list.OMSetRenderTargets(1, &copied); }));
  EXPECT_ERROR(device_.CreateShaderResourceView(color, Rtv(0)), "KA0622", "is in an RTV heap");
}

}  // namespace
}  // namespace rtapi::testing
