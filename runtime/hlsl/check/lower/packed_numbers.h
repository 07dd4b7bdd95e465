// SPDX-License-Identifier: MIT
//
// Intrinsics on packed numbers, which become plain arithmetic: sums of 64 bits in pairs of uint,
// dot products of halves and of bytes, four bytes in a uint.
// [HLSL: Shader Model 6.4; 6.6, Pack/Unpack] [DXIL: AddUint64]
#pragma once

#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class PackedNumbers : LowerPart {
 public:
  using LowerPart::LowerPart;

  static bool is_packed_intrinsic(std::string_view name);
  Value call_packed(std::string_view name, std::vector<Value>& arguments, SourceLocation location);

 private:
  Value add_uint64(std::vector<Value>& arguments, SourceLocation location);
  Value dot_of_halves(std::vector<Value>& arguments, SourceLocation location);
  Value pack_bytes(std::string_view name, const Value& argument, SourceLocation location);
  Value unpack_bytes(std::string_view name, const Value& argument, SourceLocation location);
  Value dot_of_bytes(std::string_view name, std::vector<Value>& arguments, SourceLocation location);
};

}  // namespace kaamos::hlsl
