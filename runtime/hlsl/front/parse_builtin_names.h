// SPDX-License-Identifier: MIT
// The names that are types before anything is declared: the parser needs them to tell `Name x;` and
// `(Name)x` from expressions.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "runtime/hlsl/front/ast.h"

namespace kaamos::hlsl {

struct BuiltinName {
  enum Kind : uint8_t {
    kNone,
    kNumeric,     // float3, int64_t2x2; scalar, rows, columns as in TypeSyntax.
    kType,        // Texture2D, RayDesc, vector, ...
    kSubobject,   // TriangleHitGroup, ...
    kNamespace,   // dx
    kScopedType,  // HitObject in dx::HitObject
  };
  Kind kind = kNone;
  ScalarKind scalar = ScalarKind::kFloat;
  uint8_t rows = 0;
  uint8_t columns = 0;
  SubobjectKind subobject = SubobjectKind::kStateObjectConfig;
};

// int, float and the like, which are never names; DXC takes uint, float3 and the rest as names.
bool is_type_keyword(std::string_view text);
BuiltinName find_builtin_name(std::string_view text);

// Guesses what the unknown type `text` was meant to be: a name in `declared` or a built-in one that
// differs in one or two letters, or HLSL's word for a GLSL type. Empty if there is no guess.
std::string similar_type_name(std::string_view text, std::span<const std::string_view> declared);

}  // namespace kaamos::hlsl
