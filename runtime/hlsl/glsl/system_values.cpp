// SPDX-License-Identifier: MIT
//
// System values of ray tracing stages. If a driver's nested trace overwrites the hit builtins, they
// are copied when the shader starts (Workaround::kCopyHitBuiltins).
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

constexpr uint32_t kHitStages = kStageAnyHit | kStageClosestHit | kStageIntersection;
constexpr uint32_t kRayStages = kHitStages | kStageMiss;

}  // namespace

// Wraps a builtin of the stages with a hit in a function; `text` reads it.
std::string GlslEmitter::hit_builtin(const std::string& name, const std::string& type,
                                     const std::string& text) {
  const std::string function = "g_" + name;
  if (made_.insert(function).second) {
    declare_workarounds();
    const std::string saved = "g_saved_" + name;
    declarations_ += type + " " + saved + ";\n";
    start_ += "  if ((g_workarounds & 2u) != 0u) " + saved + " = " + text + ";\n";
    helpers_ += type + " " + function + "() { return (g_workarounds & 2u) != 0u ? " + saved +
                " : " + text + "; }\n";
  }
  return function + "()";
}

// ObjectToWorld and WorldToObject. Only the 4x3 builtins are used: glslang 12 generates invalid
// SPIR-V if both forms occur in one shader.
std::string GlslEmitter::transform(bool to_world, bool transposed, const Type* t) {
  const std::string m = hit_builtin(to_world ? "object_to_world" : "world_to_object", "mat4x3",
                                    to_world ? "gl_ObjectToWorldEXT" : "gl_WorldToObjectEXT");
  const std::string name =
      std::string(to_world ? "g_to_world_" : "g_to_object_") + (transposed ? "4x3" : "3x4");
  const std::string result = type(t);
  std::string text = result + " " + name + "() {\n  mat4x3 m = " + m + ";\n  return " + result;
  if (transposed) {
    text += "(vec3[4](m[0], m[1], m[2], m[3]));\n}\n";
  } else {
    text += "(vec4[3](";
    for (int r = 0; r < 3; ++r) {
      const std::string c = "." + glsl::component(r);
      text += std::string(r == 0 ? "" : ", ") + "vec4(m[0]" + c + ", m[1]" + c + ", m[2]" + c +
              ", m[3]" + c + ")";
    }
    text += "));\n}\n";
  }
  return generated(name, text) + "()";
}

// [DXR: RayTCurrent], depending on the stage.
std::string GlslEmitter::ray_t_current() {
  switch (entry_.stage) {
    case kStageAnyHit:
    case kStageClosestHit:
      return "gl_HitTEXT";
    case kStageIntersection:
      return reported_t();
    default:
      return "gl_RayTmaxEXT";
  }
}

std::string GlslEmitter::object_ray(bool origin) {
  hit_builtin("world_to_object", "mat4x3", "gl_WorldToObjectEXT");
  const std::string name = origin ? "g_object_ray_origin" : "g_object_ray_direction";
  // Row by row, like mul() of a 3x4 matrix and a vector.
  std::string text = "vec3 " + name + "() {\n  mat4x3 m = g_world_to_object();\n  vec3 v = " +
                     (origin ? "gl_WorldRayOriginEXT" : "gl_WorldRayDirectionEXT") +
                     ";\n  return ((m[0] * v.x + m[1] * v.y) + m[2] * v.z) + m[3] * " +
                     (origin ? "1.0" : "0.0") + ";\n}\n";
  return generated(name, text) + "()";
}

std::string GlslEmitter::system_value(const Expr& expr) {
  const bool launched = entry_.stage != kStageCompute;
  const bool ray = (entry_.stage & kRayStages) != 0;
  const bool hit = (entry_.stage & kHitStages) != 0;
  if (twin_ && expr.system_value != SystemValue::kDispatchRaysIndex &&
      expr.system_value != SystemValue::kDispatchRaysDimensions) {
    const std::string text = twin_system_value(expr);
    return text.empty() ? zero(expr.type) : text;
  }
  // The checker rejects a system value that the stage does not have, except in code that never
  // runs.
  const auto if_has = [&](bool has, const auto& text) {
    return has ? std::string(text()) : zero(expr.type);
  };
  switch (expr.system_value) {
    case SystemValue::kDispatchRaysIndex:
      return if_has(launched, [&] {
        declare_workarounds();
        return generated("g_dispatch_rays_index",
                         "uvec3 g_dispatch_rays_index() {\n"
                         "  uvec3 id = gl_LaunchIDEXT;\n"
                         "  if ((g_workarounds & 8u) != 0u) {\n"
                         "    uint upper = (k_dispatch.rows + 1u) / 2u;\n"
                         "    id.y = id.y < upper ? 2u * id.y : 2u * (id.y - upper) + 1u;\n"
                         "  }\n"
                         "  return id + uvec3(k_dispatch.base[0], k_dispatch.base[1], "
                         "k_dispatch.base[2]);\n"
                         "}\n") +
               "()";
      });
    case SystemValue::kDispatchRaysDimensions:
      return "uvec3(k_dispatch.dimensions[0], k_dispatch.dimensions[1], k_dispatch.dimensions[2])";
    case SystemValue::kWorldRayOrigin:
      return if_has(ray, [] { return "gl_WorldRayOriginEXT"; });
    case SystemValue::kWorldRayDirection:
      return if_has(ray, [] { return "gl_WorldRayDirectionEXT"; });
    case SystemValue::kRayTMin:
      return if_has(ray, [] { return "gl_RayTminEXT"; });
    case SystemValue::kRayTCurrent:
      return if_has(ray, [&] { return ray_t_current(); });
    case SystemValue::kRayFlags:
      return if_has(ray, [&] { return ray_flags(); });
    case SystemValue::kInstanceIndex:
      return if_has(hit, [&] { return instance_entry() + ".instance_index"; });
    case SystemValue::kInstanceId:
      return if_has(hit, [&] { return instance_entry() + ".instance_id"; });
    case SystemValue::kGeometryIndex:
      return if_has(hit, [&] { return geometry_index(); });
    case SystemValue::kPrimitiveIndex:
      return if_has(hit, [&] { return primitive_index(); });
    case SystemValue::kObjectRayOrigin:
      return if_has(hit, [&] { return object_ray(true); });
    case SystemValue::kObjectRayDirection:
      return if_has(hit, [&] { return object_ray(false); });
    case SystemValue::kObjectToWorld3x4:
      return if_has(hit, [&] { return transform(true, false, expr.type); });
    case SystemValue::kObjectToWorld4x3:
      return if_has(hit, [&] { return transform(true, true, expr.type); });
    case SystemValue::kWorldToObject3x4:
      return if_has(hit, [&] { return transform(false, false, expr.type); });
    case SystemValue::kWorldToObject4x3:
      return if_has(hit, [&] { return transform(false, true, expr.type); });
    case SystemValue::kHitKind:
      return if_has(hit && entry_.stage != kStageIntersection,
                    [&] { return hit_builtin("hit_kind", "uint", "gl_HitKindEXT"); });
    case SystemValue::kPositionTable:
      return if_has(hit, [&] {
        const std::string instance =
            hit_builtin("instance_custom_index", "uint", "uint(gl_InstanceCustomIndexEXT)");
        const std::string id = hit_builtin("primitive_id", "uint", "uint(gl_PrimitiveID)");
        return position_table() + "(" + instance + ", " + geometry_index() + ", " + id + ")";
      });
  }
  return zero(expr.type);
}

std::string GlslEmitter::geometry_index() {
  return hit_builtin("geometry_index", "uint", "uint(gl_GeometryIndexEXT)");
}

void GlslEmitter::declare_instance_entry() {
  generated("g_InstanceEntry",
            "layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer "
            "g_InstanceEntry { uint64_t primitive_remap; uint instance_id; "
            "uint instance_index; uint64_t micromaps; uint flags; };\n"
            "layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer "
            "g_Word { uint v; };\n"
            "uint g_remapped(uint64_t words, uint geometry, uint id) {\n"
            "  if (words == 0UL) return id;\n"
            "  uint first = g_Word(words + uint64_t(geometry) * 4UL).v;\n"
            "  return g_Word(words + uint64_t(first + id) * 4UL).v;\n"
            "}\n");
}

// InstanceIndex and InstanceID as the application numbers them, and the way back to its primitives.
std::string GlslEmitter::instance_entry() {
  const std::string custom =
      hit_builtin("instance_custom_index", "uint", "uint(gl_InstanceCustomIndexEXT)");
  declare_instance_entry();
  generated("g_instance_entry",
            "g_InstanceEntry g_instance_entry() {\n"
            "  return g_InstanceEntry(k_dispatch.instances + uint64_t(" +
                custom + ") * 32UL);\n}\n");
  return "g_instance_entry()";
}

std::string GlslEmitter::primitive_index() {
  instance_entry();
  const std::string id = hit_builtin("primitive_id", "uint", "uint(gl_PrimitiveID)");
  const std::string geometry = geometry_index();
  return generated("g_primitive_index",
                   "uint g_primitive_index() {\n"
                   "  return g_remapped(g_instance_entry().primitive_remap, " +
                       geometry + ", " + id + ");\n}\n") +
         "()";
}

}  // namespace kaamos::hlsl
