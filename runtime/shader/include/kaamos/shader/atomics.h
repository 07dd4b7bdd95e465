// SPDX-License-Identifier: MIT
//
// The Interlocked operations. Each returns the previous value; for a null place (out of bounds) it
// does nothing and returns zero. The order is relaxed, because in HLSL only barriers order memory.
#pragma once

#include "kaamos/shader/vector.h"

namespace kaamos::shader {
namespace op {

// Replaces *place by change(old). `change` must be pure.
template <class T, class Change>
KAAMOS_INLINE T exchange_by(T* place, const Change& change) {
  T old = __atomic_load_n(place, __ATOMIC_RELAXED);
  while (!__atomic_compare_exchange_n(place, &old, change(old), true, __ATOMIC_RELAXED,
                                      __ATOMIC_RELAXED)) {
  }
  return old;
}

}  // namespace op

template <class T>
KAAMOS_INLINE T interlocked_add(T* place, std::type_identity_t<T> value) {
  return place != nullptr ? __atomic_fetch_add(place, value, __ATOMIC_RELAXED) : T{};
}
template <class T>
KAAMOS_INLINE T interlocked_and(T* place, std::type_identity_t<T> value) {
  return place != nullptr ? __atomic_fetch_and(place, value, __ATOMIC_RELAXED) : T{};
}
template <class T>
KAAMOS_INLINE T interlocked_or(T* place, std::type_identity_t<T> value) {
  return place != nullptr ? __atomic_fetch_or(place, value, __ATOMIC_RELAXED) : T{};
}
template <class T>
KAAMOS_INLINE T interlocked_xor(T* place, std::type_identity_t<T> value) {
  return place != nullptr ? __atomic_fetch_xor(place, value, __ATOMIC_RELAXED) : T{};
}
template <class T>
KAAMOS_INLINE T interlocked_min(T* place, std::type_identity_t<T> value) {
  if (place == nullptr) return T{};
  return op::exchange_by(place, [value](T old) { return value < old ? value : old; });
}
template <class T>
KAAMOS_INLINE T interlocked_max(T* place, std::type_identity_t<T> value) {
  if (place == nullptr) return T{};
  return op::exchange_by(place, [value](T old) { return value > old ? value : old; });
}
template <class T>
KAAMOS_INLINE T interlocked_exchange(T* place, std::type_identity_t<T> value) {
  if (place == nullptr) return T{};
  T old;
  __atomic_exchange(place, &value, &old, __ATOMIC_RELAXED);
  return old;
}
// Writes value if *place equals compare; floats, too, are compared bit by bit.
template <class T>
KAAMOS_INLINE T interlocked_compare_exchange(T* place, std::type_identity_t<T> compare,
                                             std::type_identity_t<T> value) {
  if (place == nullptr) return T{};
  __atomic_compare_exchange(place, &compare, &value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return compare;
}
template <class T>
KAAMOS_INLINE void interlocked_compare_store(T* place, std::type_identity_t<T> compare,
                                             std::type_identity_t<T> value) {
  interlocked_compare_exchange(place, compare, value);
}

}  // namespace kaamos::shader
