// SPDX-License-Identifier: MIT
//
// TraceRay, CallShader, ReportHit and the data they pass: payloads, callable data and attributes,
// as <kaamos/shader/spirv_interface.h> lays them out.
#include <algorithm>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

using shader::spirv::kMaxCallableDepthConstant;
using shader::spirv::kMaxTraceDepthConstant;
using shader::spirv::kWorkaroundsConstant;

// Bits of shader::spirv::Workaround.
constexpr const char* kRestoreAttributes = "(g_workarounds & 1u) != 0u";
static_assert(shader::spirv::kRestoreAttributes == 1);
constexpr const char* kTrackReportedT = "(g_workarounds & 4u) != 0u";
static_assert(shader::spirv::kTrackReportedT == 4);

bool two_floats(const Type* type) {
  if (glsl::words(type) != 2) {
    return false;
  }
  switch (type->kind) {
    case TypeKind::kScalar:
    case TypeKind::kVector:
    case TypeKind::kMatrix:
      return type->scalar == Scalar::kFloat32;
    case TypeKind::kArray:
      return two_floats(type->element) || (type->element->kind == TypeKind::kScalar &&
                                           type->element->scalar == Scalar::kFloat32);
    case TypeKind::kStruct:
      for (const Field& field : type->structure->fields) {
        const Type* leaf = field.type;
        while (leaf->kind == TypeKind::kArray) {
          leaf = leaf->element;
        }
        if (leaf->kind == TypeKind::kStruct ? glsl::words(leaf) != 0 && !two_floats(leaf)
                                            : leaf->scalar != Scalar::kFloat32) {
          return false;
        }
      }
      return true;
    default:
      return false;
  }
}

}  // namespace

void GlslEmitter::declare_workarounds() {
  constant(kWorkaroundsConstant, "g_workarounds");
}

// Emits a function or variable the first time it is needed. Returns the name.
std::string GlslEmitter::generated(const std::string& name, const std::string& text) {
  if (made_.insert(name).second) {
    helpers_ += text;
  }
  return name;
}

// ---------------------------------------------------------------------------------------------
// The form in which payloads are passed between shaders: bools become uints.

std::string GlslEmitter::wire_type(const Type* t) {
  if (!glsl::contains_bool(t)) {
    return type(t);
  }
  switch (t->kind) {
    case TypeKind::kScalar:
    case TypeKind::kVector:
      return glsl::vector_name(Scalar::kUint32, t->columns);
    case TypeKind::kMatrix:
      return matrix_name(Scalar::kUint32, t->rows, t->columns);
    case TypeKind::kArray: {
      std::string counts;
      for (; t->kind == TypeKind::kArray; t = t->element) {
        counts += "[" + std::to_string(t->count) + "]";
      }
      return wire_type(t) + counts;
    }
    default:
      break;
  }
  auto& name = generated_["wire " + type(t)];
  if (name.empty()) {
    name = "g_wire_" + std::to_string(generated_.size());
    std::string text = "struct " + name + " {\n";
    for (size_t i = 0; i < t->structure->fields.size(); ++i) {
      text += "  " + wire_type(t->structure->fields[i].type) + " " +
              field(t->structure, static_cast<uint32_t>(i)) + ";\n";
    }
    structs_ += text + "};\n";
  }
  return name;
}

// The name of a function that converts a type to the form in which it is passed, or back; empty if
// the two are the same.
std::string GlslEmitter::convert_wire(const Type* t, bool to_wire) {
  if (!glsl::contains_bool(t)) {
    return "";
  }
  if (t->kind == TypeKind::kScalar || t->kind == TypeKind::kVector) {
    return to_wire ? wire_type(t) : type(t);  // constructors
  }
  auto& name = generated_[(to_wire ? "to wire " : "from wire ") + type(t)];
  if (!name.empty()) {
    return name;
  }
  name = (to_wire ? "g_to_wire_" : "g_from_wire_") + std::to_string(generated_.size());
  const std::string function = name;
  const std::string result = to_wire ? wire_type(t) : type(t);
  std::string text = result + " " + function + "(" + (to_wire ? type(t) : wire_type(t)) +
                     " from) {\n  " + result + " to;\n";
  if (t->kind == TypeKind::kArray) {
    text += "  for (uint i = 0u; i < " + glsl::number(t->count) +
            "; ++i) to[i] = " + convert_wire(t->element, to_wire) + "(from[i]);\n";
  } else if (t->kind == TypeKind::kMatrix) {
    text += "  for (uint i = 0u; i < " + glsl::number(t->rows) + "; ++i) to.r[i] = " +
            glsl::vector_name(to_wire ? Scalar::kUint32 : Scalar::kBool, t->columns) +
            "(from.r[i]);\n";
  } else {
    for (size_t i = 0; i < t->structure->fields.size(); ++i) {
      const std::string& f = field(t->structure, static_cast<uint32_t>(i));
      text += "  to." + f + " = " + convert_wire(t->structure->fields[i].type, to_wire) + "(from." +
              f + ");\n";
    }
  }
  helpers_ += text + "  return to;\n}\n";
  return function;
}

// ---------------------------------------------------------------------------------------------
// TraceRay and CallShader

void GlslEmitter::declare_status() {
  generated("g_Status",
            "layout(buffer_reference, scalar, buffer_reference_align = 8) buffer g_Status {\n"
            "  uint removal_reason;\n"
            "  uint reordered;\n"
            "  uint counts[" +
                std::to_string(2 * shader::spirv::kCountCount) +
                "];\n  uint64_t unknown_structure;\n};\n");
}

// A statement that increments a counter, if the device collects statistics.
std::string GlslEmitter::count(uint32_t what) {
  constant(shader::spirv::kCountConstant, "g_counts");
  declare_status();
  generated("g_count",
            "void g_count(uint what) {\n"
            "  if (g_counts == 0u) return;\n"
            "  g_Status status = g_Status(k_dispatch.status);\n"
            "  if (atomicAdd(status.counts[2u * what], 1u) == 0xFFFFFFFFu) {\n"
            "    atomicAdd(status.counts[2u * what + 1u], 1u);\n"
            "  }\n"
            "}\n");
  return "g_count(" + glsl::number(what) + ");";
}

void GlslEmitter::declare_remove_device() {
  declare_status();
  if (made_.insert("g_remove_device").second) {
    helpers_ +=
        "void g_remove_device(uint reason) {\n"
        "  g_Status(k_dispatch.status).removal_reason = reason + 1u;\n"
        "}\n";
  }
}

std::string GlslEmitter::payload_block(const char* qualifier, int location, const Type* t,
                                       const std::string& name) {
  const std::string block = name + "_type";
  declarations_ += "struct " + block + " { uint depths; " +
                   (module_.check_access ? "uint type; uint bytes; " : "") + wire_type(t) +
                   " data; };\n" + "layout(location = " + std::to_string(location) + ") " +
                   qualifier + " " + block + " " + name + ";\n";
  return name;
}

// Writes the header that the receiving shader checks, in checked libraries.
std::string GlslEmitter::header(const std::string& payload, const Type* t) const {
  return "  " + payload + ".type = " + glsl::number(type_hash(t)) + ";\n  " + payload +
         ".bytes = " + glsl::number(4 * glsl::words(t)) + ";\n";
}

std::string GlslEmitter::trace_checks(const std::string& ray, const std::string& out,
                                      const Type* payload) const {
  if (!module_.check_access) return "";
  return "  if (unknown) k_reached(0u, site, k_structure_of(scene), flags, (mask & 0xFFu) | "
         "(contribution & 15u) << 8 | (multiplier & 15u) << 12 | miss << 16);\n"
         "  k_check_ray(" +
         ray +
         ", flags, false, site);\n"
         "  k_check_depth(g_depths & 0xFFFFu, site);\n" +
         header(out, payload);
}

// Declares the function that finds the acceleration structure to which a resource refers.
void GlslEmitter::declare_top_level() {
  declare_status();
  generated("g_top_level",
            "layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer "
            "g_TopLevelEntry { uint64_t address; uint64_t vulkan; uint64_t with_micromaps; "
            "uint64_t all_candidates; };\n"
            "uint64_t g_top_level_entry(k_Descriptor scene) {\n"
            "  if ((scene.kind_access & 0xFFFFu) != 7u || scene.address == 0UL) return 0UL;\n"
            "  uint mask = k_dispatch.top_level_mask;\n"
            "  uint slot = uint(scene.address >> 8) * 0x9E3779B1u >> 7;\n"
            "  for (uint i = 0u; i <= mask; ++i, ++slot) {\n"
            "    uint64_t at = k_dispatch.top_levels + uint64_t(slot & mask) * 32UL;\n"
            "    uint64_t found = g_TopLevelEntry(at).address;\n"
            "    if (found == scene.address) return at;\n"
            "    if (found == 0UL) break;\n"
            "  }\n"
            "  g_Status(k_dispatch.status).unknown_structure = scene.address;\n"
            "  return 0UL;\n"
            "}\n"
            "uint64_t g_top_level(k_Descriptor scene) {\n"
            "  uint64_t at = g_top_level_entry(scene);\n"
            "  return at == 0UL ? k_dispatch.empty_top_level : g_TopLevelEntry(at).vulkan;\n"
            "}\n");
}

std::string GlslEmitter::trace_function(const Type* payload) {
  if (twin_) return twin_trace_function(payload);
  auto& name = generated_["trace " + type(payload)];
  if (!name.empty()) {
    return name;
  }
  const int location = next_location_++;
  const std::string number = std::to_string(location);
  const std::string function = "g_trace_" + number;
  name = function;
  const std::string out = payload_block("rayPayloadEXT", location, payload, "g_payload_" + number);
  const std::string to = convert_wire(payload, true);
  const std::string from = convert_wire(payload, false);
  Type desc;
  desc.kind = TypeKind::kStruct;
  desc.structure = module_.ray_desc;
  const std::string ray = type(&desc);
  constant(kMaxTraceDepthConstant, "g_max_trace_depth");
  declare_remove_device();
  declare_micromap_top_level();
  const auto member = [&](uint32_t i) { return "ray." + field(module_.ray_desc, i); };
  const std::string of_ray = member(0) + ", " + member(1) + ", " + member(2) + ", " + member(3);
  const bool checked = module_.check_access;
  const std::string allowed = micromaps_allowed();
  helpers_ +=
      "void " + function +
      "(k_Descriptor scene, uint flags, uint mask, uint contribution, uint multiplier, "
      "uint miss, " +
      ray + " ray, inout " + type(payload) + " payload" +
      (checked ? ", uint site, bool unknown" : "") + ") {\n" + trace_checks(of_ray, out, payload) +
      "  if ((g_depths & 0xFFFFu) >= g_max_trace_depth) {\n"
      "    g_remove_device(0u);\n"
      "    return;\n"
      "  }\n"
      "  " +
      count(shader::spirv::kTraceRayCalls) +
      "\n"
      "  if ((flags & 8u) != 0u && (flags & 5u) != 0u) " +
      count(shader::spirv::kVisibilityRays) +
      "\n"
      "  " +
      out +
      ".depths = g_depths + 1u;\n"
      "  " +
      out + ".data = " + to +
      "(payload);\n"
      "  uint driver_flags = flags & 0x7FFu;\n"
      "  uint64_t top;\n"
      "  if (" +
      allowed +
      ") top = g_micromap_top_level(scene, driver_flags);\n"
      "  else top = g_top_level(scene);\n"
      "  traceRayEXT(accelerationStructureEXT(top), driver_flags, mask & 0xFFu, "
      "contribution & 15u, multiplier & 15u, min(miss & 0xFFFFu, k_dispatch.miss_count), " +
      of_ray + ", " + number + ");\n" +
      (checked ? "  if (" + out + ".type != 0u && (flags & 8u) == 0u) k_ran_nothing(1u);\n" : "") +
      "  payload = " + from + "(" + out +
      ".data);\n"
      "}\n";
  return function;
}

void GlslEmitter::trace_ray(const Stmt& stmt) {
  const std::string function = stmt.result != nullptr ? trace_hit_function(stmt.place->type)
                                                      : trace_function(stmt.place->type);
  std::string text = call(function, stmt.operands);
  text.pop_back();
  line((stmt.result != nullptr ? variable(stmt.result) + " = " : "") + text + ", " +
       path(stmt.place).text +
       (module_.check_access
            ? ", " + site(stmt.location) + (is_unknown(module_, stmt) ? ", true" : ", false")
            : "") +
       ");");
}

std::string GlslEmitter::call_shader_function(const Type* data) {
  auto& name = generated_["call " + type(data)];
  if (!name.empty()) {
    return name;
  }
  const int location = next_location_++;
  const std::string number = std::to_string(location);
  const std::string function = "g_call_" + number;
  name = function;
  const std::string out = payload_block("callableDataEXT", location, data, "g_data_" + number);
  const std::string to = convert_wire(data, true);
  const std::string from = convert_wire(data, false);
  constant(kMaxCallableDepthConstant, "g_max_callable_depth");
  declare_remove_device();
  helpers_ += "void " + function + "(uint shader, inout " + type(data) + " data) {\n" +
              (module_.check_access ? header(out, data) : "") +
              "  if ((g_depths >> 16) >= g_max_callable_depth) {\n"
              "    g_remove_device(1u);\n"
              "    return;\n"
              "  }\n"
              "  " +
              out +
              ".depths = g_depths + 0x10000u;\n"
              "  " +
              out + ".data = " + to +
              "(data);\n"
              "  executeCallableEXT(min(shader, k_dispatch.callable_count), " +
              number + ");\n" +
              (module_.check_access ? "  if (" + out + ".type != 0u) k_ran_nothing(2u);\n" : "") +
              "  data = " + from + "(" + out +
              ".data);\n"
              "}\n";
  return function;
}

void GlslEmitter::call_shader(const Stmt& stmt) {
  const std::string function = call_shader_function(stmt.place->type);
  if (module_.check_access && is_unknown(module_, stmt)) {
    line("k_reached(2u, " + site(stmt.location) + ", 0UL, 0u, " + value(stmt.operands[0]) + ");");
  }
  line(function + "(" + value(stmt.operands[0]) + ", " + path(stmt.place).text + ");");
}

// ---------------------------------------------------------------------------------------------
// Hit attributes

// A shader may report hits with attributes of several types.
bool GlslEmitter::attributes_are_floats() const {
  return std::all_of(attribute_types_.begin(), attribute_types_.end(), two_floats);
}

uint32_t GlslEmitter::attribute_words() const {
  uint32_t most = 1;
  for (const Type* type : attribute_types_) {
    most = std::max(most, glsl::words(type));
  }
  return most;
}

void GlslEmitter::declare_attributes() {
  if (made_.insert("g_attributes").second) {
    declarations_ += attributes_are_floats() ? std::string("hitAttributeEXT vec2 g_attributes;\n")
                                             : "hitAttributeEXT uint g_attributes[" +
                                                   std::to_string(attribute_words()) + "];\n";
  }
}

namespace {

// Converts a scalar's bits to 32-bit words, or back.
std::string to_word(Scalar scalar, const std::string& text, int half) {
  switch (scalar) {
    case Scalar::kFloat32:
      return "floatBitsToUint(" + text + ")";
    case Scalar::kFloat16:
      return "uint(float16BitsToUint16(" + text + "))";
    case Scalar::kFloat64:
      return "unpackDouble2x32(" + text + ")" + (half == 0 ? ".x" : ".y");
    case Scalar::kInt64:
    case Scalar::kUint64:
      return "unpackUint2x32(uint64_t(" + text + "))" + (half == 0 ? ".x" : ".y");
    default:
      return "uint(" + text + ")";
  }
}

std::string from_words(Scalar scalar, const std::string& low, const std::string& high) {
  switch (scalar) {
    case Scalar::kBool:
      return "(" + low + " != 0u)";
    case Scalar::kFloat32:
      return "uintBitsToFloat(" + low + ")";
    case Scalar::kFloat16:
      return "uint16BitsToFloat16(uint16_t(" + low + "))";
    case Scalar::kFloat64:
      return "packDouble2x32(uvec2(" + low + ", " + high + "))";
    case Scalar::kInt64:
      return "int64_t(packUint2x32(uvec2(" + low + ", " + high + ")))";
    case Scalar::kUint64:
      return "packUint2x32(uvec2(" + low + ", " + high + "))";
    default:
      return glsl::scalar_name(scalar) + "(" + low + ")";
  }
}

}  // namespace

void GlslEmitter::each_scalar(const Type* t, const std::string& at,
                              const std::function<void(Scalar, const std::string&)>& visit) {
  switch (t->kind) {
    case TypeKind::kScalar:
      visit(t->scalar, at);
      break;
    case TypeKind::kVector:
      for (int c = 0; c < t->columns; ++c) {
        visit(t->scalar, t->columns == 1 ? at : at + "." + glsl::component(c));
      }
      break;
    case TypeKind::kMatrix:
      for (int r = 0; r < t->rows; ++r) {
        for (int c = 0; c < t->columns; ++c) {
          visit(t->scalar, at + ".r[" + std::to_string(r) + "]" +
                               (t->columns == 1 ? "" : "." + glsl::component(c)));
        }
      }
      break;
    case TypeKind::kArray:
      for (uint32_t i = 0; i < t->count; ++i) {
        each_scalar(t->element, at + "[" + std::to_string(i) + "]", visit);
      }
      break;
    case TypeKind::kStruct:
      for (size_t i = 0; i < t->structure->fields.size(); ++i) {
        each_scalar(t->structure->fields[i].type,
                    at + "." + field(t->structure, static_cast<uint32_t>(i)), visit);
      }
      break;
    default:
      break;
  }
}

// Statements that store each scalar of `value` in words, or load it from them.
std::string GlslEmitter::words_of(const Type* t, const std::string& words, bool store) {
  std::string text;
  uint32_t next = 0;
  each_scalar(t, "value", [&](Scalar scalar, const std::string& part) {
    const auto word = [&](uint32_t i) { return words + "[" + std::to_string(i) + "]"; };
    const uint32_t count = scalar_bytes(scalar, ScalarStorage::kBuffer) == 8 ? 2 : 1;
    if (store) {
      for (uint32_t i = 0; i < count; ++i) {
        text += "  " + word(next + i) + " = " + to_word(scalar, part, static_cast<int>(i)) + ";\n";
      }
    } else {
      text += "  " + part + " = " + from_words(scalar, word(next), word(next + 1)) + ";\n";
    }
    next += count;
  });
  return text;
}

// A function that stores a value in the attributes, or loads one from them.
std::string GlslEmitter::attributes_function(const Type* t, bool store) {
  auto& name = generated_[(store ? "store attributes " : "load attributes ") + type(t)];
  if (!name.empty()) {
    return name;
  }
  declare_attributes();
  name = (store ? "g_store_attributes_" : "g_load_attributes_") + std::to_string(generated_.size());
  const bool floats = attributes_are_floats();
  std::string text = store ? "void " + name + "(" + type(t) + " value) {\n"
                           : type(t) + " " + name + "() {\n  " + type(t) + " value;\n";
  if (floats) {
    int next = 0;
    each_scalar(t, "value", [&](Scalar, const std::string& part) {
      const std::string to = "g_attributes." + glsl::component(next++);
      text += "  " + (store ? to + " = " + part : part + " = " + to) + ";\n";
    });
  } else {
    text += words_of(t, "g_attributes", store);
  }
  helpers_ += text + (store ? "}\n" : "  return value;\n}\n");
  return name;
}

std::string GlslEmitter::report_function(const Type* attributes) {
  if (twin_) return twin_report_function(attributes);
  auto& name = generated_["report " + type(attributes)];
  if (!name.empty()) {
    return name;
  }
  const std::string store = attributes_function(attributes, true);
  name = "g_report_" + std::to_string(generated_.size());
  declare_workarounds();
  const std::string saved = attributes_are_floats()
                                ? std::string("vec2 saved")
                                : "uint saved[" + std::to_string(attribute_words()) + "]";
  helpers_ += "bool " + name + "(float t, uint kind, " + type(attributes) + " value) {\n  " +
              saved + " = g_attributes;\n  " + store +
              "(value);\n"
              "  bool accepted = reportIntersectionEXT(t, kind);\n"
              "  if (accepted) {\n"
              "    g_t_reported = t;\n"
              "    if ((gl_IncomingRayFlagsEXT & 4u) != 0u) g_ended = 3u;\n"
              "  } else if (" +
              kRestoreAttributes +
              ") {\n"
              "    g_attributes = saved;\n"
              "  }\n"
              "  return accepted;\n"
              "}\n";
  return name;
}

// The closest hit so far, in an intersection shader.
std::string GlslEmitter::reported_t() {
  declare_workarounds();
  return generated("g_ray_t_current", std::string("float g_ray_t_current() { return ") +
                                          kTrackReportedT +
                                          " ? g_t_reported : gl_RayTmaxEXT; }\n") +
         "()";
}

void GlslEmitter::report_hit(const Stmt& stmt) {
  const std::string function = report_function(stmt.operands[2]->type);
  const std::string result = stmt.result != nullptr ? variable(stmt.result) + " = " : "";
  if (module_.check_access) {
    generated("g_check_kind",
              "void g_check_kind(uint kind, uint site) {\n"
              "  if (kind > 127u) k_tell(12u, site, 0u, 0u, uint64_t(kind), 0UL, 0UL, 0UL);\n"
              "}\n");
    line("g_check_kind(" + value(stmt.operands[1]) + ", " + site(stmt.location) + ");");
  }
  line(result + call(function, stmt.operands) + ";");
  return_if_ended();
}

}  // namespace kaamos::hlsl
