// SPDX-License-Identifier: MIT
// Memory for a syntax tree: nodes are not destroyed one by one, but all together with the arena.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <span>
#include <string_view>
#include <type_traits>

namespace kaamos::hlsl {

class AstArena {
 public:
  AstArena() = default;
  AstArena(const AstArena&) = delete;
  AstArena& operator=(const AstArena&) = delete;

  // Makes a value-initialised node. T must be trivially destructible, because no destructor runs.
  template <class T>
  T* make() {
    static_assert(std::is_trivially_destructible_v<T>);
    T* node = new (memory_.allocate(sizeof(T), alignof(T))) T{};
    if constexpr (requires { T::kKind; }) node->kind = T::kKind;
    return node;
  }

  template <class T>
  std::span<const T> copy(std::span<const T> items) {
    static_assert(std::is_trivially_destructible_v<T>);
    if (items.empty()) return {};
    T* target = static_cast<T*>(memory_.allocate(items.size_bytes(), alignof(T)));
    std::uninitialized_copy(items.begin(), items.end(), target);
    return {target, items.size()};
  }

  std::string_view copy(std::string_view text) {
    if (text.empty()) return {};
    char* target = static_cast<char*>(memory_.allocate(text.size(), 1));
    std::copy(text.begin(), text.end(), target);
    return {target, text.size()};
  }

 private:
  std::pmr::monotonic_buffer_resource memory_{64 * 1024};
};

}  // namespace kaamos::hlsl
