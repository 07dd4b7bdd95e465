// SPDX-License-Identifier: MIT
//
// What emitted code reads structs from and writes them to, member by member: one interface over raw
// and constant buffers and over an element of a structured buffer.
#pragma once

#include "kaamos/shader/memory.h"

namespace kaamos::shader {

struct MemoryView {
  const Descriptor& buffer;
};
struct ElementView {
  const Descriptor& buffer;
  uint32_t index;
};
KAAMOS_INLINE MemoryView memory_view(const Descriptor& buffer) {
  return {buffer};
}
KAAMOS_INLINE ElementView element_view(const Descriptor& buffer, uint32_t index) {
  return {buffer, index};
}

template <class V, Layout L, bool RowMajor>
KAAMOS_INLINE V read(const MemoryView& view, uint32_t offset) {
  return load<V, L, RowMajor>(view.buffer, offset);
}
template <class V, Layout L, bool RowMajor>
KAAMOS_INLINE V read(const ElementView& view, uint32_t offset) {
  return load_element<V, L, RowMajor>(view.buffer, view.index, offset);
}
template <Layout L, bool RowMajor, class V>
KAAMOS_INLINE void write(const MemoryView& view, uint32_t offset, const V& value) {
  store<V, L, RowMajor>(view.buffer, offset, value);
}
template <Layout L, bool RowMajor, class V>
KAAMOS_INLINE void write(const ElementView& view, uint32_t offset, const V& value) {
  store_element<V, L, RowMajor>(view.buffer, view.index, offset, value);
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
