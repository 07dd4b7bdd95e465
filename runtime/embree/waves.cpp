// SPDX-License-Identifier: MIT
#include "runtime/embree/waves.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstring>

#include "kaamos/shader/wave_results.h"

namespace kaamos::embree {
namespace {

using shader::kMostWaveLanes;
using shader::WaveCall;
using shader::WaveOp;
using shader::WaveScalar;

constexpr uint32_t kMostComponents = 4;

std::strong_ordering compare_paths(const WaveCall& a, const WaveCall& b) {
  return std::lexicographical_compare_three_way(a.path, a.path + a.path_length, b.path,
                                                b.path + b.path_length);
}

// Copies the results of the lanes in `arrival` from `results`, which has kMostWaveLanes for each
// component.
void hand_out(const WaveArrival& arrival, const std::byte* results, size_t scalar_bytes) {
  const WaveCall& call = *arrival.call;
  const size_t bytes = shader::gives_bool(call.op) ? 1
                       : shader::gives_mask(call.op) || shader::gives_number(call.op)
                           ? 4
                           : scalar_bytes;
  const uint32_t components = shader::gives_mask(call.op) ? 4
                              : shader::gives_number(call.op) ||
                                      (shader::gives_bool(call.op) && call.op != WaveOp::kAllEqual)
                                  ? 1
                                  : call.components;
  auto* const out = static_cast<std::byte*>(call.result);
  for (uint32_t c = 0; c < components; ++c) {
    shader::wave::each(call.active, [&](uint32_t i) {
      std::memcpy(out + (c * call.width + i) * bytes,
                  results + (c * kMostWaveLanes + arrival.first_lane + i) * bytes, bytes);
    });
  }
}

template <class T>
void run_typed(const std::vector<WaveArrival>& arrivals) {
  const WaveCall& first = *arrivals[0].call;
  T values[kMostComponents * kMostWaveLanes] = {};
  uint32_t second[kMostComponents * kMostWaveLanes] = {};
  alignas(8) std::byte results[kMostComponents * kMostWaveLanes * 8];
  const uint32_t words = shader::has_mask_operand(first.op)   ? 4
                         : shader::has_lane_operand(first.op) ? 1
                                                              : 0;
  uint32_t active = 0;
  for (const WaveArrival& arrival : arrivals) {
    const WaveCall& call = *arrival.call;
    active |= call.active << arrival.first_lane;
    const auto* const from = static_cast<const T*>(call.value);
    shader::wave::each(call.active, [&](uint32_t i) {
      const uint32_t lane = arrival.first_lane + i;
      for (uint32_t c = 0; c < call.components; ++c) {
        values[c * kMostWaveLanes + lane] = from[c * call.width + i];
      }
      for (uint32_t c = 0; c < words; ++c) {
        second[c * kMostWaveLanes + lane] = call.second[c * call.width + i];
      }
    });
  }
  shader::wave_results<T>(first.op,
                          {active, kMostWaveLanes, first.components, values, second, results});
  for (const WaveArrival& arrival : arrivals) hand_out(arrival, results, sizeof(T));
}

}  // namespace

std::vector<WaveArrival> least_path(const std::vector<WaveArrival>& arrivals) {
  std::vector<WaveArrival> out;
  for (const WaveArrival& arrival : arrivals) {
    if (!out.empty()) {
      const auto order = compare_paths(*arrival.call, *out[0].call);
      if (order > 0) continue;
      if (order < 0) out.clear();
    }
    out.push_back(arrival);
  }
  return out;
}

void run_wave(const std::vector<WaveArrival>& arrivals) {
  switch (arrivals[0].call->scalar) {
    case WaveScalar::kBool:
      return run_typed<bool>(arrivals);
    case WaveScalar::kInt16:
      return run_typed<int16_t>(arrivals);
    case WaveScalar::kUint16:
      return run_typed<uint16_t>(arrivals);
    case WaveScalar::kInt32:
      return run_typed<int32_t>(arrivals);
    case WaveScalar::kUint32:
      return run_typed<uint32_t>(arrivals);
    case WaveScalar::kInt64:
      return run_typed<int64_t>(arrivals);
    case WaveScalar::kUint64:
      return run_typed<uint64_t>(arrivals);
    case WaveScalar::kFloat16:
      return run_typed<shader::half>(arrivals);
    case WaveScalar::kFloat32:
      return run_typed<float>(arrivals);
    case WaveScalar::kFloat64:
      return run_typed<double>(arrivals);
  }
}

bool answer_at_once(const WaveCall& call, uint32_t first_thread,
                    const shader::ComputeGroup& group) {
  if (!shader::is_answered_at_once(call.op)) return false;
  const uint32_t lanes = group.wave_lanes;
  const auto answer = [&](uint32_t thread) {
    switch (call.op) {
      case WaveOp::kLaneIndex:
        return thread % lanes;
      case WaveOp::kGroupWaveIndex:
        return thread / lanes;
      case WaveOp::kGroupWaveCount:
        return (group.threads + lanes - 1) / lanes;
      default:
        return lanes;
    }
  };
  auto* const out = static_cast<uint32_t*>(call.result);
  shader::wave::each(call.active, [&](uint32_t i) { out[i] = answer(first_thread + i); });
  return true;
}

}  // namespace kaamos::embree
