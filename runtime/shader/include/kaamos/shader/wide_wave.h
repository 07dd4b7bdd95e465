// SPDX-License-Identifier: MIT
//
// Wave operations of several threads that run at once. If their wave has no more lanes than that,
// nobody else takes part; otherwise the backend brings them together with the others.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/wave.h"
#include "kaamos/shader/wide.h"

namespace kaamos::shader {
namespace wave {

// A wide scalar, vector or matrix is an array of wide scalars.
template <class W>
KAAMOS_INLINE auto wide_scalars(W& wide_value) {
  using S = typename shape<std::remove_const_t<W>>::scalar;
  static_assert(sizeof(W) == sizeof(S) * shape<std::remove_const_t<W>>::count);
  return reinterpret_cast<std::conditional_t<std::is_const_v<W>, const S, S>*>(&wide_value);
}

template <int N, class T, class W>
KAAMOS_INLINE void take_apart(T (&out)[N * kLanes], const W& wide_value) {
  const auto* const scalars = wide_scalars(wide_value);
  for (int c = 0; c < N; ++c) {
    for (int lane = 0; lane < kLanes; ++lane) out[c * kLanes + lane] = get(scalars[c], lane);
  }
}

}  // namespace wave

// `first` is the index in its group of the thread in lane 0.
template <class R>
KAAMOS_INLINE R wide_lane_index(const ComputeGroup& group, uint32_t first) {
  R out{};
  for (int lane = 0; lane < kLanes; ++lane) {
    set(out, lane, (first + static_cast<uint32_t>(lane)) & (group.wave_lanes - 1));
  }
  return out;
}

template <class R>
KAAMOS_INLINE R wide_group_wave_index(const ComputeGroup& group, uint32_t first) {
  R out{};
  for (int lane = 0; lane < kLanes; ++lane) {
    set(out, lane, (first + static_cast<uint32_t>(lane)) / group.wave_lanes);
  }
  return out;
}

template <WaveOp kOp, class R, class W>
inline R wide_wave_call(Invocation& invocation, ComputeGroup& group, const lanes& active,
                        const uint32_t* path, uint32_t path_length, const W& value,
                        const uint32_t* second) {
  using T = Lane<typename shape<W>::scalar>;
  using ResultScalar = Lane<typename shape<R>::scalar>;
  constexpr int kOperands = shape<W>::count;
  constexpr int kResults = shape<R>::count;
  T values[kOperands * kLanes];
  wave::take_apart<kOperands>(values, value);
  ResultScalar results[kResults * kLanes] = {};
  const uint32_t bits = bits_of(active);
  if (group.wave_lanes > kLanes) {
    WaveCall call;
    call.op = kOp;
    call.scalar = wave_scalar_of<T>();
    call.components = kOperands;
    call.width = kLanes;
    call.active = bits;
    call.value = values;
    call.second = second;
    call.result = results;
    call.path = path;
    call.path_length = path_length;
    invocation.dispatch->services->wave(group, call);
  } else {
    const uint32_t one_wave = (1u << group.wave_lanes) - 1;
    for (uint32_t lane = 0; lane < kLanes; lane += group.wave_lanes) {
      const uint32_t part = bits >> lane & one_wave;
      if (part == 0) continue;
      wave_results<T>(kOp, {part, kLanes, kOperands, values + lane,
                            second != nullptr ? second + lane : nullptr, results + lane});
    }
  }
  R out{};
  auto* const scalars = wave::wide_scalars(out);
  for (int c = 0; c < kResults; ++c) {
    for (int lane = 0; lane < kLanes; ++lane) set(scalars[c], lane, results[c * kLanes + lane]);
  }
  return out;
}

template <WaveOp kOp, class R>
inline R wide_wave_operation(Invocation& invocation, ComputeGroup& group, const lanes& active,
                             const uint32_t* path, uint32_t path_length) {
  return wide_wave_call<kOp, R>(invocation, group, active, path, path_length, active, nullptr);
}
template <WaveOp kOp, class R, class W>
inline R wide_wave_operation(Invocation& invocation, ComputeGroup& group, const lanes& active,
                             const uint32_t* path, uint32_t path_length, const W& value) {
  return wide_wave_call<kOp, R>(invocation, group, active, path, path_length, value, nullptr);
}
// S is the wide form of uint or uint4.
template <WaveOp kOp, class R, class W, class S>
inline R wide_wave_operation(Invocation& invocation, ComputeGroup& group, const lanes& active,
                             const uint32_t* path, uint32_t path_length, const W& value,
                             const S& second) {
  uint32_t words[shape<S>::count * kLanes];
  wave::take_apart<shape<S>::count>(words, second);
  return wide_wave_call<kOp, R>(invocation, group, active, path, path_length, value, words);
}

}  // namespace kaamos::shader
