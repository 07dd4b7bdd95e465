// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/printing.h"

#include <algorithm>

#include "kaamos/shader/printing.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/shader/print_format.h"

namespace kaamos::hlsl {
namespace {

using shader::PrintConversion;

// FNV-1a
uint64_t hash_of(const ir::Print& print) {
  uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&](std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<uint8_t>(c)) * 0x100000001B3u;
    hash = (hash ^ 0xFFu) * 0x100000001B3u;
  };
  add(print.format);
  add(print.arguments);
  add(print.is_error ? "e" : "");
  return hash;
}

char letter_of(Scalar scalar) {
  if (scalar == Scalar::kBool) return 'b';
  const bool wide = scalar_bytes(scalar, ScalarStorage::kBuffer) == 8;
  if (is_floating(scalar)) return wide ? 'd' : 'f';
  if (is_signed_integer(scalar)) return wide ? 'l' : 'i';
  return wide ? 'q' : 'u';
}

// The type of 32 or 64 bits that holds it.
Scalar stored_scalar(Scalar scalar) {
  if (scalar == Scalar::kBool) return Scalar::kUint32;
  if (scalar_bytes(scalar, ScalarStorage::kBuffer) >= 4) return scalar;
  return is_floating(scalar)         ? Scalar::kFloat32
         : is_signed_integer(scalar) ? Scalar::kInt32
                                     : Scalar::kUint32;
}

uint32_t bytes_of(const ir::Type* type) {
  return scalar_bytes(type->scalar, ScalarStorage::kBuffer) * type->rows * type->columns;
}

}  // namespace

void Printing::make_thread() {
  if (bench_.print_thread) return;
  VariableInfo* info = names_.make_variable();
  info->kind = VariableKind::kGlobal;
  info->variable = build_.variable("print_thread", build_.vector_type(Scalar::kUint32, 3),
                                   ir::Storage::kStaticGlobal);
  bench_.print_thread = info;
}

const ir::Variable* Printing::thread() const {
  return bench_.print_thread ? bench_.print_thread->variable : nullptr;
}

void Printing::use_thread(FunctionInfo& function) {
  function.globals.push_back(bench_.print_thread);
}

Printing::Argument Printing::to_store(std::string_view name, const Value& given) {
  Argument out;
  Value value = lower_.conversions.settle(given);
  if (value.type && value.type->is_enum()) {
    const Type* plain = types_.scalar(value.type->enumeration->underlying);
    value = rvalue(lower_.conversions.convert(value, plain, given.location), plain);
  }
  if (value.failed() || !value.type || !value.type->is_numeric() || value.type->is_long_vector()) {
    if (!value.failed()) {
      report(CheckId::kPrint, given.location,
             {std::string(name), "it cannot print a '" + to_string(value.type) + "'"});
    }
    return out;
  }
  const ir::Expr* loaded = lower_.conversions.convert(value, value.type, given.location);
  if (!loaded) return out;
  const ir::Type* type = loaded->type;
  out.type = to_string(value.type);
  out.letters =
      letter_of(type->scalar) + std::to_string(type->rows) + std::to_string(type->columns);
  out.is_float = is_floating(type->scalar);
  out.is_matrix = type->kind == ir::TypeKind::kMatrix;
  out.components = uint32_t{type->rows} * type->columns;
  out.value = body_.repeatable(build_.convert(loaded, stored_scalar(type->scalar)));
  return out;
}

bool Printing::lower_arguments(std::string_view name, const CallExpr* expr,
                               std::vector<Argument>& out) {
  std::vector<const Expr*> numbers;
  for (const Expr* argument : expr->arguments) {
    if (!as<StringLiteralExpr>(argument)) numbers.push_back(argument);
  }
  const std::vector<Value> values = lower_.expressions.lower_all(numbers, true, true);
  const bool failed =
      std::any_of(values.begin(), values.end(), [](const Value& value) { return value.failed(); });
  if (failed) return false;
  size_t next = 0;
  for (size_t i = 1; i < expr->arguments.size(); ++i) {
    Argument argument;
    argument.text = as<StringLiteralExpr>(expr->arguments[i]);
    if (!argument.text) {
      argument = to_store(name, values[next++]);
      if (!argument.value) return false;
    }
    out.push_back(std::move(argument));
  }
  return true;
}

std::optional<std::string> Printing::fitting_format(std::string_view name, const CallExpr* expr,
                                                    const std::vector<Argument>& arguments) {
  const std::string_view format = as<StringLiteralExpr>(expr->arguments[0])->value;
  const auto refuse = [&](const std::string& why) {
    report(CheckId::kPrint, expr->location, {std::string(name), why});
    return std::nullopt;
  };
  std::string out;
  size_t at = 0;
  size_t used = 0;
  while (const auto conversion = shader::next_conversion(format, at)) {
    out += format.substr(at, conversion->begin - at);
    at = conversion->end;
    const std::string text(format.substr(conversion->begin, at - conversion->begin));
    if (conversion->letter == 0) return refuse("'" + text + "' is no conversion");
    if (conversion->letter == '%') {
      out += "%%";
      continue;
    }
    if (used == arguments.size()) return refuse("there is no value for '" + text + "'");
    const Argument& argument = arguments[used++];
    const std::string which = "value " + std::to_string(used);
    if (argument.text || conversion->letter == 's') {
      if (!argument.text || conversion->letter != 's') {
        return refuse("'" + text + "' prints " +
                      (argument.text
                           ? "a number, and " + which + " is a string"
                           : "a string literal, and " + which + " is a '" + argument.type + "'"));
      }
      for (const char c : argument.text->value) out += c == '%' ? "%%" : std::string(1, c);
      continue;
    }
    const bool fits_scalar =
        conversion->letter == 'v' || conversion->is_float() == argument.is_float;
    const bool fits_shape = conversion->letter == 'v' ||
                            (!argument.is_matrix && conversion->components == argument.components);
    if (!fits_scalar || !fits_shape) {
      return refuse("'" + text + "' does not print " + which + ", which is a '" + argument.type +
                    "'; %v prints any");
    }
    out += text;
  }
  out += format.substr(at);
  if (used != arguments.size()) {
    return refuse(std::to_string(arguments.size()) + " values for " + std::to_string(used) +
                  " conversions");
  }
  return out;
}

// if (the filter lets the thread pass) {
//   if (there is room) { at = used += bytes; store the record } else { ++lost }
// }
void Printing::store(uint64_t id, const std::vector<Argument>& arguments) {
  const ir::Type* word = build_.scalar_type(Scalar::kUint32);
  const ir::Type* id3 = build_.vector_type(Scalar::kUint32, 3);
  const ir::Expr* buffer =
      build_.expr(ir::ExprKind::kPrintBuffer,
                  build_.types().resource(ir::ResourceKind::kRWByteAddressBuffer, nullptr));
  const ir::Expr* thread = build_.read(bench_.print_thread->variable);
  const auto load = [&](uint32_t offset, const ir::Type* type) {
    return build_.expr(ir::ExprKind::kLoad, type, {buffer, build_.uint32(offset)});
  };
  const auto add = [&](uint32_t offset, uint32_t amount, const ir::Variable* result) {
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kAtomic);
    statement->target = ir::AtomicTarget::kMemory;
    statement->operands = {buffer, build_.uint32(offset)};
    statement->value = build_.uint32(amount);
    statement->result = result;
    return statement;
  };
  uint32_t bytes = shader::kRecordValues;
  for (const Argument& argument : arguments) {
    if (argument.value) bytes += bytes_of(argument.value->type);
  }
  const ir::Variable* at = body_.empty_temporary(word);
  ir::Stmt* room = build_.stmt(ir::StmtKind::kIf);
  room->value = build_.binary(ir::BinaryOp::kLess, load(shader::kPrintUsed, word),
                              load(shader::kPrintRoom, word));
  room->body.push_back(add(shader::kPrintUsed, bytes, at));
  const auto put = [&](uint32_t offset, const ir::Expr* value) {
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kStore);
    statement->operands = {buffer, build_.add(build_.read(at), shader::kPrintRecords + offset)};
    statement->value = value;
    statement->row_major = value->type->kind == ir::TypeKind::kMatrix;
    room->body.push_back(statement);
  };
  put(shader::kRecordBytes, build_.uint32(bytes));
  put(shader::kRecordId, build_.uint32(id & 0xFFFFFFFFu));
  put(shader::kRecordId + 4, build_.uint32(id >> 32));
  put(shader::kRecordThread, thread);
  uint32_t offset = shader::kRecordValues;
  for (const Argument& argument : arguments) {
    if (!argument.value) continue;
    put(offset, argument.value);
    offset += bytes_of(argument.value->type);
  }
  room->orelse.push_back(add(shader::kPrintLost, 1, nullptr));
  ir::Stmt* filter = build_.stmt(ir::StmtKind::kIf);
  const ir::Expr* everybody =
      build_.binary(ir::BinaryOp::kEqual, load(shader::kPrintFilter, word), build_.uint32(0));
  const ir::Expr* same = build_.intrinsic(
      Intrinsic::all, build_.scalar_type(Scalar::kBool),
      {build_.binary(ir::BinaryOp::kEqual, thread, load(shader::kPrintThread, id3))});
  filter->value = build_.binary(ir::BinaryOp::kBitOr, everybody, same);
  filter->body.push_back(room);
  body_.emit(filter);
}

Value Printing::call(std::string_view name, const CallExpr* expr) {
  const bool has_format =
      !expr->arguments.empty() && as<StringLiteralExpr>(expr->arguments[0]) != nullptr;
  if (!has_format) {
    report(CheckId::kPrint, expr->location,
           {std::string(name), "its first argument is not a string literal"});
    return error_value();
  }
  std::vector<Argument> arguments;
  if (!lower_arguments(name, expr, arguments)) return error_value();
  at(expr->location);
  const auto format = fitting_format(name, expr, arguments);
  if (!format) return error_value();
  ir::Print print;
  print.format = *format;
  for (const Argument& argument : arguments) print.arguments += argument.letters;
  print.is_error = name == "errorf";
  print.id = hash_of(print);
  auto& known = bench_.module.prints;
  const bool is_new = std::none_of(known.begin(), known.end(),
                                   [&](const ir::Print& one) { return one.id == print.id; });
  const uint64_t id = print.id;
  if (is_new) known.push_back(std::move(print));
  make_thread();
  if (body_.function) use_thread(*body_.function);
  store(id, arguments);
  return rvalue(build_.int32(0), types_.void_type());
}

}  // namespace kaamos::hlsl
