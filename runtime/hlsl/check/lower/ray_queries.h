// SPDX-License-Identifier: MIT
//
// RayQuery: inline ray tracing in any stage. [DXR: RayQuery]
#pragma once

#include <functional>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class RayQueries : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_query_method(const Value& object, const NamePart& part, std::vector<Value>& arguments,
                          SourceLocation location);
  // An array of queries is as many variables.
  void lower_local_array(const VariableDecl* decl, const Type* type, VariableInfo* info);
  // Whether the value is an element whose index is not constant.
  static bool is_indexed(const Value& value);
  // Indexes an array of queries, of which earlier indices may not have been constant.
  Value element_of(const Value& array, const ir::Expr* index);
  // Does the same with whichever query the value is.
  Value for_each_of(const Value& value, const std::function<Value(const Value&)>& use);
  bool rename_query(const AssignExpr* expr, const Value& value);
  void lower_local_query(const VariableDecl* decl, const Type* type, VariableInfo* info);
  const ir::Expr* query_object(const Value& value, const Type* type);
  // `return query;`: all returns of a function name the same one.
  void return_query(const Value& value, SourceLocation location);
  // The local variable that a lowered function returns becomes a parameter of it: the caller's
  // object. Not if it is a parameter already.
  void pass_returned_query(FunctionInfo& function, ir::Block& body);
  // What a call gives: an argument, or a new object that the call is passed.
  const ir::Variable* call_result(const FunctionInfo& function, ir::Stmt& call);

 private:
  Value trace_ray_inline(ir::Stmt* statement, const Type* query, std::vector<Value>& arguments);
};

}  // namespace kaamos::hlsl
