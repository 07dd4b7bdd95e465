// SPDX-License-Identifier: MIT
//
// The shader as a whole: globals, functions, main.
#include "runtime/hlsl/glsl/emit_glsl.h"

#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/glsl/emitter.h"
#include "runtime/hlsl/glsl/prelude.h"
#include "runtime/hlsl/ir/hit_object.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

constexpr uint32_t kPayloadStages = kStageAnyHit | kStageClosestHit | kStageMiss;

constexpr char kExtensions[] =
    "#extension GL_EXT_null_initializer : require\n"
    "#extension GL_EXT_buffer_reference2 : require\n"
    "#extension GL_EXT_scalar_block_layout : require\n"
    "#extension GL_EXT_shader_explicit_arithmetic_types : require\n";

}  // namespace

GlslEmitter::GlslEmitter(const Module& module, const EntryPoint& entry, bool twin)
    : module_(module), entry_(entry), twin_(twin) {
  shader_.stage = twin ? kStageCallable : entry.stage;
}

void GlslEmitter::collect(const Expr& root) {
  visit_expr(&root, [&](const Expr& expr) {
    if (expr.kind == ExprKind::kVariable && expr.variable->storage != Storage::kLocal &&
        expr.variable->storage != Storage::kParameter && globals_.insert(expr.variable).second &&
        expr.variable->initialiser != nullptr) {
      collect(*expr.variable->initialiser);
    }
  });
}

// Collects what the entry point reaches.
void GlslEmitter::collect(const Function& function) {
  if (!functions_.insert(&function).second) {
    return;
  }
  visit(
      function.body,
      [&](const Expr& expr) {
        if (expr.kind == ExprKind::kVariable) {
          collect(expr);
        }
      },
      [&](const Stmt& stmt) {
        if (stmt.kind == StmtKind::kCall) {
          collect(*stmt.function);
        } else if (stmt.kind == StmtKind::kReportHit) {
          attribute_types_.push_back(stmt.operands[2]->type);
        }
      });
}

std::string GlslEmitter::variable(const Variable* variable) {
  return variable_names_[variable];
}

void GlslEmitter::emit_globals() {
  for (const Variable* variable : module_.globals) {
    if (globals_.count(variable) == 0) {
      continue;
    }
    const std::string name = global_names_.add(variable->name);
    const std::string declaration = type(variable->type) + " " + name;
    variable_names_[variable] = name;
    if (variable->storage == Storage::kGroupShared && entry_.stage == kStageCompute) {
      declarations_ += "shared " + declaration + " = {};\n";
    } else if (variable->storage == Storage::kConstant &&
               (variable->initialiser == nullptr || is_constant(*variable->initialiser))) {
      const std::string initial =
          variable->initialiser != nullptr ? value(variable->initialiser) : "{}";
      declarations_ += "const " + declaration + " = " + initial + ";\n";
    } else {
      declarations_ += declaration + ";\n";
    }
  }
}

// Runs once per invocation, in main.
void GlslEmitter::initialise_globals() {
  for (const Variable* variable : module_.globals) {
    const bool constant = variable->storage == Storage::kConstant;
    const bool shared = variable->storage == Storage::kGroupShared && entry_.stage == kStageCompute;
    if (globals_.count(variable) == 0 || shared ||
        (constant && (variable->initialiser == nullptr || is_constant(*variable->initialiser)))) {
      continue;
    }
    line(variable_names_[variable] + " = " +
         (variable->initialiser != nullptr ? value(variable->initialiser) : zero(variable->type)) +
         ";");
  }
}

void GlslEmitter::emit_function(const Function& function) {
  current_ = &function;
  local_names_ = GlslNames("u_");
  // Locals and globals share one prefix; a local must not hide a global that the function uses.
  for (const Variable* variable : module_.globals) {
    if (globals_.count(variable) != 0) {
      local_names_.reserve(variable_names_[variable]);
    }
  }
  std::string text = type(function.result) + " " + function_names_[&function] + "(";
  for (size_t i = 0; i < function.parameters.size(); ++i) {
    const Variable* parameter = function.parameters[i];
    variable_names_[parameter] = local_names_.add(parameter->name);
    constexpr const char* kModes[] = {"", "inout ", "out "};
    if (parameter->type->is_query()) {  // opaque: always passed by reference
      const std::string& name = variable_names_[parameter];
      text +=
          (i == 0 ? "" : ", ") + type(parameter->type) + " " + name + ", inout g_Query g_s_" + name;
      continue;
    }
    text += (i == 0 ? "" : ", ") + std::string(kModes[static_cast<int>(parameter->mode)]) +
            type(parameter->type) + " " + variable_names_[parameter];
  }
  open(text + ") {");
  for (const Variable* parameter : function.parameters) {
    if (parameter->mode == ParameterMode::kOut) {
      line(variable_names_[parameter] + " = " + zero(parameter->type) + ";");
    }
  }
  block(function.body);
  // If HLSL code can fall off the end of a function, its result is undefined; here it is zero.
  if (function.result->kind != TypeKind::kVoid) {
    line("return " + zero(function.result) + ";");
  }
  close("}");
  current_ = nullptr;
}

std::string GlslEmitter::entry_argument(size_t index) {
  const Type* t = entry_.function->parameters[index]->type;
  const std::string name = type(t);
  const auto group_value = [&](const std::string& ids) {
    return name + "((" + ids + ")." + std::string("xyz").substr(0, t->columns) + ")";
  };
  constexpr const char* kGroupId =
      "gl_WorkGroupID + uvec3(k_dispatch.base[0], k_dispatch.base[1], k_dispatch.base[2])";
  switch (entry_.parameters[index]) {
    case EntryParameter::kPayload:
    case EntryParameter::kCallableData:
      return "g_argument";
    case EntryParameter::kAttributes:
      return twin_ ? twin_attributes(t) : attributes_function(t, false) + "()";
    case EntryParameter::kDispatchThreadId:
      return group_value("(" + std::string(kGroupId) +
                         ") * gl_WorkGroupSize + gl_LocalInvocationID");
    case EntryParameter::kGroupId:
      return group_value(kGroupId);
    case EntryParameter::kGroupThreadId:
      return group_value("gl_LocalInvocationID");
    case EntryParameter::kGroupIndex:
      return name + "(gl_LocalInvocationIndex)";
    default:  // graphics.cpp
      break;
  }
  return "";
}

void GlslEmitter::count_invocation() {
  switch (entry_.stage) {
    case kStageIntersection:
      return line(count(shader::spirv::kIntersectionInvocations));
    case kStageAnyHit:
      return line(count(shader::spirv::kAnyHitInvocations));
    case kStageClosestHit:
      return line(count(shader::spirv::kClosestHitInvocations));
    case kStageMiss:
      return line(count(shader::spirv::kMissInvocations));
    case kStageCallable:
      return line(count(shader::spirv::kCallableInvocations));
    default:
      return;
  }
}

void GlslEmitter::emit_main() {
  std::string functions = std::move(out_);
  out_.clear();
  indent_ = 1;
  initialise_globals();
  const bool payload = (entry_.stage & kPayloadStages) != 0;
  const bool callable = entry_.stage == kStageCallable;
  const bool incoming = entry_.payload != nullptr && (payload || callable) && !twin_;
  if (twin_) begin_twin();
  if (incoming) {
    payload_block(payload ? "rayPayloadInEXT" : "callableDataInEXT", 0, entry_.payload, "g_in");
    line("g_depths = g_in.depths;");
    if (module_.check_access) {
      line("if (g_in.type != " + glsl::number(type_hash(entry_.payload)) + ") k_tell(13u, " +
           site(entry_.function->location) + ", 0u, 0u, uint64_t(g_in.bytes), " +
           std::to_string(4 * glsl::words(entry_.payload)) + "UL, " + (callable ? "1UL" : "0UL") +
           ", 0UL);");
      if (entry_.stage != kStageAnyHit) line("g_in.type = 0u;");  // tells the caller that this ran
    }
    line(type(entry_.payload) + " g_argument = " + convert_wire(entry_.payload, false) +
         "(g_in.data);");
  }
  count_invocation();
  start_ = micromap_start() + start_;
  if (entry_.is_graphics()) {
    graphics_main();
    out_ = std::move(functions) + "void main() {\n" + start_ + out_ + "}\n";
    return;
  }
  std::string text = function_names_[entry_.function] + "(";
  for (size_t i = 0; i < entry_.parameters.size(); ++i) {
    text += (i == 0 ? "" : ", ") + entry_argument(i);
  }
  line(text + ");");
  if (incoming) {
    line("g_in.data = " + convert_wire(entry_.payload, true) + "(g_argument);");
  }
  if (twin_) {
    end_twin();
  } else if (entry_.stage == kStageAnyHit && entry_.function->may_end_shader) {
    line("if (g_ended == 1u) ignoreIntersectionEXT;");
    line("if (g_ended == 2u) terminateRayEXT;");
  }
  out_ = std::move(functions) + "void main() {\n" + start_ + out_ + "}\n";
}

// For k_tell: which shader of the pipeline is running, and for which pixel or thread group.
void GlslEmitter::define_check_place() {
  Expr index;
  index.kind = ExprKind::kSystemValue;
  index.system_value = SystemValue::kDispatchRaysIndex;
  const std::string text =
      entry_.stage == kStageCompute
          ? std::string(
                "gl_WorkGroupID + uvec3(k_dispatch.base[0], k_dispatch.base[1], "
                "k_dispatch.base[2])")
      : entry_.stage == kStagePixel    ? "uvec3(gl_FragCoord.xy, gl_PrimitiveID)"
      : entry_.stage == kStageVertex   ? "uvec3(gl_VertexIndex, gl_InstanceIndex, 0)"
      : entry_.stage == kStageGeometry ? "uvec3(gl_PrimitiveIDIn, gl_InvocationID, 0)"
                                       : system_value(index);
  constant(shader::spirv::kShaderConstant, "g_shader");
  helpers_ += "uint g_check_shader() { return g_shader; }\nuvec3 g_check_index() { return " + text +
              "; }\n";
}

GlslShader GlslEmitter::run() {
  collect(*entry_.function);
  if (entry_.attributes != nullptr) {
    attribute_types_.push_back(entry_.attributes);
  }
  if (entry_.stage != kStageCompute && !entry_.is_graphics()) {
    declarations_ += "uint g_depths = 0u;\n";
  }
  if (entry_.function->may_end_shader) {
    declarations_ += "uint g_ended = 0u;\n";
  }
  if (entry_.stage == kStageIntersection) {
    declarations_ += "float g_t_reported = 0.0;\n";
    start_ += "  g_t_reported = " + (twin_ ? twin_value(kHitT) : "gl_RayTmaxEXT") + ";\n";
  }
  emit_globals();
  for (const Function* function : module_.functions) {
    if (functions_.count(function) != 0) {
      function_names_[function] = function_names_set_.add(function->name);
    }
  }
  for (const Function* function : module_.functions) {
    if (functions_.count(function) != 0) {
      emit_function(*function);
    }
  }
  emit_main();
  if (module_.check_access) define_check_place();

  std::string head = std::string("#version 460\n") + kExtensions;
  std::string layout;
  if (entry_.stage == kStageCompute) {
    layout = "layout(local_size_x = " + std::to_string(entry_.thread_group[0]) +
             ", local_size_y = " + std::to_string(entry_.thread_group[1]) +
             ", local_size_z = " + std::to_string(entry_.thread_group[2]) + ") in;\n";
  } else if (entry_.is_graphics()) {
    head += graphics_head();
    layout = graphics_layout();
  } else {
    head += "#extension GL_EXT_ray_tracing : require\n#define KAAMOS_SHADER_RECORD\n";
  }
  if (uses_queries()) {
    head += "#extension GL_EXT_ray_query : require\n";
  }
  head += wave_extensions();
  const std::string body =
      layout + constants_ + matrices_ + structs_ + declarations_ + helpers_ + out_;
  shader_.text = head + glsl_prelude(body).text + body;
  return std::move(shader_);
}

GlslShader emit_glsl(const Module& module, const EntryPoint& entry) {
  return GlslEmitter(module, entry).run();
}

bool has_twin(const Module& module, const EntryPoint& entry) {
  constexpr uint32_t kStages = kPayloadStages | kStageIntersection;
  return module.hit_object != nullptr && (entry.stage & kStages) != 0;
}

GlslShader emit_glsl_twin(const Module& module, const EntryPoint& entry) {
  return GlslEmitter(module, entry, true).run();
}

}  // namespace kaamos::hlsl
