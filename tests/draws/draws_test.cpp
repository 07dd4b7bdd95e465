// SPDX-License-Identifier: MIT
//
// Tests what draws leave in targets, from shaders in buffers to texels. Expected values are worked
// out by hand from the rules.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <optional>

#include "canvas.h"
#include "on_backends.h"
#include "tests/common/structures.h"
#include "tests/vulkan/support.h"

namespace kaamos::draws {
namespace {

using namespace rtapi;

struct Corner {
  float position[3];
  float color[3];
};

// Pixel coordinates of the canvas to normalized ones; both are exact.
float ndc_x(float x) {
  return x / 32 - 1;
}
float ndc_y(float y) {
  return 1 - y / 32;
}

std::vector<InputElementDesc> layout() {
  return {{.SemanticName = "POSITION", .Format = Format::kR32G32B32Float},
          {.SemanticName = "COLOR", .Format = Format::kR32G32B32Float},
          {.SemanticName = "OFFSET",
           .Format = Format::kR32G32Float,
           .InputSlot = 1,
           .InputSlotClass = InputClassification::kPerInstanceData,
           .InstanceDataStepRate = 1}};
}

// The rectangle (8, 8) to (24, 24) as two triangles; its left half is red on one side, green on the
// other.
const std::vector<Corner> kRectangle = {
    {{ndc_x(8), ndc_y(8), 0.5f}, {1, 0, 0}},   {{ndc_x(24), ndc_y(8), 0.5f}, {0, 1, 0}},
    {{ndc_x(8), ndc_y(24), 0.5f}, {1, 0, 0}},  {{ndc_x(24), ndc_y(8), 0.5f}, {0, 1, 0}},
    {{ndc_x(24), ndc_y(24), 0.5f}, {0, 1, 0}}, {{ndc_x(8), ndc_y(24), 0.5f}, {1, 0, 0}}};

class Draws : public OnBackends {
 protected:
  void SetUp() override {
    OnBackends::SetUp();
    if (can_run()) canvas_.emplace(GetParam());
  }
  Buffer upload(const auto& elements) {
    return CreateUploadBuffer(canvas_->device, elements, "vertices").value();
  }
  static VertexBufferView view(const Buffer& buffer, uint32_t stride) {
    return {buffer.GetGPUVirtualAddress(), static_cast<uint32_t>(buffer.size()), stride};
  }
  std::array<uint32_t, 2> counts() {
    const auto bytes = ReadbackBuffer(canvas_->device, canvas_->queue, canvas_->counter).value();
    std::array<uint32_t, 2> out;
    std::memcpy(out.data(), bytes.data(), sizeof out);
    return out;
  }

  std::optional<Canvas> canvas_;
};
INSTANTIATE_TEST_SUITE_P(Backends, Draws, ::testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Draws, VerticesComeFromBuffersAndColorsAreInterpolated) {
  GraphicsPipelineStateDesc desc = canvas_->desc("FromBuffers", "Color");
  desc.InputLayout = layout();
  const PipelineState pipeline = canvas_->make(desc);
  const Buffer vertices = upload(kRectangle);
  // The second instance is 32 pixels to the right.
  const Buffer offsets = upload(std::vector<float>{0, 0, 1, 0});
  canvas_->run([&](CommandList& list) {
    Canvas::use(list, pipeline, {1, 0.5f, 1, 1});
    const VertexBufferView views[] = {view(vertices, sizeof(Corner)), view(offsets, 8)};
    list.IASetVertexBuffers(0, views);
    list.DrawInstanced(6, 2, 0, 0);
  });
  int covered = 0;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const uint32_t in_rectangle = x % 32;
      const bool inside = in_rectangle >= 8 && in_rectangle < 24 && y >= 8 && y < 24;
      covered += canvas_->texel<float>(x, y, 3) == 1.0f;
      ASSERT_EQ(canvas_->texel<float>(x, y, 3), inside ? 1.0f : 0.0f) << x << ", " << y;
      if (!inside) continue;
      const float green = (static_cast<float>(in_rectangle) + 0.5f - 8) / 16;
      EXPECT_NEAR(canvas_->texel<float>(x, y, 0), 1 - green, 1e-6f) << x << ", " << y;
      EXPECT_NEAR(canvas_->texel<float>(x, y, 1), green / 2, 1e-6f) << x << ", " << y;
      EXPECT_EQ(canvas_->depth(x, y), 0.5f);
    }
  }
  EXPECT_EQ(covered, 2 * 16 * 16);
}

TEST_P(Draws, RAS_08_10_12_IdsBeginAtZeroWhereverTheDrawStarts) {
  Canvas canvas(GetParam(), Format::kR32G32B32A32Uint);
  GraphicsPipelineStateDesc desc = canvas.desc("FromBuffers", "Facts");
  desc.InputLayout = layout();
  const PipelineState pipeline = canvas.make(desc);
  const Buffer vertices = CreateUploadBuffer(canvas.device, kRectangle).value();
  const Buffer offsets = CreateUploadBuffer(canvas.device, std::vector<float>{0, 0, 1, 0}).value();
  const Buffer indices =
      CreateUploadBuffer(canvas.device, std::vector<uint16_t>{9, 9, 4, 5, 6, 7, 8, 9}).value();
  canvas.run([&](CommandList& list) {
    Canvas::use(list, pipeline);
    const VertexBufferView views[] = {view(vertices, sizeof(Corner)), view(offsets, 8)};
    list.IASetVertexBuffers(0, views);
    const IndexBufferView index_view = {indices.GetGPUVirtualAddress(), 16, Format::kR16Uint};
    list.IASetIndexBuffer(&index_view);
    // Indices 4, 5, ... with base -4; only the second instance's offset.
    list.DrawIndexedInstanced(6, 1, 2, -4, 1);
  });
  EXPECT_EQ(canvas.texel<uint32_t>(41, 9, 0), 4u);   // SV_VertexID is the index, instance 0
  EXPECT_EQ(canvas.texel<uint32_t>(41, 9, 1), 0u);   // the first triangle
  EXPECT_EQ(canvas.texel<uint32_t>(55, 23, 0), 7u);  // the leading vertex of the second
  EXPECT_EQ(canvas.texel<uint32_t>(55, 23, 1), 1u);
  EXPECT_EQ(canvas.texel<uint32_t>(41, 9, 2), 1u);  // clockwise on the screen: front
  EXPECT_EQ(canvas.texel<uint32_t>(41, 9, 3), 41u + 1000 * 9);
  EXPECT_EQ(canvas.texel<uint32_t>(9, 9, 3), 0u);  // nothing of the first instance
}

TEST_P(Draws, VertexShadersReadWhereTheDrawStarts) {
  Canvas canvas(GetParam(), Format::kR32G32B32A32Uint);
  const PipelineState pipeline = canvas.make(canvas.desc("StartsAt", "Facts"));
  const Buffer indices = CreateUploadBuffer(canvas.device, std::vector<uint16_t>{0, 1, 2}).value();
  const auto id_of = [&](const std::function<void(CommandList&)>& draw) {
    canvas.run([&](CommandList& list) {
      Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
      const IndexBufferView view = {indices.GetGPUVirtualAddress(), 6, Format::kR16Uint};
      list.IASetIndexBuffer(&view);
      draw(list);
    });
    return canvas.texel<uint32_t>(20, 20, 0);
  };
  EXPECT_EQ(id_of([](CommandList& list) { list.DrawInstanced(3, 1, 5, 7); }), 507u);
  EXPECT_EQ(id_of([](CommandList& list) { list.DrawIndexedInstanced(3, 1, 0, 9, 3); }), 903u);
  EXPECT_EQ(id_of([](CommandList& list) { list.DrawIndexedInstanced(3, 1, 0, -2, 3); }), 3u - 200u);
  EXPECT_EQ(id_of([](CommandList& list) { list.DrawInstanced(3, 1, 0, 0); }), 0u);
}

TEST_P(Draws, RAS_61_101_TheNearestWinsInAnyOrder) {
  const PipelineState pipeline = canvas_->make(canvas_->desc("WholeTarget", "Constant"));
  canvas_->run([&](CommandList& list) {
    for (const float z : {0.5f, 0.25f, 0.75f, 0.25f}) {
      // The tint's alpha is the depth; its red says which draw it was.
      Canvas::use(list, pipeline, {z == 0.25f ? 2.0f : 1.0f, 0, 0, z});
      list.DrawInstanced(3, 1, 0, 0);
    }
  });
  EXPECT_EQ(canvas_->texel<float>(5, 40, 0), 2.0f);
  EXPECT_EQ(canvas_->depth(5, 40), 0.25f);
}

TEST_P(Draws, RAS_82_86_DerivativesAreRightBesideDiscardedPixels) {
  const PipelineState pipeline = canvas_->make(canvas_->desc("WholeTarget", "Checkerboard"));
  canvas_->run([&](CommandList& list) {
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  EXPECT_EQ(canvas_->texel<float>(10, 20, 0), 20.5f);  // d(x y)/dx in row 20
  EXPECT_EQ(canvas_->texel<float>(10, 20, 1), 10.5f);
  EXPECT_EQ(canvas_->texel<float>(11, 21, 0), 21.5f);
  EXPECT_EQ(canvas_->texel<float>(11, 21, 1), 11.5f);
  // Coarse: the quad's first row; RAS-83 allows each pixel its own, which lavapipe has.
  const float coarse = canvas_->texel<float>(11, 21, 2);
  EXPECT_TRUE(coarse == 20.5f || (on_vulkan() && coarse == 21.5f)) << coarse;
  EXPECT_EQ(canvas_->texel<float>(11, 20, 3), 0.0f);  // discarded
  EXPECT_EQ(canvas_->depth(11, 20), 1.0f);
  EXPECT_EQ(canvas_->depth(10, 20), 0.5f);
}

TEST_P(Draws, RAS_91_TheLevelOfDetailComesFromTheQuad) {
  // A texture of 256 texels on 64 pixels: level 2, whose texels are 2.
  const Texture texture =
      canvas_->device
          .CreateTexture({.Width = 256, .Height = 256, .MipLevels = 0, .Format = Format::kR32Float})
          .value();
  for (uint32_t mip = 0; mip < 9; ++mip) {
    const uint32_t side = 256u >> mip;
    const std::vector<float> texels(size_t{side} * side, static_cast<float>(mip));
    UploadTexture(canvas_->device, canvas_->queue, texture, mip,
                  std::as_bytes(std::span<const float>(texels)))
        .value();
  }
  canvas_->device.CreateShaderResourceView(texture, canvas_->views.GetCPUDescriptorHandle(0))
      .value();
  const PipelineState pipeline = canvas_->make(canvas_->desc("WholeTarget", "Sampled"));
  canvas_->run([&](CommandList& list) {
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  for (const uint32_t x : {0u, 17u, 63u}) EXPECT_NEAR(canvas_->texel<float>(x, 33), 2.0f, 0.02f);
}

TEST_P(Draws, RAS_85_99_UnorderedAccessesOfCoveredPixelsOnly) {
  const PipelineState pipeline = canvas_->make(canvas_->desc("WholeTarget", "Counted"));
  canvas_->run([&](CommandList& list) {
    list.RSSetScissorRects(Rect{3, 5, 51, 38});
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
    // Behind the first: no test before the shader, since it writes memory.
    Canvas::use(list, pipeline, {1, 1, 1, 0.75f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  EXPECT_EQ(counts()[0], 2u * 48 * 33);
  EXPECT_EQ(counts()[1], 2u * 29 * 33);  // pixels 3 to 31 go on after the discard
}

// Single pixels and columns, so that most lanes are helpers.
TEST_P(Draws, HelpersTakePartInQuadsAndNotInWaves) {
  Canvas canvas(GetParam(), Format::kR32G32B32A32Uint);
  GraphicsPipelineStateDesc desc = canvas.desc("FromBuffers", "Waves");
  desc.InputLayout = layout();
  desc.DepthStencilState.DepthEnable = false;
  const PipelineState waves = canvas.make(desc);
  desc.PS = canvas.desc("FromBuffers", "QuadVotes").PS;
  const PipelineState votes = canvas.make(desc);
  std::vector<Corner> corners;
  const auto rectangle = [&](float left, float top, float right, float bottom) {
    for (const auto& [x, y] : {std::pair(left, top),
                               {right, top},
                               {left, bottom},
                               {right, top},
                               {right, bottom},
                               {left, bottom}}) {
      corners.push_back({{ndc_x(x), ndc_y(y), 0.5f}, {0, 0, 0}});
    }
  };
  rectangle(8, 8, 24, 24);
  rectangle(31, 3, 32, 4);
  rectangle(33, 5, 36, 40);
  rectangle(40, 11, 60, 12);
  constexpr int kCovered = 16 * 16 + 1 + 3 * 35 + 20;
  const Buffer vertices = CreateUploadBuffer(canvas.device, corners).value();
  const Buffer offset = CreateUploadBuffer(canvas.device, std::vector<float>{0, 0}).value();
  for (const bool in_waves : {true, false}) {
    const PipelineState& pipeline = in_waves ? waves : votes;
    canvas.run([&](CommandList& list) {
      Canvas::use(list, pipeline);
      const VertexBufferView views[] = {view(vertices, sizeof(Corner)), view(offset, 8)};
      list.IASetVertexBuffers(0, views);
      list.DrawInstanced(static_cast<uint32_t>(corners.size()), 1, 0, 0);
    });
    int covered = 0;
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        if (canvas.texel<uint32_t>(x, y, 0) == 0) continue;
        ++covered;
        for (uint32_t c = 0; c < 4; ++c) {
          const uint32_t wanted = c == 2 && !in_waves ? 0 : 1;
          EXPECT_EQ(canvas.texel<uint32_t>(x, y, c), wanted) << x << ", " << y << ": " << c;
        }
      }
    }
    EXPECT_EQ(covered, kCovered);
  }
  const auto bytes = ReadbackBuffer(canvas.device, canvas.queue, canvas.counter).value();
  uint32_t counted = 0;
  std::memcpy(&counted, bytes.data(), sizeof counted);
  EXPECT_EQ(counted, kCovered);
}

TEST_P(Draws, CoverageIsOfOneSample) {
  Canvas canvas(GetParam(), Format::kR32G32B32A32Uint);
  GraphicsPipelineStateDesc desc = canvas.desc("FromBuffers", "EvenColumns");
  desc.InputLayout = layout();
  const PipelineState pipeline = canvas.make(desc);
  std::vector<Corner> corners;
  // Column 19 is the last one, whose quad is covered; the right half of column 11's is not.
  for (const auto& [left, right] : {std::pair(4.0f, 11.0f), {14.0f, 20.0f}}) {
    for (const auto& [x, y] : {std::pair(left, 4.0f),
                               {right, 4.0f},
                               {left, 8.0f},
                               {right, 4.0f},
                               {right, 8.0f},
                               {left, 8.0f}}) {
      corners.push_back({{ndc_x(x), ndc_y(y), 0.5f}, {0, 0, 0}});
    }
  }
  const Buffer vertices = CreateUploadBuffer(canvas.device, corners).value();
  const Buffer offset = CreateUploadBuffer(canvas.device, std::vector<float>{0, 0}).value();
  canvas.run([&](CommandList& list) {
    Canvas::use(list, pipeline);
    const VertexBufferView views[] = {view(vertices, sizeof(Corner)), view(offset, 8)};
    list.IASetVertexBuffers(0, views);
    list.DrawInstanced(static_cast<uint32_t>(corners.size()), 1, 0, 0);
  });
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const bool covered = y >= 4 && y < 8 && ((x >= 4 && x < 11) || (x >= 14 && x < 20));
      const bool stays = covered && x % 2 == 0;
      EXPECT_EQ(canvas.depth(x, y), stays ? 0.5f : 1.0f) << x << ", " << y;
      EXPECT_EQ(canvas.texel<uint32_t>(x, y, 0), stays ? 1u : 0u) << x << ", " << y;
      EXPECT_EQ(canvas.texel<uint32_t>(x, y, 1), stays ? 1u : 0u) << x << ", " << y;
    }
  }
  // Inside, both pixels of a row are covered; at column 10 the other one is a helper. The edge that
  // the triangles of a rectangle share is not looked at.
  EXPECT_EQ(canvas.texel<uint32_t>(10, 7, 2), 0u);
  EXPECT_EQ(canvas.texel<uint32_t>(10, 7, 3), 1u);
  EXPECT_EQ(canvas.texel<uint32_t>(4, 4, 2), 1u);
  EXPECT_EQ(canvas.texel<uint32_t>(4, 4, 3), 0u);
  const auto bytes = ReadbackBuffer(canvas.device, canvas.queue, canvas.counter).value();
  uint32_t counted = 0;
  std::memcpy(&counted, bytes.data(), sizeof counted);
  EXPECT_EQ(counted, 4u * (7 + 6));
}

TEST_P(Draws, RAS_120_BlendingInTheOrderOfDraws) {
  GraphicsPipelineStateDesc desc = canvas_->desc("WholeTarget", "Constant");
  desc.DepthStencilState.DepthEnable = false;
  RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
  blend.BlendEnable = true;
  blend.SrcBlend = Blend::kSrcAlpha;
  blend.DestBlend = Blend::kInvSrcAlpha;
  const PipelineState pipeline = canvas_->make(desc);
  canvas_->run([&](CommandList& list) {
    for (const float red : {1.0f, 0.0f, 3.0f}) {
      Canvas::use(list, pipeline, {red, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    }
  });
  // ((0 + 1) / 2 + 0) / 2 = 0.25; (0.25 + 3) / 2.
  EXPECT_EQ(canvas_->texel<float>(31, 31, 0), 1.625f);
}

TEST_P(Draws, RAS_145_IndirectDraws) {
  GraphicsPipelineStateDesc desc = canvas_->desc("WholeTarget", "Constant");
  desc.DepthStencilState.DepthEnable = false;
  RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
  blend.BlendEnable = true;
  blend.DestBlend = Blend::kOne;
  const PipelineState pipeline = canvas_->make(desc);
  const CommandSignature signature =
      canvas_->device
          .CreateCommandSignature(
              {.ByteStride = 20,
               .ArgumentDescs = {{.Type = IndirectArgumentType::kConstant, .Constant = {0, 0, 1}},
                                 {.Type = IndirectArgumentType::kDraw}}},
              canvas_->root_signature)
          .value();
  std::vector<uint32_t> arguments;
  for (const float red : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
    for (const uint32_t word : {std::bit_cast<uint32_t>(red), red == 2.0f ? 0u : 3u, 1u, 0u, 0u}) {
      arguments.push_back(word);
    }
  }
  const Buffer buffer = upload(arguments);
  const Buffer count = upload(std::vector<uint32_t>{3});
  canvas_->run([&](CommandList& list) {
    Canvas::use(list, pipeline, {0, 0, 0, 0.5f});
    list.ExecuteIndirect(signature, 5, buffer, 0, count, 0);
  });
  EXPECT_EQ(canvas_->texel<float>(10, 10, 0), 5.0f);  // 1 + 4; the second draws no vertices
}

TEST_P(Draws, DepthIsReadByTheNextPass) {
  const PipelineState depth_only = canvas_->make(canvas_->desc("WholeTarget", ""));
  GraphicsPipelineStateDesc desc = canvas_->desc("WholeTarget", "Fetched");
  desc.DepthStencilState.DepthEnable = false;
  desc.DSVFormat = Format::kUnknown;
  const PipelineState shade = canvas_->make(desc);
  canvas_->device
      .CreateShaderResourceView(
          Resource(canvas_->depth_buffer),
          {.Format = Format::kR32Float, .ViewDimension = SrvDimension::kTexture2D},
          canvas_->views.GetCPUDescriptorHandle(0))
      .value();
  canvas_->run([&](CommandList& list) {
    list.RSSetScissorRects(Rect{0, 0, 32, 64});
    Canvas::use(list, depth_only, {1, 1, 1, 0.375f});
    list.DrawInstanced(3, 1, 0, 0);
    list.ResourceBarrier(ResourceBarrier::Transition(
        canvas_->depth_buffer, ResourceStates::kDepthWrite, ResourceStates::kPixelShaderResource));
    const CpuDescriptorHandle target = canvas_->rtvs.GetCPUDescriptorHandle(0);
    list.OMSetRenderTargets(1, &target);
    list.RSSetScissorRects(Rect{0, 0, 64, 64});
    Canvas::use(list, shade, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
    list.ResourceBarrier(ResourceBarrier::Transition(
        canvas_->depth_buffer, ResourceStates::kPixelShaderResource, ResourceStates::kDepthWrite));
  });
  EXPECT_EQ(canvas_->texel<float>(31, 50, 0), 0.375f);
  EXPECT_EQ(canvas_->texel<float>(32, 50, 0), 1.0f);
}

TEST_P(Draws, RAS_108_PixelShadersTraceRays) {
  // A triangle in the plane z = 1 that covers the pixels with x + y < 64.
  const std::vector<float> corners = {-1, -1, 1, 1, -1, 1, -1, 1, 1};
  const Buffer vertices = upload(corners);
  RaytracingGeometryDesc geometry;
  geometry.Type = RaytracingGeometryType::kTriangles;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = 3;
  geometry.Triangles.VertexBuffer = {vertices.GetGPUVirtualAddress(), 12};
  const Buffer bottom = test::build_bottom_level(canvas_->device, canvas_->queue, {geometry});
  RaytracingInstanceDesc instance = {};
  instance.Transform[0][0] = instance.Transform[1][1] = instance.Transform[2][2] = 1;
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom.GetGPUVirtualAddress();
  const Buffer top = test::build_top_level(canvas_->device, canvas_->queue, {instance});
  const PipelineState pipeline = canvas_->make(canvas_->desc("WholeTarget", "Traced"));
  canvas_->run([&](CommandList& list) {
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.SetGraphicsRootShaderResourceView(2, top.GetGPUVirtualAddress());
    list.DrawInstanced(3, 1, 0, 0);
  });
  for (uint32_t y = 0; y < kSize; y += 3) {
    for (uint32_t x = 0; x < kSize; x += 3) {
      if (x + y + 1 == 64) continue;  // the ray goes through the edge
      const bool hit = x + y + 1 < 64;
      ASSERT_EQ(canvas_->texel<float>(x, y, 3), hit ? 1.0f : 0.0f) << x << ", " << y;
      if (!hit) continue;
      EXPECT_EQ(canvas_->texel<float>(x, y, 0), 2.0f);
      EXPECT_NEAR(canvas_->texel<float>(x, y, 1), (static_cast<float>(x) + 0.5f) / 64, 1e-6f);
    }
  }
}

TEST(DrawThreads, RAS_149_ResultsDoNotDependOnThreads) {
  std::vector<float> of_one_thread;
  for (const uint32_t threads : {1u, 2u, 3u, 7u}) {
    Canvas canvas("embree", Format::kR32G32B32A32Float, threads);
    GraphicsPipelineStateDesc desc = canvas.desc("WholeTarget", "Constant");
    desc.DepthStencilState.DepthEnable = false;
    RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
    blend.BlendEnable = true;
    blend.SrcBlend = Blend::kSrcAlpha;
    blend.DestBlend = Blend::kInvSrcAlpha;
    const PipelineState pipeline = canvas.make(desc);
    canvas.run([&](CommandList& list) {
      for (int i = 0; i < 100; ++i) {
        list.RSSetScissorRects(Rect{i % 40, i % 17, 64 - i % 23, 64});
        Canvas::use(list, pipeline,
                    {static_cast<float>(i) * 0.37f, 1, 0, static_cast<float>(i % 7) / 10});
        list.DrawInstanced(3, 1, 0, 0);
      }
    });
    std::vector<float> texels;
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) texels.push_back(canvas.texel<float>(x, y));
    }
    if (of_one_thread.empty()) of_one_thread = texels;
    EXPECT_EQ(texels, of_one_thread) << threads << " threads";
  }
}

// Clears in front of a pass: of a target that is written, of one that is only bound and is smaller,
// and of depth; and again in front of a pass without the smaller one.
TEST_P(Draws, ClearsReachWhatDrawsDoNot) {
  constexpr uint32_t kWidth = 200, kHeight = 150;
  const auto texture = [&](uint32_t width, uint32_t height, Format format, bool depth) {
    return canvas_->device
        .CreateTexture(
            {.Width = width,
             .Height = height,
             .Format = format,
             .Flags = depth ? ResourceFlags::kAllowDepthStencil : ResourceFlags::kAllowRenderTarget,
             .InitialState = depth ? ResourceStates::kDepthWrite : ResourceStates::kRenderTarget})
        .value();
  };
  const Texture written = texture(kWidth, kHeight, Format::kR32G32B32A32Float, false);
  const Texture bound = texture(130, 70, Format::kR32G32B32A32Float, false);
  const Texture depth = texture(kWidth, kHeight, Format::kR32Typeless, true);
  const auto heap = [&](DescriptorHeapType type, uint32_t count) {
    return canvas_->device.CreateDescriptorHeap({.Type = type, .NumDescriptors = count}).value();
  };
  const DescriptorHeap rtvs = heap(DescriptorHeapType::kRtv, 2);
  const DescriptorHeap dsvs = heap(DescriptorHeapType::kDsv, 1);
  const CpuDescriptorHandle targets[2] = {rtvs.GetCPUDescriptorHandle(0),
                                          rtvs.GetCPUDescriptorHandle(1)};
  const CpuDescriptorHandle dsv = dsvs.GetCPUDescriptorHandle(0);
  canvas_->device.CreateRenderTargetView(written, targets[0]).value();
  canvas_->device.CreateRenderTargetView(bound, targets[1]).value();
  canvas_->device.CreateDepthStencilView(depth, dsv).value();

  GraphicsPipelineStateDesc desc = canvas_->desc("WholeTarget", "Constant");
  const PipelineState pipeline = canvas_->make(desc);
  for (const uint32_t count : {2u, 1u}) {
    const float color = static_cast<float>(count);
    canvas_->run([&](CommandList& list) {
      for (uint32_t i = 0; i < count; ++i) {
        const float clear[4] = {color, 0, 0, static_cast<float>(i)};
        list.ClearRenderTargetView(targets[i], clear);
      }
      list.ClearDepthStencilView(dsv, ClearFlags::kDepth, 0.25f * color, 0);
      list.OMSetRenderTargets(count, targets, false, &dsv);
      list.RSSetViewports(Viewport{10, 20, 5, 4, 0, 1});
      Canvas::use(list, pipeline, {9, 9, 9, 0.125f});
      list.DrawInstanced(3, 1, 0, 0);
    });
    const auto texels = [&](const Texture& of) {
      return ReadbackTexture(canvas_->device, canvas_->queue, of, 0).value();
    };
    const auto float_at = [](const std::vector<std::byte>& bytes, size_t number) {
      float value;
      std::memcpy(&value, bytes.data() + number * sizeof value, sizeof value);
      return value;
    };
    const auto of_written = texels(written);
    const auto of_depth = texels(depth);
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      const uint32_t x = i % kWidth, y = i / kWidth;
      const bool drawn = x >= 10 && x < 15 && y >= 20 && y < 24;
      ASSERT_EQ(float_at(of_written, size_t{4} * i), drawn ? 9 : color) << x << ' ' << y;
      ASSERT_EQ(float_at(of_depth, i), drawn ? 0.125f : 0.25f * color) << x << ' ' << y;
    }
    const auto of_bound = texels(bound);
    for (size_t i = 0; i < size_t{130} * 70; ++i) {
      ASSERT_EQ(float_at(of_bound, 4 * i), 2) << i;
      ASSERT_EQ(float_at(of_bound, 4 * i + 3), 1) << i;
    }
  }
}

}  // namespace
}  // namespace kaamos::draws
