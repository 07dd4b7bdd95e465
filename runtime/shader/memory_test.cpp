// SPDX-License-Identifier: MIT
#include "kaamos/shader/memory.h"

#include <cstring>
#include <vector>

#include "kaamos/shader/atomics.h"
#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

// Words that count up from 1, with a descriptor for the first `bytes` bytes. The vector continues
// past them, so that a read out of bounds gives a number and not a fault.
struct Buffer {
  std::vector<uint32_t> words;
  Descriptor descriptor;

  explicit Buffer(uint32_t bytes, DescriptorKind kind = DescriptorKind::kRawBuffer,
                  uint32_t stride = 0)
      : words(256) {
    for (uint32_t i = 0; i < words.size(); ++i) words[i] = i + 1;
    descriptor.kind = kind;
    descriptor.stride_bytes = stride;
    descriptor.address = reinterpret_cast<uintptr_t>(words.data());
    descriptor.size_bytes = bytes;
  }
};

TEST(ShaderMemory, RawLoadsAreCutOffPerComponent) {
  Buffer b(16);
  expect_components(load<uint4>(b.descriptor, 0), {1, 2, 3, 4});
  expect_components(load<uint4>(b.descriptor, 8), {3, 4, 0, 0});
  expect_components(load<uint3>(b.descriptor, 12), {4, 0, 0});
  EXPECT_EQ(load<uint32_t>(b.descriptor, 16), 0u);
  EXPECT_EQ(load<uint32_t>(b.descriptor, 13), 4u);  // the two low bits are ignored
  EXPECT_EQ(load<uint32_t>(b.descriptor, 0xFFFFFFFCu), 0u);
  expect_components(load<uint4>(b.descriptor, 0xFFFFFFFCu), {0, 0, 0, 0});
  EXPECT_EQ(load<uint32_t>(b.descriptor, 3), 1u);
  EXPECT_EQ(load<uint64_t>(b.descriptor, 7), 0x0000000300000002u);
  EXPECT_EQ(load<uint16_t>(b.descriptor, 5), 2);  // one low bit is ignored
  EXPECT_EQ(load<uint16_t>(b.descriptor, 6), 0);
  EXPECT_EQ(load<uint64_t>(b.descriptor, 8), 0x0000000400000003u);
  EXPECT_EQ(load<uint64_t>(b.descriptor, 12), 0u);
  EXPECT_EQ(load<uint16_t>(b.descriptor, 4), 2);
}

TEST(ShaderMemory, RawStoresAreCutOffPerComponent) {
  Buffer b(16);
  store<uint4>(b.descriptor, 8, uint4{10, 11, 12, 13});
  EXPECT_EQ(b.words[2], 10u);
  EXPECT_EQ(b.words[3], 11u);
  EXPECT_EQ(b.words[4], 5u);
  EXPECT_EQ(b.words[5], 6u);
  store<uint32_t>(b.descriptor, 0xFFFFFFFCu, 99u);
  store<half>(b.descriptor, 0, half{0x3C00});
  EXPECT_EQ(b.words[0], 0x3C00u);
  store<uint32_t>(b.descriptor, 16, 99u);
  EXPECT_EQ(b.words[4], 5u);
}

TEST(ShaderMemory, OtherKindsHaveNoBytes) {
  for (const DescriptorKind kind :
       {DescriptorKind::kNull, DescriptorKind::kTexture, DescriptorKind::kSampler,
        DescriptorKind::kAccelerationStructure}) {
    Buffer b(64, kind, 4);
    EXPECT_EQ(load<uint32_t>(b.descriptor, 0), 0u);
    EXPECT_EQ(load_element<uint32_t>(b.descriptor, 0, 0), 0u);
    store<uint32_t>(b.descriptor, 0, 99u);
    EXPECT_EQ(b.words[0], 1u);
    EXPECT_EQ(memory_address<uint32_t>(b.descriptor, 0), nullptr);
  }
}

// A TextureBuffer reads the bytes of a typed buffer.
TEST(ShaderMemory, TypedBuffersHaveTheirBytes) {
  Buffer b(64, DescriptorKind::kTypedBuffer, 4);
  EXPECT_EQ(load<uint32_t>(b.descriptor, 0), b.words[0]);
  EXPECT_EQ(load<uint32_t>(b.descriptor, 64), 0u);
}

TEST(ShaderMemory, BoolTakesFourBytes) {
  Buffer b(64);
  b.words[0] = 0;
  b.words[1] = 256;
  expect_components(load<bool3>(b.descriptor, 0), {0, 1, 1});
  store<bool2>(b.descriptor, 0, bool2{true, false});
  EXPECT_EQ(b.words[0], 1u);
  EXPECT_EQ(b.words[1], 0u);
}

TEST(ShaderMemory, StructuredLayoutIsTight) {
  Buffer b(1024);
  expect_components(load<uint2x3>(b.descriptor, 0), {1, 3, 5, 2, 4, 6});  // columns
  expect_components(load<uint2x3, Layout::kStructured, true>(b.descriptor, 0), {1, 2, 3, 4, 5, 6});
  const auto a = load<array<uint3, 2>>(b.descriptor, 4);
  expect_components(a[0], {2, 3, 4});
  expect_components(a[1], {5, 6, 7});
}

TEST(ShaderMemory, ConstantBufferLayoutStartsRows) {
  Buffer b(1024, DescriptorKind::kConstantBuffer);
  constexpr Layout kC = Layout::kConstantBuffer;
  const auto scalars = load<array<uint32_t, 3>, kC>(b.descriptor, 0);
  EXPECT_EQ(scalars[0], 1u);
  EXPECT_EQ(scalars[1], 5u);
  EXPECT_EQ(scalars[2], 9u);
  // Column-major: each column of three rows is in a row of 16 bytes.
  expect_components(load<uint3x2, kC>(b.descriptor, 0), {1, 5, 2, 6, 3, 7});
  expect_components(load<uint3x2, kC, true>(b.descriptor, 0), {1, 2, 5, 6, 9, 10});
  const auto matrices = load<array<uint3x2, 2>, kC>(b.descriptor, 16);
  expect_components(matrices[1], {13, 17, 14, 18, 15, 19});
  const auto nested = load<array<array<uint32_t, 2>, 2>, kC>(b.descriptor, 0);
  EXPECT_EQ(nested[1][0], 9u);
  EXPECT_EQ(nested[1][1], 13u);
  const auto doubles = load<double3x2, kC>(b.descriptor, 0);  // a column takes two rows
  EXPECT_EQ(std::bit_cast<uint64_t>(doubles[0][1]), 0x0000000A00000009u);
}

// float3x2 foo[7] takes 220 bytes with stride 32, float1x3 bar[5] 228. [DXC
// vk.layout.cbuffer.fxc.matrix.array]
TEST(ShaderMemory, ExtentsMatchDxc) {
  constexpr Layout kC = Layout::kConstantBuffer;
  EXPECT_EQ((memory::Extent<array<float3x2, 7>, kC, false>::bytes), 220u);
  EXPECT_EQ((memory::Extent<array<float3x2, 7>, kC, false>::stride), 32u);
  EXPECT_EQ((memory::Extent<array<float1x3, 5>, kC, false>::bytes), 228u);
  EXPECT_EQ((memory::Extent<float1x2, kC, false>::bytes), 20u);
  EXPECT_EQ((memory::Extent<array<float, 2>, kC, false>::bytes), 20u);
  EXPECT_EQ((memory::Extent<array<float, 2>, Layout::kStructured, false>::bytes), 8u);
}

TEST(ShaderMemory, ConstantBufferIsCutOffAtItsEnd) {
  Buffer b(16, DescriptorKind::kConstantBuffer);
  expect_components(load<uint2x2, Layout::kConstantBuffer>(b.descriptor, 0), {1, 0, 2, 0});
  expect_components(load<uint4, Layout::kConstantBuffer>(b.descriptor, 16), {0, 0, 0, 0});
}

TEST(ShaderMemory, StructuredElementsFollowTheViewsStride) {
  Buffer b(36, DescriptorKind::kStructuredBuffer, 12);
  expect_components(load_element<uint3>(b.descriptor, 2, 0), {7, 8, 9});
  EXPECT_EQ(load_element<uint32_t>(b.descriptor, 1, 8), 6u);
  expect_components(load_element<uint3>(b.descriptor, 3, 0), {0, 0, 0});
  EXPECT_EQ(load_element<uint32_t>(b.descriptor, 0xFFFFFFFFu, 0), 0u);
  EXPECT_EQ(load_element<uint32_t>(b.descriptor, 0, 12), 0u);  // not the next element
  expect_components(load_element<uint2>(b.descriptor, 0, 8), {3, 0});
  store_element<uint2>(b.descriptor, 0, 8, uint2{30, 40});
  EXPECT_EQ(b.words[2], 30u);
  EXPECT_EQ(b.words[3], 4u);
  b.descriptor.stride_bytes = 0;
  EXPECT_EQ(load_element<uint32_t>(b.descriptor, 0, 0), 0u);
}

template <class V, Layout L, bool RowMajor>
void expect_round_trip() {
  Buffer b(1024);
  V value{};
  for (int i = 0; i < shape<V>::count; ++i) {
    component(value, i) = static_cast<scalar_of<V>>(1000 + i);
  }
  store<V, L, RowMajor>(b.descriptor, 20, value);
  const V back = load<V, L, RowMajor>(b.descriptor, 20);
  for (int i = 0; i < shape<V>::count; ++i) EXPECT_EQ(component(back, i), component(value, i));
  EXPECT_EQ(b.words[4], 5u);
  const uint32_t end = 20 + memory::Extent<V, L, RowMajor>::bytes;
  EXPECT_EQ(load<uint32_t>(b.descriptor, (end + 3) / 4 * 4), (end + 3) / 4 + 1);
}

TEST(ShaderMemory, StoresReadBack) {
  expect_round_trip<float4, Layout::kStructured, false>();
  expect_round_trip<float3x4, Layout::kStructured, false>();
  expect_round_trip<float3x4, Layout::kStructured, true>();
  expect_round_trip<float3x4, Layout::kConstantBuffer, false>();
  expect_round_trip<double2x3, Layout::kStructured, true>();
  expect_round_trip<int16_t4, Layout::kStructured, false>();
}

TEST(ShaderMemory, RootDescriptorsReachPast32Bits) {
  Buffer b(0, DescriptorKind::kStructuredBuffer, 4);
  b.descriptor.size_bytes = ~uint64_t{0};
  EXPECT_EQ(load_element<uint32_t>(b.descriptor, 100, 0), 101u);
}

TEST(ShaderAtomics, ReturnTheOldValue) {
  uint32_t u = 10;
  EXPECT_EQ(interlocked_add(&u, 5u), 10u);
  EXPECT_EQ(interlocked_and(&u, 14u), 15u);
  EXPECT_EQ(interlocked_or(&u, 1u), 14u);
  EXPECT_EQ(interlocked_xor(&u, 3u), 15u);
  EXPECT_EQ(interlocked_min(&u, 4u), 12u);
  EXPECT_EQ(interlocked_max(&u, 0xFFFFFFFFu), 4u);
  EXPECT_EQ(interlocked_exchange(&u, 7u), 0xFFFFFFFFu);
  EXPECT_EQ(interlocked_compare_exchange(&u, 8u, 9u), 7u);
  EXPECT_EQ(interlocked_compare_exchange(&u, 7u, 9u), 7u);
  interlocked_compare_store(&u, 9u, 11u);
  EXPECT_EQ(u, 11u);
  int32_t i = -3;
  EXPECT_EQ(interlocked_max(&i, -5), -3);
  EXPECT_EQ(interlocked_min(&i, -5), -3);
  EXPECT_EQ(i, -5);
  int64_t l = kIntMax;
  EXPECT_EQ(interlocked_add(&l, 1), kIntMax);
  EXPECT_EQ(l, int64_t{1} << 31);
  float f = -0.0f;
  EXPECT_EQ(interlocked_compare_exchange(&f, 0.0f, 5.0f), 0.0f);
  EXPECT_TRUE(std::signbit(f));  // the bits differ, so nothing was written
  EXPECT_EQ(interlocked_exchange(&f, 2.0f), 0.0f);
  EXPECT_EQ(f, 2.0f);
}

TEST(ShaderAtomics, NullPlacesAreIgnored) {
  EXPECT_EQ(interlocked_add(static_cast<uint32_t*>(nullptr), 5u), 0u);
  EXPECT_EQ(interlocked_min(static_cast<int32_t*>(nullptr), 5), 0);
  EXPECT_EQ(interlocked_compare_exchange(static_cast<uint64_t*>(nullptr), 5u, 6u), 0u);
  EXPECT_EQ(interlocked_exchange(static_cast<float*>(nullptr), 5.0f), 0.0f);
  Buffer b(16);
  EXPECT_EQ(memory_address<uint32_t>(b.descriptor, 12), b.words.data() + 3);
  EXPECT_EQ(memory_address<uint32_t>(b.descriptor, 16), nullptr);
  EXPECT_EQ(memory_address<uint32_t>(b.descriptor, 2), nullptr);
  Buffer s(16, DescriptorKind::kStructuredBuffer, 8);
  EXPECT_EQ(element_address<uint32_t>(s.descriptor, 1, 4), s.words.data() + 3);
  EXPECT_EQ(element_address<uint32_t>(s.descriptor, 2, 0), nullptr);
}

}  // namespace
}  // namespace kaamos::shader
