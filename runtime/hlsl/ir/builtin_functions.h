// SPDX-License-Identifier: MIT
//
// HLSL's intrinsic functions, as tables: the arguments and result of each, and the stages in which
// it is legal. [HLSL: Intrinsic functions] [DXR: Ray tracing system values]
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/ir/intrinsics.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

enum class IntrinsicShape : uint8_t {
  kFloat,      // converts all arguments to one floating type and shape, which is also the result's
  kNumeric,    // the same, but integers stay integers
  kUint,       // one integer argument of any shape; the result is uint (64-bit ones: uint64)
  kSign,       // one numeric argument; the result is int of the shape
  kTest,       // one floating argument; the result is bool of the shape
  kReduce,     // any numeric argument; the result is one bool
  kDot,        // two vectors of one numeric type; the result is a scalar
  kCross,      // two float3
  kLength,     // one floating vector to a scalar
  kDistance,   // two floating vectors to a scalar
  kVector,     // floating vectors of one shape; the result too
  kRefract,    // two floating vectors and a scalar
  kTranspose,  // a matrix
  kDeterminant,
  kAsFloat,  // 32-bit components reinterpreted
  kAsInt,
  kAsUint,
  kAsFloat16,
  kAsInt16,
  kAsUint16,
  kHalfToFloat,  // uint to float of the shape
  kFloatToHalf,  // float to uint of the shape
  kDouble,       // all arguments to double
  kAsDouble,     // two uint to double
  kMsad4,
  kDst,
  kLit,
};

struct IntrinsicRule {
  std::string_view name;
  Intrinsic intrinsic;
  IntrinsicShape shape;
  uint8_t count;  // number of arguments
};
const IntrinsicRule* find_intrinsic(std::string_view name);

// A method of RayQuery that only returns a value. [DXR: RayQuery intrinsics]
struct QueryValueRule {
  std::string_view name;
  ir::QueryValue value;
  bool of_committed;
  ir::Scalar scalar;
  uint8_t rows;  // 0: not a matrix
  uint8_t columns;
};

struct SystemValueRule {
  std::string_view name;
  ir::SystemValue value;
  ir::Scalar scalar;
  uint8_t rows;  // 0: not a matrix
  uint8_t columns;
  uint32_t stages;  // ir::StageBits
};
const SystemValueRule* find_system_value(std::string_view name);
const QueryValueRule* find_query_value(std::string_view name);

struct AtomicRule {
  std::string_view name;
  ir::AtomicOp op;
  bool has_compare;
  bool needs_result;  // the last argument must not be omitted
  bool has_result;
  bool on_floats = false;  // compares and exchanges their bits
};
// InterlockedAdd and so on. The methods of raw buffers have the same names and may end in "64".
const AtomicRule* find_atomic(std::string_view name);

struct BarrierRule {
  std::string_view name;
  uint32_t flags;  // ir::BarrierFlags
};
// The types to which the first operand of a wave operation is converted.
enum class WaveOperand : uint8_t {
  kNone,
  kBool,
  kAny,       // a scalar, vector or matrix as it is
  kNumber,    // the same, but bool becomes int
  kInteger,   // of integers
  kUnsigned,  // of unsigned integers
};

struct WaveRule {
  std::string_view name;
  shader::WaveOp op;
  WaveOperand operand;
  uint8_t minor;  // of the shader model that brought it
};

const WaveRule* find_wave(std::string_view name);
std::string_view wave_function_name(shader::WaveOp op);
const BarrierRule* find_barrier(std::string_view name);

enum class SampleForm : uint8_t {
  kSample,
  kBias,
  kLevel,
  kGradient,
  kCompare,
  kCompareZero,
  kCompareLevel,
  kCompareBias,
  kCompareGradient,
  kGather,
  kGatherCompare
};
struct SampleRule {
  std::string_view name;
  SampleForm form;
  uint8_t component;  // Gather
};
const SampleRule* find_sample(std::string_view name);

// For HLSL functions that are known but not supported yet: the feature they belong to. Empty for
// any other name.
std::string_view unsupported_function(std::string_view name);
// ddx and the like, clip, and what else is about pixels.
bool is_pixel_function(std::string_view name);
// Any of the above, or a function that is handled by name.
bool is_builtin_function(std::string_view name);

// The supported functions, for suggestions.
const std::vector<std::string_view>& builtin_function_names();

// "ray generation", "closest hit" ..; takes a single bit.
std::string_view stage_name(uint32_t stage);
// "closest hit and any hit shaders".
std::string stage_list(uint32_t stages);

}  // namespace kaamos::hlsl
