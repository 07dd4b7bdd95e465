// SPDX-License-Identifier: MIT
//
// The meanings of the semantics of vertex, geometry and pixel shaders. [HLSL: Semantics; DXIL:
// Semantic Interpretations]
#pragma once

#include <string_view>

#include "runtime/hlsl/check/names/types.h"

namespace kaamos::hlsl {

enum class SignaturePoint : uint8_t {
  kVertexIn,
  kVertexOut,
  kPixelIn,
  kPixelOut,
  kGeometryIn,
  kGeometryOut
};

enum class SemanticMeaning : uint8_t {
  kArbitrary,  // a name like any other
  kSystemValue,
  kZero,        // an input that is 0: one sample, one view, a shading rate of 1 x 1
  kNotOffered,  // HLSL has it there, Kaamos does not
  kNotThere,    // nor does HLSL
};

struct SemanticRule {
  SemanticMeaning meaning = SemanticMeaning::kArbitrary;
  shader::SystemValue value = shader::SystemValue::kNone;
};

// `base` is a semantic without its number. Case does not count.
SemanticRule find_semantic(std::string_view base, SignaturePoint point);

// Returns whether a system value can have that type; `wanted` says which it can have.
bool fits_system_value(shader::SystemValue value, const Type* type, std::string_view& wanted);

bool same_letters(std::string_view a, std::string_view b);

}  // namespace kaamos::hlsl
