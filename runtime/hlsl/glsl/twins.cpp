// SPDX-License-Identifier: MIT
//
// Twins: hit and miss shaders as callable shaders, which functions of HitObject run
// (hit_objects.cpp). What a hit or miss shader gets from the driver, its twin reads in its data.
#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/ir/hit_object.h"

namespace kaamos::hlsl {

using namespace ir;

// Bits of TwinControl.
static_assert(shader::spirv::kTwinIgnored == 1 && shader::spirv::kTwinEnded == 2 &&
              shader::spirv::kTwinAccepted == 4 && shader::spirv::kTwinOpaque == 8);

// What a twin reads of its hit.
std::string GlslEmitter::twin_value(uint32_t index) {
  return "g_in.hit" + hit_member(index);
}

// ReportHit in the twin of an intersection shader calls the twin of the any-hit shader.
std::string GlslEmitter::twin_report_function(const Type* attributes) {
  auto& name = generated_["report " + type(attributes)];
  if (!name.empty()) return name;
  name = "g_report_" + std::to_string(generated_.size());
  const std::string function = name;
  declare_twin();
  std::string store = words_of(attributes, "g_twin.hit.$attributes", true);
  helpers_ += with_hit(
      "bool " + function + "(float t, uint kind, " + type(attributes) +
      " value) {\n"
      "  if (!(t >= g_in.hit.$t_min && t <= g_t_reported)) return false;\n"
      "  g_twin.depths = g_in.depths;\n"
      "  g_twin.control = 0u;\n"
      "  g_twin.type = g_in.type;\n"
      "  g_twin.bytes = g_in.bytes;\n"
      "  g_twin.hit = g_in.hit;\n"
      "  g_twin.hit.$t = t;\n"
      "  g_twin.hit.$kind = kind;\n"
      "  for (uint i = 0u; i < 8u; ++i) g_twin.hit.$attributes[i] = 0u;\n" +
      store +
      "  if ((g_in.control & 8u) == 0u) {\n"
      "    for (uint i = 0u; i < g_twin_words; ++i) g_twin.payload[i] = g_in.payload[i];\n"
      "    g_TwinTables tables = g_twin_tables();\n"
      "    executeCallableEXT(tables.first + 3u * min(g_in.hit.$record, tables.last_hit), " +
      twin_location_ +
      ");\n"
      "    for (uint i = 0u; i < g_twin_words; ++i) g_in.payload[i] = g_twin.payload[i];\n"
      "    if ((g_twin.control & 1u) != 0u) return false;\n"
      "  }\n"
      "  g_t_reported = t;\n"
      "  g_in.hit.$t = t;\n"
      "  g_in.hit.$kind = kind;\n"
      "  g_in.hit.$attributes = g_twin.hit.$attributes;\n"
      "  g_in.control |= 4u;\n"
      "  if ((g_twin.control & 2u) != 0u || (g_in.hit.$flags & 4u) != 0u) {\n"
      "    g_in.control |= 2u;\n"
      "    g_ended = 3u;\n"
      "  }\n"
      "  return true;\n"
      "}\n");
  return function;
}

// At the start of a twin's main.
void GlslEmitter::begin_twin() {
  declare_twin_data();
  declarations_ += "layout(location = 0) callableDataInEXT g_Twin g_in;\n";
  line("g_depths = g_in.depths;");
  if (entry_.payload == nullptr) return;
  if (module_.check_access) {
    line("if (g_in.type != " + glsl::number(type_hash(entry_.payload)) + ") k_tell(13u, " +
         site(entry_.function->location) + ", 0u, 0u, uint64_t(g_in.bytes), " +
         std::to_string(4 * glsl::words(entry_.payload)) + "UL, 0UL, 0UL);");
    if (entry_.stage != kStageAnyHit) line("g_in.type = 0u;");  // tells the caller that this ran
  }
  line(type(entry_.payload) + " g_argument = " + twin_payload("g_in", entry_.payload, false) +
       "();");
}

void GlslEmitter::end_twin() {
  if (entry_.payload != nullptr) {
    line(twin_payload("g_in", entry_.payload, true) + "(g_argument);");
  }
  if (entry_.stage == kStageAnyHit && entry_.function->may_end_shader) {
    line("g_in.control |= g_ended;");  // 1 and 2 are the bits, too
  }
}

std::string GlslEmitter::twin_attributes(const Type* t) {
  auto& name = generated_["twin attributes " + type(t)];
  if (name.empty()) {
    name = "g_attributes_" + std::to_string(generated_.size());
    const std::string function = name;
    helpers_ += type(t) + " " + function + "() {\n  " + type(t) + " value = " + zero(t) + ";\n" +
                words_of(t, "g_in.hit" + hit_member(kHitAttributes), false) +
                "  return value;\n}\n";
    return function + "()";
  }
  return name + "()";
}

std::string GlslEmitter::twin_transform(bool to_world, bool transposed, const Type* t) {
  const std::string rows = twin_value(to_world ? kHitObjectToWorld : kHitWorldToObject);
  if (!transposed) return rows;
  std::string text = type(t) + "(vec3[4](";
  for (int c = 0; c < 4; ++c) {
    const std::string part = "." + glsl::component(c);
    text += std::string(c == 0 ? "" : ", ") + "vec3(" + rows + ".r[0]" + part + ", " + rows +
            ".r[1]" + part + ", " + rows + ".r[2]" + part + ")";
  }
  return text + "))";
}

std::string GlslEmitter::twin_object_ray(bool origin) {
  const std::string name = origin ? "g_object_ray_origin" : "g_object_ray_direction";
  std::string text = "vec3 " + name + "() {\n  vec3 v = g_in.hit." +
                     (origin ? "$origin" : "$direction") + ";\n  vec3 o;\n" +
                     "  for (int i = 0; i < 3; ++i) {\n"
                     "    vec4 r = g_in.hit.$to_object.r[i];\n"
                     "    o[i] = ((r.x * v.x + r.y * v.y) + r.z * v.z) + r.w * " +
                     (origin ? "1.0" : "0.0") + ";\n  }\n  return o;\n}\n";
  return generated(name, with_hit(std::move(text))) + "()";
}

std::string GlslEmitter::twin_system_value(const Expr& expr) {
  switch (expr.system_value) {
    case SystemValue::kWorldRayOrigin:
      return twin_value(kHitOrigin);
    case SystemValue::kWorldRayDirection:
      return twin_value(kHitDirection);
    case SystemValue::kRayTMin:
      return twin_value(kHitTMin);
    case SystemValue::kRayTCurrent:
      return entry_.stage == kStageIntersection ? "g_t_reported" : twin_value(kHitT);
    case SystemValue::kRayFlags:
      return twin_value(kHitRayFlags);
    default:
      break;
  }
  if (entry_.stage == kStageMiss) return "";
  switch (expr.system_value) {
    case SystemValue::kInstanceIndex:
      return twin_value(kHitInstanceIndex);
    case SystemValue::kInstanceId:
      return twin_value(kHitInstanceId);
    case SystemValue::kGeometryIndex:
      return twin_value(kHitGeometryIndex);
    case SystemValue::kPrimitiveIndex:
      return twin_value(kHitPrimitiveIndex);
    case SystemValue::kObjectRayOrigin:
      return twin_object_ray(true);
    case SystemValue::kObjectRayDirection:
      return twin_object_ray(false);
    case SystemValue::kObjectToWorld3x4:
      return twin_transform(true, false, expr.type);
    case SystemValue::kObjectToWorld4x3:
      return twin_transform(true, true, expr.type);
    case SystemValue::kWorldToObject3x4:
      return twin_transform(false, false, expr.type);
    case SystemValue::kWorldToObject4x3:
      return twin_transform(false, true, expr.type);
    case SystemValue::kHitKind:
      return entry_.stage == kStageIntersection ? "" : twin_value(kHitHitKind);
    case SystemValue::kPositionTable:
      return generated("g_twin_position_table",
                       with_hit("uvec2 g_twin_position_table() {\n"
                                "  return g_in.hit.$kind >= 254u ? uvec2(g_in.hit.$attributes[6], "
                                "g_in.hit.$attributes[7]) : uvec2(0u);\n}\n")) +
             "()";
    default:
      return "";
  }
}

}  // namespace kaamos::hlsl
