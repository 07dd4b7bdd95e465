// SPDX-License-Identifier: MIT
//
// Enhanced barriers: what goes together. [D3D12: Enhanced Barriers]
#include "rtapi/testing/command_list_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;
using Sync = BarrierSync;
using Access = BarrierAccess;
using Layout = BarrierLayout;

class EnhancedBarriers : public CommandListTest {
 protected:
  template <class Barrier>
  Status record(const Barrier& barrier) {
    return Record([&](CommandList& list) { list.Barrier(barrier); });
  }
  Texture texture(ResourceFlags flags, uint16_t mips = 3, uint16_t layers = 4) {
    TextureDesc desc;
    desc.Width = 16;
    desc.Height = 16;
    desc.DepthOrArraySize = layers;
    desc.MipLevels = mips;
    desc.Format =
        HasAny(flags, ResourceFlags::kAllowDepthStencil) ? Format::kD32Float : Format::kR32Float;
    desc.Flags = flags;
    desc.Name = "tex";
    return device_.CreateTexture(desc).value();
  }
  static GlobalBarrier scopes(Sync before, Access from, Sync after, Access to) {
    return {before, after, from, to};
  }
  static GlobalBarrier nothing() {
    return scopes(Sync::kNone, Access::kNoAccess, Sync::kNone, Access::kNoAccess);
  }
};

TEST_F(EnhancedBarriers, AnAccessNeedsWorkThatMakesIt) {
  struct Case {
    Access access;
    Sync fits;
    Sync fits_not;
  };
  const Case cases[] = {
      {Access::kVertexBuffer, Sync::kVertexShading, Sync::kPixelShading},
      {Access::kConstantBuffer, Sync::kPixelShading, Sync::kCopy},
      {Access::kIndexBuffer, Sync::kIndexInput, Sync::kVertexShading},
      {Access::kRenderTarget, Sync::kRenderTarget, Sync::kPixelShading},
      {Access::kUnorderedAccess, Sync::kClearUnorderedAccessView, Sync::kCopy},
      {Access::kDepthStencilWrite, Sync::kDepthStencil, Sync::kRenderTarget},
      {Access::kDepthStencilRead, Sync::kDraw, Sync::kPixelShading},
      {Access::kShaderResource, Sync::kBuildAccelerationStructure, Sync::kCopy},
      {Access::kIndirectArgument, Sync::kExecuteIndirect, Sync::kDraw},
      {Access::kCopyDest, Sync::kCopy, Sync::kResolve},
      {Access::kCopySource, Sync::kCopy, Sync::kComputeShading},
      {Access::kResolveDest, Sync::kResolve, Sync::kCopy},
      {Access::kResolveSource, Sync::kResolve, Sync::kDraw},
      {Access::kAccelerationStructureRead, Sync::kRaytracing, Sync::kCopy},
      {Access::kAccelerationStructureWrite, Sync::kCopyAccelerationStructure,
       Sync::kEmitPostbuildInfo},
  };
  for (const Case& one : cases) {
    EXPECT_OK(record(scopes(Sync::kAll, one.access, one.fits, one.access)));
    EXPECT_OK(record(scopes(one.fits | Sync::kCopy, one.access, Sync::kAll, one.access)));
    EXPECT_ERROR(record(scopes(Sync::kAll, one.access, one.fits_not, one.access)), "KA0858",
                 "AccessAfter");
    EXPECT_ERROR(record(scopes(one.fits_not, one.access, Sync::kAll, one.access)), "KA0858",
                 "AccessBefore");
  }
}

TEST_F(EnhancedBarriers, BitsThatStandAlone) {
  EXPECT_OK(record(GlobalBarrier{}));
  EXPECT_OK(record(nothing()));
  EXPECT_ERROR(record(scopes(Sync::kNone, Access::kCommon, Sync::kAll, Access::kCommon)), "KA0858",
               "SyncBefore 0x0 goes with kNoAccess");
  EXPECT_ERROR(record(scopes(Sync::kAll, Access::kNoAccess | Access::kCopyDest, Sync::kAll,
                             Access::kCommon)),
               "KA0858", "kNoAccess stands alone");
  EXPECT_ERROR(record(scopes(Sync::kAll, Access::kCommon, Sync::kSplit, Access::kCommon)), "KA0858",
               "a global barrier cannot be split");
  EXPECT_ERROR(
      record(scopes(static_cast<Sync>(0x10000), Access::kCommon, Sync::kAll, Access::kCommon)),
      "KA0858", "SyncBefore 0x10000");
  EXPECT_ERROR(
      record(scopes(Sync::kAll, Access::kCommon, Sync::kAll, static_cast<Access>(0x10000))),
      "KA0858", "AccessAfter 0x10000");
}

TEST_F(EnhancedBarriers, OfBuffers) {
  const auto make = [&](const Buffer& buffer, Access access) {
    return BufferBarrier{scopes(Sync::kAll, access, Sync::kAll, access), buffer};
  };
  const Buffer plain = MakeBuffer(64, HeapType::kDefault, "buf");
  const Buffer writable =
      MakeBuffer(64, HeapType::kDefault, "uav", ResourceFlags::kAllowUnorderedAccess);
  EXPECT_OK(record(make(plain, Access::kCopyDest | Access::kVertexBuffer)));
  EXPECT_ERROR(record(make(plain, Access::kUnorderedAccess)), "KA0858", "kUnorderedAccess");
  EXPECT_OK(record(make(writable, Access::kUnorderedAccess)));
  EXPECT_ERROR(record(make(plain, Access::kRenderTarget)), "KA0858", "\"buf\"");
  EXPECT_ERROR(record(make(writable, Access::kAccelerationStructureRead)), "KA0858",
               "kAccelerationStructureRead");
  EXPECT_ERROR(record(make(MakeBuffer(64, HeapType::kUpload), Access::kCopyDest)), "KA0858",
               "kCopyDest");
  EXPECT_OK(record(make(MakeBuffer(64, HeapType::kReadback), Access::kCopyDest)));
  EXPECT_ERROR(record(make({}, Access::kCopyDest)), "KA0904");
  BufferBarrier piece = make(plain, Access::kCopyDest);
  piece.Size = 64;
  EXPECT_OK(record(piece));
  piece.Size = 32;
  EXPECT_ERROR(record(piece), "KA0858", "Offset 0, Size 32");
  const Buffer structure =
      device_
          .CreateBuffer({.SizeInBytes = 256,
                         .Flags = ResourceFlags::kAllowUnorderedAccess,
                         .InitialState = ResourceStates::kRaytracingAccelerationStructure})
          .value();
  EXPECT_OK(record(make(structure, Access::kAccelerationStructureWrite)));
  EXPECT_ERROR(record(make(structure, Access::kCopyDest)), "KA0858", "kCopyDest");
}

TEST_F(EnhancedBarriers, LayoutsAllowAccesses) {
  struct Case {
    Layout layout;
    Access allowed;
    ResourceFlags flags;
  };
  const auto none = ResourceFlags::kNone;
  const auto uav = ResourceFlags::kAllowUnorderedAccess;
  const auto common = Access::kShaderResource | Access::kCopySource | Access::kCopyDest;
  const Case cases[] = {
      {Layout::kCommon, common, none},
      {Layout::kGenericRead, Access::kShaderResource | Access::kCopySource, none},
      {Layout::kRenderTarget, Access::kRenderTarget, ResourceFlags::kAllowRenderTarget},
      {Layout::kUnorderedAccess, Access::kUnorderedAccess, uav},
      {Layout::kDepthStencilWrite, Access::kDepthStencilWrite | Access::kDepthStencilRead,
       ResourceFlags::kAllowDepthStencil},
      {Layout::kDepthStencilRead, Access::kDepthStencilRead, ResourceFlags::kAllowDepthStencil},
      {Layout::kShaderResource, Access::kShaderResource, none},
      {Layout::kCopySource, Access::kCopySource, none},
      {Layout::kCopyDest, Access::kCopyDest, none},
      {Layout::kResolveSource, Access::kResolveSource, none},
      {Layout::kResolveDest, Access::kResolveDest, none},
      {Layout::kDirectQueueCommon, common, none},
      {Layout::kDirectQueueCommon, common | Access::kUnorderedAccess, uav},
      {Layout::kDirectQueueUnorderedAccess, Access::kUnorderedAccess, uav},
      {Layout::kComputeQueueShaderResource, Access::kShaderResource, none},
  };
  constexpr Access kEach[] = {
      Access::kVertexBuffer,     Access::kRenderTarget,     Access::kUnorderedAccess,
      Access::kShaderResource,   Access::kDepthStencilRead, Access::kDepthStencilWrite,
      Access::kCopyDest,         Access::kCopySource,       Access::kResolveDest,
      Access::kIndirectArgument, Access::kResolveSource,    Access::kAccelerationStructureRead};
  for (const Case& one : cases) {
    for (const Access access : kEach) {
      const TextureBarrier barrier = {scopes(Sync::kAll, access, Sync::kAll, access), one.layout,
                                      one.layout, texture(one.flags)};
      if (HasAny(one.allowed, access)) {
        EXPECT_OK(record(barrier));
      } else {
        EXPECT_ERROR(record(barrier), "KA0858", "LayoutBefore");
      }
    }
  }
  for (const Layout layout : {Layout::kRenderTarget, Layout::kUnorderedAccess,
                              Layout::kDepthStencilWrite, Layout::kDepthStencilRead}) {
    EXPECT_ERROR(record(TextureBarrier{nothing(), Layout::kCommon, layout, texture(none)}),
                 "KA0858", "needs ResourceFlags");
  }
  for (const uint32_t odd : {12u, 17u, 30u}) {  // shading rates, video, and none
    EXPECT_ERROR(
        record(TextureBarrier{nothing(), Layout::kCommon, static_cast<Layout>(odd), texture(none)}),
        "KA0858", "is not defined, or is one of video");
  }
}

TEST_F(EnhancedBarriers, UndefinedLayoutsAndDiscards) {
  const Texture target = texture(ResourceFlags::kAllowRenderTarget);
  TextureBarrier barrier = {
      scopes(Sync::kNone, Access::kNoAccess, Sync::kRenderTarget, Access::kRenderTarget),
      Layout::kUndefined, Layout::kRenderTarget, target};
  EXPECT_OK(record(barrier));
  barrier.Flags = TextureBarrierFlags::kDiscard;
  EXPECT_OK(record(barrier));
  barrier.LayoutBefore = Layout::kCommon;
  EXPECT_ERROR(record(barrier), "KA0858", "kDiscard goes with LayoutBefore kUndefined");
  barrier.Flags = static_cast<TextureBarrierFlags>(2);
  EXPECT_ERROR(record(barrier), "KA0858", "Flags 0x2");
  EXPECT_ERROR(record(TextureBarrier{
                   scopes(Sync::kCopy, Access::kCopyDest, Sync::kAll, Access::kShaderResource),
                   Layout::kUndefined, Layout::kCommon, target}),
               "KA0858", "LayoutBefore 0xffffffff does not allow");
  EXPECT_ERROR(record(TextureBarrier{nothing(), Layout::kCommon, Layout::kUndefined, target}),
               "KA0858", "only follows itself");
  EXPECT_OK(record(
      TextureBarrier{scopes(Sync::kAll, Access::kCopyDest, Sync::kAll, Access::kShaderResource),
                     Layout::kUndefined, Layout::kUndefined, target}));
}

TEST_F(EnhancedBarriers, RangesOfSubresources) {
  const auto ranged = [&](BarrierSubresourceRange range) {
    return record(TextureBarrier{GlobalBarrier{}, Layout::kCommon, Layout::kCopySource,
                                 texture(ResourceFlags::kNone), range});
  };
  EXPECT_OK(ranged({}));
  EXPECT_OK(ranged({11}));
  EXPECT_ERROR(ranged({12}), "KA0858", "subresource 12 does not exist; there are 12");
  EXPECT_OK(ranged({1, 2, 2, 2}));
  EXPECT_ERROR(ranged({1, 3, 2, 2}), "KA0858", "there are 3 mips, 4 array slices and 1 planes");
  EXPECT_ERROR(ranged({1, 2, 3, 2}), "KA0858");
  EXPECT_OK(ranged({1, 2, 3, 0}));  // one array slice
  EXPECT_ERROR(ranged({1, 2, 4, 0}), "KA0858");
  EXPECT_OK(ranged({1, 2, 2, 2, 0, 1}));
  EXPECT_ERROR(ranged({1, 2, 2, 2, 1, 1}), "KA0858", "planes 1 + 1");
  EXPECT_ERROR(ranged({1, 2, 2, 2, 1, 0}), "KA0858");
}

TEST_F(EnhancedBarriers, TheSecondHalfOfASplitBarrierCounts) {
  const Buffer buffer = MakeBuffer(64);
  CommandList list = device_.CreateCommandList().value();
  list.Barrier(BufferBarrier{
      scopes(Sync::kCopy, Access::kCopyDest, Sync::kSplit, Access::kCopySource), buffer});
  list.Barrier(BufferBarrier{
      scopes(Sync::kSplit, Access::kCopyDest, Sync::kCopy, Access::kCopySource), buffer});
  EXPECT_OK(queue_.ExecuteAndWait(list));
  const auto& executed = null_log().executed;
  ASSERT_EQ(executed.size(), 1u);
  EXPECT_EQ(std::get<runtime::BarrierCommand>(executed[0]).kind,
            runtime::BarrierCommand::Kind::kAccess);
  EXPECT_EQ(std::get<runtime::BarrierCommand>(executed[0]).after, ResourceStates::kCopySource);
}

TEST_F(EnhancedBarriers, LayoutsAreStatesOfTextures) {
  EXPECT_EQ(StatesOfLayout(Layout::kCommon), ResourceStates::kCommon);
  EXPECT_EQ(StatesOfLayout(Layout::kUndefined), ResourceStates::kCommon);
  EXPECT_EQ(StatesOfLayout(Layout::kShaderResource), ResourceStates::kAllShaderResource);
  EXPECT_EQ(StatesOfLayout(Layout::kDirectQueueUnorderedAccess), ResourceStates::kUnorderedAccess);
  EXPECT_EQ(StatesOfLayout(Layout::kGenericRead),
            ResourceStates::kAllShaderResource | ResourceStates::kCopySource);
}

}  // namespace
}  // namespace rtapi::testing
