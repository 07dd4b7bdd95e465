// SPDX-License-Identifier: MIT
//
// The unit as a whole: constants, the context, functions and entry functions.
#include "runtime/hlsl/cpp/emit_cpp.h"

#include <kaamos/shader/abi.h>
#include <kaamos/shader/debugging.h>

#include <algorithm>
#include <map>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/cpp/emitter.h"
#include "runtime/hlsl/cpp/wide_emitter.h"
#include "runtime/hlsl/ir/payload_layout.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

std::string quote(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte >= 0x7F) {
      // Octal, because it has at most three digits and so ends by itself.
      out += '\\';
      out += static_cast<char>('0' + (byte >> 6));
      out += static_cast<char>('0' + ((byte >> 3) & 7));
      out += static_cast<char>('0' + (byte & 7));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

namespace {

// A group looks up all elements of a resource array, whether read or not, which only pays off for
// short arrays.
constexpr uint32_t kMostBoundElements = 16;

}  // namespace

CppEmitter::CppEmitter(const Module& module, const EmitCppOptions& options)
    : module_(module),
      options_(options),
      wave_paths_(module),
      binds_per_group_(!module.check_access && module.library_functions.empty() &&
                       !module.entry_points.empty()) {
  for (const EntryPoint& entry : module.entry_points) {
    binds_per_group_ = binds_per_group_ && entry.stage == kStageCompute;
  }
  for (const EntryPoint& entry : module.entry_points) {
    wave_words_ = std::max(wave_words_, wave_paths_.length(*entry.function));
  }
  reads_bound_ = !module.check_access && !binds_per_group_;
  bound_count_ = static_cast<uint32_t>(module.bindings.size());
  for (const Binding& binding : module.bindings) {
    const bool small_array = binding.count > 1 && binding.count <= kMostBoundElements;
    bound_elements_.push_back(binds_per_group_ && small_array ? bound_count_ : 0);
    if (bound_elements_.back() != 0) bound_count_ += binding.count;
  }
}

// Copying structures costs more than what many functions do with them: it was a tenth of the
// instructions of a closest-hit shader for reflections.
void CppEmitter::collect_parameters_by_reference() {
  for (const Function* function : module_.functions) {
    for (const Variable* parameter : function->parameters) {
      const TypeKind kind = parameter->type->kind;
      const bool is_large =
          kind == TypeKind::kStruct || kind == TypeKind::kArray || kind == TypeKind::kMatrix;
      if (is_large && parameter->mode == ParameterMode::kIn) by_reference_.insert(parameter);
    }
    visit(
        function->body, [](const Expr&) {},
        [&](const Stmt& stmt) {
          visit_written(
              stmt, [&](const Variable* written, const Expr*) { by_reference_.erase(written); });
        });
  }
}

// Finds which static globals a function can touch, and how much stack it may need. Callees come
// before callers in the module.
void CppEmitter::collect_static_use() {
  for (const Function* function : module_.functions) {
    auto& statics = statics_[function];
    uint32_t own = 0;
    uint32_t deepest = 0;
    const auto on_expr = [&](const Expr& expr) {
      if (expr.kind == ExprKind::kVariable && expr.variable->storage == Storage::kStaticGlobal) {
        statics.insert(expr.variable);
      }
      if (expr.kind == ExprKind::kSystemValue && expr.system_value == SystemValue::kHitKind) {
        hit_kind_readers_.insert(function);
      }
    };
    const auto on_stmt = [&](const Stmt& stmt) {
      if (stmt.kind == StmtKind::kDeclare) {
        own += stack_bytes(stmt.variable->type);
      }
      if (stmt.kind == StmtKind::kCall) {
        statics.insert(statics_[stmt.function].begin(), statics_[stmt.function].end());
        deepest = std::max(deepest, stack_[stmt.function]);
        if (hit_kind_readers_.count(stmt.function) != 0) hit_kind_readers_.insert(function);
      }
    };
    visit(function->body, on_expr, on_stmt);
    for (const Variable* parameter : function->parameters) {
      own += parameter->mode == ParameterMode::kIn ? stack_bytes(parameter->type) : 8;
    }
    stack_[function] = 16 + own + deepest;
  }
  // An initialiser may read other static globals.
  for (auto& entry : statics_) {
    auto& statics = entry.second;  // by name: clang 14 cannot capture a structured binding
    for (bool grown = true; grown;) {
      const size_t before = statics.size();
      for (const Variable* variable :
           std::vector<const Variable*>(statics.begin(), statics.end())) {
        visit_expr(variable->initialiser, [&](const Expr& expr) {
          if (expr.kind == ExprKind::kVariable &&
              expr.variable->storage == Storage::kStaticGlobal) {
            statics.insert(expr.variable);
          }
        });
      }
      grown = statics.size() != before;
    }
  }
}

void CppEmitter::emit_constants() {
  for (const Variable* variable : module_.globals) {
    if (variable->storage != Storage::kConstant) {
      continue;
    }
    const std::string name = global_names_.add(variable->name);
    variable_names_[variable] = name;
    at(variable->location);
    line("static const " + type(variable->type) + " " + name +
         (variable->initialiser != nullptr ? " = " + value(variable->initialiser) : "{}") + ";");
  }
}

void CppEmitter::emit_context() {
  NameSet shared_names;
  NameSet static_names;
  at_generated();
  open("struct Shared {");
  for (const Variable* variable : module_.globals) {
    if (variable->storage == Storage::kGroupShared) {
      variable_names_[variable] = shared_names.add(variable->name);
      line(type(variable->type) + " " + variable_names_[variable] + ";");
    }
  }
  close("};");
  open("struct Statics {");
  for (const Variable* variable : module_.globals) {
    if (variable->storage == Storage::kStaticGlobal) {
      variable_names_[variable] = static_names.add(variable->name);
      line(type(variable->type) + " " + variable_names_[variable] + ";");
    }
  }
  close("};");
  open("struct Context {");
  line("ks::Invocation& invocation;");
  line("ks::ComputeGroup* group = nullptr;");
  line("Shared* shared = nullptr;");
  line("bool ended = false;");
  line("ks::AnyHitResult any_hit = ks::AnyHitResult::kAccept;");
  line("Statics statics;");
  if (wave_words_ != 0) {
    line("uint32_t wave_path[" + std::to_string(wave_words_) + "];");
    line("uint32_t wave_depth = 0;");
  }
  if (has_geometry_) line("ks::GeometryStream* stream = nullptr;");
  if (binds_per_group_) line("const ks::BoundResource* bound = nullptr;");
  line("explicit Context(ks::Invocation& i) : invocation(i) {}");
  close("};");
}

void CppEmitter::emit_signature(const Function& function) {
  // The "inline" hint matters: without it g++ does not inline even a function that only reads a ray
  // from a buffer, which costs 2 % of the time of a short ray.
  std::string text = "static inline " + type(function.result) + " " + function_names_[&function] +
                     "([[maybe_unused]] Context& ctx";
  for (const Variable* parameter : function.parameters) {
    variable_names_[parameter] = local_names_.declare(parameter->name);
    const bool is_in = parameter->mode == ParameterMode::kIn;
    const bool only_read = by_reference_.count(parameter) != 0;
    text += std::string(only_read ? ", const " : ", ") + type(parameter->type) +
            (is_in && !only_read ? " " : "& ") + variable_names_[parameter];
  }
  at(function.location);
  open(text + ") {");
}

// What a function uses more than once is looked up at its start, because the C++ compiler cannot
// know that storing to a texture leaves the bindings unchanged.
void CppEmitter::look_up_once(const Function& function) {
  if (!reads_bound_) return;
  std::map<uint32_t, int> resources, views;
  const auto is_buffer = [](const Expr& expr) {
    return expr.kind == ExprKind::kBinding && expr.operands.empty() &&
           expr.type->resource <= ResourceKind::kRWStructuredBuffer;  // has bytes
  };
  visit(
      function.body,
      [&](const Expr& expr) {
        if (is_buffer(expr)) ++resources[expr.index];
        const bool reads = expr.kind == ExprKind::kLoad || expr.kind == ExprKind::kLoadElement;
        if (!reads || !is_buffer(*expr.operands[0])) return;
        --resources[expr.operands[0]->index];
        if (expr.kind == ExprKind::kLoad) ++views[expr.operands[0]->index];
      },
      [&](const Stmt& stmt) {
        const bool writes = stmt.kind == StmtKind::kStore || stmt.kind == StmtKind::kStoreElement;
        if (!writes || !is_buffer(*stmt.operands[0])) return;
        --resources[stmt.operands[0]->index];
        if (stmt.kind == StmtKind::kStore) ++views[stmt.operands[0]->index];
      });
  const auto declare = [&](const char* type, const char* look_up, uint32_t binding) {
    const std::string name = local_names_.declare(module_.bindings[binding].name);
    line(std::string("const ks::") + type + " " + name + " = ks::" + look_up + "(ctx.invocation, " +
         std::to_string(binding) + "u);");
    return name;
  };
  for (const auto& [binding, uses] : views) {
    if (uses > 1) views_found_[binding] = declare("MemoryView", "bound_memory_view", binding);
  }
  for (const auto& [binding, uses] : resources) {
    if (uses > 1) resources_found_[binding] = declare("Descriptor", "bound_resource", binding);
  }
}

namespace {

bool ends_in_its_only_return(const Function& function) {
  if (function.body.empty() || function.body.back()->kind != StmtKind::kReturn) return false;
  size_t returns = 0;
  visit(
      function.body, [](const Expr&) {},
      [&](const Stmt& stmt) { returns += stmt.kind == StmtKind::kReturn; });
  return returns == 1;
}

}  // namespace

void CppEmitter::emit_function(const Function& function) {
  current_ = &function;
  local_names_.push();
  emit_signature(function);
  for (const Variable* parameter : function.parameters) {
    if (parameter->mode == ParameterMode::kOut) {
      line(variable_names_[parameter] + " = " + type(parameter->type) + "{};");
    }
  }
  look_up_once(function);
  block(function.body);
  resources_found_.clear();
  views_found_.clear();
  at(function.end_location);
  // If HLSL code can fall off the end of a function, its result is undefined; here it is zero.
  // Nothing is emitted after an only return, which lets the C++ compiler build the returned
  // variable in place. Functions with more returns are faster if it stays in registers until they
  // end.
  if (function.result->kind != TypeKind::kVoid && !ends_in_its_only_return(function)) {
    line("return " + type(function.result) + "{};");
    at(function.end_location);
  }
  close("}");
  local_names_.pop();
  current_ = nullptr;
}

void CppEmitter::emit_functions() {
  for (const Function* function : module_.functions) {
    function_names_[function] = global_names_.add(function->name);
  }
  for (const Function* function : module_.functions) {
    emit_function(*function);
  }
}

void CppEmitter::emit_static_initialisers(const Function& function) {
  const auto& used = statics_[&function];
  for (const Variable* variable : module_.globals) {
    if (variable->storage != Storage::kStaticGlobal || used.count(variable) == 0) {
      continue;
    }
    line(this->variable(variable) + " = " +
         (variable->initialiser != nullptr ? value(variable->initialiser)
                                           : type(variable->type) + "{}") +
         ";");
  }
}

std::string CppEmitter::entry_argument(const EntryPoint& entry, size_t parameter) {
  const std::string t = type(entry.function->parameters[parameter]->type);
  switch (entry.parameters[parameter]) {
    case EntryParameter::kPayload:
    case EntryParameter::kCallableData:
      return "*static_cast<" + t + "*>(payload)";
    case EntryParameter::kAttributes:
      return "ks::load_attributes<" + t + ">(attributes)";
    case EntryParameter::kDispatchThreadId:
      return "ks::dispatch_thread_id<" + t + ">(group, size, thread)";
    case EntryParameter::kGroupId:
      return "ks::group_value<" + t + ">(group.group_id)";
    case EntryParameter::kGroupThreadId:
      return "ks::group_value<" + t + ">(thread)";
    case EntryParameter::kGroupIndex:
      return t + "(thread[0] + size[0] * (thread[1] + size[1] * thread[2]))";
    default:  // graphics.cpp
      break;
  }
  return "";
}

std::string CppEmitter::entry_arguments(const EntryPoint& entry) {
  std::string out = "ctx";
  for (size_t i = 0; i < entry.parameters.size(); ++i) out += ", " + entry_argument(entry, i);
  return out;
}

// Declares `bound` and fills in what the entry point can reach.
void CppEmitter::emit_bound(const EntryPoint& entry) {
  if (!binds_per_group_ && !reads_bound_) return;
  std::string used;
  std::string arrays;
  uint32_t count = 0;
  for (const uint32_t binding : entry.bindings) {
    const std::string n = std::to_string(binding);
    if (module_.bindings[binding].count == 1) {
      used += n + "u, ";
      ++count;
    } else if (const uint32_t place = bound_elements_[binding]; place != 0) {
      arrays += "ks::bind_array(invocation, " + n + "u, " +
                std::to_string(module_.bindings[binding].count) + "u, bound + " +
                std::to_string(place) + "u); ";
    }
  }
  line("ks::BoundResource bound[" + std::to_string(bound_count_ + 1) + "];");
  line("static constexpr uint32_t used[] = {" + used + "0u};");
  line("ks::bind(invocation, used, " + std::to_string(count) + "u, bound);");
  if (!arrays.empty()) line(arrays);
  if (reads_bound_) line("invocation.bound = bound;");
}

void CppEmitter::emit_compute_entry(size_t index) {
  const EntryPoint& entry = module_.entry_points[index];
  const std::string number = std::to_string(index);
  const std::string size = std::to_string(entry.thread_group[0]) + ", " +
                           std::to_string(entry.thread_group[1]) + ", " +
                           std::to_string(entry.thread_group[2]);
  if (emit_split_group(index)) {
    line("static const ks::ComputeDesc compute_" + number + " = {{" + size +
         "}, sizeof(u::Shared), group_" + number + ", nullptr" + wave_facts(entry) + "};");
    return;
  }
  // A group function runs its threads itself and binds for all of them; otherwise each thread binds
  // for itself.
  const bool fibers = entry.function->has_barrier || entry.function->has_waves;
  const bool in_group = !module_.check_access && !fibers;
  const bool passes_bound = in_group && binds_per_group_;
  open("static void thread_" + number +
       "(ks::Invocation& invocation, ks::ComputeGroup& group, const uint32_t thread[3]" +
       (passes_bound ? ", const ks::BoundResource* bound) {" : ") {"));
  line("[[maybe_unused]] constexpr uint32_t size[3] = {" + size + "};");
  line("u::Context ctx(invocation);");
  if (!in_group) emit_bound(entry);
  if (binds_per_group_) line("ctx.bound = bound;");
  line("ctx.group = &group;");
  line("ctx.shared = static_cast<u::Shared*>(group.shared);");
  emit_static_initialisers(*entry.function);
  line("u::" + function_names_[entry.function] + "(" + entry_arguments(entry) + ");");
  close("}");
  if (!fibers) {
    open("static void group_" + number + "(ks::Invocation& invocation, ks::ComputeGroup& group) {");
    emit_bound(entry);
    line("uint32_t thread[3];");
    for (int axis = 2; axis >= 0; --axis) {
      const std::string t = "thread[" + std::to_string(axis) + "]";
      line("for (" + t + " = 0; " + t + " < " + std::to_string(entry.thread_group[axis]) + "u; ++" +
           t + ")");
    }
    line("  thread_" + number + "(invocation, group, thread" + (passes_bound ? ", bound);" : ");"));
    close("}");
  }
  line("static const ks::ComputeDesc compute_" + number + " = {{" + size +
       "}, sizeof(u::Shared), " +
       (fibers ? "nullptr, thread_" + number : "group_" + number + ", nullptr") +
       wave_facts(entry) + "};");
}

void CppEmitter::payload_check(const EntryPoint& entry) {
  if (!module_.check_access || entry.payload == nullptr) return;
  line("ks::checked::check_payload(invocation, " + site(entry.function->location) + ", payload, " +
       std::to_string(type_hash(entry.payload)) + "u, sizeof(" + type(entry.payload) + "), " +
       (entry.stage == kStageCallable ? "true" : "false") + ");");
}

void CppEmitter::emit_entry(size_t index) {
  const EntryPoint& entry = module_.entry_points[index];
  if (entry.is_graphics()) return emit_graphics_entry(index);
  if (entry.stage == kStageCompute) {
    emit_compute_entry(index);
    return;
  }
  if (has_row_[index]) {
    const std::string number = std::to_string(index);
    line("static void entry_" + number + "(ks::Invocation& invocation) { row_" + number +
         "(invocation, 1); }");
    return;
  }
  const bool any_hit = entry.stage == kStageAnyHit;
  std::string parameters = "ks::Invocation& invocation";
  if (entry.stage & (kStageMiss | kStageCallable | kStageClosestHit | kStageAnyHit)) {
    parameters += ", [[maybe_unused]] void* payload";
  }
  if (entry.stage & (kStageClosestHit | kStageAnyHit)) {
    parameters += ", [[maybe_unused]] const void* attributes";
  }
  open(std::string("static ") + (any_hit ? "ks::AnyHitResult" : "void") + " entry_" +
       std::to_string(index) + "(" + parameters + ") {");
  line("u::Context ctx(invocation);");
  if (entry.attributes != nullptr) {
    // The size of the backend's buffer; C++ padding may exceed what DXR counts.
    line("static_assert(sizeof(" + type(entry.attributes) + ") <= 32);");
  }
  payload_check(entry);
  emit_static_initialisers(*entry.function);
  line("u::" + function_names_[entry.function] + "(" + entry_arguments(entry) + ");");
  if (any_hit) {
    line("return ctx.any_hit;");
  }
  close("}");
}

// A loop here is faster than one that calls the entry point. Not used in code for a debugger.
bool CppEmitter::emit_row(size_t index) {
  const EntryPoint& entry = module_.entry_points[index];
  if (entry.stage != kStageRayGeneration || module_.check_access ||
      options_.wide == WideThreads::kNever) {
    return false;
  }
  open("static void row_" + std::to_string(index) +
       "(ks::Invocation& invocation, uint32_t count) {");
  line("const uint32_t first = invocation.index[0];");
  open("for (uint32_t i = 0; i < count; ++i) {");
  line("invocation.index[0] = first + i;");
  line("u::Context ctx(invocation);");
  emit_static_initialisers(*entry.function);
  line("u::" + function_names_[entry.function] + "(ctx);");
  close("}");
  close("}");
  return true;
}

// Variables of shaders stay in memory, where a debugger finds them; functions of the headers above
// are optimised.
void CppEmitter::emit_unoptimised() {
  line("#ifdef __clang__");
  line("#pragma clang optimize off");
  line("#else");
  line("#pragma GCC optimize(\"O0\")");
  line("#endif");
}

// What the prelude leaves out, because few shaders have it.
void CppEmitter::include_experimental() {
  bool debugs = false;
  bool reads_positions = false;
  for (const Function* function : module_.functions) {
    visit(
        function->body,
        [&](const Expr& expr) {
          reads_positions = reads_positions || expr.kind == ExprKind::kTrianglePositions ||
                            expr.kind == ExprKind::kClusterId || is_position_table(expr);
          debugs = debugs || (expr.kind == ExprKind::kRecordConstant &&
                              is_literal(expr.operands[1], shader::kDebuggingEnabled));
        },
        [&](const Stmt& stmt) { debugs = debugs || stmt.kind == StmtKind::kDebugBreak; });
  }
  if (debugs) line("#include <kaamos/shader/debugging.h>");
  if (reads_positions) line("#include <kaamos/shader/triangle_positions.h>");
}

std::string CppEmitter::run() {
  line("// Generated by kaamos-hlsl from " + cpp_identifier(module_.name) + "; do not edit.");
  line("#include <kaamos/shader/prelude.h>");
  line("#include <kaamos/shader/views.h>");
  const bool graphics = std::any_of(module_.entry_points.begin(), module_.entry_points.end(),
                                    [](const EntryPoint& entry) { return entry.is_graphics(); });
  if (graphics) line("#include <kaamos/shader/columns.h>");
  has_geometry_ =
      std::any_of(module_.entry_points.begin(), module_.entry_points.end(),
                  [](const EntryPoint& entry) { return entry.stage == kStageGeometry; });
  if (has_geometry_) line("#include <kaamos/shader/geometry.h>");
  if (wave_words_ != 0) line("#include <kaamos/shader/wave.h>");
  if (module_.check_access) line("#include <kaamos/shader/checked.h>");
  if (!module_.coverage.empty()) line("#include <kaamos/shader/coverage.h>");
  include_experimental();
  WideEmitter wide(*this);
  for (const EntryPoint& entry : module_.entry_points) wide.plan(entry);
  if (wide.any()) line("#include <kaamos/shader/wide_memory.h>");
  if (wide.any()) line("#include <kaamos/shader/wide_stage.h>");
  if (wide.any() && (graphics || wave_words_ != 0)) {
    line("#include <kaamos/shader/wide_columns.h>");
  }
  if (wide.any() && wave_words_ != 0) line("#include <kaamos/shader/wide_wave.h>");
  if (options_.flags & shader::kLibraryDebug) emit_unoptimised();
  line("namespace {");
  // A namespace of its own allows several units in one file.
  line("namespace unit_" + options_.entry_point + " {");
  line("namespace ks = kaamos::shader;");
  if (!module_.coverage.empty()) {
    line("static uint8_t covered[" + std::to_string(module_.coverage.size()) + "];");
  }
  line("namespace u {");
  for (const char* reserved : {"Shared", "Statics", "Context", "WideStatics", "WideContext"}) {
    global_names_.add(reserved);
  }
  collect_parameters_by_reference();
  collect_static_use();
  emit_structs();
  emit_memory_functions();
  emit_constants();
  emit_context();
  emit_functions();
  wide.emit_declarations();
  at_generated();
  line("}  // namespace u");
  for (size_t i = 0; i < module_.entry_points.size(); ++i) {
    has_row_.push_back(wide.emit_row(i) || emit_row(i));
    if (!wide.emit_group(i) && !wide.emit_graphics(i)) emit_entry(i);
  }
  emit_tables();
  if (!module_.coverage.empty()) emit_coverage();
  line("}}");
  const auto give = [&](const std::string& type, const std::string& function,
                        const std::string& table) {
    line("extern \"C\" __attribute__((visibility(\"default\"))) const kaamos::shader::" + type +
         "* " + function + "() { return &unit_" + options_.entry_point + "::" + table + "; }");
  };
  give("LibraryDesc", options_.entry_point, "library");
  if (!module_.coverage.empty()) {
    give("CoverageDesc", options_.entry_point + "_coverage", "coverage");
  }
  return std::move(out_);
}

std::string emit_cpp(const Module& module, const EmitCppOptions& options) {
  return CppEmitter(module, options).run();
}

}  // namespace kaamos::hlsl
