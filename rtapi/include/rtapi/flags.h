// SPDX-License-Identifier: MIT
//
// Bit operators for the enumerations that D3D12 defines as flags.
#pragma once

#include <type_traits>

namespace rtapi {

template <class E>
inline constexpr bool kIsFlags = false;

template <class E>
concept FlagsEnum = std::is_enum_v<E> && kIsFlags<E>;

template <FlagsEnum E>
constexpr E operator|(E a, E b) {
  using U = std::underlying_type_t<E>;
  return static_cast<E>(static_cast<U>(a) | static_cast<U>(b));
}
template <FlagsEnum E>
constexpr E operator&(E a, E b) {
  using U = std::underlying_type_t<E>;
  return static_cast<E>(static_cast<U>(a) & static_cast<U>(b));
}
template <FlagsEnum E>
constexpr E operator~(E a) {
  using U = std::underlying_type_t<E>;
  return static_cast<E>(~static_cast<U>(a));
}
template <FlagsEnum E>
constexpr E& operator|=(E& a, E b) {
  return a = a | b;
}
template <FlagsEnum E>
constexpr E& operator&=(E& a, E b) {
  return a = a & b;
}

// True if any bit of `bits` is set in `flags`.
template <FlagsEnum E>
constexpr bool HasAny(E flags, E bits) {
  return static_cast<std::underlying_type_t<E>>(flags & bits) != 0;
}

}  // namespace rtapi
