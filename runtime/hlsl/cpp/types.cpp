// SPDX-License-Identifier: MIT
//
// Types, and how values of struct and array types move between variables and memory: C++ has its
// own struct layout, so a struct is read and written member by member at HLSL's offsets.
#include "kaamos/shader/abi.h"
#include "runtime/hlsl/cpp/emitter.h"
#include "runtime/hlsl/ir/layout.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

// Resources are handles: a struct that contains one is never in a buffer.
bool lies_in_memory(const Type* type) {
  switch (type->kind) {
    case TypeKind::kVoid:
    case TypeKind::kResource:
      return false;
    case TypeKind::kArray:
      return lies_in_memory(type->element);
    case TypeKind::kStruct:
      for (const Field& field : type->structure->fields) {
        if (!lies_in_memory(field.type)) {
          return false;
        }
      }
      return true;
    default:
      return true;
  }
}

const char* layout_name(Layout layout) {
  return layout == Layout::kConstantBuffer ? "ks::Layout::kConstantBuffer"
                                           : "ks::Layout::kStructured";
}

const char* layout_suffix(Layout layout) {
  return layout == Layout::kConstantBuffer ? "constant_buffer" : "structured";
}

bool contains_struct(const Type* type) {
  while (type->kind == TypeKind::kArray) {
    type = type->element;
  }
  return type->kind == TypeKind::kStruct;
}

}  // namespace

const char* scalar_name(Scalar scalar) {
  switch (scalar) {
    case Scalar::kBool:
      return "bool";
    case Scalar::kInt16:
      return "int16_t";
    case Scalar::kUint16:
      return "uint16_t";
    case Scalar::kInt32:
      return "int32_t";
    case Scalar::kUint32:
      return "uint32_t";
    case Scalar::kInt64:
      return "int64_t";
    case Scalar::kUint64:
      return "uint64_t";
    case Scalar::kFloat16:
      return "ks::half";
    case Scalar::kFloat32:
      return "float";
    case Scalar::kFloat64:
      return "double";
    default:  // Only plain ones get here.
      break;
  }
  return "int32_t";
}

std::string CppEmitter::type(const Type* t) {
  switch (t->kind) {
    case TypeKind::kVoid:
      return "void";
    case TypeKind::kScalar:
      return scalar_name(t->scalar);
    case TypeKind::kVector:
      return std::string("ks::vec<") + scalar_name(t->scalar) + ", " + std::to_string(t->columns) +
             ">";
    case TypeKind::kMatrix:
      return std::string("ks::mat<") + scalar_name(t->scalar) + ", " + std::to_string(t->rows) +
             ", " + std::to_string(t->columns) + ">";
    case TypeKind::kArray:
      return "ks::array<" + type(t->element) + ", " + std::to_string(t->count) + ">";
    case TypeKind::kStruct:
      return "u::" + struct_names_[t->structure];
    case TypeKind::kResource:
      return t->is_query() ? "ks::RayQuery" : "ks::Descriptor";
  }
  return "void";
}

uint32_t CppEmitter::stack_bytes(const Type* t) const {
  switch (t->kind) {
    case TypeKind::kVoid:
      return 0;
    case TypeKind::kScalar:
      return scalar_bytes(t->scalar, ScalarStorage::kVariable);
    case TypeKind::kVector:
      return scalar_bytes(t->scalar, ScalarStorage::kVariable) * t->columns;
    case TypeKind::kMatrix:
      return scalar_bytes(t->scalar, ScalarStorage::kVariable) * t->columns * t->rows;
    case TypeKind::kArray:
      return stack_bytes(t->element) * t->count;
    case TypeKind::kStruct: {
      uint32_t bytes = 0;
      for (const Field& field : t->structure->fields) {
        bytes += stack_bytes(field.type);
      }
      return bytes;
    }
    case TypeKind::kResource:
      return t->is_query() ? sizeof(shader::RayQuery) : 32;
  }
  return 0;
}

void CppEmitter::emit_structs() {
  for (const Struct* s : module_.structs) {
    struct_names_[s] = global_names_.add(s->name);
    NameSet names;
    auto& fields = field_names_[s];
    at(s->location);
    open("struct " + struct_names_[s] + " {");
    for (const Field& field : s->fields) {
      fields.push_back(names.add(field.name));
      line(type(field.type) + " " + fields.back() + ";");
    }
    close("};");
  }
}

// The size of a `t` whose memory layout is the same as in C++ and in which nothing has an alignment
// above 4; otherwise 0.
uint64_t CppEmitter::bytes_in_place(const Type* t, Layout layout) {
  switch (t->kind) {
    case TypeKind::kScalar:
    case TypeKind::kVector: {
      const bool is_word = t->scalar == Scalar::kInt32 || t->scalar == Scalar::kUint32 ||
                           t->scalar == Scalar::kFloat32;
      return is_word ? uint64_t{4} * t->columns : 0;
    }
    case TypeKind::kArray: {
      const uint64_t element = bytes_in_place(t->element, layout);
      return element == array_stride(t->element, layout, false) ? element * t->count : 0;
    }
    case TypeKind::kStruct: {
      const std::vector<uint32_t> offsets = field_offsets(*t->structure, layout);
      uint64_t end = 0;
      for (size_t i = 0; i < offsets.size(); ++i) {
        const uint64_t bytes = bytes_in_place(t->structure->fields[i].type, layout);
        if (bytes == 0 || offsets[i] != end) return 0;
        end += bytes;
      }
      return end;
    }
    default:
      return 0;
  }
}

std::string CppEmitter::read_function(const Type* t, Layout layout) {
  return "u::read_" + struct_names_[t->structure] + "_" + layout_suffix(layout);
}

// An expression that reads a `t` from memory view `view` at byte `offset`.
std::string CppEmitter::memory_read(const Type* t, Layout layout, bool row_major,
                                    const std::string& view, const std::string& offset) {
  if (t->kind == TypeKind::kStruct) {
    return read_function(t, layout) + "(" + view + ", " + offset + ")";
  }
  if (t->kind == TypeKind::kArray && contains_struct(t)) {
    return "ks::read_array<" + type(t) + ">([&](uint32_t at) { return " +
           memory_read(t->element, layout, row_major, view, "at") + "; }, " + offset + ", " +
           std::to_string(array_stride(t->element, layout, row_major)) + "u)";
  }
  return "ks::read<" + type(t) + ", " + layout_name(layout) + ", " +
         (row_major ? "true" : "false") + ">(" + view + ", " + offset + ")";
}

std::string CppEmitter::memory_write(const Type* t, Layout layout, bool row_major,
                                     const std::string& view, const std::string& offset,
                                     const std::string& text) {
  if (t->kind == TypeKind::kStruct) {
    return "u::write_" + struct_names_[t->structure] + "_" + layout_suffix(layout) + "(" + view +
           ", " + offset + ", " + text + ")";
  }
  if (t->kind == TypeKind::kArray && contains_struct(t)) {
    return "ks::write_array(" + text + ", [&](uint32_t at, const auto& item) { " +
           memory_write(t->element, layout, row_major, view, "at", "item") + "; }, " + offset +
           ", " + std::to_string(array_stride(t->element, layout, row_major)) + "u)";
  }
  return std::string("ks::write<") + layout_name(layout) + ", " + (row_major ? "true" : "false") +
         ">(" + view + ", " + offset + ", " + text + ")";
}

void CppEmitter::emit_memory_functions() {
  at_generated();
  for (const Struct* s : module_.structs) {
    Type t;
    t.kind = TypeKind::kStruct;
    t.structure = s;
    if (!lies_in_memory(&t)) {
      continue;
    }
    const std::string& name = struct_names_[s];
    const auto& fields = field_names_[s];
    for (const Layout layout : {Layout::kConstantBuffer, Layout::kStructured}) {
      const std::vector<uint32_t> offsets = field_offsets(*s, layout);
      const auto at_offset = [&](size_t i) { return "at + " + std::to_string(offsets[i]) + "u"; };
      const std::string bytes = std::to_string(extent_of(&t, layout, false).size) + "u";
      open("template <typename View> " + name + " read_" + name + "_" + layout_suffix(layout) +
           "(const View& view, uint32_t at) {");
      open("return ks::read_struct<" + name + ">(view, at, " + bytes +
           ", [](const auto& members, uint32_t at) KAAMOS_INLINE_LAMBDA {");
      line(name + " out;");
      for (size_t i = 0; i < fields.size(); ++i) {
        const Field& f = s->fields[i];
        line("out." + fields[i] + " = " +
             memory_read(f.type, layout, f.row_major, "members", at_offset(i)) + ";");
      }
      line("return out;");
      close("});");
      close("}");
      if (layout == Layout::kConstantBuffer) {
        continue;  // constant buffers are read-only
      }
      open("template <typename View> void write_" + name +
           "_structured(const View& view, "
           "uint32_t at, const " +
           name + "& in) {");
      open("ks::write_struct(view, at, " + bytes +
           ", in, [](const auto& members, uint32_t at, const auto& in) KAAMOS_INLINE_LAMBDA {");
      for (size_t i = 0; i < fields.size(); ++i) {
        const Field& f = s->fields[i];
        line(memory_write(f.type, layout, f.row_major, "members", at_offset(i), "in." + fields[i]) +
             ";");
      }
      close("});");
      close("}");
    }
  }
}

bool CppEmitter::is_looked_up(const Expr& resource) const {
  return is_bound(resource) ||
         (reads_bound_ && resource.kind == ExprKind::kBinding && resource.operands.empty());
}

std::string CppEmitter::buffer_view(const Expr& buffer, const Expr* element, const TextOf& text) {
  const std::string view = element != nullptr ? "element_view" : "memory_view";
  const std::string index = element != nullptr ? ", " + text(element) : "";
  if (!is_looked_up(buffer)) return "ks::" + view + "(" + text(&buffer) + index + ")";
  const auto found = views_found_.find(buffer.index);
  if (element == nullptr && found != views_found_.end()) return found->second;
  const std::string of_bytes =
      element != nullptr ? "<" + std::to_string(module_.bindings[buffer.index].size_bytes) + "u>"
                         : "";
  if (is_bound(buffer)) return "ks::" + view + of_bytes + "(" + bound(buffer) + index + ")";
  return "ks::bound_" + view + of_bytes + "(ctx.invocation, " + std::to_string(buffer.index) + "u" +
         index + ")";
}

std::string CppEmitter::load(const Expr& expr) {
  const bool element = expr.kind == ExprKind::kLoadElement;
  if (module_.check_access) {
    const std::string view =
        accessed("_view", expr.operands[0], element ? expr.operands[1] : nullptr,
                 expr.operands.back(), expr.type, expr.layout, expr.row_major, 0, expr.location);
    return memory_read(expr.type, expr.layout, expr.row_major, view, "0u");
  }
  const std::string view = buffer_view(*expr.operands[0], element ? expr.operands[1] : nullptr,
                                       [this](const Expr* e) { return value(e); });
  return memory_read(expr.type, expr.layout, expr.row_major, view, value(expr.operands.back()));
}

void CppEmitter::store(const Stmt& stmt) {
  const bool element = stmt.kind == StmtKind::kStoreElement;
  if (module_.check_access) {
    const std::string view = accessed(
        "_view", stmt.operands[0], element ? stmt.operands[1] : nullptr, stmt.operands.back(),
        stmt.value->type, stmt.layout, stmt.row_major, 1, stmt.location);
    line(
        memory_write(stmt.value->type, stmt.layout, stmt.row_major, view, "0u", value(stmt.value)) +
        ";");
    return;
  }
  const std::string view = buffer_view(*stmt.operands[0], element ? stmt.operands[1] : nullptr,
                                       [this](const Expr* e) { return value(e); });
  line(memory_write(stmt.value->type, stmt.layout, stmt.row_major, view,
                    value(stmt.operands.back()), value(stmt.value)) +
       ";");
}

}  // namespace kaamos::hlsl
