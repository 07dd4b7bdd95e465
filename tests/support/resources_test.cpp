// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tests/support/harness.h"

namespace {

using namespace rtapi;
using namespace kaamos::support;

KAAMOS_CALLS(Resources);

TEST_P(Resources, CreateBuffer) {
  BufferDesc desc;
  desc.SizeInBytes = 1000;
  const auto made = device_.CreateBuffer(desc);
  KAAMOS_SUPPORTED(made);
  EXPECT_NE(made->GetGPUVirtualAddress(), 0u);
}

TEST_P(Resources, CreateBuffer_custom_heap) {
  const auto made = device_.CreateBuffer({.SizeInBytes = 4 * kCount,
                                          .Heap = HeapType::kCustom,
                                          .Flags = ResourceFlags::kAllowUnorderedAccess,
                                          .InitialState = ResourceStates::kUnorderedAccess});
  KAAMOS_SUPPORTED(made);
  out_ = *made;
  const std::span<std::byte> memory = made->Map().value();
  std::fill(memory.begin(), memory.end(), std::byte{1});
  compute("FromRootConstants");
  uint32_t words[kCount];
  std::memcpy(words, memory.data(), sizeof words);
  for (uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(words[i], i * constants_[0] + constants_[1]);
  CommandList list = device_.CreateCommandList().value();
  list.ResourceBarrier(ResourceBarrier::Transition(*made, ResourceStates::kUnorderedAccess,
                                                   ResourceStates::kCopyDest));
  list.CopyBufferRegion(*made, 0, upload(numbers(40)), 0, 4 * kCount);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  std::memcpy(words, memory.data(), sizeof words);
  EXPECT_EQ(words[kCount - 1], 47u);
}

TEST_P(Resources, CreateTexture) {
  TextureDesc desc;
  desc.Width = desc.Height = 16;
  desc.MipLevels = 5;
  desc.Format = Format::kR16G16B16A16Float;
  KAAMOS_SUPPORTED(device_.CreateTexture(desc));
}

TEST_P(Resources, GetCopyableFootprints) {
  TextureDesc desc;
  desc.Width = desc.Height = 8;
  desc.Format = Format::kR8G8B8A8Unorm;
  std::vector<PlacedSubresourceFootprint> layouts;
  const auto bytes = device_.GetCopyableFootprints(desc, 0, 1, 0, &layouts);
  KAAMOS_SUPPORTED(bytes);
  ASSERT_EQ(layouts.size(), 1u);
  EXPECT_GE(*bytes, 8u * 8 * 4);
}

TEST_P(Resources, WriteBufferImmediate) {
  const Buffer words = buffer(32);
  const uint64_t at = words.GetGPUVirtualAddress();
  const WriteBufferImmediateParameter values[] = {{at + 4, 7}, {at + 28, 8}, {at + 4, 9}};
  CommandList list = device_.CreateCommandList().value();
  list.WriteBufferImmediate(values);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(words), (std::vector<uint32_t>{0, 9, 0, 0, 0, 0, 0, 8}));
}

TEST_P(Resources, CopyBufferRegion) {
  const Buffer source = upload(numbers(1));
  const Buffer dest = buffer(32);
  CommandList list = device_.CreateCommandList().value();
  list.CopyBufferRegion(dest, 4, source, 8, 12);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(dest), (std::vector<uint32_t>{0, 3, 4, 5, 0, 0, 0, 0}));
}

TEST_P(Resources, CopyTextureRegion) {
  const Texture from = texture_of(0xFF000010);
  const Texture to = texture();
  CommandList list = device_.CreateCommandList().value();
  const Box box{2, 0, 0, 5, 1, 1};
  list.CopyTextureRegion({to, 0}, 1, 0, 0, {from, 0}, &box);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  const auto bytes = ReadbackTexture(device_, queue_, to, 0).value();
  uint32_t texels[kCount];
  std::memcpy(texels, bytes.data(), sizeof texels);
  EXPECT_EQ(texels[1], 0xFF000012u);
  EXPECT_EQ(texels[3], 0xFF000014u);
}

TEST_P(Resources, CopyResource) {
  const Buffer source = upload(numbers(9));
  const Buffer dest = buffer(32);
  CommandList list = device_.CreateCommandList().value();
  list.CopyResource(dest, source);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(dest), numbers(9));
}

KAAMOS_CALLS(Descriptors);

TEST_P(Descriptors, StructuredSrv) {
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Buffer.StructureByteStride = 4;
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(upload(numbers(20)), view, slot(kStructured)));
  EXPECT_EQ(compute("FromStructuredView"), numbers(22));
}

TEST_P(Descriptors, TypedSrv) {
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Format = Format::kR32Uint;
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(upload(numbers(20)), view, slot(kTyped)));
  EXPECT_EQ(compute("FromTypedView"), numbers(23));
}

TEST_P(Descriptors, RawSrv) {
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Format = Format::kR32Typeless;
  view.Buffer.Flags = BufferSrvFlags::kRaw;
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(upload(numbers(20)), view, slot(kRaw)));
  EXPECT_EQ(compute("FromRawView"), numbers(24));
}

TEST_P(Descriptors, TextureSrv) {
  const Texture source = texture_of(30);
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(source, slot(kTexture)));
  EXPECT_EQ(compute("FromTexture"), numbers(30));
}

// Views reinterpret what a typed texture holds. [D3D12: Relaxed Format Casting Rules]
TEST_P(Descriptors, TextureSrv_casts) {
  const Texture source = texture_of(200);
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kTexture2D;
  view.Format = Format::kR8G8B8A8UnormSrgb;
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(source, view, slot(kTexture)));
  std::vector<uint32_t> linear = numbers(200);
  for (uint32_t& value : linear) {
    value = static_cast<uint32_t>(std::pow((value / 255.0 + 0.055) / 1.055, 2.4) * 255 + 0.5);
  }
  // Half a step of what is stored, which is less than one here. [D3D11.3: 3.2.3.8 SRGB to FLOAT]
  const std::vector<uint32_t> found = compute("FromTexture");
  ASSERT_EQ(found.size(), linear.size());
  for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], linear[i], 1);
}

TEST_P(Descriptors, TextureUav_casts) {
  TextureDesc desc;
  desc.Width = desc.Height = kCount;
  desc.Format = Format::kR8G8B8A8Uint;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  const Texture picture = device_.CreateTexture(desc).value();
  UnorderedAccessViewDesc view;
  view.ViewDimension = UavDimension::kTexture2D;
  view.Format = Format::kR8G8B8A8Unorm;
  KAAMOS_SUPPORTED(device_.CreateUnorderedAccessView(picture, view, slot(kTextureOut)));
  compute("ToTexture");
  const auto bytes = ReadbackTexture(device_, queue_, picture, 0).value();
  for (uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(std::to_integer<uint32_t>(bytes[i * 4]), 10 + i);
}

TEST_P(Descriptors, AccelerationStructureSrv) {
  const auto bottom = bottom_level(2);
  KAAMOS_SUPPORTED(bottom);
  const auto top = top_level(*bottom);
  KAAMOS_SUPPORTED(top);
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
  view.RaytracingAccelerationStructure.Location = top->GetGPUVirtualAddress();
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(Resource(), view, slot(kScene)));
  Rays rays;
  rays.ray_generation = "TraceTableView";
  EXPECT_EQ(trace(rays, *top), (std::vector<uint32_t>{104, 114, 7, 7, 7, 7, 7, 7}));
}

TEST_P(Descriptors, TypedUav) {
  const Buffer words = buffer(32);
  UnorderedAccessViewDesc view;
  view.ViewDimension = UavDimension::kBuffer;
  view.Format = Format::kR32Uint;
  KAAMOS_SUPPORTED(device_.CreateUnorderedAccessView(words, view, slot(kTypedOut)));
  compute("ToTypedView");
  EXPECT_EQ(read(words), numbers(5));
}

TEST_P(Descriptors, CounterUav) {
  constexpr uint64_t kCounterAt = 4096;
  // The appended buffer's counter is behind its elements, that of the consumed one on its own.
  const Buffer appended = buffer(kCounterAt + 4);
  const Buffer counters = buffer(2 * kCounterAt + 4);
  const Buffer counted = buffer(32);
  std::vector<uint32_t> pairs(2 * kCount);
  for (uint32_t i = 0; i < pairs.size(); ++i) pairs[i] = i;
  const Buffer consumed = CreateDefaultBuffer(device_, queue_, std::as_bytes(std::span(pairs)),
                                              ResourceFlags::kAllowUnorderedAccess)
                              .value();
  const auto view = [](uint32_t stride, uint32_t count, uint64_t counter) {
    UnorderedAccessViewDesc desc;
    desc.ViewDimension = UavDimension::kBuffer;
    desc.Buffer.StructureByteStride = stride;
    desc.Buffer.NumElements = count;
    desc.Buffer.CounterOffsetInBytes = counter;
    return desc;
  };
  KAAMOS_SUPPORTED(device_.CreateUnorderedAccessView(appended, appended, view(8, 10, kCounterAt),
                                                     slot(kAppended)));
  device_.CreateUnorderedAccessView(consumed, counters, view(8, 0, 0), slot(kConsumed)).value();
  device_.CreateUnorderedAccessView(counted, counters, view(4, 0, 2 * kCounterAt), slot(kCounted))
      .value();
  // The counters start at these values.
  CommandList list = device_.CreateCommandList().value();
  const Buffer first = upload({kCount, 2, 0});
  list.CopyBufferRegion(counters, 0, first, 0, 4);
  list.CopyBufferRegion(appended, kCounterAt, first, 4, 4);
  list.CopyBufferRegion(counters, 2 * kCounterAt, first, 8, 4);
  queue_.ExecuteAndWait(list).value();
  EXPECT_EQ(compute("ThroughCounters"), std::vector<uint32_t>(kCount, 10 * 1000 + 8));

  const auto out = read(appended);
  EXPECT_EQ(out[kCounterAt / 4], 2 + kCount);
  std::vector<std::pair<uint32_t, uint32_t>> moved, wanted;
  for (uint32_t i = 0; i < kCount; ++i) {
    moved.emplace_back(out[2 * (2 + i)], out[2 * (2 + i) + 1]);
    wanted.emplace_back(2 * i + 100, 2 * i + 1);
  }
  std::sort(moved.begin(), moved.end());
  EXPECT_EQ(moved, wanted);
  EXPECT_EQ(out[0], 0u);
  EXPECT_EQ(out[2 * (2 + kCount)], 0u);
  EXPECT_EQ(read(counters)[0], 0u);
  EXPECT_EQ(read(counters)[2 * kCounterAt / 4], kCount);
  auto numbered = read(counted);
  std::sort(numbered.begin(), numbered.end());
  EXPECT_EQ(numbered, numbers(50));

  device_.CreateUnorderedAccessView(counted, view(4, 0, 0), slot(kCounted)).value();
  const auto without = compute("WithoutCounter");
  EXPECT_EQ(without[0], 0u);
  EXPECT_EQ(without[1], 0u);
  EXPECT_EQ(without[2], 7u);
}

TEST_P(Descriptors, TextureUav) {
  const Texture picture = texture();
  KAAMOS_SUPPORTED(device_.CreateUnorderedAccessView(picture, slot(kTextureOut)));
  compute("ToTexture");
  const auto bytes = ReadbackTexture(device_, queue_, picture, 0).value();
  for (uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(std::to_integer<uint32_t>(bytes[i * 4]), 10 + i);
}

TEST_P(Descriptors, ConstantBufferView) {
  std::vector<uint32_t> words(64);
  words[0] = 5;
  words[1] = 6;
  ConstantBufferViewDesc view;
  view.BufferLocation = upload(words).GetGPUVirtualAddress();
  view.SizeInBytes = 256;
  KAAMOS_SUPPORTED(device_.CreateConstantBufferView(view, slot(kConstants)));
  EXPECT_EQ(compute("FromConstantView"), numbers(6, 5));
}

TEST_P(Descriptors, CreateSampler) {
  const Texture source = texture_of(40);
  device_.CreateShaderResourceView(source, slot(kTexture)).value();
  SamplerDesc sampler;
  KAAMOS_SUPPORTED(device_.CreateSampler(sampler, samplers_.GetCPUDescriptorHandle(0)));
  EXPECT_EQ(compute("FromSampler"), numbers(40));
}

TEST_P(Descriptors, StaticSampler) {
  const Texture source = texture_of(40);
  KAAMOS_SUPPORTED(device_.CreateShaderResourceView(source, slot(kTexture)));
  EXPECT_EQ(compute("FromStaticSampler"), numbers(40));
}

TEST_P(Descriptors, CopyDescriptorsSimple) {
  DescriptorHeapDesc desc;
  desc.NumDescriptors = 1;
  const DescriptorHeap heap = device_.CreateDescriptorHeap(desc).value();
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Buffer.StructureByteStride = 4;
  device_.CreateShaderResourceView(upload(numbers(60)), view, heap.GetCPUDescriptorHandle(0))
      .value();
  KAAMOS_SUPPORTED(device_.CopyDescriptorsSimple(
      1, slot(kStructured), heap.GetCPUDescriptorHandle(0), DescriptorHeapType::kCbvSrvUav));
  EXPECT_EQ(compute("FromStructuredView"), numbers(62));
}

TEST_P(Descriptors, ClearUnorderedAccessViewUint) {
  const Buffer words = buffer(32);
  UnorderedAccessViewDesc view;
  view.ViewDimension = UavDimension::kBuffer;
  view.Format = Format::kR32Uint;
  device_.CreateUnorderedAccessView(words, view, slot(kTypedOut)).value();
  CommandList list = device_.CreateCommandList().value();
  list.SetDescriptorHeaps({views_, samplers_});
  const uint32_t values[4] = {77, 0, 0, 0};
  list.ClearUnorderedAccessViewUint(views_.GetGPUDescriptorHandle(kTypedOut), slot(kTypedOut),
                                    words, values);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  EXPECT_EQ(read(words), numbers(77, 0));
}

// Handles of a heap that is not set, rectangles, and bits of every kind of format.
TEST_P(Descriptors, ClearUnorderedAccessViewUint_rectangles) {
  const Buffer words = buffer(32);
  UnorderedAccessViewDesc view;
  view.ViewDimension = UavDimension::kBuffer;
  view.Format = Format::kR32Uint;
  device_.CreateUnorderedAccessView(words, view, slot(kTypedOut)).value();
  TextureDesc desc;
  desc.Width = 6;
  desc.Height = 4;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  desc.Format = Format::kR16G16Float;
  const Texture halves = device_.CreateTexture(desc).value();
  device_.CreateUnorderedAccessView(halves, slot(kTextureOut)).value();
  CommandList list = device_.CreateCommandList().value();
  const uint32_t values[4] = {0x13C00, 0xC000, 3, 4};
  const Rect rects[] = {{1, 0, 3, 1}, {5, 0, 50, 7}};
  list.ClearUnorderedAccessViewUint(views_.GetGPUDescriptorHandle(kTypedOut), slot(kTypedOut),
                                    words, values, rects);
  const Rect corner[] = {{-2, 2, 2, 9}, {4, 0, 6, 1}};
  list.ClearUnorderedAccessViewUint(views_.GetGPUDescriptorHandle(kTextureOut), slot(kTextureOut),
                                    halves, values, corner);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  constexpr uint32_t kValue = 0x13C00;
  EXPECT_EQ(read(words), (std::vector<uint32_t>{0, kValue, kValue, 0, 0, kValue, kValue, kValue}));
  const auto bytes = ReadbackTexture(device_, queue_, halves, 0).value();
  for (int32_t y = 0; y < 4; ++y) {
    for (int32_t x = 0; x < 6; ++x) {
      uint32_t texel = 0;
      std::memcpy(&texel, &bytes[static_cast<size_t>(y * 6 + x) * 4], 4);
      const bool inside = (x < 2 && y >= 2) || (x >= 4 && y < 1);
      EXPECT_EQ(texel, inside ? 0xC0003C00u : 0u) << x << " " << y;
    }
  }
}

TEST_P(Descriptors, ClearUnorderedAccessViewUint_packed_formats) {
  const uint32_t values[4] = {0xFFFFF801, 0x402, 0x1403, 0x6};
  const std::pair<Format, uint32_t> cases[] = {
      {Format::kR10G10B10A2Unorm, 0x001 | 0x002 << 10 | 0x003 << 20 | 2u << 30},
      {Format::kR8G8B8A8Unorm, 0x06030201},
      {Format::kR8G8B8A8Sint, 0x06030201}};
  for (const auto& [format, expected] : cases) {
    TextureDesc desc;
    desc.Width = 1;
    desc.Height = 1;
    desc.Flags = ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = ResourceStates::kUnorderedAccess;
    desc.Format = format;
    const Texture texture = device_.CreateTexture(desc).value();
    device_.CreateUnorderedAccessView(texture, slot(kTextureOut)).value();
    CommandList list = device_.CreateCommandList().value();
    list.ClearUnorderedAccessViewUint(views_.GetGPUDescriptorHandle(kTextureOut), slot(kTextureOut),
                                      texture, values);
    KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
    uint32_t texel = 0;
    const auto bytes = ReadbackTexture(device_, queue_, texture, 0).value();
    std::memcpy(&texel, bytes.data(), 4);
    EXPECT_EQ(texel, expected) << static_cast<uint32_t>(format);
  }
}

TEST_P(Descriptors, ClearUnorderedAccessViewFloat) {
  const Texture picture = texture();
  device_.CreateUnorderedAccessView(picture, slot(kTextureOut)).value();
  CommandList list = device_.CreateCommandList().value();
  list.SetDescriptorHeaps({views_, samplers_});
  const float values[4] = {0.2f, 1, 0, 1};
  list.ClearUnorderedAccessViewFloat(views_.GetGPUDescriptorHandle(kTextureOut), slot(kTextureOut),
                                     picture, values);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(list));
  const auto bytes = ReadbackTexture(device_, queue_, picture, 0).value();
  EXPECT_EQ(std::to_integer<uint32_t>(bytes[0]), 51u);
  EXPECT_EQ(std::to_integer<uint32_t>(bytes[29]), 255u);

  // No more than the view shows: elements 1 and 2 of three, level 1 of two. And a volume.
  TextureDesc desc;
  desc.Width = 6;
  desc.Height = 4;
  desc.DepthOrArraySize = 3;
  desc.MipLevels = 2;
  desc.Format = Format::kR16G16B16A16Float;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kUnorderedAccess;
  const Texture layers = device_.CreateTexture(desc).value();
  UnorderedAccessViewDesc view;
  view.ViewDimension = UavDimension::kTexture2DArray;
  view.Texture2DArray.MipSlice = 1;
  view.Texture2DArray.FirstArraySlice = 1;
  view.Texture2DArray.ArraySize = 2;
  device_.CreateUnorderedAccessView(layers, view, slot(kTextureOut)).value();
  desc.Dimension = ResourceDimension::kTexture3D;
  desc.MipLevels = 1;
  const Texture volume = device_.CreateTexture(desc).value();
  view = {};
  view.ViewDimension = UavDimension::kTexture3D;
  view.Texture3D.WSize = 3;
  device_.CreateUnorderedAccessView(volume, view, slot(kTypedOut)).value();
  CommandList others = device_.CreateCommandList().value();
  others.SetDescriptorHeaps({views_, samplers_});
  const float large[4] = {1, -2, 0.5f, 65504};
  others.ClearUnorderedAccessViewFloat(views_.GetGPUDescriptorHandle(kTextureOut),
                                       slot(kTextureOut), layers, large);
  others.ClearUnorderedAccessViewFloat(views_.GetGPUDescriptorHandle(kTypedOut), slot(kTypedOut),
                                       volume, large);
  KAAMOS_SUPPORTED(queue_.ExecuteAndWait(others));
  const auto halves = [&](const Texture& of, uint32_t subresource) {
    const auto texels = ReadbackTexture(device_, queue_, of, subresource).value();
    std::vector<uint16_t> out(texels.size() / 2);
    std::memcpy(out.data(), texels.data(), texels.size());
    return out;
  };
  const auto filled = [](uint32_t texels) {
    constexpr uint16_t kTexel[4] = {0x3C00, 0xC000, 0x3800, 0x7BFF};
    std::vector<uint16_t> out(size_t{4} * texels);
    for (size_t i = 0; i < out.size(); ++i) out[i] = kTexel[i % 4];
    return out;
  };
  for (uint32_t layer = 0; layer < 3; ++layer) {
    EXPECT_EQ(halves(layers, 2 * layer), std::vector<uint16_t>(6 * 4 * 4)) << layer;
    EXPECT_EQ(halves(layers, 2 * layer + 1),
              layer == 0 ? std::vector<uint16_t>(3 * 2 * 4) : filled(3 * 2))
        << layer;
  }
  EXPECT_EQ(halves(volume, 0), filled(6 * 4 * 3));
}

}  // namespace
