// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/hit_objects.h"

#include <algorithm>
#include <bit>

#include "kaamos/shader/abi.h"
#include "kaamos/shader/reordering.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/ir/hit_object.h"

namespace kaamos::hlsl {
namespace {

constexpr uint32_t kStages = ir::kStageRayGeneration | ir::kStageClosestHit | ir::kStageMiss;
constexpr uint32_t kDefinedRayFlags = 0x7FF;
constexpr uint32_t kHitRecordBits = 0xFFFFFFF;
constexpr uint32_t kMissRecordBits = 0xFFFF;

struct Getter {
  std::string_view name;
  uint32_t field;
};
constexpr Getter kGetters[] = {
    {"GetRayFlags", ir::kHitRayFlags},
    {"GetRayTMin", ir::kHitTMin},
    {"GetRayTCurrent", ir::kHitT},
    {"GetWorldRayOrigin", ir::kHitOrigin},
    {"GetWorldRayDirection", ir::kHitDirection},
    {"GetInstanceIndex", ir::kHitInstanceIndex},
    {"GetInstanceID", ir::kHitInstanceId},
    {"GetGeometryIndex", ir::kHitGeometryIndex},
    {"GetPrimitiveIndex", ir::kHitPrimitiveIndex},
    {"GetHitKind", ir::kHitHitKind},
    {"GetShaderTableIndex", ir::kHitRecord},
};

// Value is the committed hit's if `committed`, else the ray's.
struct QueryField {
  uint32_t field;
  ir::QueryValue value;
  bool committed;
};
constexpr QueryField kQueryFields[] = {
    {ir::kHitRayFlags, ir::QueryValue::kRayFlags, false},
    {ir::kHitOrigin, ir::QueryValue::kWorldRayOrigin, false},
    {ir::kHitTMin, ir::QueryValue::kRayTMin, false},
    {ir::kHitDirection, ir::QueryValue::kWorldRayDirection, false},
    {ir::kHitT, ir::QueryValue::kRayT, true},
    {ir::kHitInstanceIndex, ir::QueryValue::kInstanceIndex, true},
    {ir::kHitInstanceId, ir::QueryValue::kInstanceId, true},
    {ir::kHitGeometryIndex, ir::QueryValue::kGeometryIndex, true},
    {ir::kHitPrimitiveIndex, ir::QueryValue::kPrimitiveIndex, true},
    {ir::kHitObjectToWorld, ir::QueryValue::kObjectToWorld3x4, true},
    {ir::kHitWorldToObject, ir::QueryValue::kWorldToObject3x4, true},
};

}  // namespace

void HitObjects::use(std::string_view name, uint32_t stages, SourceLocation location) {
  lower_.intrinsics.use_in_stages(name, stages, location);
  if (body_.function) body_.function->hit_objects = true;
}

std::optional<Value> HitObjects::call_function(const QualifiedName& name, const CallExpr* call) {
  const auto arguments = [&] { return lower_.expressions.lower_all(call->arguments, true, true); };
  const auto any_failed = [](const std::vector<Value>& values) {
    return std::any_of(values.begin(), values.end(), [](const Value& one) { return one.failed(); });
  };
  if (name.parts.size() >= 2) {
    QualifiedName scope = name;
    scope.parts = name.parts.first(name.parts.size() - 1);
    const Symbol* symbol = names_.resolve_name(scope, body_.scope, true);
    if (symbol && symbol->kind == SymbolKind::kType && symbol->type->is_hit_object()) {
      std::vector<Value> values = arguments();
      if (any_failed(values)) return error_value();
      at(call->location);
      return call_static(name.last(), values, call->location);
    }
  }
  const bool asks_debugger = name.last().identifier == "IsDebuggingEnabled";
  if (!asks_debugger && name.last().identifier != "MaybeReorderThread") return std::nullopt;
  const Symbol* symbol = names_.resolve_name(name, body_.scope, true);
  if (!symbol || symbol->kind != SymbolKind::kFunctions || !symbol->functions.empty()) {
    return std::nullopt;
  }
  std::vector<Value> values = arguments();
  if (any_failed(values)) return error_value();
  at(call->location);
  if (asks_debugger) return lower_.debugging.call_is_enabled(values, call->location);
  return call_reorder(values, call->location);
}

// The order in which threads go on is not observable, so there is nothing to do but to look at the
// record, in checked libraries. [DXR: MaybeReorderThread]
Value HitObjects::call_reorder(std::vector<Value>& arguments, SourceLocation location) {
  if (!lower_.intrinsics.check_count("MaybeReorderThread", arguments.size(), 1, 3, location)) {
    return error_value();
  }
  const bool has_hit = arguments.size() != 2;
  lower_.intrinsics.use_in_stages("dx::MaybeReorderThread", ir::kStageRayGeneration, location);
  if (has_hit && body_.function) body_.function->hit_objects = true;
  const Type* number = types_.scalar(Scalar::kUint32);
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Type* type = has_hit && i == 0 ? names_.hit_object() : number;
    if (!lower_.conversions.convert(arguments[i], type, arguments[i].location)) {
      return error_value();
    }
  }
  if (has_hit) {
    const ir::Expr* value = lower_.places.load(arguments[0]);
    if (!value) return error_value();
    body_.temporary(build_.expr(ir::ExprKind::kRecordConstant, number->ir,
                                {value, build_.uint32(shader::kReorderedRecord)}));
  }
  return rvalue(build_.int32(0), types_.void_type());
}

Value HitObjects::call_static(const NamePart& part, std::vector<Value>& arguments,
                              SourceLocation location) {
  const std::string name(part.identifier);
  const Type* type = names_.hit_object();
  const auto has = [&](size_t lowest, size_t highest) {
    return lower_.intrinsics.check_count("dx::HitObject::" + name, arguments.size(), lowest,
                                         highest, location);
  };
  use("dx::HitObject", kStages, location);
  if (name == "MakeNop") {
    return has(0, 0) ? rvalue(build_.zero(type->ir), type) : error_value();
  }
  if (name == "MakeMiss") return has(3, 3) ? make_miss(arguments) : error_value();
  if (name == "FromRayQuery") return has(1, 3) ? from_query(arguments, location) : error_value();
  if (name == "TraceRay") {
    return has(8, 8) ? lower_.ray_intrinsics.call_trace_ray(arguments, location, true)
                     : error_value();
  }
  if (name == "Invoke") {
    return has(2, 2) ? lower_.ray_intrinsics.call_invoke(arguments, location) : error_value();
  }
  report(CheckId::kNoSuchMethod, location, {to_string(type), name});
  return error_value();
}

Value HitObjects::make_miss(std::vector<Value>& arguments) {
  const Type* number = types_.scalar(Scalar::kUint32);
  const Type* types[] = {number, number, names_.ray_desc()};
  const ir::Expr* values[3];
  for (size_t i = 0; i < 3; ++i) {
    values[i] = lower_.conversions.convert(arguments[i], types[i], arguments[i].location);
    if (!values[i]) return error_value();
  }
  const ir::Expr* ray = body_.repeatable(values[2]);
  const auto masked = [&](const ir::Expr* value, uint32_t bits) {
    return build_.binary(ir::BinaryOp::kBitAnd, value, build_.uint32(bits));
  };
  const Type* type = names_.hit_object();
  std::vector<const ir::Expr*> fields;
  for (const ir::Field& field : type->ir->structure->fields) {
    fields.push_back(build_.zero(field.type));
  }
  fields[ir::kHitState] = build_.uint32(shader::kHitObjectMiss);
  fields[ir::kHitRayFlags] = masked(values[0], kDefinedRayFlags);
  fields[ir::kHitOrigin] = build_.field(ray, 0);
  fields[ir::kHitTMin] = build_.field(ray, 1);
  fields[ir::kHitDirection] = build_.field(ray, 2);
  fields[ir::kHitT] = build_.field(ray, 3);
  fields[ir::kHitIsBound] = build_.uint32(1);
  fields[ir::kHitRecord] = masked(values[1], kMissRecordBits);
  return rvalue(build_.construct(type->ir, std::move(fields)), type);
}

// Committed hits give a hit that is bound to no record, anything else a NOP.
Value HitObjects::from_query(std::vector<Value>& arguments, SourceLocation location) {
  if (arguments.size() == 2) {
    lower_.intrinsics.check_count("dx::HitObject::FromRayQuery", 2, 1, 1, location);
    return error_value();
  }
  const Type* query_type = arguments[0].type;
  if (!query_type || !query_type->is_query()) {
    report(CheckId::kConversion, location,
           {query_type ? to_string(query_type) : "this", "RayQuery"});
    return error_value();
  }
  const ir::Expr* query = lower_.ray_queries.query_object(arguments[0], query_type);
  if (!query) return error_value();
  const auto read = [&](ir::QueryValue value, const ir::Type* type, bool committed) {
    ir::Expr* node = build_.expr(ir::ExprKind::kQueryValue, type, {query});
    node->query_value = value;
    node->index = committed ? 1 : 0;
    return static_cast<const ir::Expr*>(node);
  };
  const ir::Type* number = build_.scalar_type(Scalar::kUint32);
  const ir::Expr* status = read(ir::QueryValue::kType, number, true);
  const ir::Expr* of_triangle =
      build_.binary(ir::BinaryOp::kEqual, status, build_.uint32(1));  // COMMITTED_TRIANGLE_HIT
  const Type* type = names_.hit_object();
  const auto& declared = type->ir->structure->fields;
  const ir::Type* words = declared[ir::kHitAttributes].type;
  const auto as_words = [&](const ir::Expr* attributes) {
    return static_cast<const ir::Expr*>(build_.expr(ir::ExprKind::kSameBytes, words, {attributes}));
  };
  const ir::Expr* kind = build_.uint32(0);
  const ir::Expr* attributes = build_.zero(words);
  if (arguments.size() == 3) {
    kind = lower_.conversions.convert(arguments[1], types_.scalar(Scalar::kUint32),
                                      arguments[1].location);
    if (!kind || !check_attributes(arguments[2].type, arguments[2].location)) return error_value();
    const ir::Expr* given = lower_.places.load(arguments[2]);
    if (!given) return error_value();
    kind = body_.repeatable(kind);
    attributes = as_words(body_.repeatable(given));
  }
  at(location);
  std::vector<const ir::Expr*> fields;
  for (const ir::Field& field : declared) fields.push_back(build_.zero(field.type));
  fields[ir::kHitState] = build_.uint32(shader::kHitObjectHit);
  for (const QueryField& one : kQueryFields) {
    fields[one.field] = read(one.value, declared[one.field].type, one.committed);
  }
  const ir::Expr* front = read(ir::QueryValue::kFrontFace, build_.scalar_type(Scalar::kBool), true);
  const ir::Expr* facing = build_.conditional(front, build_.uint32(254), build_.uint32(255));
  const ir::Expr* barycentrics =
      read(ir::QueryValue::kBarycentrics, build_.vector_type(Scalar::kFloat32, 2), true);
  fields[ir::kHitHitKind] = build_.conditional(of_triangle, facing, kind);
  fields[ir::kHitAttributes] = build_.conditional(
      of_triangle, lower_.triangle_positions.attributes_of(query, barycentrics, words), attributes);
  const ir::Expr* hit = build_.construct(type->ir, std::move(fields));
  const ir::Expr* is_nothing = build_.binary(ir::BinaryOp::kEqual, status, build_.uint32(0));
  // The query may change before the value is read.
  return rvalue(
      build_.read(body_.temporary(build_.conditional(is_nothing, build_.zero(type->ir), hit))),
      type);
}

bool HitObjects::check_attributes(const Type* type, SourceLocation location) {
  if (!type || !type->is_struct() || contains_resource(type) || contains_hit_object(type) ||
      contains_long_vector(type)) {
    report(CheckId::kUserStruct, location,
           {"the attributes of a hit object", type ? to_string(type) : "a resource"});
    return false;
  }
  const uint32_t bytes = payload_bytes(type);
  if (bytes <= 32) return true;
  report(CheckId::kAttributeSize, location, {to_string(type), std::to_string(bytes)});
  return false;
}

Value HitObjects::call_method(const Value& object, const NamePart& part,
                              std::vector<Value>& arguments, SourceLocation location) {
  const std::string name(part.identifier);
  const Type* number = types_.scalar(Scalar::kUint32);
  const auto has = [&](size_t lowest, size_t highest) {
    return lower_.intrinsics.check_count(name, arguments.size(), lowest, highest, location);
  };
  use("dx::HitObject", kStages, location);
  if (name == "SetShaderTableIndex") {
    return has(1, 1) ? set_record(object, arguments[0]) : error_value();
  }
  const ir::Expr* value = lower_.places.load(object);
  if (!value) return error_value();
  const ir::Expr* hit = body_.repeatable(value);
  if (name == "GetAttributes") {
    return has(0, 1) ? attributes_of(hit, part, arguments, location) : error_value();
  }
  if (name == "LoadLocalRootTableConstant") {
    if (!has(1, 1)) return error_value();
    const ir::Expr* offset =
        lower_.conversions.convert(arguments[0], number, arguments[0].location);
    if (!offset) return error_value();
    return rvalue(build_.expr(ir::ExprKind::kRecordConstant, number->ir, {hit, offset}), number);
  }
  if (auto result = lower_.triangle_positions.call_hit_object(name, hit, arguments, location)) {
    return *result;
  }
  if (auto result = getter(hit, name)) return has(0, 0) ? *result : error_value();
  report(CheckId::kNoSuchMethod, location, {to_string(object.type), name});
  return error_value();
}

std::optional<Value> HitObjects::getter(const ir::Expr* hit, std::string_view name) {
  const Type* vector = types_.vector(Scalar::kFloat32, 3);
  if (name == "IsNop") return rvalue(is(hit, shader::kHitObjectNop), types_.boolean());
  if (name == "IsHit") return rvalue(is(hit, shader::kHitObjectHit), types_.boolean());
  if (name == "IsMiss") return rvalue(is(hit, shader::kHitObjectMiss), types_.boolean());
  for (const Getter& one : kGetters) {
    if (one.name != name) continue;
    const ir::Expr* value = build_.field(hit, one.field);
    const bool is_vector = value->type->kind == ir::TypeKind::kVector;
    return rvalue(value, is_vector ? vector : types_.scalar(value->type->scalar));
  }
  if (name == "GetObjectRayOrigin") {
    return rvalue(in_object_space(hit, ir::kHitOrigin, 1), vector);
  }
  if (name == "GetObjectRayDirection") {
    return rvalue(in_object_space(hit, ir::kHitDirection, 0), vector);
  }
  const bool to_world = name.starts_with("GetObjectToWorld");
  if (!to_world && !name.starts_with("GetWorldToObject")) return std::nullopt;
  const std::string_view shape = name.substr(16);
  if (shape != "3x4" && shape != "4x3") return std::nullopt;
  const ir::Expr* rows = matrix_of(hit, to_world ? ir::kHitObjectToWorld : ir::kHitWorldToObject);
  if (shape == "3x4") return rvalue(rows, types_.matrix(Scalar::kFloat32, 3, 4));
  const Type* columns = types_.matrix(Scalar::kFloat32, 4, 3);
  return rvalue(build_.intrinsic(Intrinsic::transpose, columns->ir, {rows}), columns);
}

const ir::Expr* HitObjects::is(const ir::Expr* hit, uint32_t state) {
  return build_.binary(ir::BinaryOp::kEqual, build_.field(hit, ir::kHitState),
                       build_.uint32(state));
}

// The identity for everything but a hit.
const ir::Expr* HitObjects::matrix_of(const ir::Expr* hit, uint32_t field) {
  const ir::Expr* matrix = build_.field(hit, field);
  const ir::Type* row = build_.vector_type(Scalar::kFloat32, 4);
  std::vector<const ir::Expr*> rows;
  for (uint32_t i = 0; i < 3; ++i) {
    std::vector<uint64_t> values(4, 0);
    values[i] = std::bit_cast<uint64_t>(1.0);
    rows.push_back(build_.literal(row, std::move(values)));
  }
  const ir::Expr* identity = build_.construct(matrix->type, std::move(rows));
  return build_.conditional(is(hit, shader::kHitObjectHit), matrix, identity);
}

const ir::Expr* HitObjects::in_object_space(const ir::Expr* hit, uint32_t field, float w) {
  const ir::Expr* world = build_.field(hit, field);
  const ir::Expr* whole =
      build_.construct(build_.vector_type(Scalar::kFloat32, 4),
                       {world, build_.literal(build_.scalar_type(Scalar::kFloat32),
                                              {std::bit_cast<uint64_t>(static_cast<double>(w))})});
  const ir::Expr* object = build_.intrinsic(Intrinsic::mul, world->type,
                                            {build_.field(hit, ir::kHitWorldToObject), whole});
  return build_.conditional(is(hit, shader::kHitObjectHit), object, world);
}

// Binds the object, if it is a hit or a miss.
Value HitObjects::set_record(const Value& object, const Value& index) {
  if (!lower_.places.require_place(object, object.location, "the object of SetShaderTableIndex")) {
    return error_value();
  }
  const Type* number = types_.scalar(Scalar::kUint32);
  const ir::Expr* given = lower_.conversions.convert(index, number, index.location);
  if (!given) return error_value();
  const ir::Expr* record = body_.repeatable(given);
  Value place = object;
  size_t position = body_.block->size();
  lower_.places.freeze(place, &position);
  const ir::Expr* hit = lower_.places.load(place);
  const auto masked = [&](uint32_t bits) {
    return build_.binary(ir::BinaryOp::kBitAnd, record, build_.uint32(bits));
  };
  const ir::Expr* of_miss = build_.conditional(is(hit, shader::kHitObjectMiss),
                                               masked(kMissRecordBits), build_.uint32(0));
  const ir::Expr* chosen =
      build_.conditional(is(hit, shader::kHitObjectHit), masked(kHitRecordBits), of_miss);
  lower_.places.store(lower_.places.field_of(place, ir::kHitRecord, number), chosen);
  const ir::Expr* bound =
      build_.conditional(is(hit, shader::kHitObjectNop), build_.uint32(0), build_.uint32(1));
  lower_.places.store(lower_.places.field_of(place, ir::kHitIsBound, number), bound);
  return rvalue(build_.int32(0), types_.void_type());
}

// `hit.GetAttributes(attributes)` as in DXC, `hit.GetAttributes<Attributes>()` as in DXR's text.
Value HitObjects::attributes_of(const ir::Expr* hit, const NamePart& part,
                                std::vector<Value>& arguments, SourceLocation location) {
  const Type* type = nullptr;
  if (arguments.empty()) {
    if (part.template_arguments.size() != 1) {
      report(CheckId::kTemplateCount, location,
             {"GetAttributes", "1", std::to_string(part.template_arguments.size())});
      return error_value();
    }
    type = names_.type_argument(part.template_arguments[0], body_.scope);
    if (type->is_error()) return error_value();
  } else {
    type = arguments[0].type;
  }
  if (!check_attributes(type, location)) return error_value();
  const ir::Expr* value =
      build_.expr(ir::ExprKind::kSameBytes, type->ir, {build_.field(hit, ir::kHitAttributes)});
  if (arguments.empty()) return rvalue(value, type);
  if (!lower_.places.require_place(arguments[0], location, "the argument of GetAttributes")) {
    return error_value();
  }
  lower_.places.store(arguments[0], value);
  return rvalue(build_.int32(0), types_.void_type());
}

}  // namespace kaamos::hlsl
