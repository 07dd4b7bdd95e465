// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/debugging.h"

#include "kaamos/shader/debugging.h"
#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {

Value Debugging::call_break(const std::vector<Value>& arguments, SourceLocation location) {
  if (shader_model_minor(names_.options().target) < 10) {
    report(CheckId::kNeedsShaderModel, location, {"DebugBreak", "6.10"});
    return error_value();
  }
  if (!lower_.intrinsics.check_count("DebugBreak", arguments.size(), 0, 0, location)) {
    return error_value();
  }
  at(location);
  body_.emit(build_.stmt(ir::StmtKind::kDebugBreak));
  return rvalue(build_.int32(0), types_.void_type());
}

// A value that backends give beside the constants of records.
Value Debugging::call_is_enabled(const std::vector<Value>& arguments, SourceLocation location) {
  if (!lower_.intrinsics.check_count("dx::IsDebuggingEnabled", arguments.size(), 0, 0, location)) {
    return error_value();
  }
  const ir::Expr* answer =
      build_.expr(ir::ExprKind::kRecordConstant, build_.scalar_type(Scalar::kUint32),
                  {build_.zero(names_.hit_object()->ir), build_.uint32(shader::kDebuggingEnabled)});
  return rvalue(build_.convert(answer, Scalar::kBool), types_.boolean());
}

}  // namespace kaamos::hlsl
