// SPDX-License-Identifier: MIT
// D3D12's structures have the bytes of rtapi's, so that they are passed on as they are.
// rtapi/src/layout_structs_test.cpp checks their members; here only sizes are checked.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace kaamos::d3d12 {

template <class To, class From>
const To* same_bytes(const From* from) {
  static_assert(sizeof(To) == sizeof(From) && alignof(To) <= alignof(From));
  static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  return reinterpret_cast<const To*>(from);
}

/// Empty for null.
template <class To, class From>
std::span<const To> same_bytes(const From* from, size_t count) {
  return {same_bytes<To>(from), from != nullptr ? count : 0};
}

}  // namespace kaamos::d3d12
