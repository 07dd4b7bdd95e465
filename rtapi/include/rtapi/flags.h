// SPDX-License-Identifier: MIT
/// @file
/// Bit operators for the enumerations that D3D12 defines as flags.
#pragma once

#include <type_traits>

namespace rtapi {

/// True for the enumerations that have the operators below. A flags enumeration specializes it.
template <class E>
inline constexpr bool kIsFlags = false;

/// An enumeration whose values are combined by `|`.
template <class E>
concept FlagsEnum = std::is_enum_v<E> && kIsFlags<E>;

/// Bit operators, on the underlying integers. [D3D12: DEFINE_ENUM_FLAG_OPERATORS]
///@{
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
///@}

/// True if any bit of `bits` is set in `flags`; false where `bits` is 0.
template <FlagsEnum E>
constexpr bool HasAny(E flags, E bits) {
  return static_cast<std::underlying_type_t<E>>(flags & bits) != 0;
}

}  // namespace rtapi
