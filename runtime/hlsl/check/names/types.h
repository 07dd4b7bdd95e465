// SPDX-License-Identifier: MIT
//
// The checker's types. They hold what the intermediate representation does not: literal types,
// enums, a matrix's storage order and the struct declaration that a type came from. Types are
// interned: two are equal if their `canonical` pointers are.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/builder/ir_types.h"
#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/front/ast.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

enum class TypeKind : uint8_t {
  kError,  // already diagnosed; converts to and from anything without a message
  kVoid,
  kNumeric,
  kEnum,
  kArray,
  kStruct,
  kResource,
  kString,
};

struct StructInfo;
struct EnumInfo;

// Of a vector that can be swizzled, and of any vector in shader model 6.9. [HLSL: 0026 Long
// vectors]
inline constexpr uint32_t kMostComponents = 4;
inline constexpr uint32_t kMostLongComponents = 1024;

struct Type {
  TypeKind kind = TypeKind::kError;
  Scalar scalar = Scalar::kFloat32;
  uint8_t rows = 0;      // 0: not a matrix
  uint16_t columns = 0;  // 0: a scalar
  bool row_major = false;
  bool is_single = false;         // float1: a scalar that can be indexed
  const Type* element = nullptr;  // array; resource
  uint32_t count = 0;             // array; 0: unbounded
  StructInfo* structure = nullptr;
  EnumInfo* enumeration = nullptr;
  ir::ResourceKind resource = ir::ResourceKind::kByteAddressBuffer;
  bool has_written_element = false;  // Texture2D<float4>, not Texture2D
  uint32_t ray_query_flags = 0;      // RayQuery<flags>
  const Type* canonical = nullptr;   // without storage order
  const ir::Type* ir = nullptr;

  bool is_numeric() const { return kind == TypeKind::kNumeric; }
  bool is_scalar() const { return kind == TypeKind::kNumeric && columns == 0; }
  bool is_vector() const { return kind == TypeKind::kNumeric && columns > 0 && rows == 0; }
  // Of shader model 6.9: no swizzles, and not in everything that holds a vector.
  bool is_long_vector() const { return is_vector() && columns > kMostComponents; }
  bool is_matrix() const { return kind == TypeKind::kNumeric && rows > 0; }
  bool is_array() const { return kind == TypeKind::kArray; }
  bool is_struct() const { return kind == TypeKind::kStruct; }
  bool is_resource() const { return kind == TypeKind::kResource; }
  bool is_query() const { return ir && ir->is_query(); }
  bool is_hit_object() const;
  bool is_stream() const;
  bool is_enum() const { return kind == TypeKind::kEnum; }
  bool is_void() const { return kind == TypeKind::kVoid; }
  bool is_error() const { return kind == TypeKind::kError; }
  // 1 for a scalar.
  uint32_t components() const {
    return (rows == 0 ? 1u : rows) * (columns == 0 ? 1u : static_cast<uint32_t>(columns));
  }
};

// Texels have no components of 64 bits: each is kept as its low and its high half.
inline bool has_paired_texel(const Type* element) {
  return element->is_numeric() &&
         (element->scalar == Scalar::kInt64 || element->scalar == Scalar::kUint64 ||
          element->scalar == Scalar::kFloat64);
}

inline bool same_type(const Type* a, const Type* b) {
  return a->canonical == b->canonical;
}

// The number of scalars, vectors, matrices, arrays and structs in a value when it is flattened.
// Saturates at 2^31 so that nested arrays cannot overflow.
uint64_t flat_component_count(const Type* type);
bool contains_resource(const Type* type);
bool contains_long_vector(const Type* type);
bool contains_hit_object(const Type* type);

struct FieldInfo {
  std::string_view name;
  const Type* type = nullptr;
  const VariableDecl* decl = nullptr;
  uint32_t index = 0;  // in ir::Struct::fields
  PayloadAccessBits access;
  // A bit field: the type of the field of the ir::Struct, which several may share, and the bits.
  const Type* unit = nullptr;
  uint8_t bit_offset = 0;
  uint8_t bit_width = 0;

  bool is_padding() const { return unit && name.empty(); }
  bool begins_field() const { return bit_offset == 0; }
};

struct Scope;

struct StructInfo {
  std::string name;  // qualified
  const StructDecl* decl = nullptr;
  Scope* scope = nullptr;               // its members
  StructInfo* base = nullptr;           // field 0 of the ir::Struct, if there is one
  std::vector<StructInfo*> interfaces;  // that it implements; they have no place in memory
  std::vector<FieldInfo> fields;
  ir::Struct* ir = nullptr;
  const Type* type = nullptr;
  bool complete = false;
  uint32_t open_bits = 0;      // how many are free in the last field, if it holds bit fields
  bool is_payload = false;     // its access qualifiers take effect
  bool is_hit_object = false;  // the built-in dx::HitObject
  // PointStream, LineStream and TriangleStream: 1 to 3, and the type of a vertex.
  uint32_t stream_corners = 0;
  const Type* stream_vertex = nullptr;
  std::string_view template_name;  // "Pair" for Pair<float>; empty if it is not an instance
};

// The fields of a payload struct, which must have `is_payload`.
PayloadLeaves payload_leaves(const StructInfo& structure);

struct EnumInfo {
  std::string name;
  Scalar underlying = Scalar::kInt32;
  bool is_class = false;
};

inline bool Type::is_stream() const {
  return is_struct() && structure->stream_corners != 0;
}
inline bool Type::is_hit_object() const {
  return is_struct() && structure->is_hit_object;
}

// Creates each type once. Owned by a check; its ir::Types live in the module.
class TypeTable {
 public:
  explicit TypeTable(IrTypes& ir);

  const Type* error() const { return error_; }
  const Type* void_type() const { return void_; }
  const Type* string() const { return string_; }
  const Type* scalar(Scalar scalar) { return numeric(scalar, 0, 0); }
  const Type* vector(Scalar scalar, uint32_t size) { return numeric(scalar, 0, size); }
  const Type* matrix(Scalar scalar, uint32_t rows, uint32_t columns, bool row_major = false) {
    return numeric(scalar, rows, columns, row_major);
  }
  // `float1` is a float in everything but that it can be indexed: single() makes it, and here rows
  // 0 and columns 1 give the scalar.
  const Type* numeric(Scalar scalar, uint32_t rows, uint32_t columns, bool row_major = false);
  const Type* single(Scalar scalar);
  const Type* with_scalar(const Type* shape, Scalar scalar);
  const Type* array(const Type* element, uint32_t count);
  const Type* resource(ir::ResourceKind kind, const Type* element, bool written = true);
  // Returns what a texel of that type holds: two 32-bit components for each of 64 bits.
  const Type* texel_of(const Type* element);
  const Type* ray_query(uint32_t flags);
  const Type* structure(StructInfo* info);
  // Makes a struct the same type in the IR as another one with the same fields.
  void share(StructInfo* info, const StructInfo& other);
  const Type* enumeration(EnumInfo* info);
  const Type* boolean() { return scalar(Scalar::kBool); }
  // Literal types become their default types.
  const Type* settled(const Type* type);
  // float3[2] for half3[2].
  const Type* plain(const Type* type);

 private:
  Type* make(TypeKind kind);

  IrTypes& ir_;
  std::deque<Type> pool_;
  const Type* error_ = nullptr;
  const Type* void_ = nullptr;
  const Type* string_ = nullptr;
  std::unordered_map<uint32_t, const Type*> numeric_;
  std::map<Scalar, const Type*> singles_;
  std::map<std::pair<const Type*, uint32_t>, const Type*> arrays_;
  std::map<std::tuple<ir::ResourceKind, const Type*, bool>, const Type*> resources_;
  std::map<uint32_t, const Type*> ray_queries_;
};

// As written in HLSL: "float3", "row_major float4x4", "Light[4]".
std::string to_string(const Type* type);

}  // namespace kaamos::hlsl
