// SPDX-License-Identifier: MIT
//
// Loads and stores of scalars, vectors, matrices and arrays of these through buffer descriptors.
// Structures are read and written member by member by the emitted code.
//
// Bounds apply to each scalar: at or past Descriptor::size_bytes, reads give zero and writes are
// dropped. A descriptor that is not a raw, structured or constant buffer has no bytes at all. Raw
// loads and stores ignore the low bits of the offset: two for words and wider, one for 16-bit
// scalars. bool takes 4 bytes. [D3D11.3 7.13]
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/vector.h"

namespace kaamos::shader {

enum class Layout : uint8_t {
  kConstantBuffer,  // 16-byte rows: each array element and matrix column starts a new one
  kStructured,      // tightly packed
};

namespace memory {

template <class T>
using Stored = std::conditional_t<std::is_same_v<T, bool>, uint32_t, T>;

constexpr uint32_t row_aligned(uint32_t bytes) {
  return (bytes + 15u) & ~15u;
}

// The memory layout of a type: its bytes without padding after the last component, and the stride
// of its elements (array) or lines (matrix: columns, or rows if row-major).
template <class V, Layout L, bool RowMajor>
struct Extent {
  static constexpr uint32_t scalar_bytes = sizeof(Stored<V>);
  static constexpr uint32_t bytes = scalar_bytes;
};
template <class T, int N, Layout L, bool RowMajor>
struct Extent<vec<T, N>, L, RowMajor> {
  static constexpr uint32_t scalar_bytes = sizeof(Stored<T>);
  static constexpr uint32_t bytes = scalar_bytes * N;
};
template <class T, int R, int C, Layout L, bool RowMajor>
struct Extent<mat<T, R, C>, L, RowMajor> {
  static constexpr uint32_t scalar_bytes = sizeof(Stored<T>);
  static constexpr uint32_t lines = RowMajor ? R : C;
  static constexpr uint32_t line_bytes = scalar_bytes * (RowMajor ? C : R);
  static constexpr uint32_t stride =
      L == Layout::kConstantBuffer ? row_aligned(line_bytes) : line_bytes;
  static constexpr uint32_t bytes = stride * (lines - 1) + line_bytes;
};
template <class T, uint32_t N, Layout L, bool RowMajor>
struct Extent<array<T, N>, L, RowMajor> {
  static constexpr uint32_t scalar_bytes = Extent<T, L, RowMajor>::scalar_bytes;
  static constexpr uint32_t element_bytes = Extent<T, L, RowMajor>::bytes;
  static constexpr uint32_t stride =
      L == Layout::kConstantBuffer ? row_aligned(element_bytes) : element_bytes;
  static constexpr uint32_t bytes = stride * (N - 1) + element_bytes;
};

// The place of a value: [0, bytes) may be read from `base`.
struct Window {
  uint8_t* base;
  uint64_t bytes;
};

constexpr uint64_t buffer_bytes(const Descriptor& buffer) {
  const bool is_buffer = buffer.kind == DescriptorKind::kRawBuffer ||
                         buffer.kind == DescriptorKind::kStructuredBuffer ||
                         buffer.kind == DescriptorKind::kConstantBuffer ||
                         buffer.kind == DescriptorKind::kTypedBuffer;  // TextureBuffer<T>
  return is_buffer ? buffer.size_bytes : 0;
}

// Addresses stay integers until a byte is known to be inside.
KAAMOS_INLINE uint8_t* pointer(uint64_t address) {
  return reinterpret_cast<uint8_t*>(static_cast<uintptr_t>(address));
}

KAAMOS_INLINE Window window(const Descriptor& buffer, uint32_t offset) {
  const uint64_t size = buffer_bytes(buffer);
  return {pointer(buffer.address + offset), size > offset ? size - offset : 0};
}

// The offset that a raw access of a V actually uses.
template <class V>
constexpr uint32_t aligned_offset(uint32_t offset) {
  constexpr uint32_t kBytes = Extent<V, Layout::kStructured, false>::scalar_bytes;
  return offset & ~((kBytes < 4 ? kBytes : 4u) - 1);
}

KAAMOS_INLINE Window element_window(const Descriptor& buffer, uint32_t index, uint32_t offset) {
  if (buffer.kind != DescriptorKind::kStructuredBuffer || offset >= buffer.stride_bytes)
      [[unlikely]] {
    return {nullptr, 0};
  }
  const uint64_t at = static_cast<uint64_t>(index) * buffer.stride_bytes + offset;
  if (at >= buffer.size_bytes) [[unlikely]]
    return {nullptr, 0};
  // An element ends at the view's stride, even if the shader takes it to be longer.
  const uint64_t in_buffer = buffer.size_bytes - at;
  const uint64_t in_element = buffer.stride_bytes - offset;
  return {pointer(buffer.address + at), in_buffer < in_element ? in_buffer : in_element};
}

template <class T, bool Checked>
KAAMOS_INLINE T read_scalar(const Window& w, uint32_t at) {
  Stored<T> stored{};
  if (!Checked || w.bytes >= at + sizeof(stored)) {
    __builtin_memcpy(&stored, w.base + at, sizeof(stored));
  }
  if constexpr (std::is_same_v<T, bool>) {
    return stored != 0;
  } else {
    return stored;
  }
}

template <class T, bool Checked>
KAAMOS_INLINE void write_scalar(const Window& w, uint32_t at, T value) {
  const Stored<T> stored = value;
  if (!Checked || w.bytes >= at + sizeof(stored)) {
    __builtin_memcpy(w.base + at, &stored, sizeof(stored));
  }
}

// Calls visit(component or row-major array element, byte offset) for each scalar of `value`.
template <Layout L, bool RowMajor, class T, class Visit>
KAAMOS_INLINE void each(T& value, uint32_t at, const Visit& visit) {
  visit(value, at);
}
template <Layout L, bool RowMajor, class T, int N, class Visit>
KAAMOS_INLINE void each(vec<T, N>& value, uint32_t at, const Visit& visit) {
  unroll<N>([&](int i) KAAMOS_INLINE_LAMBDA {
    visit(value.e[i], at + static_cast<uint32_t>(i) * static_cast<uint32_t>(sizeof(Stored<T>)));
  });
}
template <Layout L, bool RowMajor, class T, int R, int C, class Visit>
KAAMOS_INLINE void each(mat<T, R, C>& value, uint32_t at, const Visit& visit) {
  constexpr uint32_t kStride = Extent<mat<T, R, C>, L, RowMajor>::stride;
  unroll<R>([&](int r) KAAMOS_INLINE_LAMBDA {
    unroll<C>([&, r](int c) KAAMOS_INLINE_LAMBDA {
      const uint32_t line = static_cast<uint32_t>(RowMajor ? r : c);
      const uint32_t place = static_cast<uint32_t>(RowMajor ? c : r);
      visit(value.e[r].e[c], at + line * kStride + place * sizeof(Stored<T>));
    });
  });
}
template <Layout L, bool RowMajor, class T, uint32_t N, class Visit>
KAAMOS_INLINE void each(array<T, N>& value, uint32_t at, const Visit& visit) {
  constexpr uint32_t kStride = Extent<array<T, N>, L, RowMajor>::stride;
  for (uint32_t i = 0; i < N; ++i) each<L, RowMajor>(value.e[i], at + i * kStride, visit);
}

template <class V, Layout L, bool RowMajor, bool Checked>
KAAMOS_INLINE V read_all(const Window& w) {
  V value{};
  each<L, RowMajor>(value, 0, [&w](auto& scalar, uint32_t at) KAAMOS_INLINE_LAMBDA {
    scalar = read_scalar<std::remove_reference_t<decltype(scalar)>, Checked>(w, at);
  });
  return value;
}
template <class V, Layout L, bool RowMajor, bool Checked>
KAAMOS_INLINE void write_all(const Window& w, const V& value) {
  V copy = value;
  each<L, RowMajor>(copy, 0, [&w](auto& scalar, uint32_t at) KAAMOS_INLINE_LAMBDA {
    write_scalar<std::remove_reference_t<decltype(scalar)>, Checked>(w, at, scalar);
  });
}

// Out of line, because values rarely straddle the end; this keeps the code off the fast path.
template <class V, Layout L, bool RowMajor>
[[gnu::noinline, gnu::cold]] inline V read_partly(Window w) {
  return read_all<V, L, RowMajor, true>(w);
}
template <class V, Layout L, bool RowMajor>
[[gnu::noinline, gnu::cold]] inline void write_partly(Window w, const V& value) {
  write_all<V, L, RowMajor, true>(w, value);
}

template <class V, Layout L, bool RowMajor>
KAAMOS_INLINE V read(const Window& w) {
  if (__builtin_expect(w.bytes >= Extent<V, L, RowMajor>::bytes, 1)) {
    return read_all<V, L, RowMajor, false>(w);
  }
  return read_partly<V, L, RowMajor>(w);
}
template <class V, Layout L, bool RowMajor>
KAAMOS_INLINE void write(const Window& w, const V& value) {
  if (__builtin_expect(w.bytes >= Extent<V, L, RowMajor>::bytes, 1)) {
    write_all<V, L, RowMajor, false>(w, value);
  } else {
    write_partly<V, L, RowMajor>(w, value);
  }
}

template <class T>
KAAMOS_INLINE T* atomic_pointer(const Window& w) {
  const uintptr_t address = reinterpret_cast<uintptr_t>(w.base);
  return w.bytes >= sizeof(T) && address % sizeof(T) == 0 ? reinterpret_cast<T*>(w.base) : nullptr;
}

}  // namespace memory

// Raw and constant buffers; offset in bytes. RowMajor only matters for matrices and arrays of them.
template <class V, Layout L = Layout::kStructured, bool RowMajor = false>
KAAMOS_INLINE V load(const Descriptor& buffer, uint32_t offset) {
  return memory::read<V, L, RowMajor>(memory::window(buffer, memory::aligned_offset<V>(offset)));
}
template <class V, Layout L = Layout::kStructured, bool RowMajor = false>
KAAMOS_INLINE void store(const Descriptor& buffer, uint32_t offset,
                         const std::type_identity_t<V>& value) {
  memory::write<V, L, RowMajor>(memory::window(buffer, memory::aligned_offset<V>(offset)), value);
}

// Structured buffers: byte `offset` of element `index`, using the view's stride.
template <class V, Layout L = Layout::kStructured, bool RowMajor = false>
KAAMOS_INLINE V load_element(const Descriptor& buffer, uint32_t index, uint32_t offset) {
  return memory::read<V, L, RowMajor>(memory::element_window(buffer, index, offset));
}
template <class V, Layout L = Layout::kStructured, bool RowMajor = false>
KAAMOS_INLINE void store_element(const Descriptor& buffer, uint32_t index, uint32_t offset,
                                 const std::type_identity_t<V>& value) {
  memory::write<V, L, RowMajor>(memory::element_window(buffer, index, offset), value);
}

// For atomics: null if out of bounds or misaligned.
template <class T>
KAAMOS_INLINE T* memory_address(const Descriptor& buffer, uint32_t offset) {
  return memory::atomic_pointer<T>(memory::window(buffer, offset));
}
// The counter of a structured buffer; null if it has none.
KAAMOS_INLINE uint32_t* counter(const Descriptor& buffer) {
  return reinterpret_cast<uint32_t*>(static_cast<uintptr_t>(counter_address(buffer)));
}

template <class T>
KAAMOS_INLINE T* element_address(const Descriptor& buffer, uint32_t index, uint32_t offset) {
  return memory::atomic_pointer<T>(memory::element_window(buffer, index, offset));
}

}  // namespace kaamos::shader
