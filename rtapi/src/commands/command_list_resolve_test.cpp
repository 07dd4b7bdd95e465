// SPDX-License-Identifier: MIT
//
// Multisampled textures: what may have samples, how they are viewed, copied and resolved.
#include "rtapi/testing/graphics_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;

class MultisampleTest : public GraphicsTest {
 protected:
  static TextureDesc Desc(uint32_t samples, Format format = Format::kR8G8B8A8Unorm) {
    return {.Width = 8,
            .Height = 4,
            .DepthOrArraySize = 2,
            .MipLevels = 1,
            .Format = format,
            .SampleDesc = {samples, 0},
            .Flags = IsDepthFormat(format) ? ResourceFlags::kAllowDepthStencil
                                           : ResourceFlags::kAllowRenderTarget,
            .Name = samples > 1 ? "many" : "one"};
  }
  Texture Make(const TextureDesc& desc) { return device_.CreateTexture(desc).value(); }
  Status Refused(const TextureDesc& desc) {
    auto made = device_.CreateTexture(desc);
    return made.ok() ? Status() : Status(made.error());
  }
};

TEST_F(MultisampleTest, TargetsHaveTheCountsOfTheBackend) {
  EXPECT_EQ(device_.GetMultisampleQualityLevels(Format::kR8G8B8A8Unorm, 0), 0u);
  EXPECT_EQ(device_.GetMultisampleQualityLevels(Format::kR8G8B8A8Unorm, 1), 1u);
  EXPECT_EQ(device_.GetMultisampleQualityLevels(Format::kR8G8B8A8Unorm, 4), 1u);
  EXPECT_EQ(device_.GetMultisampleQualityLevels(Format::kR8G8B8A8Unorm, 8), 0u);
  EXPECT_EQ(device_.GetMultisampleQualityLevels(Format::kR9G9B9E5Sharedexp, 4), 0u);
  EXPECT_OK(Refused(Desc(4)));
  EXPECT_OK(Refused(Desc(4, Format::kD32Float)));
  EXPECT_ERROR(Refused(Desc(2)), "KA0573", "\"many\" has 2 samples", "has 1, 4");
  EXPECT_ERROR(Refused(Desc(0)), "KA0573", "SampleDesc {0, 0}");
  TextureDesc desc = Desc(4);
  desc.SampleDesc.Quality = 0xFFFFFFFFu;  // the standard pattern
  EXPECT_OK(Refused(desc));
  desc.SampleDesc.Quality = 1;
  EXPECT_ERROR(Refused(desc), "KA0573", "SampleDesc {4, 1}");
  desc = Desc(1);
  desc.SampleDesc.Quality = 0xFFFFFFFFu;
  EXPECT_ERROR(Refused(desc), "KA0573");
}

TEST_F(MultisampleTest, OnlyTargetsWithOneMipHaveSamples) {
  const auto refused = [&](const auto& change) {
    TextureDesc desc = Desc(4);
    change(desc);
    return Refused(desc);
  };
  EXPECT_ERROR(refused([](auto& d) { d.MipLevels = 2; }), "KA0573", "2 mip levels");
  EXPECT_ERROR(refused([](auto& d) { d.Flags = ResourceFlags::kNone; }), "KA0573",
               "neither kAllowRenderTarget");
  EXPECT_ERROR(refused([](auto& d) { d.Flags = d.Flags | ResourceFlags::kAllowUnorderedAccess; }),
               "KA0573", "kAllowUnorderedAccess");
  EXPECT_ERROR(refused([](auto& d) {
                 d.Dimension = ResourceDimension::kTexture3D;
                 d.Flags = ResourceFlags::kNone;
               }),
               "KA0573", "kTexture2D");
  TextureDesc desc = Desc(4);
  desc.MipLevels = 0;
  EXPECT_EQ(Make(desc).GetDesc().MipLevels, 1);
  std::vector<PlacedSubresourceFootprint> layouts;
  EXPECT_ERROR(device_.GetCopyableFootprints(Desc(4), 0, 1, 0, &layouts), "KA0574");
}

TEST_F(MultisampleTest, ViewsSayWhetherThereAreSamples) {
  const Texture many = Make(Desc(4));
  const Texture one = Make(Desc(1));
  const DescriptorHeap rtvs =
      device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  const DescriptorHeap srvs = device_.CreateDescriptorHeap({.NumDescriptors = 1}).value();
  const auto rtv = [&](const Texture& texture, RtvDimension dimension) {
    RenderTargetViewDesc desc;
    desc.ViewDimension = dimension;
    return device_.CreateRenderTargetView(texture, desc, rtvs.GetCPUDescriptorHandle(0));
  };
  EXPECT_OK(rtv(many, RtvDimension::kUnknown));
  EXPECT_OK(rtv(many, RtvDimension::kTexture2DMS));
  EXPECT_OK(rtv(many, RtvDimension::kTexture2DMSArray));
  EXPECT_ERROR(rtv(many, RtvDimension::kTexture2D), "KA0574", "\"many\" has 4 samples");
  EXPECT_ERROR(rtv(one, RtvDimension::kTexture2DMSArray), "KA0574", "\"one\" has 1 samples");
  EXPECT_ERROR(rtv(one, RtvDimension::kTexture3D), "KA0730", "\"one\" is a 2-D texture");
  EXPECT_ERROR(rtv(one, static_cast<RtvDimension>(9)), "KA0730", "2 to 8");
  const auto srv = [&](const Texture& texture, SrvDimension dimension) {
    ShaderResourceViewDesc desc;
    desc.ViewDimension = dimension;
    return device_.CreateShaderResourceView(texture, desc, srvs.GetCPUDescriptorHandle(0));
  };
  EXPECT_OK(srv(many, SrvDimension::kTexture2DMS));
  EXPECT_EQ(null_log().texture_views.back().slice_count, 1u);
  EXPECT_OK(srv(many, SrvDimension::kTexture2DMSArray));
  EXPECT_EQ(null_log().texture_views.back().slice_count, 2u);
  EXPECT_OK(device_.CreateShaderResourceView(many, srvs.GetCPUDescriptorHandle(0)));
  EXPECT_EQ(null_log().texture_views.back().dimension, SrvDimension::kTexture2DMSArray);
  EXPECT_ERROR(srv(many, SrvDimension::kTexture2DArray), "KA0574", "one with MS");
  EXPECT_ERROR(srv(one, SrvDimension::kTexture2DMS), "KA0574", "one without MS");
}

TEST_F(MultisampleTest, CopiesAreBetweenTexturesWithAsManySamples) {
  const Texture many = Make(Desc(4));
  const Texture other = Make(Desc(4));
  const Texture one = Make(Desc(1));
  EXPECT_OK(Record([&](CommandList& l) { l.CopyResource(other, many); }));
  EXPECT_ERROR(Record([&](CommandList& l) { l.CopyResource(one, many); }), "KA0574",
               "\"many\" has 4 samples", "\"one\" has 1");
  const Box box = {0, 0, 0, 4, 4, 1};
  EXPECT_OK(Record([&](CommandList& l) {
    l.CopyTextureRegion({other, 0}, 4, 0, 0, {many, 0}, &box);
  }));
}

TEST_F(MultisampleTest, ResolvesReduceAnElementToOneSample) {
  const Texture many = Make(Desc(4));
  const Texture one = Make(Desc(1));
  CommandList list = device_.CreateCommandList().value();
  list.ResolveSubresource(one, 1, many, 0, Format::kR8G8B8A8Unorm);
  const Rect rect = {2, 1, 5, 3};
  list.ResolveSubresourceRegion(one, 0, 4, 2, many, 1, &rect, Format::kR8G8B8A8Unorm,
                                ResolveMode::kAverage);
  const Rect empty = {2, 1, 2, 3};
  list.ResolveSubresourceRegion(one, 0, 0, 0, many, 1, &empty, Format::kR8G8B8A8Unorm,
                                ResolveMode::kAverage);
  EXPECT_OK(list.Close());
  ASSERT_TRUE(device_.CreateCommandQueue().value().ExecuteAndWait(list).ok());
  const auto& executed = null_log().executed;
  ASSERT_EQ(executed.size(), 2u);
  const auto& whole = std::get<runtime::ResolveCommand>(executed[0]);
  EXPECT_EQ(whole.dest.array_element, 1u);
  EXPECT_EQ(whole.source.array_element, 0u);
  EXPECT_EQ(whole.extent[0], 8u);
  EXPECT_EQ(whole.extent[1], 4u);
  const auto& part = std::get<runtime::ResolveCommand>(executed[1]);
  EXPECT_EQ(part.source.origin[0], 2u);
  EXPECT_EQ(part.source.origin[1], 1u);
  EXPECT_EQ(part.dest.origin[0], 4u);
  EXPECT_EQ(part.dest.origin[1], 2u);
  EXPECT_EQ(part.extent[0], 3u);
  EXPECT_EQ(part.extent[1], 2u);
}

TEST_F(MultisampleTest, ResolvesThatMakeNoSenseAreRefused) {
  const Texture many = Make(Desc(4));
  const Texture one = Make(Desc(1));
  TextureDesc larger_desc = Desc(1);
  larger_desc.Width = 16;
  const Texture larger = Make(larger_desc);
  const auto resolve = [&](const Texture& dest, uint32_t dest_index, const Texture& source,
                           uint32_t source_index, Format format = Format::kR8G8B8A8Unorm) {
    return Record([&](CommandList& l) {
      l.ResolveSubresource(dest, dest_index, source, source_index, format);
    });
  };
  EXPECT_ERROR(resolve(one, 0, one, 1), "KA0575", "\"one\" has 1 samples");
  EXPECT_ERROR(resolve(many, 0, many, 1), "KA0575", "the destination one");
  EXPECT_ERROR(resolve(larger, 0, many, 0), "KA0575", "8x4", "16x4");
  EXPECT_ERROR(resolve(one, 2, many, 0), "KA0817", "subresource 2");
  EXPECT_ERROR(resolve(one, 0, many, 2), "KA0817", "subresource 2");
  EXPECT_ERROR(resolve({}, 0, many, 0), "KA0904", "dest");
  EXPECT_ERROR(resolve(one, 0, many, 0, Format::kR32Float), "KA0575", "family of both");
  EXPECT_ERROR(resolve(one, 0, many, 0, Format::kR8G8B8A8Uint), "KA0575", "no average");
  const auto region = [&](uint32_t x, const Rect* rect, ResolveMode mode) {
    return Record([&](CommandList& l) {
      l.ResolveSubresourceRegion(one, 0, x, 0, many, 0, rect, Format::kR8G8B8A8Unorm, mode);
    });
  };
  const Rect outside = {4, 0, 9, 4};
  const Rect half = {0, 0, 4, 4};
  EXPECT_OK(region(4, &half, ResolveMode::kAverage));
  EXPECT_ERROR(region(5, &half, ResolveMode::kAverage), "KA0817", "do not fit at (5, 0)");
  EXPECT_ERROR(region(0, &outside, ResolveMode::kAverage), "KA0817", "(4, 0) to (9, 4)");
  EXPECT_ERROR(region(0, nullptr, ResolveMode::kDecompress), "KA0575", "as many");
  EXPECT_ERROR(region(0, nullptr, static_cast<ResolveMode>(4)), "KA0575", "mode 4");
  EXPECT_ERROR(region(0, nullptr, ResolveMode::kMin), "KA0575", "mode 1");  // as on Vulkan
}

TEST_F(MultisampleTest, SamplesAreDecompressedBesideThemselves) {
  const Texture many = Make(Desc(4));
  const Texture other = Make(Desc(4));
  const auto decompress = [&](const Texture& dest, uint32_t x, const Rect* rect) {
    return Record([&](CommandList& l) {
      l.ResolveSubresourceRegion(dest, 0, x, 0, many, 0, rect, Format::kR8G8B8A8Unorm,
                                 ResolveMode::kDecompress);
    });
  };
  const Rect half = {0, 0, 4, 4};
  EXPECT_OK(decompress(other, 0, nullptr));
  EXPECT_OK(decompress(many, 0, nullptr));  // where it is
  EXPECT_OK(decompress(many, 4, &half));
  EXPECT_ERROR(decompress(many, 3, &half), "KA0818", "(0, 0) overlap those at (3, 0)");
}

TEST_F(MultisampleTest, PipelinesAndTargetsHaveOneCount) {
  GraphicsPipelineStateDesc desc = GraphicsTest::Desc();
  desc.SampleDesc = {2, 0};
  EXPECT_ERROR(GraphicsTest::Make(desc), "KA0573", "2 samples");
  desc.SampleDesc = {4, 1};
  EXPECT_ERROR(GraphicsTest::Make(desc), "KA0573", "{4, 1}");
  desc.SampleDesc = {4, 0};
  desc.BlendState.AlphaToCoverageEnable = true;
  EXPECT_OK(GraphicsTest::Make(desc));
  EXPECT_EQ(Linked().samples, 4u);
  EXPECT_TRUE(Linked().alpha_to_coverage);
  const Texture many = Make(Desc(4));
  const Texture one = Make(Desc(1));
  const DescriptorHeap rtvs =
      device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 2}).value();
  const CpuDescriptorHandle handles[] = {rtvs.GetCPUDescriptorHandle(0),
                                         rtvs.GetCPUDescriptorHandle(1)};
  device_.CreateRenderTargetView(many, handles[0]).value();
  device_.CreateRenderTargetView(one, handles[1]).value();
  EXPECT_ERROR(Record([&](CommandList& l) { l.OMSetRenderTargets(2, handles); }), "KA0574",
               "of 4 and of 1");
  const PipelineState pipeline = device_.CreateGraphicsPipelineState(desc).value();
  const auto draw = [&](CpuDescriptorHandle target) {
    return Record([&](CommandList& l) {
      l.SetGraphicsRootSignature(desc.pRootSignature);
      l.SetPipelineState(pipeline);
      l.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
      l.OMSetRenderTargets(1, &target);
      l.DrawInstanced(3, 1, 0, 0);
    });
  };
  EXPECT_OK(draw(handles[0]));
  EXPECT_ERROR(draw(handles[1]), "KA0574", "render target 0 has 1 samples", "Count 4");
}

}  // namespace
}  // namespace rtapi::testing
