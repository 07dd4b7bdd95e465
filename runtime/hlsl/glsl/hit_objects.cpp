// SPDX-License-Identifier: MIT
//
// HitObject, which Vulkan has as an extension at most. HitObject::TraceRay is a ray query, and what
// it calls while it traverses, as well as what Invoke calls, are the twins of the shaders: each
// any-hit, intersection, closest-hit and miss shader is compiled a second time, as a callable
// shader that gets the hit and the payload in its data (spirv_interface.h). Callables cannot call
// traceRayEXT, so that a twin's TraceRay is HitObject::TraceRay and Invoke.
#include <algorithm>

#include "kaamos/shader/debugging.h"
#include "kaamos/shader/reordering.h"
#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/ir/hit_object.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

using shader::spirv::kMaxTraceDepthConstant;
using shader::spirv::kTwinPayloadConstant;

// Bits of TwinControl.
static_assert(shader::spirv::kTwinIgnored == 1 && shader::spirv::kTwinEnded == 2 &&
              shader::spirv::kTwinAccepted == 4 && shader::spirv::kTwinOpaque == 8);
static_assert(shader::kReorderedRecord == 0xFFFFFFFFu);
static_assert(shader::kHitObjectHit == 1 && shader::kHitObjectMiss == 2);

// shader::spirv::TwinTables
constexpr char kTables[] =
    "layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer g_TwinTables {\n"
    "  uint first;\n  uint last_hit;\n  uint last_miss;\n  uint ray_flags;\n"
    "  uint64_t address[2];\n  uint64_t size[2];\n  uint64_t stride[2];\n};\n"
    "g_TwinTables g_twin_tables() { return g_TwinTables(g_Address(k_dispatch_address + 624UL).v); "
    "}\n";
static_assert(offsetof(shader::spirv::DispatchBlock, twin_tables) == 624);

// `@` is the name of the hit object's struct, `$0` the name of its first member, and so on.
constexpr char kSearch[] =
    "@ g_search(k_Descriptor scene, uint flags, uint mask, uint contribution, uint multiplier, "
    "uint miss, vec3 origin, float t_min, vec3 direction, float t_max) {\n"
    "  @ hit = g_no_hit;\n"
    "  hit.$state = 2u;\n"
    "  hit.$flags = flags & 0x7FFu;\n"
    "  hit.$origin = origin;\n"
    "  hit.$t_min = t_min;\n"
    "  hit.$direction = direction;\n"
    "  hit.$t = t_max;\n"
    "  hit.$bound = 1u;\n"
    "  hit.$record = miss & 0xFFFFu;\n"
    "  uint driver_flags = hit.$flags | g_twin_tables().ray_flags;\n"
    "  uint64_t top;\n"
    "  if (g_micromaps_allowed != 0u) top = g_micromap_top_level(scene, driver_flags);\n"
    "  else top = g_top_level(scene);\n"
    // A ray that Vulkan does not allow is a miss.
    "  if (any(isnan(origin)) || any(isinf(origin)) || any(isnan(direction)) || "
    "any(isinf(direction)) || !(t_min <= t_max)) return hit;\n"
    "  g_TwinTables tables = g_twin_tables();\n"
    "  uint first = tables.first;\n"
    "  uint last = tables.last_hit;\n"
    "  rayQueryEXT q;\n"
    "  rayQueryInitializeEXT(q, accelerationStructureEXT(top), driver_flags & 0x7FFu, "
    "mask & 0xFFu, origin, max(t_min, 0.0), direction, t_max);\n"
    "  uint kind = 0u;\n"
    "  uint attributes[8] = uint[8](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);\n"
    "  bool ended = false;\n"
    "  while (!ended && rayQueryProceedEXT(q)) {\n"
    "    uint seen = 2u;\n"
    "    if (g_micromaps_allowed != 0u) {\n"
    "      seen = g_query_opacity(q, hit.$flags);\n"
    "      if (seen == 0u) continue;\n"
    "      if (seen == 1u && rayQueryGetIntersectionTypeEXT(q, false) == 0u) {\n"
    "        rayQueryConfirmIntersectionEXT(q);\n"
    "        ended = (flags & 4u) != 0u;\n"
    "        continue;\n"
    "      }\n"
    "    }\n"
    "    g_twin.hit = hit;\n"
    "    g_twin.hit.$state = 1u;\n"
    "    g_candidate(q, g_twin.hit, contribution, multiplier);\n"
    "    uint record = first + 3u * min(g_twin.hit.$record, last);\n"
    "    if (rayQueryGetIntersectionTypeEXT(q, false) == 0u) {\n"
    "      vec2 at = rayQueryGetIntersectionBarycentricsEXT(q, false);\n"
    "      g_twin.hit.$t = rayQueryGetIntersectionTEXT(q, false);\n"
    "      g_twin.hit.$kind = rayQueryGetIntersectionFrontFaceEXT(q, false) ? 254u : 255u;\n"
    "      g_twin.hit.$attributes[0] = floatBitsToUint(at.x);\n"
    "      g_twin.hit.$attributes[1] = floatBitsToUint(at.y);\n"
    "      uvec2 table = "
    "g_position_table($of_candidate);\n"
    "      g_twin.hit.$attributes[6] = table.x;\n"
    "      g_twin.hit.$attributes[7] = table.y;\n"
    "      g_twin.control = 0u;\n"
    "      executeCallableEXT(record, $location);\n"
    "      if ((g_twin.control & 1u) == 0u) {\n"
    "        rayQueryConfirmIntersectionEXT(q);\n"
    "        ended = (g_twin.control & 2u) != 0u || (flags & 4u) != 0u;\n"
    "      }\n"
    "    } else {\n"
    "      if (rayQueryGetIntersectionTypeEXT(q, true) != 0u) {\n"
    "        g_twin.hit.$t = rayQueryGetIntersectionTEXT(q, true);\n"
    "      }\n"
    "      g_twin.control = seen == 1u || rayQueryGetIntersectionCandidateAABBOpaqueEXT(q) ? 8u "
    "          : 0u;\n"
    "      executeCallableEXT(record + 1u, $location);\n"
    "      if ((g_twin.control & 4u) != 0u) {\n"
    "        rayQueryGenerateIntersectionEXT(q, g_twin.hit.$t);\n"
    "        kind = g_twin.hit.$kind;\n"
    "        attributes = g_twin.hit.$attributes;\n"
    "        ended = (g_twin.control & 2u) != 0u;\n"
    "      }\n"
    "    }\n"
    "  }\n"
    "  uint type = rayQueryGetIntersectionTypeEXT(q, true);\n"
    "  if (type == 0u) return hit;\n"
    "  hit.$state = 1u;\n"
    "  g_committed(q, hit, contribution, multiplier);\n"
    "  hit.$t = rayQueryGetIntersectionTEXT(q, true);\n"
    "  if (type == 1u) {\n"
    "    vec2 at = rayQueryGetIntersectionBarycentricsEXT(q, true);\n"
    "    kind = rayQueryGetIntersectionFrontFaceEXT(q, true) ? 254u : 255u;\n"
    "    uvec2 table = "
    "g_position_table($of_hit);\n"
    "    attributes = uint[8](floatBitsToUint(at.x), floatBitsToUint(at.y), 0u, 0u, 0u, 0u, "
    "table.x, table.y);\n"
    "  }\n"
    "  hit.$kind = kind;\n"
    "  hit.$attributes = attributes;\n"
    "  return hit;\n"
    "}\n";

// What a hit object has of a candidate (# is false) or of the committed hit (true).
constexpr char kInstance[] =
    "void $name(rayQueryEXT q, inout @ hit, uint contribution, uint multiplier) {\n"
    "  g_InstanceEntry entry = g_InstanceEntry(k_dispatch.instances + "
    "uint64_t(rayQueryGetIntersectionInstanceCustomIndexEXT(q, #)) * 32UL);\n"
    "  uint geometry = uint(rayQueryGetIntersectionGeometryIndexEXT(q, #));\n"
    "  hit.$instance = entry.instance_index;\n"
    "  hit.$id = entry.instance_id;\n"
    "  hit.$geometry = geometry;\n"
    "  hit.$primitive = g_remapped(entry.primitive_remap, geometry, "
    "uint(rayQueryGetIntersectionPrimitiveIndexEXT(q, #)));\n"
    "  hit.$record = (contribution & 15u) + (multiplier & 15u) * geometry + "
    "uint(rayQueryGetIntersectionInstanceShaderBindingTableRecordOffsetEXT(q, #));\n"
    "  mat4x3 m = rayQueryGetIntersectionObjectToWorldEXT(q, #);\n"
    "  for (int r = 0; r < 3; ++r) hit.$to_world.r[r] = vec4(m[0][r], m[1][r], m[2][r], m[3][r]);\n"
    "  m = rayQueryGetIntersectionWorldToObjectEXT(q, #);\n"
    "  for (int r = 0; r < 3; ++r) hit.$to_object.r[r] = vec4(m[0][r], m[1][r], m[2][r], "
    "m[3][r]);\n"
    "}\n";

constexpr char kRecordConstant[] =
    "uint g_record_constant(@ hit, uint offset) {\n"
    "  if (hit.$bound == 0u) return 0u;\n"
    "  g_TwinTables tables = g_twin_tables();\n"
    "  int which = hit.$state == 1u ? 0 : 1;\n"
    "  if (offset == 0xFFFFFFFFu) {\n"
    "    uint last = which == 0 ? tables.last_hit : tables.last_miss;\n"
    "    bool there = tables.size[which] != 0UL && (tables.stride[which] == 0UL || hit.$record < "
    "last);\n"
    "    if (!there) g_Status(k_dispatch.status).reordered = (hit.$record << 1 | uint(which)) + "
    "1u;\n"
    "    return 0u;\n"
    "  }\n"
    "  uint64_t at = uint64_t(hit.$record) * tables.stride[which] + 32UL + uint64_t(offset);\n"
    "  if (at + 4UL > tables.size[which] || (offset & 3u) != 0u) return 0u;\n"
    "  return g_Word(tables.address[which] + at).v;\n"
    "}\n";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string GlslEmitter::hit_type() {
  Type hit;
  hit.kind = TypeKind::kStruct;
  hit.structure = module_.hit_object;
  return type(&hit);
}

std::string GlslEmitter::hit_member(uint32_t index) {
  hit_type();
  return "." + field(module_.hit_object, index);
}

// With the names of the hit object's members in place of those in the text.
std::string GlslEmitter::with_hit(std::string text) {
  const std::pair<const char*, uint32_t> members[] = {{"$state", kHitState},
                                                      {"$flags", kHitRayFlags},
                                                      {"$origin", kHitOrigin},
                                                      {"$t_min", kHitTMin},
                                                      {"$direction", kHitDirection},
                                                      {"$instance", kHitInstanceIndex},
                                                      {"$id", kHitInstanceId},
                                                      {"$geometry", kHitGeometryIndex},
                                                      {"$primitive", kHitPrimitiveIndex},
                                                      {"$kind", kHitHitKind},
                                                      {"$bound", kHitIsBound},
                                                      {"$record", kHitRecord},
                                                      {"$attributes", kHitAttributes},
                                                      {"$to_world", kHitObjectToWorld},
                                                      {"$to_object", kHitWorldToObject},
                                                      {"$t", kHitT}};
  replace_all(text, "@", hit_type());
  for (const auto& [from, index] : members) {
    replace_all(text, from, field(module_.hit_object, index));
  }
  return text;
}

// The data that twins get.
void GlslEmitter::declare_twin_data() {
  if (!made_.insert("g_Twin").second) return;
  constants_ += "layout(constant_id = " + std::to_string(shader_.constants.size()) +
                ") const uint g_twin_words = 16384u;\n";  // glslang compares indices with it
  shader_.constants.push_back(kTwinPayloadConstant);
  const std::string hit = hit_type();
  declarations_ += "struct g_Twin { uint depths; uint control; uint type; uint bytes; " + hit +
                   " hit; uint payload[g_twin_words]; };\n";
}

// The data that this shader passes to twins.
void GlslEmitter::declare_twin() {
  declare_twin_data();
  if (!made_.insert("g_twin").second) return;
  twin_location_ = std::to_string(next_location_++);
  declarations_ += "layout(location = " + twin_location_ + ") callableDataEXT g_Twin g_twin;\n";
  declare_address();
  generated("g_TwinTables", kTables);
}

// A function that writes a payload into the words of the data, or reads it from there. A payload
// that does not fit is none that a shader of the pipeline takes.
std::string GlslEmitter::twin_payload(const std::string& data, const Type* t, bool store) {
  auto& name = generated_[(store ? "pack " : "unpack ") + data + type(t)];
  if (!name.empty()) return name;
  name = (store ? "g_pack_" : "g_unpack_") + std::to_string(generated_.size());
  const std::string function = name;
  std::string text = (store ? "void " : type(t) + " ") + function + "(" +
                     (store ? type(t) + " value" : std::string()) + ") {\n" +
                     (store ? "" : "  " + type(t) + " value = " + zero(t) + ";\n") +
                     "  if (g_twin_words >= " + glsl::number(glsl::words(t)) + ") {\n";
  text += words_of(t, data + ".payload", store);
  helpers_ += text + "  }\n" + (store ? "" : "  return value;\n") + "}\n";
  return function;
}

std::string GlslEmitter::search_function() {
  declare_twin();
  declare_top_level();
  declare_instance_entry();
  position_table();
  micromaps_allowed();
  declare_micromap_top_level();
  declare_query_opacity();
  if (made_.insert("g_search").second) {
    made_.insert("g_Query");  // the extension
    Type hit;
    hit.kind = TypeKind::kStruct;
    hit.structure = module_.hit_object;
    declarations_ += "const " + hit_type() + " g_no_hit = " + zero(&hit) + ";\n";
    for (const bool committed : {false, true}) {
      std::string text = kInstance;
      replace_all(text, "$name", committed ? "g_committed" : "g_candidate");
      replace_all(text, "#", committed ? "true" : "false");
      helpers_ += with_hit(std::move(text));
    }
    std::string text = kSearch;
    replace_all(text, "$location", twin_location_);
    replace_all(text, "$of_candidate", query_table_arguments(false));
    replace_all(text, "$of_hit", query_table_arguments(true));
    helpers_ += with_hit(std::move(text));
  }
  return "g_search";
}

// HitObject::TraceRay.
std::string GlslEmitter::trace_hit_function(const Type* payload) {
  auto& name = generated_["trace hit " + type(payload)];
  if (!name.empty()) return name;
  name = "g_trace_hit_" + std::to_string(generated_.size());
  const std::string function = name;
  const std::string search = search_function();
  const std::string pack = twin_payload("g_twin", payload, true);
  const std::string unpack = twin_payload("g_twin", payload, false);
  Type desc;
  desc.kind = TypeKind::kStruct;
  desc.structure = module_.ray_desc;
  const std::string ray = type(&desc);
  const auto member = [&](uint32_t i) { return "ray." + field(module_.ray_desc, i); };
  const std::string of_ray = member(0) + ", " + member(1) + ", " + member(2) + ", " + member(3);
  constant(kMaxTraceDepthConstant, "g_max_trace_depth");
  declare_remove_device();
  const std::string counted = count(shader::spirv::kTraceRayCalls);
  const bool checked = module_.check_access;
  helpers_ +=
      hit_type() + " " + function +
      "(k_Descriptor scene, uint flags, uint mask, uint contribution, uint multiplier, uint "
      "miss, " +
      ray + " ray, inout " + type(payload) + " payload" +
      (checked ? ", uint site, bool unknown" : "") + ") {\n" +
      trace_checks(of_ray, "g_twin", payload) +
      "  if ((g_depths & 0xFFFFu) >= g_max_trace_depth) {\n"
      "    g_remove_device(0u);\n"
      "    return g_no_hit;\n"
      "  }\n  " +
      counted + "\n  g_twin.depths = g_depths + 1u;\n  " + pack + "(payload);\n  " + hit_type() +
      " hit = " + search + "(scene, flags, mask, contribution, multiplier, miss, " + of_ray +
      ");\n  payload = " + unpack + "();\n  return hit;\n}\n";
  return function;
}

// HitObject::Invoke.
std::string GlslEmitter::invoke_function(const Type* payload) {
  auto& name = generated_["invoke " + type(payload)];
  if (!name.empty()) return name;
  name = "g_invoke_" + std::to_string(generated_.size());
  const std::string function = name;
  declare_twin();
  const std::string pack = twin_payload("g_twin", payload, true);
  const std::string unpack = twin_payload("g_twin", payload, false);
  constant(kMaxTraceDepthConstant, "g_max_trace_depth");
  declare_remove_device();
  const bool checked = module_.check_access;
  helpers_ +=
      with_hit("void " + function + "(@ hit, inout " + type(payload) + " payload" +
               (checked ? ", uint site) {\n  k_check_depth(g_depths & 0xFFFFu, site);\n" +
                              header("g_twin", payload)
                        : std::string(") {\n")) +
               "  if ((g_depths & 0xFFFFu) >= g_max_trace_depth) {\n"
               "    g_remove_device(0u);\n"
               "    return;\n"
               "  }\n"
               "  bool is_hit = hit.$state == 1u;\n"
               "  if (hit.$bound == 0u || (is_hit && (hit.$flags & 8u) != 0u)) return;\n"
               "  g_TwinTables tables = g_twin_tables();\n"
               "  uint index = is_hit ? 3u * min(hit.$record, tables.last_hit) + 2u\n"
               "      : 3u * (tables.last_hit + 1u) + min(hit.$record, tables.last_miss);\n"
               "  g_twin.depths = g_depths + 1u;\n"
               "  g_twin.control = 0u;\n"
               "  g_twin.hit = hit;\n  " +
               pack + "(payload);\n  executeCallableEXT(tables.first + index, " + twin_location_ +
               ");\n" + (checked ? "  if (g_twin.type != 0u) k_ran_nothing(1u);\n" : "") +
               "  payload = " + unpack + "();\n}\n");
  return function;
}

// TraceRay of a twin.
std::string GlslEmitter::twin_trace_function(const Type* payload) {
  auto& name = generated_["trace " + type(payload)];
  if (!name.empty()) return name;
  name = "g_trace_" + std::to_string(generated_.size());
  const std::string function = name;
  const std::string trace = trace_hit_function(payload);
  const std::string invoke = invoke_function(payload);
  Type desc;
  desc.kind = TypeKind::kStruct;
  desc.structure = module_.ray_desc;
  const bool checked = module_.check_access;
  helpers_ += "void " + function +
              "(k_Descriptor scene, uint flags, uint mask, uint contribution, uint multiplier, "
              "uint miss, " +
              type(&desc) + " ray, inout " + type(payload) + " payload" +
              (checked ? ", uint site, bool unknown" : "") +
              ") {\n  if ((flags & 8u) != 0u && (flags & 5u) != 0u) " +
              count(shader::spirv::kVisibilityRays) + "\n  " + hit_type() + " hit = " + trace +
              "(scene, flags, mask, contribution, multiplier, miss, ray, payload" +
              (checked ? ", site, unknown" : "") + ");\n  " + invoke + "(hit, payload" +
              (checked ? ", site" : "") + ");\n}\n";
  return function;
}

void GlslEmitter::invoke(const Stmt& stmt) {
  const std::string function = invoke_function(stmt.place->type);
  line(function + "(" + value(stmt.operands[0]) + ", " + path(stmt.place).text +
       (module_.check_access ? ", " + site(stmt.location) : "") + ");");
}

// Attributes as another struct, or as the words of a hit object.
std::string GlslEmitter::same_bytes(const Expr& expr) {
  const Type* from = expr.operands[0]->type;
  const Type* to = expr.type;
  auto& name = generated_["same bytes " + type(from) + " " + type(to)];
  if (name.empty()) {
    name = "g_same_bytes_" + std::to_string(generated_.size());
    const std::string function = name;
    const uint32_t count = std::max({glsl::words(from), glsl::words(to), 1u});
    const std::string words = "words[" + std::to_string(count) + "]";
    std::string text = type(to) + " " + function + "(" + type(from) + " from) {\n  uint " + words +
                       ";\n  for (uint i = 0u; i < " + glsl::number(count) +
                       "; ++i) words[i] = 0u;\n  " + type(from) + " value = from;\n";
    text += words_of(from, "words", true);
    text += "  {\n  " + type(to) + " value = " + zero(to) + ";\n";
    text += words_of(to, "words", false);
    helpers_ += text + "  return value;\n  }\n}\n";
    return function + "(" + value(expr.operands[0]) + ")";
  }
  return name + "(" + value(expr.operands[0]) + ")";
}

std::string GlslEmitter::record_constant(const Expr& expr) {
  const Expr* offset = expr.operands[1];
  const bool reorders = offset->kind == ExprKind::kLiteral &&
                        static_cast<uint32_t>(offset->literal[0]) == shader::kReorderedRecord;
  if (reorders && !module_.check_access) return "0u";
  // No debugger stops in a driver's shaders.
  if (is_literal(offset, shader::kDebuggingEnabled)) return "0u";
  declare_instance_entry();
  declare_status();
  declare_address();
  generated("g_TwinTables", kTables);
  hit_type();
  return call(generated("g_record_constant", with_hit(kRecordConstant)), expr.operands);
}

}  // namespace kaamos::hlsl
