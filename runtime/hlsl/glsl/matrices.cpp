// SPDX-License-Identifier: MIT
//
// Matrices are structs of rows, whose functions are generated from those on vectors when first
// used. Sums are in the order of <kaamos/shader/intrinsics_geometry.h>.
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool is_matrix(const Type* type) {
  return type->kind == TypeKind::kMatrix;
}

std::string row(const std::string& matrix, int index) {
  return matrix + ".r[" + std::to_string(index) + "]";
}

// One component of a row; the row is a scalar if the matrix has one column.
std::string at(const std::string& matrix, const Type* type, int r, int c) {
  return row(matrix, r) + (type->columns == 1 ? "" : "." + glsl::component(c));
}

}  // namespace

// Applies one of the prelude's functions, which work on rows, to whole matrices: an operand that is
// not a matrix goes to every row.
std::string GlslEmitter::matrix_call(const std::string& function, const Type* result,
                                     const std::vector<const Expr*>& operands) {
  const Type* shape = result;
  std::string parameters;
  std::string key = function;
  for (size_t i = 0; i < operands.size(); ++i) {
    const Type* t = operands[i]->type;
    shape = is_matrix(t) ? t : shape;
    parameters += (i == 0 ? "" : ", ") + type(t) + " p" + std::to_string(i);
    key += "," + type(t);
  }
  if (made_.insert(key).second) {
    std::string text =
        type(result) + " " + function + "(" + parameters + ") {\n  " + type(result) + " result;\n";
    for (int r = 0; r < shape->rows; ++r) {
      std::string arguments;
      for (size_t i = 0; i < operands.size(); ++i) {
        const std::string p = "p" + std::to_string(i);
        arguments += (i == 0 ? "" : ", ") + (is_matrix(operands[i]->type) ? row(p, r) : p);
      }
      text += "  " + row("result", r) + " = " + function + "(" + arguments + ");\n";
    }
    helpers_ += text + "  return result;\n}\n";
  }
  return call(function, operands);
}

std::string GlslEmitter::mul(const Type* result, const Type* a, const Type* b) {
  const std::string name = "g_mul_" + std::to_string(helpers_.size());
  const std::string key = "mul," + type(a) + "," + std::to_string(static_cast<int>(a->kind)) + "," +
                          type(b) + "," + std::to_string(static_cast<int>(b->kind));
  auto& function = generated_[key];
  if (!function.empty()) {
    return function;
  }
  function = name;
  std::string text = type(result) + " " + name + "(" + type(a) + " a, " + type(b) + " b) {\n  " +
                     type(result) + " result;\n";
  // A row vector times a matrix: float16 sums are kept in float and rounded once.
  const auto row_times = [&](const std::string& to, const std::string& v, bool scalar_v,
                             const Type* m) {
    const bool half = m->scalar == Scalar::kFloat16;
    const std::string sum = glsl::vector_name(half ? Scalar::kFloat32 : m->scalar, m->columns);
    std::string terms;
    for (int r = 0; r < m->rows; ++r) {
      const std::string factor = scalar_v ? v : v + "." + glsl::component(r);
      const std::string product = sum + "(" + (half ? "float(" + factor + ")" : factor) + ") * " +
                                  sum + "(" + row("b", r) + ")";
      terms = r == 0 ? product : "(" + terms + ") + " + product;
    }
    return "  " + to + " = " + glsl::vector_name(m->scalar, m->columns) + "(" + terms + ");\n";
  };
  if (!is_matrix(a) && a->kind == TypeKind::kScalar) {
    for (int r = 0; r < b->rows; ++r) {
      text += "  " + row("result", r) + " = " + glsl::vector_name(b->scalar, b->columns) +
              "(a) * " + row("b", r) + ";\n";
    }
  } else if (!is_matrix(b) && b->kind == TypeKind::kScalar) {
    for (int r = 0; r < a->rows; ++r) {
      text += "  " + row("result", r) + " = " + row("a", r) + " * " +
              glsl::vector_name(a->scalar, a->columns) + "(b);\n";
    }
  } else if (!is_matrix(b)) {
    for (int r = 0; r < a->rows; ++r) {
      text += "  result" + (a->rows == 1 ? "" : "." + glsl::component(r)) +
              (a->columns == 1 ? " = " + row("a", r) + " * b;\n"
                               : " = k_dot(" + row("a", r) + ", b);\n");
    }
  } else if (!is_matrix(a)) {
    text += row_times("result", "a", b->rows == 1, b);
  } else {
    for (int r = 0; r < a->rows; ++r) {
      text += row_times(row("result", r), row("a", r), b->rows == 1, b);
    }
  }
  helpers_ += text + "  return result;\n}\n";
  return name;
}

std::string GlslEmitter::transpose(const Type* m) {
  const std::string name = "g_transpose_" + type(m);
  if (made_.insert(name).second) {
    const std::string result = matrix_name(m->scalar, m->columns, m->rows);
    std::string text = result + " " + name + "(" + type(m) + " m) {\n  " + result + " result;\n";
    for (int c = 0; c < m->columns; ++c) {
      text += "  " + row("result", c) + " = " + glsl::vector_name(m->scalar, m->rows) + "(";
      for (int r = 0; r < m->rows; ++r) {
        text += (r == 0 ? "" : ", ") + at("m", m, r, c);
      }
      text += ");\n";
    }
    helpers_ += text + "  return result;\n}\n";
  }
  return name;
}

std::string GlslEmitter::determinant(const Type* m) {
  const std::string name = "g_determinant_" + type(m);
  if (!made_.insert(name).second) {
    return name;
  }
  const Scalar sum = m->scalar == Scalar::kFloat16 ? Scalar::kFloat32 : m->scalar;
  const std::string scalar = glsl::scalar_name(m->scalar);
  const std::string wide = glsl::vector_name(sum, m->columns);
  const auto minor = [](int r, const char* i, const char* j) {
    const std::string upper = "r" + std::to_string(r) + ".";
    const std::string lower = "r" + std::to_string(r + 1) + ".";
    return "(" + upper + i + " * " + lower + j + " - " + upper + j + " * " + lower + i + ")";
  };
  std::string text = scalar + " " + name + "(" + type(m) + " m) {\n";
  for (int r = 0; r < m->rows; ++r) {
    text += "  " + wide + " r" + std::to_string(r) + " = " + wide + "(" + row("m", r) + ");\n";
  }
  std::string out = "r0";
  if (m->rows == 2) {
    out = minor(0, "x", "y");
  } else if (m->rows == 3) {
    out = "k_dot(r0, k_cross(r1, r2))";
  } else if (m->rows == 4) {
    const auto term = [&](const char* a, const char* b, const char* c, const char* d) {
      return minor(0, a, b) + " * " + minor(2, c, d);
    };
    out = term("x", "y", "z", "w") + " - " + term("x", "z", "y", "w") + " + " +
          term("x", "w", "y", "z") + " + " + term("y", "z", "x", "w") + " - " +
          term("y", "w", "x", "z") + " + " + term("z", "w", "x", "y");
  }
  helpers_ += text + "  return " + scalar + "(" + out + ");\n}\n";
  return name;
}

std::string GlslEmitter::matrix_intrinsic(const Expr& expr) {
  const Type* first = expr.operands[0]->type;
  switch (expr.intrinsic) {
    case Intrinsic::mul: {
      // Called first, because the function must be defined before its use.
      const std::string function = mul(expr.type, first, expr.operands[1]->type);
      return call(function, expr.operands);
    }
    case Intrinsic::transpose:
      return call(transpose(first), expr.operands);
    case Intrinsic::determinant:
      return call(determinant(first), expr.operands);
    case Intrinsic::all:
    case Intrinsic::any: {
      const std::string function = "k_" + std::string(name_of(expr.intrinsic));
      if (made_.insert(function + "," + type(first)).second) {
        std::string out;
        for (int r = 0; r < first->rows; ++r) {
          out += r == 0 ? "" : expr.intrinsic == Intrinsic::all ? " && " : " || ";
          out += function + "(" + row("m", r) + ")";
        }
        helpers_ += "bool " + function + "(" + type(first) + " m) {\n  return " + out + ";\n}\n";
      }
      return call(function, expr.operands);
    }
    default:
      return matrix_call("k_" + std::string(name_of(expr.intrinsic)), expr.type, expr.operands);
  }
}

std::string GlslEmitter::matrix_construct(const Expr& expr) {
  const Type* m = expr.type;
  // Collects all components individually, and also the parts that are whole rows.
  std::vector<std::string> components;
  std::vector<std::string> whole;
  for (const Expr* operand : expr.operands) {
    const Type* t = operand->type;
    const int count = t->rows * t->columns;
    const size_t at_component = components.size();
    if (count == 1) {
      components.push_back(value(operand));
    } else {
      const std::string part = repeatable(operand);
      for (int i = 0; i < count; ++i) {
        components.push_back(is_matrix(t) ? at(part, t, i / t->columns, i % t->columns)
                                          : part + "." + glsl::component(i));
      }
      whole.resize(components.size());
      if (!is_matrix(t) && t->columns == m->columns && at_component % m->columns == 0) {
        whole[at_component] = part;
      }
    }
  }
  whole.resize(components.size());
  const std::string row_type = glsl::vector_name(m->scalar, m->columns);
  std::string out = type(m) + "(" + row_type + "[" + std::to_string(m->rows) + "](";
  for (int r = 0; r < m->rows; ++r) {
    const size_t first = static_cast<size_t>(r) * m->columns;
    out += r == 0 ? "" : ", ";
    if (first + m->columns > components.size()) {
      out += row_type + "(" + scalar_literal(m->scalar, 0) + ")";
    } else if (!whole[first].empty()) {
      out += whole[first];
    } else {
      out += row_type + "(";
      for (int c = 0; c < m->columns; ++c) {
        out += (c == 0 ? "" : ", ") + components[first + static_cast<size_t>(c)];
      }
      out += ")";
    }
  }
  return out + "))";
}

std::string GlslEmitter::matrix_splat(const Expr& expr) {
  const Type* m = expr.type;
  const std::string scalar = repeatable(expr.operands[0]);
  const std::string row_type = glsl::vector_name(m->scalar, m->columns);
  std::string out = type(m) + "(" + row_type + "[" + std::to_string(m->rows) + "](";
  for (int r = 0; r < m->rows; ++r) {
    out += (r == 0 ? "" : ", ") + row_type + "(" + scalar + ")";
  }
  return out + "))";
}

std::string GlslEmitter::matrix_truncate(const Expr& expr) {
  const Type* to = expr.type;
  const Type* from = expr.operands[0]->type;
  const std::string m = repeatable(expr.operands[0]);
  if (!is_matrix(to)) {
    // Truncates to a scalar, or to a vector of the first components.
    std::string out = type(to) + "(";
    for (int i = 0; i < to->columns; ++i) {
      out += (i == 0 ? "" : ", ") + at(m, from, i / from->columns, i % from->columns);
    }
    return out + ")";
  }
  const std::string row_type = glsl::vector_name(to->scalar, to->columns);
  std::string out = type(to) + "(" + row_type + "[" + std::to_string(to->rows) + "](";
  for (int r = 0; r < to->rows; ++r) {
    out += (r == 0 ? "" : ", ") + row(m, r);
    if (to->columns != from->columns) {
      out += "." + std::string("xyzw").substr(0, to->columns);
    }
  }
  return out + "))";
}

std::string GlslEmitter::matrix_swizzle(const Expr& expr) {
  const Type* from = expr.operands[0]->type;
  const std::string m = repeatable(expr.operands[0]);
  std::string out;
  for (size_t i = 0; i < expr.components.size(); ++i) {
    out += (i == 0 ? "" : ", ") + at(m, from, expr.components[i] / 4, expr.components[i] % 4);
  }
  return expr.components.size() == 1 ? out : type(expr.type) + "(" + out + ")";
}

}  // namespace kaamos::hlsl
