// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/streams.h"

#include <string>

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {

Value Streams::call_method(const Value& stream, const NamePart& part, std::vector<Value>& arguments,
                           SourceLocation location) {
  const std::string name(part.identifier);
  const bool appends = name == "Append";
  if (!appends && name != "RestartStrip") {
    report(CheckId::kNoSuchMethod, location, {to_string(stream.type), name});
    return error_value();
  }
  const size_t count = appends ? 1 : 0;
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location)) {
    return error_value();
  }
  lower_.intrinsics.use_in_stages(name, ir::kStageGeometry, location);
  ir::Stmt* statement = build_.stmt(appends ? ir::StmtKind::kEmitVertex : ir::StmtKind::kCutStrip);
  if (appends) {
    const Type* type = stream.type->structure->stream_vertex;
    const ir::Expr* vertex = lower_.conversions.convert(arguments[0], type, arguments[0].location);
    if (!vertex) return error_value();
    at(location);
    take_apart(type, body_.repeatable(vertex), statement->operands);
  }
  body_.emit(statement);
  return rvalue(build_.int32(0), types_.void_type());
}

void Streams::take_apart(const Type* type, const ir::Expr* value,
                         std::vector<const ir::Expr*>& parts) {
  const auto put = [&](const ir::Expr* part, Scalar scalar) {
    parts.push_back(build_.convert(part, is_floating(scalar)         ? Scalar::kFloat32
                                         : is_signed_integer(scalar) ? Scalar::kInt32
                                                                     : Scalar::kUint32));
  };
  if (type->is_struct()) {
    const StructInfo& info = *type->structure;
    if (info.base) take_apart(info.base->type, build_.field(value, 0), parts);
    for (const FieldInfo& field : info.fields) {
      if (field.unit) return;  // refused where the signature is made
      take_apart(field.type, build_.field(value, field.index), parts);
    }
  } else if (type->is_array()) {
    for (uint32_t i = 0; i < type->count; ++i) {
      take_apart(type->element, build_.element(value, build_.uint32(i)), parts);
    }
  } else if (type->is_matrix()) {
    const auto columns = static_cast<uint8_t>(type->columns);
    const uint8_t lines = type->row_major ? type->rows : columns;
    const uint8_t size = type->row_major ? columns : type->rows;
    for (uint8_t line = 0; line < lines; ++line) {
      std::vector<uint8_t> places;
      for (uint8_t i = 0; i < size; ++i) {
        places.push_back(static_cast<uint8_t>(type->row_major ? line * 4 + i : i * 4 + line));
      }
      put(build_.matrix_swizzle(value, places), type->scalar);
    }
  } else if (type->is_numeric() && !type->is_long_vector()) {
    put(value, type->scalar);
  }
}

}  // namespace kaamos::hlsl
