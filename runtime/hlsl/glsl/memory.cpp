// SPDX-License-Identifier: MIT
//
// Moves values between variables and buffers: scalars and short vectors through the prelude's
// k_read_ and k_write_ functions, everything else by generated functions at HLSL's offsets. The
// GLSL counterpart of <kaamos/shader/memory.h> and views.h.
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/ir/layout.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

std::string plus(const std::string& at, uint64_t bytes) {
  if (bytes == 0) {
    return at;
  }
  return at == "0u" ? glsl::number(bytes) : at + " + " + glsl::number(bytes);
}

// The prelude has functions for 1 to 4 components of 32 bits, except bool, and for any scalar.
std::string access_name(Scalar scalar, int columns) {
  return std::string(glsl::suffix(scalar)) + (columns > 1 ? "x" + std::to_string(columns) : "");
}

bool has_vector_access(Scalar scalar) {
  return scalar == Scalar::kInt32 || scalar == Scalar::kUint32 || scalar == Scalar::kFloat32;
}

// The low bits of an offset that are ignored.
uint32_t ignored_bits(Scalar scalar) {
  return scalar_bytes(scalar, ScalarStorage::kBuffer) < 4 ? 1 : 3;
}

bool is_numeric(const Type* type) {
  return type->kind == TypeKind::kScalar || type->kind == TypeKind::kVector ||
         type->kind == TypeKind::kMatrix;
}

const Type* innermost(const Type* type) {
  while (type->kind == TypeKind::kArray) {
    type = type->element;
  }
  return type;
}

std::string function_suffix(Layout layout, bool row_major) {
  return std::string(layout == Layout::kConstantBuffer ? "_c" : "_s") + (row_major ? "r" : "");
}

}  // namespace

std::string GlslEmitter::memory_read(const Type* t, Layout layout, bool row_major,
                                     const std::string& window, const std::string& at) {
  const bool flat = t->kind == TypeKind::kScalar || t->kind == TypeKind::kVector;
  if (flat && (t->columns == 1 || has_vector_access(t->scalar))) {
    return "k_read_" + access_name(t->scalar, t->columns) + "(" + window + ", " + at + ")";
  }
  return read_function(t, layout, row_major) + "(" + window + ", " + at + ")";
}

std::string GlslEmitter::memory_write(const Type* t, Layout layout, bool row_major,
                                      const std::string& window, const std::string& at,
                                      const std::string& text) {
  const bool flat = t->kind == TypeKind::kScalar || t->kind == TypeKind::kVector;
  if (flat && (t->columns == 1 || has_vector_access(t->scalar))) {
    return "k_write_" + access_name(t->scalar, t->columns) + "(" + window + ", " + at + ", " +
           text + ")";
  }
  return write_function(t, layout, row_major) + "(" + window + ", " + at + ", " + text + ")";
}

namespace {

// Calls visit(component of "value", its byte offset) for each part of a vector or matrix that one
// prelude function reads: a scalar or, if the matrix is stored by rows, a row.
template <typename Visit>
void each_part(const Type* t, Layout layout, bool row_major, const Visit& visit) {
  const uint32_t bytes = scalar_bytes(t->scalar, ScalarStorage::kBuffer);
  if (t->kind == TypeKind::kVector) {
    for (int i = 0; i < t->columns; ++i) {
      visit("value." + glsl::component(i), static_cast<uint32_t>(i) * bytes, 1);
    }
    return;
  }
  const uint32_t stride = matrix_stride(t, layout, row_major);
  for (int r = 0; r < t->rows; ++r) {
    const std::string row = "value.r[" + std::to_string(r) + "]";
    const auto ur = static_cast<uint32_t>(r);
    if (row_major && has_vector_access(t->scalar)) {
      visit(row, ur * stride, t->columns);
      continue;
    }
    for (int c = 0; c < t->columns; ++c) {
      const auto uc = static_cast<uint32_t>(c);
      visit(t->columns == 1 ? row : row + "." + glsl::component(c),
            row_major ? ur * stride + uc * bytes : uc * stride + ur * bytes, 1);
    }
  }
}

}  // namespace

std::string GlslEmitter::read_function(const Type* t, Layout layout, bool row_major) {
  const std::string key =
      type(t) + function_suffix(layout, row_major && t->kind != TypeKind::kStruct);
  auto& name = generated_["read " + key];
  if (!name.empty()) {
    return name;
  }
  const std::string function = "g_read_" + std::to_string(generated_.size());
  name = function;
  std::string text = type(t) + " " + function + "(k_Window w, uint at) {\n";
  if (t->kind == TypeKind::kArray) {
    const uint64_t stride = array_stride(t->element, layout, row_major);
    text += "  " + type(t) + " value;\n  for (uint i = 0u; i < " + glsl::number(t->count) +
            "; ++i) value[i] = " +
            memory_read(t->element, layout, row_major, "w", "at + i * " + glsl::number(stride)) +
            ";\n";
  } else if (t->kind == TypeKind::kStruct) {
    const std::vector<uint32_t> offsets = field_offsets(*t->structure, layout);
    text += "  " + type(t) + " value;\n";
    for (size_t i = 0; i < offsets.size(); ++i) {
      const Field& f = t->structure->fields[i];
      text += "  value." + field(t->structure, static_cast<uint32_t>(i)) + " = " +
              memory_read(f.type, layout, f.row_major, "w", plus("at", offsets[i])) + ";\n";
    }
    if (offsets.empty()) {
      text += "  value.g_empty = 0u;\n";
    }
  } else {
    text += "  " + type(t) + " value;\n";
    each_part(t, layout, row_major, [&](const std::string& part, uint32_t offset, int columns) {
      text += "  " + part + " = k_read_" + access_name(t->scalar, columns) + "(w, " +
              plus("at", offset) + ");\n";
    });
  }
  helpers_ += text + "  return value;\n}\n";
  return function;
}

std::string GlslEmitter::write_function(const Type* t, Layout layout, bool row_major) {
  const std::string key =
      type(t) + function_suffix(layout, row_major && t->kind != TypeKind::kStruct);
  auto& name = generated_["write " + key];
  if (!name.empty()) {
    return name;
  }
  const std::string function = "g_write_" + std::to_string(generated_.size());
  name = function;
  std::string text = "void " + function + "(k_Window w, uint at, " + type(t) + " value) {\n";
  if (t->kind == TypeKind::kArray) {
    const uint64_t stride = array_stride(t->element, layout, row_major);
    text += "  for (uint i = 0u; i < " + glsl::number(t->count) + "; ++i) " +
            memory_write(t->element, layout, row_major, "w", "at + i * " + glsl::number(stride),
                         "value[i]") +
            ";\n";
  } else if (t->kind == TypeKind::kStruct) {
    const std::vector<uint32_t> offsets = field_offsets(*t->structure, layout);
    for (size_t i = 0; i < offsets.size(); ++i) {
      const Field& f = t->structure->fields[i];
      text += "  " +
              memory_write(f.type, layout, f.row_major, "w", plus("at", offsets[i]),
                           "value." + field(t->structure, static_cast<uint32_t>(i))) +
              ";\n";
    }
  } else {
    each_part(t, layout, row_major, [&](const std::string& part, uint32_t offset, int columns) {
      text += "  k_write_" + access_name(t->scalar, columns) + "(w, " + plus("at", offset) + ", " +
              part + ");\n";
    });
  }
  helpers_ += text + "}\n";
  return function;
}

std::string GlslEmitter::site(const Location& location) const {
  return glsl::number(site_of(location.line != 0 ? location : statement_location_));
}

std::string GlslEmitter::access_arguments(const Type* t, Layout layout, bool row_major, int write,
                                          const Location& location) const {
  const Access access = access_of(t, layout, row_major);
  return ", " + glsl::number(access.bytes) + ", " + glsl::number(access.alignment) + ", " +
         std::to_string(write) + "u, " + site(location);
}

// The window through which a `t` is accessed. The operands are the resource, the element of a
// structured buffer, and the offset, whose low bits are ignored. `access` is access_arguments in a
// checked library.
std::string GlslEmitter::window(const std::vector<const Expr*>& operands, bool element,
                                const Type* t, const std::string& access) {
  if (!access.empty()) {
    std::string text = element ? "k_element_window_checked(" : "k_window_checked(";
    for (size_t i = 0; i < operands.size(); ++i) text += (i == 0 ? "" : ", ") + value(operands[i]);
    return text + access + ")";
  }
  const Expr* offset = operands.back();
  const Type* leaf = innermost(t);
  // A struct's members have offsets of their own, and 16-bit members need only two-byte alignment.
  const bool mask = !element && is_numeric(leaf);
  std::string text;
  if (offset->kind == ExprKind::kLiteral) {
    const auto bytes = static_cast<uint32_t>(offset->literal[0]);
    text = glsl::number(mask ? bytes & ~ignored_bits(leaf->scalar) : bytes);
  } else {
    text = value(offset);
    if (mask) {
      text = "(" + text + ") & " + glsl::number(~ignored_bits(leaf->scalar));
    }
  }
  if (element) {
    return "k_element_window(" + value(operands[0]) + ", " + value(operands[1]) + ", " + text + ")";
  }
  return "k_window(" + value(operands[0]) + ", " + text + ")";
}

std::string GlslEmitter::load(const Expr& expr) {
  const std::string access =
      module_.check_access
          ? access_arguments(expr.type, expr.layout, expr.row_major, 0, expr.location)
          : "";
  const std::string w =
      window(expr.operands, expr.kind == ExprKind::kLoadElement, expr.type, access);
  return memory_read(expr.type, expr.layout, expr.row_major, w, "0u");
}

void GlslEmitter::store(const Stmt& stmt) {
  const std::string access =
      module_.check_access
          ? access_arguments(stmt.value->type, stmt.layout, stmt.row_major, 1, stmt.location)
          : "";
  const std::string w =
      window(stmt.operands, stmt.kind == StmtKind::kStoreElement, stmt.value->type, access);
  line(memory_write(stmt.value->type, stmt.layout, stmt.row_major, w, "0u", value(stmt.value)) +
       ";");
}

}  // namespace kaamos::hlsl
