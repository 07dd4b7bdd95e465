// SPDX-License-Identifier: MIT
//
// Types and literals.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/ir/emitted_names.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

constexpr uint32_t kMostWrittenZeros = 1u << 16;

}  // namespace

namespace glsl {

std::string scalar_name(Scalar scalar) {
  constexpr const char* kNames[] = {"bool",    "int16_t",  "uint16_t",  "int",   "uint",
                                    "int64_t", "uint64_t", "float16_t", "float", "double"};
  return kNames[static_cast<int>(scalar)];
}

std::string vector_name(Scalar scalar, int columns) {
  constexpr const char* kNames[] = {"bvec",   "i16vec", "u16vec", "ivec", "uvec",
                                    "i64vec", "u64vec", "f16vec", "vec",  "dvec"};
  return columns == 1 ? scalar_name(scalar)
                      : kNames[static_cast<int>(scalar)] + std::to_string(columns);
}

const char* suffix(Scalar scalar) {
  constexpr const char* kNames[] = {"bool", "i16", "u16", "i32", "u32",
                                    "i64",  "u64", "f16", "f32", "f64"};
  return kNames[static_cast<int>(scalar)];
}

std::string component(int index) {
  return std::string(1, "xyzw"[index & 3]);
}

std::string number(uint64_t n) {
  return std::to_string(n) + "u";
}

bool contains_bool(const Type* type) {
  switch (type->kind) {
    case TypeKind::kScalar:
    case TypeKind::kVector:
    case TypeKind::kMatrix:
      return type->scalar == Scalar::kBool;
    case TypeKind::kArray:
      return contains_bool(type->element);
    case TypeKind::kStruct:
      for (const Field& field : type->structure->fields) {
        if (contains_bool(field.type)) {
          return true;
        }
      }
      return false;
    default:
      return false;
  }
}

uint32_t words(const Type* type) {
  switch (type->kind) {
    case TypeKind::kScalar:
    case TypeKind::kVector:
    case TypeKind::kMatrix:
      return (scalar_bytes(type->scalar, ScalarStorage::kBuffer) == 8 ? 2u : 1u) * type->rows *
             type->columns;
    case TypeKind::kArray:
      return words(type->element) * type->count;
    case TypeKind::kStruct: {
      uint32_t sum = 0;
      for (const Field& field : type->structure->fields) {
        sum += words(field.type);
      }
      return sum;
    }
    default:
      return 0;
  }
}

}  // namespace glsl

std::string GlslNames::add(std::string_view hlsl_name) {
  std::string base = prefix_ + cpp_identifier(hlsl_name);
  // GLSL allows 1024 characters, of which generated names add some.
  constexpr size_t kMaxCharacters = 256;
  if (base.size() > kMaxCharacters) base.resize(kMaxCharacters);
  // Two consecutive underscores are reserved.
  while (base.size() > prefix_.size() && base.back() == '_') {
    base.pop_back();
  }
  std::string name = base;
  for (int& number = used_[base];;) {
    if (++number > 1) {
      name = base + "_" + std::to_string(number);
    }
    if (name == base || used_.emplace(name, 1).second) {
      return name;
    }
  }
}

std::string GlslEmitter::matrix_name(Scalar scalar, int rows, int columns) {
  const std::string name =
      "g_mat_" + std::to_string(rows) + "x" + std::to_string(columns) + "_" + glsl::suffix(scalar);
  if (made_.insert(name).second) {
    matrices_ += "struct " + name + " { " + glsl::vector_name(scalar, columns) + " r[" +
                 std::to_string(rows) + "]; };\n";
  }
  return name;
}

std::string GlslEmitter::type(const Type* t) {
  switch (t->kind) {
    case TypeKind::kVoid:
      return "void";
    case TypeKind::kScalar:
      return glsl::scalar_name(t->scalar);
    case TypeKind::kVector:
      return glsl::vector_name(t->scalar, t->columns);
    case TypeKind::kMatrix:
      return matrix_name(t->scalar, t->rows, t->columns);
    case TypeKind::kArray: {
      std::string counts;
      for (; t->kind == TypeKind::kArray; t = t->element) {
        counts += "[" + std::to_string(t->count) + "]";
      }
      return type(t) + counts;
    }
    case TypeKind::kStruct:
      emit_struct(t->structure);
      return struct_names_[t->structure];
    case TypeKind::kResource:
      if (t->is_query()) {
        declare_query();
        return "rayQueryEXT";
      }
      return "k_Descriptor";
  }
  return "void";
}

void GlslEmitter::emit_struct(const Struct* s) {
  if (struct_names_.count(s) != 0) {
    return;
  }
  const std::string name = struct_names_set_.add(s->name);
  struct_names_[s] = name;
  GlslNames names("m_");
  std::vector<std::string> fields;
  std::string text = "struct " + name + " {\n";
  for (const Field& f : s->fields) {
    fields.push_back(names.add(f.name));
    text += "  " + type(f.type) + " " + fields.back() + ";\n";
  }
  if (fields.empty()) {
    text += "  uint g_empty;\n";  // GLSL has no empty structs
  }
  field_names_[s] = std::move(fields);
  structs_ += text + "};\n";
}

const std::string& GlslEmitter::field(const Struct* structure, uint32_t index) {
  emit_struct(structure);
  return field_names_[structure][index];
}

std::string GlslEmitter::zero(const Type* t) {
  if (t->kind == TypeKind::kScalar) {
    return scalar_literal(t->scalar, 0);
  }
  const std::string name = type(t);
  if (t->kind == TypeKind::kResource && !t->is_query()) return "k_null";
  if (t->kind == TypeKind::kVector) {
    return t->columns == 1 ? scalar_literal(t->scalar, 0)
                           : name + "(" + scalar_literal(t->scalar, 0) + ")";
  }
  if (const auto found = generated_.find(name); found != generated_.end()) return found->second;
  // glslang crashes where a constant takes a part of `{}`, so that is only for what is too large to
  // be written out.
  std::string parts;
  const auto add = [&](const std::string& part) { parts += (parts.empty() ? "" : ", ") + part; };
  if (glsl::words(t) <= kMostWrittenZeros) {
    if (t->kind == TypeKind::kMatrix) {
      const std::string row = glsl::vector_name(t->scalar, t->columns);
      for (uint32_t i = 0; i < t->rows; ++i) add(row + "(" + scalar_literal(t->scalar, 0) + ")");
      parts = row + "[" + std::to_string(t->rows) + "](" + parts + ")";
    } else if (t->kind == TypeKind::kArray) {
      const std::string part = zero(t->element);
      for (uint32_t i = 0; i < t->count; ++i) add(part);
    } else if (t->kind == TypeKind::kStruct) {
      for (const Field& field : t->structure->fields) add(zero(field.type));
      if (t->structure->fields.empty()) parts = "0u";
    }
  }
  const std::string value = parts.empty() ? "{}" : name + "(" + parts + ")";
  const std::string constant = "g_zero_" + std::to_string(generated_.size() + 1);
  generated_[name] = constant;
  declarations_ += "const " + name + " " + constant + " = " + value + ";\n";
  return constant;
}

namespace {

// A number with a short decimal text means the same to every parser; any other is written as bits.
bool is_plain(double number) {
  return std::isfinite(number) &&
         (number == 0 ? !std::signbit(number)
                      : std::fabs(number) >= 1e-30 && std::fabs(number) <= 1e30);
}

std::string decimal(double number, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  std::string out = text;
  if (out.find_first_of(".e") == std::string::npos) {
    out += ".0";
  }
  return out;
}

std::string float32_literal(float number) {
  if (is_plain(static_cast<double>(number))) {
    const std::string text = decimal(static_cast<double>(number), "%.9g");
    return number < 0 ? "(" + text + ")" : text;
  }
  return "uintBitsToFloat(" + glsl::number(std::bit_cast<uint32_t>(number)) + ")";
}

std::string float64_literal(double number) {
  const std::string text = decimal(number, "%.15g");
  if (is_plain(number) && text.size() <= 12 && std::strtod(text.c_str(), nullptr) == number) {
    return number < 0 ? "(" + text + "lf)" : text + "lf";
  }
  const uint64_t bits = std::bit_cast<uint64_t>(number);
  return "packDouble2x32(uvec2(" + glsl::number(bits & 0xFFFFFFFFu) + ", " +
         glsl::number(bits >> 32) + "))";
}

// int(-5) for a literal: GLSL has no negative literals, and -2147483648 is out of range before its
// sign is applied.
std::string negative(const std::string& name, uint64_t bits, const char* suffix) {
  return name + "(" + std::to_string(bits) + suffix + ")";
}

}  // namespace

std::string GlslEmitter::scalar_literal(Scalar scalar, uint64_t bits) {
  switch (scalar) {
    case Scalar::kBool:
      return bits != 0 ? "true" : "false";
    case Scalar::kInt16:
      return "int16_t(" + std::to_string(static_cast<int16_t>(bits)) + ")";
    case Scalar::kUint16:
      return "uint16_t(" + glsl::number(static_cast<uint16_t>(bits)) + ")";
    case Scalar::kInt32: {
      const auto number = static_cast<int32_t>(bits);
      if (number >= 0) {
        return std::to_string(number);
      }
      return number == INT32_MIN ? negative("int", 0x80000000u, "u")
                                 : "(" + std::to_string(number) + ")";
    }
    case Scalar::kUint32:
      return glsl::number(static_cast<uint32_t>(bits));
    case Scalar::kInt64: {
      const auto number = static_cast<int64_t>(bits);
      return number >= 0 ? std::to_string(number) + "l" : negative("int64_t", bits, "ul");
    }
    case Scalar::kUint64:
      return std::to_string(bits) + "ul";
    case Scalar::kFloat16: {
      const auto number = static_cast<float>(std::bit_cast<double>(bits));
      return is_plain(static_cast<double>(number)) || number == 0
                 ? "float16_t(" + float32_literal(number) + ")"
                 : "k_to_f16(" + float32_literal(number) + ")";
    }
    case Scalar::kFloat32:
      return float32_literal(static_cast<float>(std::bit_cast<double>(bits)));
    case Scalar::kFloat64:
      return float64_literal(std::bit_cast<double>(bits));
    default:  // Only plain ones get here.
      break;
  }
  return "0";
}

std::string GlslEmitter::literal(const Expr& expr) {
  if (expr.type->kind == TypeKind::kScalar || expr.type->columns == 1) {
    return scalar_literal(expr.type->scalar, expr.literal.empty() ? 0 : expr.literal[0]);
  }
  std::string out = type(expr.type) + "(";
  for (size_t i = 0; i < expr.literal.size(); ++i) {
    out += (i == 0 ? "" : ", ") + scalar_literal(expr.type->scalar, expr.literal[i]);
  }
  return out + ")";
}

// Returns whether GLSL accepts it as the initialiser of a constant: no calls, so no floats made
// from bits.
bool GlslEmitter::is_constant(const Expr& expr) const {
  switch (expr.kind) {
    case ExprKind::kZero:
      return true;
    case ExprKind::kLiteral:
      for (const uint64_t bits : expr.literal) {
        if (is_floating(expr.type->scalar) && !is_plain(std::bit_cast<double>(bits))) {
          return false;
        }
      }
      return expr.type->scalar != Scalar::kFloat64;
    case ExprKind::kConstruct:
      for (const Expr* operand : expr.operands) {
        // Matrix parts that are not scalars are taken apart through a temporary.
        const bool part =
            expr.type->kind == TypeKind::kMatrix && operand->type->kind != TypeKind::kScalar;
        if (part || !is_constant(*operand)) {
          return false;
        }
      }
      return true;
    default:
      return false;
  }
}

}  // namespace kaamos::hlsl
