// SPDX-License-Identifier: MIT
//
// Barriers, copies and clears.
#include "rtapi/testing/command_list_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;

// --- barriers ---

TEST_F(CommandListTest, Barriers) {
  auto buffer = MakeBuffer(64, HeapType::kDefault, "buf");
  auto upload = MakeBuffer(64, HeapType::kUpload, "up");
  const auto read = ResourceStates::kNonPixelShaderResource;
  const auto common = ResourceStates::kCommon;
  auto barrier = [&](const ResourceBarrier& b) {
    return Record([&](CommandList& l) { l.ResourceBarrier(b); });
  };
  EXPECT_OK(barrier(ResourceBarrier::Uav()));
  EXPECT_OK(barrier(ResourceBarrier::Uav(buffer)));
  EXPECT_OK(barrier(ResourceBarrier::Transition(buffer, common, read)));
  EXPECT_ERROR(barrier(ResourceBarrier::Transition(buffer, read, read)), "KA0802", "\"buf\"");
  EXPECT_ERROR(barrier(ResourceBarrier::Transition({}, common, read)), "KA0904");
  EXPECT_ERROR(barrier(ResourceBarrier::Transition(upload, common, read)), "KA0802",
               "cannot leave their state");
  EXPECT_ERROR(barrier(ResourceBarrier::Transition(buffer, common, read, 1)), "KA0802",
               "subresource 1");
  EXPECT_OK(barrier(ResourceBarrier::Aliasing()));
  EXPECT_OK(barrier(ResourceBarrier::Aliasing(buffer, upload)));
  const Buffer foreign = testing::CreateNullDevice().CreateBuffer({.SizeInBytes = 64}).value();
  EXPECT_ERROR(barrier(ResourceBarrier::Aliasing(buffer, foreign)), "KA0903", "the one after");
  ResourceBarrier odd;
  odd.Type = static_cast<ResourceBarrierType>(7);
  EXPECT_ERROR(barrier(odd), "KA0802", "type 7");
}

TEST_F(CommandListTest, AS_22_NoTransitionOfStructures) {
  auto buffer = MakeBuffer(64);
  auto structure =
      device_
          .CreateBuffer({.SizeInBytes = 256,
                         .Flags = ResourceFlags::kAllowUnorderedAccess,
                         .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                         .Name = "tlas"})
          .value();
  const auto as = ResourceStates::kRaytracingAccelerationStructure;
  EXPECT_ERROR(
      Record([&](CommandList& l) {
        l.ResourceBarrier(ResourceBarrier::Transition(structure, as, ResourceStates::kCommon));
      }),
      "KA0803", "\"tlas\"");
  EXPECT_ERROR(
      Record([&](CommandList& l) {
        l.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kCommon, as));
      }),
      "KA0803");
  EXPECT_OK(Record([&](CommandList& l) { l.ResourceBarrier(ResourceBarrier::Uav(structure)); }));
}

// --- copies ---

TEST_F(CommandListTest, BufferCopies) {
  auto up = MakeBuffer(16, HeapType::kUpload, "up");
  auto gpu = MakeBuffer(16, HeapType::kDefault, "gpu");
  auto back = MakeBuffer(16, HeapType::kReadback, "back");
  for (int i = 0; i < 16; ++i) up.data<uint8_t>()[static_cast<size_t>(i)] = static_cast<uint8_t>(i);
  list_.CopyBufferRegion(gpu, 4, up, 0, 8);
  list_.CopyResource(back, gpu);
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok());
  EXPECT_EQ(back.data<uint8_t>()[3], 0);
  EXPECT_EQ(back.data<uint8_t>()[11], 7);
  auto copy = [&](const Buffer& d, uint64_t at, const Buffer& s, uint64_t from, uint64_t n) {
    return Record([&](CommandList& l) { l.CopyBufferRegion(d, at, s, from, n); });
  };
  EXPECT_ERROR(copy(gpu, 9, up, 0, 8), "KA0817", "dest", "\"gpu\"");
  EXPECT_ERROR(copy(gpu, 0, up, 9, 8), "KA0817", "source", "\"up\"");
  EXPECT_ERROR(copy(gpu, UINT64_MAX, up, 0, 2), "KA0817");
  EXPECT_ERROR(copy(gpu, 0, up, 2, UINT64_MAX), "KA0817");
  EXPECT_ERROR(copy(gpu, 0, gpu, 4, 8), "KA0818");
  EXPECT_OK(copy(gpu, 0, gpu, 8, 8));
  EXPECT_ERROR(copy(up, 0, gpu, 0, 8), "KA0821", "upload");
  EXPECT_ERROR(copy(gpu, 0, back, 0, 8), "KA0821", "readback");
  EXPECT_ERROR(copy({}, 0, back, 0, 8), "KA0904", "dest");
  EXPECT_ERROR(Record([&](CommandList& l) { l.CopyResource(gpu, MakeBuffer(8)); }), "KA0819");
}

class TextureCopyTest : public CommandListTest {
 protected:
  Texture MakeTexture(Format format = Format::kR8G8B8A8Unorm, uint16_t mips = 1) {
    return device_
        .CreateTexture({.Width = 8, .Height = 4, .MipLevels = mips, .Format = format, .Name = "t"})
        .value();
  }
  static PlacedSubresourceFootprint Footprint(uint64_t offset, uint32_t pitch = 256) {
    return {offset, {Format::kR8G8B8A8Unorm, 8, 4, 1, pitch}};
  }
  Status Copy(const TextureCopyLocation& dest, uint32_t x, uint32_t y,
              const TextureCopyLocation& source, const Box* box = nullptr) {
    return Record([&](CommandList& l) { l.CopyTextureRegion(dest, x, y, 0, source, box); });
  }
};

TEST_F(TextureCopyTest, BufferToTexture) {
  auto buffer = MakeBuffer(2048, HeapType::kUpload);
  auto texture = MakeTexture();
  const Box box = {2, 1, 0, 6, 3, 1};
  list_.CopyTextureRegion({texture, 0}, 4, 2, 0, {buffer, Footprint(512)}, &box);
  ASSERT_TRUE(queue_.ExecuteAndWait(list_).ok()) << list_.GetErrors().at(0).message;
  const auto& c = Executed<runtime::CopyTextureCommand>(0);
  EXPECT_EQ(c.extent[0], 4u);
  EXPECT_EQ(c.extent[1], 2u);
  EXPECT_EQ(c.source.origin[0], 2u);
  EXPECT_EQ(c.dest.origin[0], 4u);
  EXPECT_EQ(c.source.offset, 512u);
  EXPECT_EQ(c.source.row_pitch, 256u);
  EXPECT_EQ(c.source.slice_pitch, 1024u);
}

TEST_F(TextureCopyTest, Errors) {
  auto buffer = MakeBuffer(2048, HeapType::kUpload, "pixels");
  auto texture = MakeTexture();
  EXPECT_ERROR(Copy({texture, 1}, 0, 0, {buffer, Footprint(0)}), "KA0817", "subresource 1");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(100)}), "KA0820", "512");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(0, 100)}), "KA0820");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(0, 0)}), "KA0820");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(1536)}), "KA0817", "\"pixels\"");
  EXPECT_ERROR(Copy({texture, 0}, 1, 0, {buffer, Footprint(0)}), "KA0817", "axis 0");
  EXPECT_ERROR(Copy({texture, 0}, 0xFFFFFFFF, 0, {buffer, Footprint(0)}), "KA0817");
  const Box box = {0, 0, 0, 9, 1, 1};
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Footprint(0)}, &box), "KA0817");
  EXPECT_ERROR(Copy({buffer, Footprint(0)}, 0, 0, {buffer, Footprint(0)}), "KA0819", "buffers");
  EXPECT_ERROR(Copy({MakeTexture(Format::kR32Float), 0}, 0, 0, {texture, 0}), "KA0819", "family");
  EXPECT_OK(Copy({MakeTexture(Format::kR8G8B8A8UnormSrgb), 0}, 0, 0, {texture, 0}));
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {texture, 0}), "KA0818");
  const Box left = {0, 0, 0, 4, 4, 1};
  EXPECT_ERROR(Copy({texture, 0}, 3, 0, {texture, 0}, &left), "KA0818", "0..4 x 0..4");
  EXPECT_OK(Copy({texture, 0}, 4, 0, {texture, 0}, &left));  // beside itself
  EXPECT_ERROR(Copy({Texture(), 0}, 0, 0, {texture, 0}), "KA0904");
  auto whole = [&](const Resource& d, const Resource& s) {
    return Record([&](CommandList& l) { l.CopyResource(d, s); });
  };
  EXPECT_OK(whole(MakeTexture(), texture));
  EXPECT_ERROR(whole(MakeTexture(Format::kR8G8B8A8Unorm, 2), texture), "KA0819", "mip");
  EXPECT_ERROR(whole(texture, buffer), "KA0819");
}

class BlockCopyTest : public TextureCopyTest {
 protected:
  // 10 x 6 texels: 3 x 2 blocks, of which those at the far edges reach out.
  Texture MakeBlocks(Format format = Format::kBC1Unorm) {
    return device_
        .CreateTexture({.Width = 10, .Height = 6, .MipLevels = 4, .Format = format, .Name = "bc"})
        .value();
  }
  static PlacedSubresourceFootprint Blocks(uint32_t width, uint32_t height,
                                           Format format = Format::kBC1Unorm) {
    return {0, {format, width, height, 1, 256}};
  }
  const runtime::CopyTextureCommand& Copied(const TextureCopyLocation& dest, uint32_t x, uint32_t y,
                                            const TextureCopyLocation& source, const Box* box) {
    CommandList list = device_.CreateCommandList().value();
    list.CopyTextureRegion(dest, x, y, 0, source, box);
    const Status status = queue_.ExecuteAndWait(list);
    EXPECT_TRUE(status.ok()) << MessageOf(status);
    return std::get<runtime::CopyTextureCommand>(null_log().executed.back());
  }
};

TEST_F(BlockCopyTest, CommandsCountInBlocks) {
  auto buffer = MakeBuffer(2048, HeapType::kUpload);
  auto texture = MakeBlocks();
  const Box box = {4, 4, 0, 10, 6, 1};  // up to the edges
  const auto& c = Copied({MakeBlocks(), 0}, 4, 4, {texture, 0}, &box);
  EXPECT_EQ(c.extent[0], 2u);
  EXPECT_EQ(c.extent[1], 1u);
  EXPECT_EQ(c.extent[2], 1u);
  EXPECT_EQ(c.source.origin[0], 1u);
  EXPECT_EQ(c.source.origin[1], 1u);
  EXPECT_EQ(c.dest.origin[0], 1u);
  const Box padded = {0, 0, 0, 12, 8, 1};  // whole blocks
  EXPECT_EQ(Copied({MakeBlocks(), 0}, 0, 0, {texture, 0}, &padded).extent[0], 3u);
  const auto& up = Copied({texture, 0}, 0, 0, {buffer, Blocks(12, 8)}, nullptr);
  EXPECT_EQ(up.extent[0], 3u);
  EXPECT_EQ(up.extent[1], 2u);
  EXPECT_EQ(up.source.slice_pitch, 512u);
  // Mip 3 is 1 x 1 texel in one block.
  EXPECT_EQ(Copied({texture, 3}, 0, 0, {buffer, Blocks(4, 4)}, nullptr).extent[0], 1u);
}

TEST_F(BlockCopyTest, BlocksGoToIntegersOfAsManyBytes) {
  const auto plain = [&](Format format, uint32_t width, uint32_t height) {
    return device_.CreateTexture({.Width = width, .Height = height, .Format = format}).value();
  };
  const auto& c = Copied({plain(Format::kR32G32Uint, 3, 2), 0}, 0, 0, {MakeBlocks(), 0}, nullptr);
  EXPECT_EQ(c.extent[0], 3u);
  EXPECT_EQ(c.extent[1], 2u);
  const Box texels = {1, 0, 0, 3, 1, 1};
  const auto& back = Copied({MakeBlocks(Format::kBC6HUf16), 0}, 4, 4,
                            {plain(Format::kR32G32B32A32Sint, 3, 2), 0}, &texels);
  EXPECT_EQ(back.extent[0], 2u);
  EXPECT_EQ(back.source.origin[0], 1u);
  EXPECT_EQ(back.dest.origin[0], 1u);
  EXPECT_EQ(back.dest.origin[1], 1u);
  EXPECT_OK(Copy({plain(Format::kR16G16B16A16Typeless, 3, 2), 0}, 0, 0,
                 {MakeBlocks(Format::kBC4Snorm), 0}));
  EXPECT_OK(
      Copy({MakeBlocks(Format::kBC3Typeless), 0}, 0, 0, {MakeBlocks(Format::kBC3UnormSrgb), 0}));
  EXPECT_ERROR(Copy({plain(Format::kR32G32Float, 3, 2), 0}, 0, 0, {MakeBlocks(), 0}), "KA0819",
               "integers of the same bytes");
  EXPECT_ERROR(Copy({plain(Format::kR32G32B32A32Uint, 3, 2), 0}, 0, 0, {MakeBlocks(), 0}),
               "KA0819");
  EXPECT_ERROR(Copy({MakeBlocks(Format::kBC4Unorm), 0}, 0, 0, {MakeBlocks(), 0}), "KA0819",
               "family");
  const auto whole = [&](const Resource& d, const Resource& s) {
    return Record([&](CommandList& l) { l.CopyResource(d, s); });
  };
  const auto quarter =
      device_
          .CreateTexture({.Width = 2, .Height = 4, .MipLevels = 2, .Format = Format::kR32G32Uint})
          .value();
  const TextureDesc blocks = {
      .Width = 8, .Height = 16, .MipLevels = 2, .Format = Format::kBC1Unorm};
  EXPECT_OK(whole(quarter, device_.CreateTexture(blocks).value()));
  EXPECT_ERROR(whole(quarter, MakeBlocks()), "KA0819", "size");
}

TEST_F(BlockCopyTest, PartsOfBlocksAreErrors) {
  auto buffer = MakeBuffer(2048, HeapType::kUpload, "blocks");
  auto texture = MakeBlocks(), other = MakeBlocks();
  const auto box = [&](uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) {
    const Box b = {left, top, 0, right, bottom, 1};
    return Copy({other, 0}, 0, 0, {texture, 0}, &b);
  };
  EXPECT_OK(box(4, 0, 8, 4));
  EXPECT_ERROR(box(2, 0, 8, 4), "KA0572", "axis 0", "2..8", "multiples of 4");
  EXPECT_ERROR(box(4, 0, 9, 4), "KA0572", "4..9");
  EXPECT_ERROR(box(4, 0, 11, 4), "KA0572");
  EXPECT_ERROR(box(4, 1, 8, 4), "KA0572", "axis 1");
  EXPECT_ERROR(box(4, 0, 8, 5), "KA0572", "0..5");
  EXPECT_ERROR(box(4, 0, 16, 4), "KA0817");
  EXPECT_ERROR(Copy({other, 0}, 2, 0, {texture, 3}), "KA0572", "dest");
  EXPECT_ERROR(Copy({other, 0}, 0, 3, {texture, 3}), "KA0572", "axis 1");
  EXPECT_ERROR(Copy({other, 0}, 12, 0, {texture, 3}), "KA0817");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Blocks(10, 8)}), "KA0572", "10x8");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Blocks(12, 6)}), "KA0572", "\"blocks\"");
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Blocks(16, 8)}), "KA0817");
  // 256 bytes hold 32 blocks of 8 bytes.
  EXPECT_ERROR(Copy({texture, 0}, 0, 0, {buffer, Blocks(132, 4)}), "KA0820", "264");
}

TEST_F(CommandListTest, ClearsNeedTheSameViewTwice) {
  auto buffer = MakeBuffer(64, HeapType::kDefault, "buf", ResourceFlags::kAllowUnorderedAccess);
  auto other = MakeBuffer(64, HeapType::kDefault, "other", ResourceFlags::kAllowUnorderedAccess);
  auto heap =
      device_
          .CreateDescriptorHeap({.NumDescriptors = 2, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  const UnorderedAccessViewDesc view = {.Format = Format::kR32Uint,
                                        .ViewDimension = UavDimension::kBuffer};
  auto cpu = heap.GetCPUDescriptorHandle(0);
  auto gpu = heap.GetGPUDescriptorHandle(0);
  ASSERT_TRUE(device_.CreateUnorderedAccessView(buffer, view, cpu).ok());
  const uint32_t values[4] = {7, 0, 0, 0};
  auto clear = [&](GpuDescriptorHandle g, CpuDescriptorHandle c, const Resource& r,
                   const uint32_t* v) {
    return Record([&](CommandList& l) {
      l.SetDescriptorHeaps({heap});
      l.ClearUnorderedAccessViewUint(g, c, r, v);
    });
  };
  EXPECT_OK(clear(gpu, cpu, buffer, values));
  EXPECT_ERROR(clear(gpu, {5}, buffer, values), "KA0822", "CPU handle");
  EXPECT_ERROR(clear({5}, cpu, buffer, values), "KA0822", "GPU handle");
  EXPECT_ERROR(clear(gpu, cpu, other, values), "KA0822", "\"other\"");
  EXPECT_ERROR(clear(gpu, cpu, buffer, nullptr), "KA0822", "null");
  ASSERT_TRUE(device_.CreateConstantBufferView({}, heap.GetCPUDescriptorHandle(1)).ok());
  EXPECT_OK(clear(gpu, heap.GetCPUDescriptorHandle(1), buffer, values));  // a null view
  const ShaderResourceViewDesc read = {.Format = Format::kR32Uint,
                                       .ViewDimension = SrvDimension::kBuffer};
  ASSERT_TRUE(device_.CreateShaderResourceView(buffer, read, heap.GetCPUDescriptorHandle(1)).ok());
  EXPECT_ERROR(clear(gpu, heap.GetCPUDescriptorHandle(1), buffer, values), "KA0822",
               "not an unordered access view");
}

TEST_F(CommandListTest, ClearsTakeHandlesOfAHeapThatIsNotSet) {
  auto buffer = MakeBuffer(64, HeapType::kDefault, "buf", ResourceFlags::kAllowUnorderedAccess);
  auto heap =
      device_
          .CreateDescriptorHeap({.NumDescriptors = 1, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  auto hidden = device_.CreateDescriptorHeap({.NumDescriptors = 1}).value();
  const UnorderedAccessViewDesc view = {.Format = Format::kR32Uint,
                                        .ViewDimension = UavDimension::kBuffer};
  ASSERT_TRUE(
      device_.CreateUnorderedAccessView(buffer, view, hidden.GetCPUDescriptorHandle(0)).ok());
  const uint32_t values[4] = {7, 0, 0, 0};
  const Rect rects[3] = {{-4, -4, 2, 1}, {5, 0, 5, 1}, {3, 0, 99, 9}};
  list_.ClearUnorderedAccessViewUint(heap.GetGPUDescriptorHandle(0),
                                     hidden.GetCPUDescriptorHandle(0), buffer, values, rects);
  list_.ClearUnorderedAccessViewUint(heap.GetGPUDescriptorHandle(0),
                                     hidden.GetCPUDescriptorHandle(0), buffer, values,
                                     std::span(rects).subspan(1, 1));  // empty: nothing
  EXPECT_OK(list_.Close());
  EXPECT_OK(queue_.ExecuteCommandLists({list_}));
  ASSERT_EQ(null_log().executed.size(), 1u);
  const auto& command = Executed<runtime::ClearUavCommand>(0);
  EXPECT_FALSE(command.whole);
  ASSERT_EQ(command.rects.size(), 2u);
  EXPECT_EQ(command.rects[0].left, 0);
  EXPECT_EQ(command.rects[0].right, 2);
  EXPECT_EQ(command.rects[1].left, 3);
}

TEST_F(CommandListTest, ImmediateValuesGoToWritableBuffers) {
  auto kept = MakeBuffer(16);
  auto upload = MakeBuffer(16, HeapType::kUpload);
  const auto write = [&](GpuVirtualAddress address, std::vector<WriteBufferImmediateMode> modes) {
    return Record([&](CommandList& l) {
      const WriteBufferImmediateParameter one = {address, 5};
      l.WriteBufferImmediate({&one, 1}, modes);
    });
  };
  EXPECT_OK(write(kept.GetGPUVirtualAddress() + 12, {}));
  EXPECT_OK(write(kept.GetGPUVirtualAddress(), {WriteBufferImmediateMode::kMarkerOut}));
  EXPECT_ERROR(write(kept.GetGPUVirtualAddress() + 2, {}), "KA0825", "multiple of 4");
  EXPECT_ERROR(write(256, {}), "KA0825", "no live buffer");
  EXPECT_ERROR(write(upload.GetGPUVirtualAddress(), {}), "KA0825");
  EXPECT_ERROR(write(kept.GetGPUVirtualAddress(), {static_cast<WriteBufferImmediateMode>(3)}),
               "KA0825", "mode 3");
  EXPECT_ERROR(write(kept.GetGPUVirtualAddress(), std::vector<WriteBufferImmediateMode>(2)),
               "KA0825", "2 modes for 1 values");
}

TEST_F(CommandListTest, EventsAreBalanced) {
  list_.BeginEvent("pass");
  EXPECT_ERROR(list_.Close(), "KA0824", "1 calls of BeginEvent");
  EXPECT_ERROR(Record([](CommandList& l) { l.EndEvent(); }), "KA0824");
}

}  // namespace
}  // namespace rtapi::testing
