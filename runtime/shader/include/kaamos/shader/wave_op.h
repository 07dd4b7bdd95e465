// SPDX-License-Identifier: MIT
//
// Wave operations: their names, and what one passes to the backend. [HLSL: Shader Model 6.0, Wave
// intrinsics; Shader Model 6.5, WaveMatch and WaveMultiPrefix; Shader Model 6.7, QuadAny, QuadAll;
// Shader Model 6.10, GetGroupWaveIndex, GetGroupWaveCount]
#pragma once

#include <cstdint>

namespace kaamos::shader {

inline constexpr uint32_t kMostWaveLanes = 32;
inline constexpr uint32_t kLeastWaveLanes = 4;
inline constexpr uint32_t kDefaultWaveLanes = 8;

// The second operand is in parentheses.
enum class WaveOp : uint8_t {
  kLaneCount,  // uint, as the next ones; none has an operand or waits for other lanes
  kLaneIndex,
  kGroupWaveIndex,  // as the next one, of compute shaders
  kGroupWaveCount,
  kIsFirstLane,  // bool, without an operand
  kAnyTrue,      // bool of a bool, as the next one
  kAllTrue,
  kBallot,           // uint4 of a bool
  kCountBits,        // uint of a bool, as the next one
  kPrefixCountBits,  // lanes before this one
  kAllEqual,         // bool for each component
  kMatch,            // uint4: the lanes with this lane's value
  kReadLaneAt,       // (uint lane); here and below, the operand's type
  kReadLaneFirst,
  kSum,
  kProduct,
  kMin,
  kMax,
  kBitAnd,
  kBitOr,
  kBitXor,
  kPrefixSum,  // lanes before this one
  kPrefixProduct,
  kMultiPrefixSum,  // (uint4 lanes), of these the ones before this one
  kMultiPrefixProduct,
  kMultiPrefixCountBits,  // uint of a bool
  kMultiPrefixBitAnd,
  kMultiPrefixBitOr,
  kMultiPrefixBitXor,
  kQuadReadLaneAt,  // (uint lane of the quad)
  kQuadReadAcrossX,
  kQuadReadAcrossY,
  kQuadReadAcrossDiagonal,
  kQuadAny,  // bool of a bool, as the next one
  kQuadAll,
  kDdxCoarse,  // of a float, as the next ones: the difference at the quad's upper left pixel
  kDdyCoarse,
  kDdxFine,  // at the pixel's own row or column
  kDdyFine,
  kCount
};

// In the order of ir::Scalar.
enum class WaveScalar : uint8_t {
  kBool,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat16,
  kFloat32,
  kFloat64,
};

constexpr bool is_answered_at_once(WaveOp op) {
  return op <= WaveOp::kGroupWaveCount;
}
constexpr bool has_lane_operand(WaveOp op) {
  return op == WaveOp::kReadLaneAt || op == WaveOp::kQuadReadLaneAt;
}
constexpr bool has_mask_operand(WaveOp op) {
  return op >= WaveOp::kMultiPrefixSum && op <= WaveOp::kMultiPrefixBitXor;
}
constexpr bool is_quad_operation(WaveOp op) {
  return op >= WaveOp::kQuadReadLaneAt && op <= WaveOp::kQuadAll;
}
constexpr bool is_derivative(WaveOp op) {
  return op >= WaveOp::kDdxCoarse && op <= WaveOp::kDdyFine;
}
constexpr bool gives_bool(WaveOp op) {
  return op == WaveOp::kIsFirstLane || op == WaveOp::kAnyTrue || op == WaveOp::kAllTrue ||
         op == WaveOp::kAllEqual || op == WaveOp::kQuadAny || op == WaveOp::kQuadAll;
}
constexpr bool gives_mask(WaveOp op) {
  return op == WaveOp::kBallot || op == WaveOp::kMatch;
}
constexpr bool gives_number(WaveOp op) {
  return is_answered_at_once(op) || op == WaveOp::kCountBits || op == WaveOp::kPrefixCountBits ||
         op == WaveOp::kMultiPrefixCountBits;
}

// The operands and the path that one caller, which is one thread or `width` neighbouring threads
// that run at once, brings to an operation. Operands and results have component c of lane i at
// index c * width + i.
//
// The path says where the caller is, so that the backend can tell which lanes take part: of all
// lanes of a wave that have come to an operation, those with the least path, compared like words.
// [runtime/hlsl/analysis/wave_paths.h]
struct WaveCall {
  WaveOp op = WaveOp::kLaneCount;
  WaveScalar scalar = WaveScalar::kBool;  // of the first operand
  uint8_t components = 0;                 // of the first operand
  uint8_t width = 1;
  uint32_t active = 1;  // bit i: lane i takes part
  const void* value = nullptr;
  const uint32_t* second = nullptr;  // a lane, or the four words of a mask
  void* result = nullptr;            // written for active lanes only
  const uint32_t* path = nullptr;
  uint32_t path_length = 0;
};

}  // namespace kaamos::shader
