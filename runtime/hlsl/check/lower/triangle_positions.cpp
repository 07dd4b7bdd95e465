// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/triangle_positions.h"

#include "kaamos/shader/triangle_positions.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/hit_object.h"

namespace kaamos::hlsl {
namespace {

constexpr uint32_t kStages = ir::kStageAnyHit | ir::kStageClosestHit;

}  // namespace

bool TrianglePositions::is_usable(std::string_view name, const std::vector<Value>& arguments,
                                  SourceLocation location) {
  if (shader_model_minor(names_.options().target) < 10) {
    report(CheckId::kNeedsShaderModel, location, {std::string(name), "6.10"});
    return false;
  }
  return lower_.intrinsics.check_count(name, arguments.size(), 0, 0, location);
}

Value TrianglePositions::cluster_id(const ir::Expr* table, SourceLocation location) {
  at(location);
  const Type* number = types_.scalar(Scalar::kUint32);
  return rvalue(
      build_.read(body_.temporary(build_.expr(ir::ExprKind::kClusterId, number->ir, {table}))),
      number);
}

Value TrianglePositions::positions(const ir::Expr* table, const ir::Expr* geometry,
                                   const ir::Expr* primitive, SourceLocation location) {
  at(location);
  const ir::Type* matrix = types_.matrix(Scalar::kFloat32, 3, 3)->ir;
  const ir::Expr* rows = build_.read(body_.temporary(
      build_.expr(ir::ExprKind::kTrianglePositions, matrix, {table, geometry, primitive})));
  const Type* type = names_.triangle_positions();
  std::vector<const ir::Expr*> corners;
  for (uint32_t i = 0; i < 3; ++i) corners.push_back(build_.element(rows, build_.uint32(i)));
  return rvalue(build_.construct(type->ir, std::move(corners)), type);
}

std::optional<Value> TrianglePositions::call_function(std::string_view name,
                                                      const std::vector<Value>& arguments,
                                                      SourceLocation location) {
  const bool is_cluster = name == "ClusterID";
  if (!is_cluster && name != "TriangleObjectPositions") return std::nullopt;
  if (!is_usable(name, arguments, location)) return error_value();
  lower_.intrinsics.use_in_stages(is_cluster ? "ClusterID" : "TriangleObjectPositions", kStages,
                                  location);
  const auto read = [&](ir::SystemValue value, const ir::Type* type) {
    ir::Expr* node = build_.expr(ir::ExprKind::kSystemValue, type);
    node->system_value = value;
    return static_cast<const ir::Expr*>(node);
  };
  const ir::Type* number = build_.scalar_type(Scalar::kUint32);
  const ir::Expr* table =
      read(ir::SystemValue::kPositionTable, build_.vector_type(Scalar::kUint32, 2));
  if (is_cluster) return cluster_id(table, location);
  return positions(table, read(ir::SystemValue::kGeometryIndex, number),
                   read(ir::SystemValue::kPrimitiveIndex, number), location);
}

std::optional<Value> TrianglePositions::call_query(std::string_view name, const ir::Expr* query,
                                                   const std::vector<Value>& arguments,
                                                   SourceLocation location) {
  const bool is_committed = name.starts_with("Committed");
  if (!is_committed && !name.starts_with("Candidate")) return std::nullopt;
  const std::string_view what = name.substr(9);
  if (what != "ClusterID" && what != "TriangleObjectPositions") return std::nullopt;
  if (!is_usable(name, arguments, location)) return error_value();
  const auto read = [&](ir::QueryValue value, const ir::Type* type) {
    ir::Expr* node = build_.expr(ir::ExprKind::kQueryValue, type, {query});
    node->query_value = value;
    node->index = is_committed ? 1 : 0;
    return static_cast<const ir::Expr*>(node);
  };
  const ir::Type* number = build_.scalar_type(Scalar::kUint32);
  const ir::Expr* table = build_.read(body_.temporary(
      read(ir::QueryValue::kPositionTable, build_.vector_type(Scalar::kUint32, 2))));
  if (what == "ClusterID") return cluster_id(table, location);
  const ir::Expr* has_table = build_.binary(
      ir::BinaryOp::kNotEqual,
      build_.binary(ir::BinaryOp::kBitOr, build_.swizzle(table, {0}), build_.swizzle(table, {1})),
      build_.uint32(0));
  // Without a hit there is no index to be asked for.
  const auto if_hit = [&](ir::QueryValue value) {
    return build_.conditional(has_table, read(value, number), build_.uint32(0));
  };
  return positions(table, if_hit(ir::QueryValue::kGeometryIndex),
                   if_hit(ir::QueryValue::kPrimitiveIndex), location);
}

std::optional<Value> TrianglePositions::call_hit_object(std::string_view name, const ir::Expr* hit,
                                                        const std::vector<Value>& arguments,
                                                        SourceLocation location) {
  const bool is_cluster = name == "GetClusterID";
  if (!is_cluster && name != "TriangleObjectPositions") return std::nullopt;
  if (!is_usable(name, arguments, location)) return error_value();
  const ir::Type* pair = build_.vector_type(Scalar::kUint32, 2);
  const ir::Expr* words = build_.field(hit, ir::kHitAttributes);
  const auto word = [&](uint32_t i) { return build_.element(words, build_.uint32(i)); };
  const ir::Expr* kept = build_.construct(
      pair, {word(shader::kHitPositionTable), word(shader::kHitPositionTable + 1)});
  // The attributes of other hits are the application's; only hits have a kind.
  const ir::Expr* is_triangle =
      build_.binary(ir::BinaryOp::kGreaterEqual, build_.field(hit, ir::kHitHitKind),
                    build_.uint32(shader::kLeastTriangleHitKind));
  const ir::Expr* table = build_.conditional(is_triangle, kept, build_.zero(pair));
  if (is_cluster) return cluster_id(table, location);
  return positions(table, build_.field(hit, ir::kHitGeometryIndex),
                   build_.field(hit, ir::kHitPrimitiveIndex), location);
}

const ir::Expr* TrianglePositions::attributes_of(const ir::Expr* query,
                                                 const ir::Expr* barycentrics,
                                                 const ir::Type* words) {
  const auto two_words = [&](const ir::Expr* pair, const ir::Type* type) {
    return static_cast<const ir::Expr*>(build_.expr(ir::ExprKind::kSameBytes, type, {pair}));
  };
  if (shader_model_minor(names_.options().target) < 10) return two_words(barycentrics, words);
  const ir::Type* pair = build_.vector_type(Scalar::kUint32, 2);
  ir::Expr* table = build_.expr(ir::ExprKind::kQueryValue, pair, {query});
  table->query_value = ir::QueryValue::kPositionTable;
  table->index = 1;
  // No temporaries: a query without such a hit is not asked for them.
  const ir::Expr* at = two_words(barycentrics, pair);
  std::vector<const ir::Expr*> parts(words->count, build_.uint32(0));
  for (uint8_t i = 0; i < 2; ++i) {
    parts[i] = build_.swizzle(at, {i});
    parts[shader::kHitPositionTable + i] = build_.swizzle(table, {i});
  }
  return build_.construct(words, std::move(parts));
}

}  // namespace kaamos::hlsl
