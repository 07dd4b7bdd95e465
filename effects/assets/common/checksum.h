// SPDX-License-Identifier: MIT
/// @file
/// A checksum of bytes, to recognise data and to find damage; no protection against intent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace kaamos::effects {

/// FNV-1a with 64 bits, byte by byte.
class Checksum {
 public:
  /// Adds bytes to what it was made of so far.
  void add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) value_ = (value_ ^ byte) * 1099511628211ull;
  }
  /// Adds the letters of a text and their number.
  void add(std::string_view text) {
    add_value(text.size());
    add({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  /// Adds a value without padding.
  template <class T>
  void add_value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add({reinterpret_cast<const std::uint8_t*>(&value), sizeof(T)});
  }
  /// Adds several values without padding.
  template <class... Values>
  void add_each(const Values&... values) {
    (add_value(values), ...);
  }
  /// Adds values without padding, and their number.
  template <class T>
  void add_values(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_value(values.size());
    add({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)});
  }
  /// The checksum of everything that was added.
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace kaamos::effects
