// SPDX-License-Identifier: MIT
//
// What emitted code reads structs from and writes them to, member by member: one interface over raw
// and constant buffers and over an element of a structured buffer.
#pragma once

#include "kaamos/shader/memory.h"

namespace kaamos::shader {

// The bytes are worked out once for all members of a struct.
struct MemoryView {
  uint64_t address;
  uint64_t bytes;
};
KAAMOS_INLINE MemoryView memory_view(const Descriptor& buffer) {
  return {buffer.address, memory::buffer_bytes(buffer)};
}
KAAMOS_INLINE MemoryView element_view(const Descriptor& buffer, uint32_t index) {
  const memory::Window element = memory::element_window(buffer, index, 0);
  return {reinterpret_cast<uintptr_t>(element.base), element.bytes};
}

namespace memory {
KAAMOS_INLINE Window window(const MemoryView& view, uint32_t offset) {
  return {pointer(view.address + offset), view.bytes > offset ? view.bytes - offset : 0};
}
}  // namespace memory

template <class V, Layout L, bool RowMajor>
KAAMOS_INLINE V read(const MemoryView& view, uint32_t offset) {
  return memory::read<V, L, RowMajor>(memory::window(view, memory::aligned_offset<V>(offset)));
}
template <Layout L, bool RowMajor, class V>
KAAMOS_INLINE void write(const MemoryView& view, uint32_t offset, const V& value) {
  memory::write<V, L, RowMajor>(memory::window(view, memory::aligned_offset<V>(offset)), value);
}

// Arrays of structs; stride in bytes.
template <class A, class ReadElement>
KAAMOS_INLINE A read_array(const ReadElement& read_element, uint32_t offset, uint32_t stride) {
  A out{};
  for (auto& element : out.e) {
    element = read_element(offset);
    offset += stride;
  }
  return out;
}
template <class A, class WriteElement>
KAAMOS_INLINE void write_array(const A& value, const WriteElement& write_element, uint32_t offset,
                               uint32_t stride) {
  for (const auto& element : value.e) {
    write_element(offset, element);
    offset += stride;
  }
}

}  // namespace kaamos::shader
