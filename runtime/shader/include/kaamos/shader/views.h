// SPDX-License-Identifier: MIT
//
// The views through which emitted code reads and writes structs, member by member: one interface
// for raw and constant buffers and for an element of a structured buffer.
#pragma once

#include "kaamos/shader/memory.h"

namespace kaamos::shader {

// Address and size are computed once for all members of a struct.
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

// A view where every byte that is read or written is known to be inside.
struct WholeView {
  uint64_t address;
};

namespace memory {
KAAMOS_INLINE Window window(const WholeView& view, uint32_t offset) {
  return {pointer(view.address + offset), ~uint64_t{0}};
}
KAAMOS_INLINE Window window(const MemoryView& view, uint32_t offset) {
  return {pointer(view.address + offset), view.bytes > offset ? view.bytes - offset : 0};
}
}  // namespace memory

// Returns whether `bytes` at byte `at` are inside. A single comparison; the length of a window
// would take two more steps.
KAAMOS_INLINE bool is_inside(const MemoryView& view, uint32_t at, uint64_t bytes) {
  return __builtin_expect(view.bytes >= at + bytes, 1);
}
KAAMOS_INLINE bool is_inside(const WholeView&, uint32_t, uint64_t) {
  return true;
}

template <class V, Layout L, bool RowMajor, class View>
KAAMOS_INLINE V read(const View& view, uint32_t offset) {
  const uint32_t at = memory::aligned_offset<V>(offset);
  if (!is_inside(view, at, memory::Extent<V, L, RowMajor>::bytes)) {
    return memory::read_partly<V, L, RowMajor>(memory::window(view, at));
  }
  return memory::read_all<V, L, RowMajor, false>(memory::window(WholeView{view.address}, at));
}
template <Layout L, bool RowMajor, class View, class V>
KAAMOS_INLINE void write(const View& view, uint32_t offset, const V& value) {
  const uint32_t at = memory::aligned_offset<V>(offset);
  if (!is_inside(view, at, memory::Extent<V, L, RowMajor>::bytes)) {
    return memory::write_partly<V, L, RowMajor>(memory::window(view, at), value);
  }
  memory::write_all<V, L, RowMajor, false>(memory::window(WholeView{view.address}, at), value);
}

namespace memory {
// Out of line, because structs rarely straddle the end; this keeps the code off the fast path.
template <class S, class ReadMembers>
[[gnu::noinline, gnu::cold]] inline S read_struct_partly(const MemoryView& view, uint32_t at,
                                                         const ReadMembers& read_members) {
  return read_members(view, at);
}
template <class S, class WriteMembers>
[[gnu::noinline, gnu::cold]] inline void write_struct_partly(const MemoryView& view, uint32_t at,
                                                             const S& value,
                                                             const WriteMembers& write_members) {
  write_members(view, at, value);
}
}  // namespace memory

// Reads a struct of `bytes` at byte `at`. One bounds test covers all of it if it is inside, as
// nearly every struct is; otherwise each scalar is tested.
template <class S, class View, class ReadMembers>
KAAMOS_INLINE S read_struct(const View& view, uint32_t at, uint64_t bytes,
                            const ReadMembers& read_members) {
  if constexpr (std::is_same_v<View, MemoryView>) {
    if (!is_inside(view, at, bytes)) return memory::read_struct_partly<S>(view, at, read_members);
  }
  return read_members(WholeView{view.address}, at);
}

namespace memory {
template <auto Read, class S>
[[gnu::noinline, gnu::cold]] void copy_struct(const MemoryView& view, uint32_t at, S& copy) {
  copy = Read(view, at);
}
}  // namespace memory

// The same for a struct with S's memory layout: returned where it is or, if partly outside, in
// `copy`.
template <auto Read, class S>
KAAMOS_INLINE const S& struct_in_place(const MemoryView& view, uint32_t at, S& copy) {
  if (is_inside(view, at, sizeof(S))) return *reinterpret_cast<const S*>(view.address + at);
  memory::copy_struct<Read>(view, at, copy);
  return copy;
}

template <class S, class View, class WriteMembers>
KAAMOS_INLINE void write_struct(const View& view, uint32_t at, uint64_t bytes, const S& value,
                                const WriteMembers& write_members) {
  if constexpr (std::is_same_v<View, MemoryView>) {
    if (!is_inside(view, at, bytes)) {
      return memory::write_struct_partly(view, at, value, write_members);
    }
  }
  write_members(WholeView{view.address}, at, value);
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
