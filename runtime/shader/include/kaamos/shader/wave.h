// SPDX-License-Identifier: MIT
//
// Wave operations as emitted code calls them.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/vector.h"
#include "kaamos/shader/wave_results.h"

namespace kaamos::shader {

template <class T>
constexpr WaveScalar wave_scalar_of() {
  if constexpr (std::is_same_v<T, bool>) {
    return WaveScalar::kBool;
  } else if constexpr (is_half<T>) {
    return WaveScalar::kFloat16;
  } else if constexpr (std::is_floating_point_v<T>) {
    return sizeof(T) == 4 ? WaveScalar::kFloat32 : WaveScalar::kFloat64;
  } else {
    constexpr WaveScalar unsigned_of_size = sizeof(T) == 2   ? WaveScalar::kUint16
                                            : sizeof(T) == 4 ? WaveScalar::kUint32
                                                             : WaveScalar::kUint64;
    constexpr int below = std::is_signed_v<T> ? 1 : 0;
    return static_cast<WaveScalar>(static_cast<int>(unsigned_of_size) - below);
  }
}

KAAMOS_INLINE const uint32_t* words_of(const uint32_t& lane) {
  return &lane;
}
KAAMOS_INLINE const uint32_t* words_of(const vec<uint32_t, 4>& mask) {
  return mask.e;
}

// For one thread. V, the operand, is a scalar or a vector; without one it is a bool that nothing
// reads. In a ray shader, which has no group, the wave is one lane.
template <WaveOp kOp, class R, class V>
inline R wave_call(Invocation& invocation, ComputeGroup* group, const uint32_t* path,
                   uint32_t path_length, const V& value, const uint32_t* second) {
  using T = typename shape<V>::scalar;
  static_assert(sizeof(V) == sizeof(T) * shape<V>::count);
  R result{};
  WaveCall call;
  call.op = kOp;
  call.scalar = wave_scalar_of<T>();
  call.components = shape<V>::count;
  call.value = &value;
  call.second = second;
  call.result = &result;
  call.path = path;
  call.path_length = path_length;
  if (group != nullptr) {
    invocation.dispatch->services->wave(*group, call);
    return result;
  }
  if constexpr (std::is_same_v<R, uint32_t>) {
    if (kOp == WaveOp::kLaneCount) return 1;
    if (kOp == WaveOp::kLaneIndex) return 0;
  }
  const uint32_t own = 0;
  wave_results<T>(kOp, {1, 1, call.components, reinterpret_cast<const T*>(&value),
                        has_lane_operand(kOp) ? &own : second, &result});
  return result;
}

template <WaveOp kOp, class R>
inline R wave_operation(Invocation& invocation, ComputeGroup* group, const uint32_t* path,
                        uint32_t path_length) {
  return wave_call<kOp, R>(invocation, group, path, path_length, false, nullptr);
}
template <WaveOp kOp, class R, class V>
inline R wave_operation(Invocation& invocation, ComputeGroup* group, const uint32_t* path,
                        uint32_t path_length, const V& value) {
  return wave_call<kOp, R>(invocation, group, path, path_length, value, nullptr);
}
template <WaveOp kOp, class R, class V, class S>
inline R wave_operation(Invocation& invocation, ComputeGroup* group, const uint32_t* path,
                        uint32_t path_length, const V& value, const S& second) {
  return wave_call<kOp, R>(invocation, group, path, path_length, value, words_of(second));
}

}  // namespace kaamos::shader
