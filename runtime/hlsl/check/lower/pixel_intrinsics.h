// SPDX-License-Identifier: MIT
//
// Lowers what needs the quad of a pixel or compute shader: derivatives, implicit levels of detail;
// and clip. What is made of them here stays an expression until it is known which stages reach it.
// [builder/finish/quad_functions.h]
#pragma once

#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class PixelIntrinsics : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_pixel_function(std::string_view name, std::vector<Value>& arguments,
                            SourceLocation location);
  Value call_level_of_detail(const Value& object, bool clamped, std::vector<Value>& arguments,
                             SourceLocation location);
  void use_implicit_level(std::string_view name, ir::Expr* sample, SourceLocation location);

 private:
  uint32_t stages_with_quads() const;
  const Type* type_of_numbers(std::string_view name, const Value& argument);
  Value is_helper_lane(std::vector<Value>& arguments, SourceLocation location);
  Value render_target_sample(std::string_view name, std::vector<Value>& arguments,
                             SourceLocation location);
  // From the middle of the pixel, in pixels.
  const ir::Expr* sample_position(const ir::Expr* number);
  const ir::Expr* sample_count();

  // What of an input of the pixel shader is read; `swizzle`: which of its components, or null.
  struct InputPlace {
    const ir::Expr* value = nullptr;  // null: it is none
    const ir::Expr* swizzle = nullptr;
    InputRead read;
  };
  InputPlace input_place(const Value& argument);
  // The one of the function with the same place.
  InputRead& known_read(const InputRead& read);
  const ir::Expr* fact_of(InputRead& read, InputFact fact, const ir::Type* type);
  Value evaluate_attribute(std::string_view name, std::vector<Value>& arguments,
                           SourceLocation location);
  // `offset`: from the middle of the pixel; null: the centroid.
  const ir::Expr* evaluated(const InputRead& place, const ir::Type* type, const ir::Expr* offset);
  Value attribute_at_vertex(std::vector<Value>& arguments, SourceLocation location);
  void use_derivative(std::string_view name, SourceLocation location);
  const ir::Expr* quad_value(shader::WaveOp op, const ir::Expr* operand);
};

}  // namespace kaamos::hlsl
