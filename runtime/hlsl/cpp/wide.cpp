// SPDX-License-Identifier: MIT
//
// Structs, functions and entry points that run several threads at once.
#include "runtime/hlsl/cpp/wide_emitter.h"

#include <algorithm>

namespace kaamos::hlsl {

using namespace ir;

std::string WideEmitter::type(const Type* t) {
  const auto scalar = [t] { return std::string("ks::wide<") + scalar_name(t->scalar) + ">"; };
  switch (t->kind) {
    case TypeKind::kScalar:
      return scalar();
    case TypeKind::kVector:
      return "ks::vec<" + scalar() + ", " + std::to_string(t->columns) + ">";
    case TypeKind::kMatrix:
      return "ks::mat<" + scalar() + ", " + std::to_string(t->rows) + ", " +
             std::to_string(t->columns) + ">";
    case TypeKind::kArray:
      return "ks::array<" + type(t->element) + ", " + std::to_string(t->count) + ">";
    case TypeKind::kStruct:
      return "u::" + struct_names_[t->structure];
    default:
      return out_.type(t);
  }
}

void WideEmitter::plan(const EntryPoint& entry) {
  const WideFunction* function = nullptr;
  const uint64_t threads =
      uint64_t{entry.thread_group[0]} * entry.thread_group[1] * entry.thread_group[2];
  std::string reason;
  const bool compute = entry.stage == kStageCompute;
  const bool rows = entry.stage == kStageRayGeneration;
  const bool draws = entry.is_graphics() && entry.stage != kStageGeometry;
  if ((compute || rows || draws) && !out_.module_.check_access &&
      out_.options_.wide != WideThreads::kNever) {
    const bool where_faster = out_.options_.wide == WideThreads::kWhereFaster;
    // A group of fewer threads than lanes is slower this way than thread by thread.
    if (where_faster && compute && threads < 8) {
      reason = "its groups have fewer than 8 threads";
    } else {
      function = plan_.add(entry, reason);
    }
  }
  if (!reason.empty()) line("// " + entry.name + " runs thread by thread: " + reason);
  entries_.push_back(function);
  has_rows_ = has_rows_ || (function != nullptr && rows);
}

bool WideEmitter::any() const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [](const WideFunction* entry) { return entry != nullptr; });
}

// Names the members as the templates of wide.h expect them.
void WideEmitter::emit_structs() {
  for (const Struct* s : out_.module_.structs) {
    Type whole;
    whole.kind = TypeKind::kStruct;
    whole.structure = s;
    if (holds_resource(&whole)) continue;
    const std::string& scalar = out_.struct_names_[s];
    const std::string name = out_.global_names_.add("wide_" + scalar);
    struct_names_[s] = name;
    const auto& fields = out_.field_names_[s];
    open("struct " + name + " {");
    line("using lane = " + scalar + ";");
    for (size_t i = 0; i < fields.size(); ++i)
      line(type(s->fields[i].type) + " m_" + fields[i] + ";");
    std::string words = "true";
    for (const std::string& field : fields) words += " && ks::is_words<decltype(m_" + field + ")>";
    line("static constexpr bool words = " + words + ";");
    open("KAAMOS_INLINE lane get(int lane_number) const {");
    line("lane out;");
    for (const std::string& field : fields) {
      line("out." + field + " = ks::get(m_" + field + ", lane_number);");
    }
    line("return out;");
    close("}");
    open("KAAMOS_INLINE void set(int lane_number, const lane& in) {");
    for (const std::string& field : fields) {
      line("ks::set(m_" + field + ", lane_number, in." + field + ");");
    }
    close("}");
    open("KAAMOS_INLINE void fill(const lane& in) {");
    for (const std::string& field : fields) {
      line("ks::fill_lanes(m_" + field + ", in." + field + ");");
    }
    close("}");
    open("KAAMOS_INLINE void blend(const " + name + "& in, const ks::lanes& active) {");
    for (const std::string& field : fields) {
      line("ks::blend(m_" + field + ", in.m_" + field + ", active);");
    }
    close("}");
    close("};");
  }
}

void WideEmitter::emit_context() {
  open("struct WideStatics {");
  for (const Variable* variable : out_.module_.globals) {
    if (variable->storage != Storage::kStaticGlobal) continue;
    const bool is_shared = holds_resource(variable->type);  // by all lanes
    line((is_shared ? out_.type(variable->type) : type(variable->type)) + " " +
         out_.variable_names_[variable] + ";");
  }
  close("};");
  open("struct WideContext {");
  line("ks::Invocation& invocation;");
  line("WideStatics statics;");
  if (out_.binds_per_group_) line("const ks::BoundResource* bound = nullptr;");
  if (has_rows_) {
    line("uint32_t first_x = 0;");
    line("ks::vec<ks::wide<uint32_t>, 3> rays_index;");
    open("KAAMOS_INLINE void set_invocation(int lane_number) {");
    line("invocation.index[0] = first_x + static_cast<uint32_t>(lane_number);");
    close("}");
  }
  if (out_.wave_words_ != 0) {
    line("ks::ComputeGroup* group = nullptr;");
    line("uint32_t first = 0;");
    line("uint32_t wave_path[" + std::to_string(out_.wave_words_) + "];");
    line("uint32_t wave_depth = 0;");
  }
  line("explicit WideContext(ks::Invocation& i) : invocation(i) {}");
  close("};");
}

void WideEmitter::emit_declarations() {
  if (!any()) return;
  out_.at_generated();
  emit_structs();
  emit_context();
  for (const WideFunction* entry : entries_) {
    if (entry != nullptr) emit_reachable(*entry);
  }
}

// In the order of the statements, so that the text does not depend on addresses.
void WideEmitter::emit_reachable(const WideFunction& function) {
  if (!emitted_.insert(&function).second) return;
  const auto search = [&](const auto& self, const Block& block) -> void {
    for (const Stmt* stmt : block) {
      if (stmt->kind == StmtKind::kCall) emit_reachable(*function.callees.at(stmt));
      for (const Block* inner : {&stmt->prelude, &stmt->body, &stmt->orelse, &stmt->step}) {
        self(self, *inner);
      }
      for (const SwitchCase& c : stmt->cases) self(self, c.body);
    }
  };
  search(search, function.function->body);
  emit_function(function);
}

void WideEmitter::emit_signature(const WideFunction& function) {
  const Function& f = *function.function;
  const std::string result = function.varying_result && f.result->kind != TypeKind::kVoid
                                 ? type(f.result)
                                 : out_.type(f.result);
  std::string text = "static inline " + result + " " + names_[&function] +
                     "([[maybe_unused]] WideContext& ctx, const ks::lanes& active";
  for (const Variable* parameter : f.parameters) {
    const std::string name = out_.local_names_.declare(parameter->name);
    out_.variable_names_[parameter] = name;
    const bool varying = function.is_varying(parameter);
    text += ", ";
    if (function.only_reads(parameter)) text += "const ";
    text += varying ? type(parameter->type) : out_.type(parameter->type);
    const bool is_in = parameter->mode == ParameterMode::kIn;
    text += (is_in && !function.only_reads(parameter) ? " " : "& ") + name;
  }
  out_.at(f.location);
  open(text + ") {");
}

void WideEmitter::emit_function(const WideFunction& function) {
  const Function& f = *function.function;
  names_[&function] = out_.global_names_.add("wide_" + out_.function_names_[&f]);
  current_ = &function;
  out_.current_ = &f;
  out_.local_names_.push();
  for (const char* name : {"active", "lane_number", "lane_value"}) out_.local_names_.declare(name);
  emit_signature(function);
  mask_ = declare_mask("active");
  gone_ = function.masked_return ? declare_mask("{}") : "";
  const bool is_void = f.result->kind == TypeKind::kVoid;
  result_.clear();
  if (function.masked_return && !is_void) {
    result_ = out_.local_names_.declare("returned");
    line(type(f.result) + " " + result_ + "{};");
  }
  for (const Variable* parameter : f.parameters) {
    if (parameter->mode != ParameterMode::kOut) continue;
    const std::string& name = out_.variable_names_[parameter];
    if (function.is_varying(parameter)) {
      line("ks::blend(" + name + ", " + type(parameter->type) + "{}, " + mask_ + ");");
    } else {
      line(name + " = " + out_.type(parameter->type) + "{};");
    }
  }
  for (const Variable* parameter : f.parameters) {
    if (parameter->mode == ParameterMode::kIn) declare_texel_row(parameter, nullptr);
  }
  scope(f.body);
  texel_rows_.clear();
  out_.at(f.end_location);
  // If HLSL code can fall off the end of a function, its result is undefined; here it is zero.
  if (!result_.empty()) {
    line("return " + result_ + ";");
  } else if (!is_void) {
    const bool varying = function.varying_result;
    line("return " + (varying ? type(f.result) : out_.type(f.result)) + "{};");
  }
  close("}");
  out_.local_names_.pop();
  out_.current_ = nullptr;
  current_ = nullptr;
}

void WideEmitter::emit_static_initialisers(const Function& function) {
  const auto& used = out_.statics_[&function];
  for (const Variable* variable : out_.module_.globals) {
    if (variable->storage != Storage::kStaticGlobal || used.count(variable) == 0) continue;
    const bool is_shared = holds_resource(variable->type);
    const Expr* first = variable->initialiser;
    const std::string initial = is_shared
                                    ? (first ? out_.value(first) : out_.type(variable->type) + "{}")
                                    : (first ? value(first) : type(variable->type) + "{}");
    line("ctx.statics." + out_.variable_names_[variable] + " = " + initial + ";");
  }
}

std::string WideEmitter::entry_argument(const EntryPoint& entry, size_t i) {
  const Variable* parameter = entry.function->parameters[i];
  const std::string t = type(parameter->type);
  switch (entry.parameters[i]) {
    case EntryParameter::kDispatchThreadId:
      return "ks::wide_dispatch_thread_id<" + t + ">(group, size, thread)";
    case EntryParameter::kGroupThreadId:
      return "ks::wide_group_value<" + t + ">(thread.id)";
    case EntryParameter::kGroupIndex:
      return "ks::convert<" + std::string(scalar_name(parameter->type->scalar)) + ">(thread.index)";
    default: {
      const std::string value = out_.entry_argument(entry, i);
      return current_->is_varying(parameter) ? "ks::spread<" + t + ">(" + value + ")" : value;
    }
  }
}

bool WideEmitter::emit_group(size_t index) {
  const EntryPoint& entry = out_.module_.entry_points[index];
  const WideFunction* function = entries_[index];
  if (function == nullptr || entry.stage != kStageCompute) return false;
  const std::string number = std::to_string(index);
  const std::string size = std::to_string(entry.thread_group[0]) + ", " +
                           std::to_string(entry.thread_group[1]) + ", " +
                           std::to_string(entry.thread_group[2]);
  const uint64_t threads =
      uint64_t{entry.thread_group[0]} * entry.thread_group[1] * entry.thread_group[2];
  const std::string count = std::to_string(threads) + "u";
  const bool waves = entry.function->has_waves;
  const std::string name = (waves ? "lanes_" : "group_") + number;
  current_ = function;
  open("static void " + name +
       "(ks::Invocation& invocation, [[maybe_unused]] ks::ComputeGroup& group" +
       (waves ? ", uint32_t first) {" : ") {"));
  line("[[maybe_unused]] constexpr uint32_t size[3] = {" + size + "};");
  out_.emit_bound(entry);
  if (waves) {
    open("{");
  } else {
    open("for (uint32_t first = 0; first < " + count + "; first += ks::kLanes) {");
  }
  line("[[maybe_unused]] const ks::WideThread thread = ks::wide_thread(size, first);");
  line("u::WideContext ctx(invocation);");
  if (out_.binds_per_group_) line("ctx.bound = bound;");
  if (waves) {
    line("ctx.group = &group;");
    line("ctx.first = first;");
  }
  mask_ = "active";
  line("const ks::lanes active = ks::first_lanes(" + count + " - first);");
  emit_static_initialisers(*entry.function);
  std::string arguments = "ctx, active";
  for (size_t i = 0; i < entry.parameters.size(); ++i) {
    arguments += ", " + entry_argument(entry, i);
  }
  line("u::" + names_[function] + "(" + arguments + ");");
  close("}");
  close("}");
  line("static const ks::ComputeDesc compute_" + number + " = {{" + size +
       "}, sizeof(u::Shared), " + (waves ? "nullptr" : name) + ", nullptr" +
       out_.wave_facts(entry, waves ? name : "nullptr") + "};");
  current_ = nullptr;
  return true;
}

bool WideEmitter::emit_row(size_t index) {
  const EntryPoint& entry = out_.module_.entry_points[index];
  const WideFunction* function = entries_[index];
  if (function == nullptr || entry.stage != kStageRayGeneration) return false;
  current_ = function;
  open("static void row_" + std::to_string(index) +
       "(ks::Invocation& invocation, uint32_t count) {");
  line("const uint32_t first_x = invocation.index[0];");
  open("for (uint32_t first = 0; first < count; first += ks::kLanes) {");
  line("u::WideContext ctx(invocation);");
  line("ctx.first_x = invocation.index[0] = first_x + first;");
  line("ctx.rays_index = ks::wide_rays_index(invocation);");
  mask_ = "active";
  line("const ks::lanes active = ks::first_lanes(count - first);");
  emit_static_initialisers(*entry.function);
  line("u::" + names_[function] + "(ctx, active);");
  close("}");
  close("}");
  current_ = nullptr;
  return true;
}

}  // namespace kaamos::hlsl
