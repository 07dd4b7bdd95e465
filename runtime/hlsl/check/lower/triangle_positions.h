// SPDX-License-Identifier: MIT
//
// TriangleObjectPositions and ClusterID of hit shaders, of RayQuery and of hit objects.
// [DXR: TriangleObjectPositions, ClusterID]
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class TrianglePositions : LowerPart {
 public:
  using LowerPart::LowerPart;

  // Nothing if `name` is neither of the functions, methods of RayQuery or methods of hit objects.
  std::optional<Value> call_function(std::string_view name, const std::vector<Value>& arguments,
                                     SourceLocation location);
  std::optional<Value> call_query(std::string_view name, const ir::Expr* query,
                                  const std::vector<Value>& arguments, SourceLocation location);
  std::optional<Value> call_hit_object(std::string_view name, const ir::Expr* hit,
                                       const std::vector<Value>& arguments,
                                       SourceLocation location);
  // The attributes of a hit object that is made from the triangle that a query has committed.
  const ir::Expr* attributes_of(const ir::Expr* query, const ir::Expr* barycentrics,
                                const ir::Type* words);

 private:
  bool is_usable(std::string_view name, const std::vector<Value>& arguments,
                 SourceLocation location);
  Value positions(const ir::Expr* table, const ir::Expr* geometry, const ir::Expr* primitive,
                  SourceLocation location);
  Value cluster_id(const ir::Expr* table, SourceLocation location);
};

}  // namespace kaamos::hlsl
