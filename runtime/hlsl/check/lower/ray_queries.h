// SPDX-License-Identifier: MIT
//
// RayQuery: inline ray tracing in any stage. [DXR: RayQuery]
#pragma once

#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class RayQueries : LowerPart {
 public:
  using LowerPart::LowerPart;

  Value call_query_method(const Value& object, const NamePart& part, std::vector<Value>& arguments,
                          SourceLocation location);
  bool rename_query(const AssignExpr* expr, const Value& value);
  void lower_local_query(const VariableDecl* decl, const Type* type, VariableInfo* info);
  const ir::Expr* query_object(const Value& value, const Type* type);

 private:
  Value trace_ray_inline(ir::Stmt* statement, const Type* query, std::vector<Value>& arguments);
};

}  // namespace kaamos::hlsl
