// SPDX-License-Identifier: MIT
//
// Calls of functions and methods, including copy-in and copy-out, and the functions that are
// called.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class Calls : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value lower_call(const CallExpr* expr);
  Value call_functions(const std::vector<FunctionInfo*>& candidates, const NamePart& part,
                       const Value* object, std::vector<Value> arguments, SourceLocation location);
  void lower_function(FunctionInfo* function, SourceLocation use);
  ir::Function* make_ir_function(FunctionInfo* function);

  std::vector<FunctionInfo*> lowered;  // callees before callers

 private:
  Value call_method(const MemberExpr* callee, const CallExpr* call);
  Value call(FunctionInfo* function, const Value* object, std::vector<Value> arguments,
             SourceLocation location);
  FunctionInfo* bind_unbounded_arrays(FunctionInfo* function, const std::vector<Value>& arguments);
  void warn_passed_payload(const FunctionInfo& import, const std::vector<Value>& arguments);

  int function_depth_ = 0;  // nested lowerings of functions
  std::set<std::string> mangled_names_;
};

}  // namespace kaamos::hlsl
