// SPDX-License-Identifier: MIT
//
// RayQuery. Each rayQueryEXT is accompanied by what GLSL does not return, or not at any time: the
// ray, and whether the query is running and has a candidate. The driver is never asked for a value
// that does not exist.
#include "kaamos/shader/query_permissions.h"
#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

// Bits of g_Query::state.
constexpr char kState[] =
    "const uint g_query_runs = 1u;\n"
    "const uint g_query_has_candidate = 2u;\n"
    "const uint g_query_begun = 4u;\n"
    "const uint g_query_opaque = 8u;\n"  // the candidate is, though the driver does not know
    "struct g_Query { uint state; uint flags; float t_min; float t_max; vec3 origin; "
    "vec3 direction; };\n";

constexpr char kProceed[] =
    "bool g_query_proceed(rayQueryEXT q, inout g_Query s) {\n"
    "  bool more = (s.state & g_query_runs) != 0u && rayQueryProceedEXT(q);\n"
    "  s.state = more ? 7u : s.state & g_query_begun;\n"
    "  return more;\n"
    "}\n";

// Where the shader decides the opacity, it does what the driver does with transparent and opaque
// candidates: it passes them by and commits them.
constexpr char kProceedMicromaps[] =
    "bool g_query_proceed_micromaps(rayQueryEXT q, inout g_Query s) {\n"
    "  while ((s.state & g_query_runs) != 0u && rayQueryProceedEXT(q)) {\n"
    "    uint seen = g_query_opacity(q, s.flags);\n"
    "    if (seen == 0u) continue;\n"
    "    if (seen == 1u && rayQueryGetIntersectionTypeEXT(q, false) == 0u) {\n"
    "      rayQueryConfirmIntersectionEXT(q);\n"
    "      if ((s.flags & 4u) != 0u) s.state &= ~g_query_runs;\n"
    "      continue;\n"
    "    }\n"
    "    s.state = seen == 1u ? 7u | g_query_opaque : 7u;\n"
    "    return true;\n"
    "  }\n"
    "  s.state &= g_query_begun;\n"
    "  return false;\n"
    "}\n";

constexpr char kAbort[] =
    "void g_query_abort(rayQueryEXT q, inout g_Query s) { s.state &= ~g_query_runs; }\n";

constexpr char kCommitTriangle[] =
    "void g_query_commit_triangle(rayQueryEXT q, inout g_Query s) {\n"
    "  if ((s.state & g_query_has_candidate) == 0u) return;\n"
    "  if (rayQueryGetIntersectionTypeEXT(q, false) != 0u) return;\n"
    "  rayQueryConfirmIntersectionEXT(q);\n"
    "  if ((s.flags & 4u) != 0u) s.state &= ~g_query_runs;\n"
    "}\n";

constexpr char kCommitProcedural[] =
    "void g_query_commit_procedural(rayQueryEXT q, inout g_Query s, float t) {\n"
    "  if ((s.state & g_query_has_candidate) == 0u) return;\n"
    "  if (rayQueryGetIntersectionTypeEXT(q, false) != 1u) return;\n"
    "  float t_max = rayQueryGetIntersectionTypeEXT(q, true) != 0u\n"
    "      ? rayQueryGetIntersectionTEXT(q, true) : s.t_max;\n"
    "  if (!(t >= s.t_min && t <= t_max)) return;\n"
    "  rayQueryGenerateIntersectionEXT(q, t);\n"
    "  if ((s.flags & 4u) != 0u) s.state &= ~g_query_runs;\n"
    "}\n";

// For checked libraries; `type` is the only one allowed, unless it is 0xFFFFFFFF.
constexpr char kCheckCandidate[] =
    "void g_check_candidate(rayQueryEXT q, g_Query s, uint type, uint what, uint site) {\n"
    "  bool has = (s.state & g_query_has_candidate) != 0u;\n"
    "  uint found = has ? rayQueryGetIntersectionTypeEXT(q, false) : 0u;\n"
    "  if (has && (type == 0xFFFFFFFFu || type == found)) return;\n"
    "  k_tell(14u, site, 0u, 0u, uint64_t(what), has ? 1UL : 0UL, uint64_t(found), "
    "uint64_t(type));\n"
    "}\n";
constexpr char kCheckCommitted[] =
    "void g_check_committed(rayQueryEXT q, g_Query s, uint type, uint what, uint site) {\n"
    "  bool begun = (s.state & g_query_begun) != 0u;\n"
    "  uint found = begun ? rayQueryGetIntersectionTypeEXT(q, true) : 0u;\n"
    "  if (found != 0u && (type == 0xFFFFFFFFu || type == found)) return;\n"
    "  k_tell(15u, site, 0u, 0u, uint64_t(what), uint64_t(found), uint64_t(type), 0UL);\n"
    "}\n";
constexpr char kCheckCommit[] =
    "void g_check_commit(rayQueryEXT q, g_Query s, float t, uint site) {\n"
    "  if ((s.state & g_query_has_candidate) == 0u) return;\n"
    "  float t_max = rayQueryGetIntersectionTypeEXT(q, true) != 0u\n"
    "      ? rayQueryGetIntersectionTEXT(q, true) : s.t_max;\n"
    "  if (t >= s.t_min && t <= t_max) return;\n"
    "  k_tell(16u, site, 0u, 0u, uint64_t(floatBitsToUint(t)), uint64_t(floatBitsToUint(s.t_min)), "
    "uint64_t(floatBitsToUint(t_max)), 0UL);\n"
    "}\n";

// Whether a RayQuery uses micromaps.
bool allows_micromaps(const Expr* object) {
  return (object->type->ray_query_flags & shader::kRayQueryAllowsMicromaps) != 0;
}

}  // namespace

void GlslEmitter::declare_query() {
  if (made_.insert("g_Query").second) {
    structs_ += kState;
  }
}

bool GlslEmitter::uses_queries() const {
  return made_.count("g_Query") != 0;
}

// The object and its accompanying state, as arguments.
std::string GlslEmitter::query_arguments(const Expr* object) {
  const std::string name = path(object).text;
  return name + ", g_s_" + name;
}

std::string GlslEmitter::query_trace_function(bool micromaps) {
  if (micromaps) {
    declare_micromap_top_level();
  } else {
    declare_top_level();
  }
  Type desc;
  desc.kind = TypeKind::kStruct;
  desc.structure = module_.ray_desc;
  const std::string ray = type(&desc);
  const auto member = [&](uint32_t i) { return "ray." + field(module_.ray_desc, i); };
  const std::string origin = member(0);
  const std::string t_min = member(1);
  const std::string direction = member(2);
  const std::string t_max = member(3);
  // A ray that Vulkan does not allow is a miss.
  const std::string name = micromaps ? "g_query_trace_micromaps" : "g_query_trace";
  return generated(
      name, "void " + name +
                "(rayQueryEXT q, inout g_Query s, k_Descriptor scene, uint flags, uint "
                "mask, " +
                ray + " ray" +
                (module_.check_access ? ", uint site, bool unknown) {\n  k_reached_inline(site, "
                                        "unknown, scene, flags, mask);\n  k_check_ray(" +
                                            origin + ", " + t_min + ", " + direction + ", " +
                                            t_max + ", flags, true, site);\n"
                                      : std::string(") {\n")) +
                "  s = g_Query(5u, flags & 0x7FFu, " + t_min + ", " + t_max + ", " + origin + ", " +
                direction +
                ");\n"
                "  uint driver_flags = flags & 0x7FFu;\n"
                "  uint64_t top = " +
                (micromaps ? "g_micromap_top_level(scene, driver_flags)" : "g_top_level(scene)") +
                ";\n"
                "  vec3 o = " +
                origin + ";\n  vec3 d = " + direction + ";\n  float t0 = " + t_min +
                ";\n  float t1 = " + t_max +
                ";\n"
                "  if (any(isnan(o)) || any(isinf(o)) || any(isnan(d)) || any(isinf(d)) || "
                "!(t0 <= t1)) {\n"
                "    top = k_dispatch.empty_top_level;\n"
                "    o = vec3(0.0);\n    d = vec3(0.0, 0.0, 1.0);\n    t0 = 0.0;\n    t1 = 1.0;\n"
                "  }\n"
                "  rayQueryInitializeEXT(q, accelerationStructureEXT(top), driver_flags & 0x7FFu, "
                "mask & 0xFFu, o, max(t0, 0.0), d, t1);\n"
                "}\n");
}

void GlslEmitter::query(const Stmt& stmt) {
  declare_query();
  const std::string object = query_arguments(stmt.place);
  switch (stmt.query) {
    case QueryOp::kTrace: {
      std::string text = query_trace_function(allows_micromaps(stmt.place)) + "(" + object;
      for (const Expr* operand : stmt.operands) {
        text += ", " + value(operand);
      }
      if (module_.check_access) {
        text += ", " + site(stmt.location) + (is_unknown(module_, stmt) ? ", true" : ", false");
      }
      return line(text + ");");
    }
    case QueryOp::kProceed: {
      const bool micromaps = allows_micromaps(stmt.place);
      if (micromaps) declare_query_opacity();
      const std::string proceed = micromaps
                                      ? generated("g_query_proceed_micromaps", kProceedMicromaps)
                                      : generated("g_query_proceed", kProceed);
      return line((stmt.result != nullptr ? variable(stmt.result) + " = " : "") + proceed + "(" +
                  object + ");");
    }
    case QueryOp::kAbort:
      return line(generated("g_query_abort", kAbort) + "(" + object + ");");
    case QueryOp::kCommitTriangle:
      if (module_.check_access) {
        line(generated("g_check_candidate", kCheckCandidate) + "(" + object +
             ", 0u, 0xFFFFFFFFu, " + site(stmt.location) + ");");
      }
      return line(generated("g_query_commit_triangle", kCommitTriangle) + "(" + object + ");");
    case QueryOp::kCommitProcedural:
      if (module_.check_access) {
        line(generated("g_check_candidate", kCheckCandidate) + "(" + object +
             ", 1u, 0xFFFFFFFFu, " + site(stmt.location) + ");");
        line(generated("g_check_commit", kCheckCommit) + "(" + object + ", " +
             value(stmt.operands[0]) + ", " + site(stmt.location) + ");");
      }
      return line(generated("g_query_commit_procedural", kCommitProcedural) + "(" + object + ", " +
                  value(stmt.operands[0]) + ");");
  }
}

// The statement that returns the value, if there is a hit.
std::string GlslEmitter::query_result(const Expr& expr) {
  const std::string of = expr.index == 1 ? "(q, true)" : "(q, false)";
  const auto get = [&](const char* what) {
    return std::string("rayQueryGetIntersection") + what + "EXT" + of;
  };
  const auto entry = [&] {
    declare_instance_entry();
    return "g_InstanceEntry(k_dispatch.instances + uint64_t(" + get("InstanceCustomIndex") +
           ") * 32UL)";
  };
  const auto transform = [&](const char* which, bool transposed) {
    const std::string result = type(expr.type);
    std::string text = "mat4x3 m = " + get(which) + "; return " + result;
    if (transposed) {
      return text + "(vec3[4](m[0], m[1], m[2], m[3]));";
    }
    text += "(vec4[3](";
    for (int r = 0; r < 3; ++r) {
      const std::string c = "." + glsl::component(r);
      text += std::string(r == 0 ? "" : ", ") + "vec4(m[0]" + c + ", m[1]" + c + ", m[2]" + c +
              ", m[3]" + c + ")";
    }
    return text + "));";
  };
  const auto object_ray = [&](const char* v, const char* w) {
    return "mat4x3 m = " + get("WorldToObject") + "; vec3 v = " + v +
           "; return ((m[0] * v.x + m[1] * v.y) + m[2] * v.z) + m[3] * " + w + ";";
  };
  switch (expr.query_value) {
    case QueryValue::kType:
      return "return " + get("Type") + ";";
    case QueryValue::kRayT:
      return "return " + get("T") + ";";
    case QueryValue::kInstanceIndex:
      return "return " + entry() + ".instance_index;";
    case QueryValue::kInstanceId:
      return "return " + entry() + ".instance_id;";
    case QueryValue::kInstanceContribution:
      return "return uint(" + get("InstanceShaderBindingTableRecordOffset") + ");";
    case QueryValue::kGeometryIndex:
      return "return uint(" + get("GeometryIndex") + ");";
    case QueryValue::kPrimitiveIndex: {
      const std::string at = entry();
      return "return g_remapped(" + at + ".primitive_remap, uint(" + get("GeometryIndex") +
             "), uint(" + get("PrimitiveIndex") + "));";
    }
    case QueryValue::kObjectRayOrigin:
      return object_ray("s.origin", "1.0");
    case QueryValue::kObjectRayDirection:
      return object_ray("s.direction", "0.0");
    case QueryValue::kObjectToWorld3x4:
      return transform("ObjectToWorld", false);
    case QueryValue::kObjectToWorld4x3:
      return transform("ObjectToWorld", true);
    case QueryValue::kWorldToObject3x4:
      return transform("WorldToObject", false);
    case QueryValue::kWorldToObject4x3:
      return transform("WorldToObject", true);
    case QueryValue::kBarycentrics:
      return "return " + get("Barycentrics") + ";";
    case QueryValue::kFrontFace:
      return "return " + get("FrontFace") + ";";
    case QueryValue::kProceduralNonOpaque:
      return std::string("return ") +
             (allows_micromaps(expr.operands[0]) ? "(s.state & g_query_opaque) == 0u && " : "") +
             "!rayQueryGetIntersectionCandidateAABBOpaqueEXT(q);";
    case QueryValue::kPositionTable:
      return "return " + position_table() + "(" + query_table_arguments(expr.index == 1) + ");";
    default:
      return "";
  }
}

std::string GlslEmitter::query_value(const Expr& expr) {
  declare_query();
  const std::string state = "g_s_" + path(expr.operands[0]).text;
  switch (expr.query_value) {
    case QueryValue::kRayFlags:
      return state + ".flags";
    case QueryValue::kRayTMin:
      return state + ".t_min";
    case QueryValue::kWorldRayOrigin:
      return state + ".origin";
    case QueryValue::kWorldRayDirection:
      return state + ".direction";
    default:
      break;
  }
  const bool committed = expr.index == 1;
  std::string name = std::string(committed ? "g_committed_" : "g_candidate_") +
                     std::to_string(static_cast<int>(expr.query_value));
  if (expr.query_value == QueryValue::kProceduralNonOpaque && allows_micromaps(expr.operands[0])) {
    name += "_micromaps";
  }
  std::string guard =
      committed ? "(s.state & g_query_begun) != 0u" : "(s.state & g_query_has_candidate) != 0u";
  const std::string kind =
      std::string("rayQueryGetIntersectionTypeEXT(q, ") + (committed ? "true)" : "false)");
  std::string otherwise = zero(expr.type);
  switch (expr.query_value) {
    case QueryValue::kType:
      break;
    case QueryValue::kRayT:
      if (committed) {
        otherwise = "s.t_max";
        guard += " && " + kind + " != 0u";
        break;
      }
      [[fallthrough]];
    case QueryValue::kBarycentrics:
    case QueryValue::kFrontFace:
      guard += " && " + kind + (committed ? " == 1u" : " == 0u");
      break;
    case QueryValue::kProceduralNonOpaque:
      guard += " && " + kind + " == 1u";
      break;
    default:
      if (committed) guard += " && " + kind + " != 0u";
      break;
  }
  const std::string result = query_result(expr);
  const QueryNeed need = need_of(expr);
  std::string check;
  if (module_.check_access && need.hit) {
    check = committed ? generated("g_check_committed", kCheckCommitted)
                      : generated("g_check_candidate", kCheckCandidate);
    check = "  " + check + "(q, s, " + glsl::number(need.type) + ", " +
            std::to_string(static_cast<int>(expr.query_value)) + "u, site);\n";
  }
  generated(name, type(expr.type) + " " + name + "(rayQueryEXT q, g_Query s" +
                      (check.empty() ? "" : ", uint site") + ") {\n" + check + "  if (!(" + guard +
                      ")) return " + otherwise + ";\n  " + result + "\n}\n");
  return name + "(" + query_arguments(expr.operands[0]) +
         (check.empty() ? "" : ", " + site(expr.location)) + ")";
}

}  // namespace kaamos::hlsl
