// SPDX-License-Identifier: MIT
//
// RayQuery: its methods and values.
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/cpp/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

std::string CppEmitter::query_value(const Expr& expr) {
  std::string query = place(expr.operands[0]);
  const QueryNeed need = need_of(expr);
  if (module_.check_access && need.hit) {
    query = std::string(expr.index == 1 ? "ks::checked::committed" : "ks::checked::candidate") +
            "(ctx.invocation, " + site(expr.location) + ", " + query + ", " +
            std::to_string(need.type) + "u, " + std::to_string(static_cast<int>(expr.query_value)) +
            "u)";
  }
  const std::string hit = query + (expr.index == 1 ? ".committed" : ".candidate");
  switch (expr.query_value) {
    case QueryValue::kType:
      return hit + ".type";
    case QueryValue::kRayT:
      return hit + ".t";
    case QueryValue::kInstanceIndex:
      return hit + ".instance_index";
    case QueryValue::kInstanceId:
      return hit + ".instance_id";
    case QueryValue::kInstanceContribution:
      return hit + ".instance_contribution";
    case QueryValue::kGeometryIndex:
      return hit + ".geometry_index";
    case QueryValue::kPrimitiveIndex:
      return hit + ".primitive_index";
    case QueryValue::kObjectRayOrigin:
      return "ks::query_object_origin(" + query + ", " + hit + ")";
    case QueryValue::kObjectRayDirection:
      return "ks::query_object_direction(" + query + ", " + hit + ")";
    case QueryValue::kObjectToWorld3x4:
      return "ks::load_transform(" + hit + ".object_to_world)";
    case QueryValue::kObjectToWorld4x3:
      return "ks::transpose(ks::load_transform(" + hit + ".object_to_world))";
    case QueryValue::kWorldToObject3x4:
      return "ks::load_transform(" + hit + ".world_to_object)";
    case QueryValue::kWorldToObject4x3:
      return "ks::transpose(ks::load_transform(" + hit + ".world_to_object))";
    case QueryValue::kBarycentrics:
      return "ks::query_barycentrics(" + hit + ")";
    case QueryValue::kFrontFace:
      return hit + ".front_face";
    case QueryValue::kProceduralNonOpaque:
      return hit + ".non_opaque";
    case QueryValue::kPositionTable:
      return "ks::query_position_table(" + hit + ")";
    case QueryValue::kRayFlags:
      return query + ".ray_flags";
    case QueryValue::kRayTMin:
      return query + ".ray.t_min";
    case QueryValue::kWorldRayOrigin:
      return "ks::query_world_origin(" + query + ")";
    case QueryValue::kWorldRayDirection:
      return "ks::query_world_direction(" + query + ")";
  }
  return "0u";
}

void CppEmitter::query(const Stmt& stmt) {
  constexpr const char* kNames[] = {"trace_ray_inline", "query_proceed", "query_abort",
                                    "query_commit_triangle", "query_commit_procedural"};
  const bool searches = stmt.query == QueryOp::kTrace || stmt.query == QueryOp::kProceed;
  const bool checked =
      module_.check_access && stmt.query != QueryOp::kProceed && stmt.query != QueryOp::kAbort;
  std::string text = stmt.result != nullptr ? variable(stmt.result) + " = ks::" : "ks::";
  text +=
      std::string(checked ? "checked::" : "") + kNames[static_cast<int>(stmt.query)] + "(" +
      (searches || checked ? "ctx.invocation, " : "") +
      (checked ? site(stmt.location) + ", " : "") +
      (checked && stmt.query == QueryOp::kTrace ? (is_unknown(module_, stmt) ? "true, " : "false, ")
                                                : "") +
      place(stmt.place);
  for (const Expr* operand : stmt.operands) {
    text += ", " + value(operand);
  }
  line(text + ");");
}

}  // namespace kaamos::hlsl
