// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/payload_layout.h"

#include "runtime/hlsl/ir/host_layout.h"

namespace kaamos::hlsl {
namespace {

using namespace ir;

constexpr uint32_t kMaxFields = 256;

const char* scalar_name(Scalar scalar) {
  constexpr const char* kNames[] = {"bool",    "int16_t",  "uint16_t",  "int",   "uint",
                                    "int64_t", "uint64_t", "float16_t", "float", "double"};
  return kNames[static_cast<uint8_t>(scalar)];
}

struct Writer {
  interpret::Layouts layouts;
  std::string out;
  uint32_t fields = 0;

  void leaf(const Type* type, const std::string& name, uint32_t offset) {
    ++fields;
    out += scalar_name(type->scalar);
    if (type->kind == TypeKind::kMatrix) out += std::to_string(type->rows) + "x";
    if (type->kind != TypeKind::kScalar) out += std::to_string(type->columns);
    out += " " + (name.empty() ? "value" : name) + " " + std::to_string(offset) + ";";
  }
  void write(const Type* type, const std::string& name, uint32_t offset) {
    if (fields >= kMaxFields) return;
    switch (type->kind) {
      case TypeKind::kScalar:
      case TypeKind::kVector:
      case TypeKind::kMatrix:
        return leaf(type, name, offset);
      case TypeKind::kArray: {
        const uint32_t stride = layouts.extent_of(type->element).bytes;
        for (uint32_t i = 0; i < type->count && fields < kMaxFields; ++i) {
          write(type->element, name + "[" + std::to_string(i) + "]", offset + i * stride);
        }
        return;
      }
      case TypeKind::kStruct:
        for (uint32_t i = 0; i < type->structure->fields.size(); ++i) {
          const Field& field = type->structure->fields[i];
          write(field.type, name.empty() ? field.name : name + "." + field.name,
                offset + layouts.field_offset(*type->structure, i));
        }
        return;
      case TypeKind::kVoid:
      case TypeKind::kResource:
        return;
    }
  }
};

}  // namespace

std::string value_layout(const Type* type) {
  if (type == nullptr) return {};
  Writer writer;
  if (writer.layouts.extent_of(type).bytes > interpret::kMaxValueBytes) return {};
  writer.write(type, "", 0);
  return std::move(writer.out);
}

}  // namespace kaamos::hlsl
