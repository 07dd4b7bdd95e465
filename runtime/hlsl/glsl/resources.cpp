// SPDX-License-Identifier: MIT
//
// Resources: how a binding leads to its descriptor, typed buffers, textures, atomics.
#include <algorithm>
#include <cctype>
#include <cstddef>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/ir/texture_shape.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

constexpr const char* kConstantNames[] = {"source", "offset", "index", "count"};

bool is_buffer(const Type* resource) {
  switch (resource->resource) {
    case ResourceKind::kConstantBuffer:
    case ResourceKind::kTextureBuffer:
    case ResourceKind::kByteAddressBuffer:
    case ResourceKind::kRWByteAddressBuffer:
    case ResourceKind::kStructuredBuffer:
    case ResourceKind::kRWStructuredBuffer:
    case ResourceKind::kBuffer:
    case ResourceKind::kRWBuffer:
      return true;
    default:
      return false;
  }
}

bool is_typed_buffer(const Type* resource) {
  return resource->resource == ResourceKind::kBuffer ||
         resource->resource == ResourceKind::kRWBuffer;
}

bool is_writable_texture(const Type* resource) {
  return resource->resource >= ResourceKind::kRWTexture1D &&
         resource->resource <= ResourceKind::kRWTexture3D;
}

// The dimension as it appears in the names of the prelude's functions.
const char* dimension_name(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::kTexture1D:
    case ResourceKind::kRWTexture1D:
      return "1d";
    case ResourceKind::kTexture1DArray:
    case ResourceKind::kRWTexture1DArray:
      return "1d_array";
    case ResourceKind::kTexture2DArray:
    case ResourceKind::kRWTexture2DArray:
      return "2d_array";
    case ResourceKind::kTexture2DMS:
      return "2d_ms";
    case ResourceKind::kTexture2DMSArray:
      return "2d_ms_array";
    case ResourceKind::kTexture3D:
    case ResourceKind::kRWTexture3D:
      return "3d";
    case ResourceKind::kTextureCube:
      return "cube";
    case ResourceKind::kTextureCubeArray:
      return "cube_array";
    default:
      return "2d";
  }
}

// The number of offset components; array elements have none.
int dimension_count(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::kTexture1D:
    case ResourceKind::kRWTexture1D:
    case ResourceKind::kTexture1DArray:
    case ResourceKind::kRWTexture1DArray:
      return 1;
    case ResourceKind::kTexture3D:
    case ResourceKind::kRWTexture3D:
    case ResourceKind::kTextureCube:
    case ResourceKind::kTextureCubeArray:
      return 3;
    default:
      return 2;
  }
}

// The class of the 32-bit type that a texel holds for a component type: "f", "i" or "u".
const char* texel_class(Scalar scalar) {
  switch (scalar) {
    case Scalar::kFloat16:
    case Scalar::kFloat32:
    case Scalar::kFloat64:
      return "f";
    case Scalar::kInt16:
    case Scalar::kInt32:
    case Scalar::kInt64:
      return "i";
    default:
      return "u";
  }
}

Scalar texel_scalar(Scalar scalar) {
  const char c = texel_class(scalar)[0];
  return c == 'f' ? Scalar::kFloat32 : c == 'i' ? Scalar::kInt32 : Scalar::kUint32;
}

std::string texture_function(const char* operation, const Type* resource, Scalar scalar) {
  return std::string("k_") + operation + "_" + dimension_name(resource->resource) + "_" +
         texel_class(scalar);
}

// Returns whether it is a constant that Vulkan accepts as an offset.
bool is_texel_offset(const Expr& offset) {
  if (offset.kind != ExprKind::kLiteral) {
    return false;
  }
  return std::all_of(offset.literal.begin(), offset.literal.end(), [](uint64_t bits) {
    const auto texels = static_cast<int64_t>(bits);
    return texels >= -8 && texels <= 7;
  });
}

bool is_name(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

std::string zero_offset(const Type* resource) {
  const int count = dimension_count(resource->resource);
  return count == 1 ? "0" : "ivec" + std::to_string(count) + "(0)";
}

const char* atomic_name(AtomicOp op) {
  constexpr const char* kNames[] = {
      "add", "and", "or", "xor", "min", "max", "exchange", "compare_exchange", "compare_exchange"};
  return kNames[static_cast<int>(op)];
}

const char* glsl_atomic(AtomicOp op) {
  constexpr const char* kNames[] = {"atomicAdd",      "atomicAnd",      "atomicOr",
                                    "atomicXor",      "atomicMin",      "atomicMax",
                                    "atomicExchange", "atomicCompSwap", "atomicCompSwap"};
  return kNames[static_cast<int>(op)];
}

}  // namespace

std::string GlslEmitter::print_buffer() {
  static_assert(offsetof(shader::spirv::DispatchBlock, prints) == 640);
  declare_address();
  return generated("g_print_buffer",
                   "k_Descriptor g_print_buffer() {\n"
                   "  return k_Descriptor(2u | 1u << 16, 0u, g_Address(k_dispatch_address + "
                   "640UL).v, g_Address(k_dispatch_address + 648UL).v, 0u, 0u);\n"
                   "}\n") +
         "()";
}

// The address is the pipeline's, so that the code needs no block of a dispatch.
void GlslEmitter::cover(uint32_t point) {
  constant(shader::spirv::kCoverageLowConstant, "g_coverage_low");
  constant(shader::spirv::kCoverageHighConstant, "g_coverage_high");
  const std::string function =
      generated("g_cover",
                "layout(buffer_reference, scalar, buffer_reference_align = 4) buffer g_Covered { "
                "uint v; };\n"
                "void g_cover(uint point) {\n"
                "  uint64_t words = packUint2x32(uvec2(g_coverage_low, g_coverage_high));\n"
                "  if (words != 0UL) g_Covered(words + uint64_t(point) * 4UL).v = 1u;\n"
                "}\n");
  line(function + "(" + glsl::number(point) + ");");
}

// Declares a specialization constant once.
std::string GlslEmitter::constant(uint32_t id, const std::string& name) {
  if (made_.insert(name).second) {
    constants_ += "layout(constant_id = " + std::to_string(shader_.constants.size()) +
                  ") const uint " + name + " = 0u;\n";
    shader_.constants.push_back(id);
  }
  return name;
}

// The four constants of a binding and the index in it, as arguments.
std::string GlslEmitter::binding_arguments(uint32_t binding, const std::string& index) {
  const std::string prefix = "g_b" + std::to_string(binding) + "_";
  std::string text;
  for (uint32_t i = 0; i < 4; ++i) {
    text += constant(binding * 4 + i, prefix + kConstantNames[i]) + ", ";
  }
  text += index;
  return module_.check_access ? text + ", " + glsl::number(binding + 1) : text;
}

// A binding that is not an array is looked up once, when the shader starts.
std::string GlslEmitter::binding(const Expr& expr) {
  const bool checked = module_.check_access;
  if (!expr.operands.empty() && module_.bindings[expr.index].is_array) {
    const std::string arguments = binding_arguments(expr.index, value(expr.operands[0]));
    return checked ? "k_resolve_used(" + arguments + ", " + site(expr.location) + ")"
                   : "k_resolve(" + arguments + ")";
  }
  const std::string name = "g_b" + std::to_string(expr.index);
  if (made_.insert(name).second) {
    declarations_ += "k_Descriptor " + name + ";\n";
    start_ += "  " + name + (checked ? " = k_resolve_checked(" : " = k_resolve(") +
              binding_arguments(expr.index, "0u") + ");\n";
  }
  if (checked) {
    return "k_used(" + name + ", " + binding_arguments(expr.index, "0u") + ", " +
           site(expr.location) + ")";
  }
  return name;
}

// ---------------------------------------------------------------------------------------------
// Texels

// Converts a texel of the scalar's 32-bit type (vec4, ivec4 or uvec4) to a value.
std::string GlslEmitter::from_texel(const Type* t, const std::string& texel) {
  const std::string components =
      t->columns == 4 ? texel : texel + "." + std::string("xyzw").substr(0, t->columns);
  if (t->scalar == texel_scalar(t->scalar)) {
    return components;
  }
  return (t->scalar == Scalar::kFloat16 ? std::string("k_texel_to_f16") : type(t)) + "(" +
         components + ")";
}

std::string GlslEmitter::to_texel(const Type* t, const std::string& text) {
  const Scalar wide = texel_scalar(t->scalar);
  const std::string zeros[] = {"", ", 0, 0, 0", ", 0, 0", ", 0", ""};
  const std::string converted = glsl::vector_name(wide, t->columns) + "(" + text + ")";
  return glsl::vector_name(wide, 4) + "(" + converted + zeros[t->columns] + ")";
}

std::string GlslEmitter::typed_load(const Expr& expr) {
  const Type* resource = expr.operands[0]->type;
  const std::string descriptor = value(expr.operands[0]);
  const std::string coordinates = value(expr.operands[1]);
  const Scalar scalar = expr.type->scalar;
  if (is_typed_buffer(resource)) {
    const std::string bits = "k_load_typed(" + descriptor + ", uint(" + coordinates + "))";
    const Scalar wide = texel_scalar(scalar);
    return from_texel(expr.type, wide == Scalar::kFloat32 ? "uintBitsToFloat(" + bits + ")"
                                 : wide == Scalar::kInt32 ? "ivec4(" + bits + ")"
                                                          : bits);
  }
  if (is_writable_texture(resource)) {
    return from_texel(expr.type, texture_function("load_image", resource, scalar) + "(" +
                                     descriptor + ", " + texel_at(expr.operands[1]) + ")");
  }
  const std::string mip =
      expr.operands.size() > 2 ? "int(" + value(expr.operands[2]) + ")" : std::string("0");
  const std::string offset =
      expr.operands.size() > 3 ? value(expr.operands[3]) : zero_offset(resource);
  return from_texel(expr.type, texture_function("load_texel", resource, scalar) + "(" + descriptor +
                                   ", " + texel_at(expr.operands[1]) + ", " + mip + ", " + offset +
                                   ")");
}

// A texel's coordinates as int.
std::string GlslEmitter::texel_at(const Expr* coordinates) {
  const std::string text = value(coordinates);
  return coordinates->type->scalar == Scalar::kInt32
             ? text
             : glsl::vector_name(Scalar::kInt32, coordinates->type->columns) + "(" + text + ")";
}

void GlslEmitter::typed_store(const Stmt& stmt) {
  const Type* resource = stmt.operands[0]->type;
  const Type* t = stmt.value->type;
  const std::string descriptor = value(stmt.operands[0]);
  const std::string texel = to_texel(t, value(stmt.value));
  if (is_typed_buffer(resource)) {
    const Scalar wide = texel_scalar(t->scalar);
    line("k_store_typed(" + descriptor + ", uint(" + value(stmt.operands[1]) + "), " +
         (wide == Scalar::kFloat32 ? "floatBitsToUint(" + texel + ")"
          : wide == Scalar::kInt32 ? "uvec4(" + texel + ")"
                                   : texel) +
         ");");
    return;
  }
  line(texture_function("store_texel", resource, t->scalar) + "(" + descriptor + ", " +
       texel_at(stmt.operands[1]) + ", " + texel + ");");
}

std::string GlslEmitter::sample(const Expr& expr) {
  const auto& operands = expr.operands;
  const Type* resource = operands[0]->type;
  if (expr.sample == SampleKind::kLevelOfDetail) {
    return texture_function("level_of_detail", resource, Scalar::kFloat32) + "(" +
           value(operands[0]) + ", " + value(operands[1]) + ", " + value(operands[2]) + ", " +
           value(operands[3]) + ", " + value(operands[4]) + ")";
  }
  constexpr const char* kNames[] = {"sample_level", "sample_gradient", "sample_compare_level",
                                    "gather", "gather_compare"};
  constexpr size_t kFixed[] = {4, 5, 5, 3, 4};  // number of operands before the offset
  const auto kind = static_cast<size_t>(expr.sample);
  const bool compares =
      expr.sample == SampleKind::kCompareLevel || expr.sample == SampleKind::kGatherCompare;
  const Scalar scalar = compares ? Scalar::kFloat32 : expr.type->scalar;
  // Gathers accept any offset. For other samples, a constant offset is exact; it is passed to a
  // macro, so operands that the macro uses more than once are put in variables first.
  const bool constant_offset =
      kind < 3 && operands.size() > kFixed[kind] && is_texel_offset(*operands[kFixed[kind]]);
  std::string out = texture_function(
      (kNames[kind] + std::string(constant_offset ? "_offset" : "")).c_str(), resource, scalar);
  if (compares) {
    out.resize(out.size() - 2);  // depth values are floats
  }
  out += "(";
  for (size_t i = 0; i < kFixed[kind]; ++i) {
    const std::string operand = value(operands[i]);
    const bool named = !constant_offset || i > 1 || is_name(operand);
    out += (i == 0 ? "" : ", ") + (named ? operand : hoist(type(operands[i]->type), operand));
  }
  if (expr.sample == SampleKind::kGather) {
    out += ", " + glsl::number(expr.index);
  }
  out += ", " +
         (operands.size() > kFixed[kind] ? value(operands[kFixed[kind]]) : zero_offset(resource)) +
         ")";
  if (expr.sample == SampleKind::kCompareLevel) {
    return type(expr.type) + "(" + out + ")";  // a float
  }
  return from_texel(expr.type, out);
}

std::string GlslEmitter::dimensions(const Expr& expr) {
  const Type* resource = expr.operands[0]->type;
  const std::string descriptor = value(expr.operands[0]);
  if (is_buffer(resource)) {
    return "k_buffer_dimensions(" + descriptor + ")";
  }
  const std::string number = std::to_string(texture_shape(*resource) >> 8) + "u";
  if (is_writable_texture(resource)) {
    return std::string("k_image_dimensions_") + dimension_name(resource->resource) + "(" +
           descriptor + ", " + number + ")";
  }
  return std::string("k_texture_dimensions_") + dimension_name(resource->resource) + "(" +
         descriptor + ", " + number + ", " +
         (expr.operands.size() > 1 ? "uint(" + value(expr.operands[1]) + ")" : "0u") + ")";
}

// ---------------------------------------------------------------------------------------------
// Atomics

// An atomic operation on groupshared memory in a ray tracing shader, where no other thread shares
// it.
std::string GlslEmitter::alone_atomic(AtomicOp op, const Type* t) {
  constexpr const char* kResults[] = {"old + v",     "old & v", "old | v", "old ^ v", "min(old, v)",
                                      "max(old, v)", "v",       "",        ""};
  const bool compares = op == AtomicOp::kCompareExchange || op == AtomicOp::kCompareStore;
  const std::string name = std::string("g_") + atomic_name(op) + "_" + glsl::suffix(t->scalar);
  const bool equal_bits = t->scalar == Scalar::kFloat32;
  const std::string same =
      equal_bits ? "floatBitsToUint(old) == floatBitsToUint(compare)" : "old == compare";
  const std::string result = compares ? same + " ? v : old" : kResults[static_cast<int>(op)];
  return generated(name, type(t) + " " + name + "(inout " + type(t) + " place, " +
                             (compares ? type(t) + " compare, " : "") + type(t) + " v) {\n  " +
                             type(t) + " old = place;\n  place = " + result +
                             ";\n  return old;\n}\n");
}

// Exchanges a groupshared float, which devices need not have as an atomic operation: one thread of
// the group after another does, under a lock that it gives back before any other goes on.
void GlslEmitter::exchange_shared_float(const Stmt& stmt) {
  if (made_.insert("g_float_lock").second) declarations_ += "shared uint g_float_lock = {};\n";
  const Path p = path(stmt.place);
  const std::string guard = p.guard();
  if (!guard.empty() && stmt.result != nullptr) {
    line(variable(stmt.result) + " = " + zero(stmt.result->type) + ";");
  }
  open(guard.empty() ? "{" : "if (" + guard + ") {");
  line("const float g_new = " + value(stmt.value) + ";");
  if (stmt.compare != nullptr) line("const float g_compare = " + value(stmt.compare) + ";");
  line("float g_old = 0.0;");
  open("for (bool g_waits = true; g_waits;) {");
  open("if (atomicCompSwap(g_float_lock, 0u, 1u) == 0u) {");
  line("memoryBarrierShared();");
  line("g_old = " + p.text + ";");
  line((stmt.compare != nullptr ? "if (floatBitsToUint(g_old) == floatBitsToUint(g_compare)) "
                                : "") +
       p.text + " = g_new;");
  line("memoryBarrierShared();");
  line("atomicExchange(g_float_lock, 0u);");
  line("g_waits = false;");
  close("}");
  close("}");
  if (stmt.result != nullptr) line(variable(stmt.result) + " = g_old;");
  close("}");
}

void GlslEmitter::atomic(const Stmt& stmt) {
  const Scalar scalar = stmt.value->type->scalar;
  const std::string result = stmt.result != nullptr ? variable(stmt.result) + " = " : "";
  std::string arguments;
  if (stmt.compare != nullptr) {
    arguments += ", " + value(stmt.compare);
  }
  arguments += ", " + value(stmt.value) + ")";
  if (stmt.target == AtomicTarget::kPlace && entry_.stage == kStageCompute &&
      scalar == Scalar::kFloat32) {
    return exchange_shared_float(stmt);
  }
  if (stmt.target == AtomicTarget::kPlace) {
    const Path p = path(stmt.place);
    const std::string guard = p.guard();
    if (!guard.empty() && stmt.result != nullptr) {
      line(result + zero(stmt.result->type) + ";");
    }
    const std::string function = entry_.stage == kStageCompute
                                     ? glsl_atomic(stmt.atomic)
                                     : alone_atomic(stmt.atomic, stmt.value->type);
    line((guard.empty() ? "" : "if (" + guard + ") ") + result + function + "(" + p.text +
         arguments + ";");
    return;
  }
  const Type* resource = stmt.operands[0]->type;
  const bool is_wide = scalar_bytes(scalar, ScalarStorage::kBuffer) == 8;
  if (stmt.target == AtomicTarget::kTyped && !is_typed_buffer(resource) && is_wide) {
    const std::string t = type(stmt.value->type);
    const std::string compare =
        stmt.compare != nullptr ? "uint64_t(" + value(stmt.compare) + ")" : "0UL";
    line(result + t + "(" + texture_function("image_atomic_64", resource, scalar) + "(" +
         value(stmt.operands[0]) + ", " + texel_at(stmt.operands[1]) + ", " +
         glsl::number(static_cast<uint32_t>(stmt.atomic)) + ", " + compare + ", uint64_t(" +
         value(stmt.value) + ")));");
    return;
  }
  if (stmt.target == AtomicTarget::kTyped && !is_typed_buffer(resource)) {
    line(result +
         texture_function((std::string("image_atomic_") + atomic_name(stmt.atomic)).c_str(),
                          resource, scalar) +
         "(" + value(stmt.operands[0]) + ", " + texel_at(stmt.operands[1]) + arguments + ";");
    return;
  }
  std::string address;
  const char* bits = is_wide ? "64" : "32";
  if (stmt.target == AtomicTarget::kCounter) {
    address = "k_counter_address(" + value(stmt.operands[0]) + ")";
  } else if (stmt.target == AtomicTarget::kTyped) {
    address = std::string(is_wide ? "k_typed_address_64(" : "k_typed_address(") +
              value(stmt.operands[0]) + ", uint(" + value(stmt.operands[1]) + "))";
  } else {
    const bool element = stmt.target == AtomicTarget::kElement;
    std::string window = element ? "k_element_window" : "k_window";
    window += module_.check_access ? "_checked(" : "(";
    for (size_t i = 0; i < stmt.operands.size(); ++i) {
      window += (i == 0 ? "" : ", ") + value(stmt.operands[i]);
    }
    if (module_.check_access) {
      window += access_arguments(stmt.value->type, Layout::kStructured, false, 2, stmt.location);
    }
    address = std::string("k_atomic_address_") + bits + "(" + window + "))";
  }
  line(result + "k_atomic_" + atomic_name(stmt.atomic) + "_" + glsl::suffix(scalar) + "(" +
       address + arguments + ";");
}

}  // namespace kaamos::hlsl
