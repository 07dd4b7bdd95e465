// SPDX-License-Identifier: MIT
// The names that mean a type before any declaration: the parser needs them to tell `Name x;` and
// `(Name)x` from expressions.
#pragma once

#include <string_view>

#include "ast.h"

namespace kaamos::hlsl {

struct BuiltinName {
  enum Kind : uint8_t {
    kNone,
    kNumeric,    // float3, int64_t2x2; scalar, rows, columns as in TypeSyntax.
    kType,       // Texture2D, RayDesc, vector, ...
    kSubobject,  // TriangleHitGroup, ...
  };
  Kind kind = kNone;
  ScalarKind scalar = ScalarKind::kFloat;
  uint8_t rows = 0;
  uint8_t columns = 0;
  SubobjectKind subobject = SubobjectKind::kStateObjectConfig;
};

BuiltinName find_builtin_name(std::string_view text);

}  // namespace kaamos::hlsl
