// SPDX-License-Identifier: MIT
//
// Intrinsics that only ray tracing shaders have. [DXR: Ray tracing HLSL intrinsics]
#pragma once

#include <string_view>
#include <vector>

#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/check/lower/lower_part.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

class RayIntrinsics : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_system_value(const SystemValueRule& rule, SourceLocation location);
  // Gives a hit object if `to_hit_object`, for which no closest-hit or miss shader runs.
  Value call_trace_ray(std::vector<Value>& arguments, SourceLocation location,
                       bool to_hit_object = false);
  Value call_invoke(std::vector<Value>& arguments, SourceLocation location);
  Value call_call_shader(std::vector<Value>& arguments, SourceLocation location);
  Value call_report_hit(std::vector<Value>& arguments, SourceLocation location);

 private:
  const ir::Variable* pass_by_reference(const Value& value, std::string_view what,
                                        SourceLocation location, bool& copied);
  bool pass_payload(ir::Stmt* statement, const Value& given, std::string_view what,
                    PayloadRoles roles);
  void emit_trace(ir::Stmt* statement, const ir::Variable* payload, const Type* type,
                  SourceLocation location, PayloadRoles roles);
};

}  // namespace kaamos::hlsl
