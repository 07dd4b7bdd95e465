// SPDX-License-Identifier: MIT
#include <algorithm>

#include "runtime/hlsl/interpret/compiler.h"
#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using namespace ir;

Extent Compiler::extent_of(const Type* type) {
  Extent out = program_.layouts.extent_of(type);
  if (out.bytes > kMaxValueBytes) {
    program_.error = "a variable or a value has more than " + std::to_string(kMaxValueBytes) +
                     " bytes; make it smaller or use a C++ compiler instead of the interpreter";
    out.bytes = 0;
  }
  return out;
}

uint32_t Compiler::place(Extent extent, uint32_t& end) {
  const uint32_t offset = align(end, extent.alignment);
  end = offset + extent.bytes;
  if (end > 4 * kMaxValueBytes) {
    program_.error = "the variables of a function, or the globals, have more than " +
                     std::to_string(4 * kMaxValueBytes) +
                     " bytes; use a C++ compiler instead of the interpreter";
    end = 0;
  }
  return offset;
}

std::vector<Move> Compiler::moves_of(const Type* type, Layout layout, bool row_major) {
  std::vector<Move> out = program_.layouts.moves_of(type, layout, row_major);
  if (out.size() > kMaxMoves) {
    program_.error = "a load or store moves more than " + std::to_string(kMaxMoves) +
                     " values; use a C++ compiler instead of the interpreter";
  }
  return out;
}

uint32_t Compiler::declare(const Variable* variable, bool reference) {
  const Extent extent = reference ? Extent{8, 8} : extent_of(variable->type);
  const uint32_t offset = place(extent, variable_bytes_);
  places_[variable] = {offset, reference, nullptr};
  return offset;
}

const Action* Compiler::action(const Stmt& stmt) {
  Action& out = program_.actions.emplace_back();
  out.stmt = &stmt;
  out.place_in_wave = program_.wave_paths->find(stmt);
  out.prelude = block(stmt.prelude);  // declares what the loop's condition reads
  temporary_bytes_ = 0;
  out.place = node(stmt.place);
  out.value = node(stmt.value);
  out.compare = node(stmt.compare);
  for (const Expr* operand : stmt.operands) out.operands.push_back(node(operand));
  for (const Expr* argument : stmt.arguments) out.arguments.push_back(node(argument));
  if (stmt.result != nullptr) out.result = variable_node(stmt.result, nullptr);
  switch (stmt.kind) {
    case StmtKind::kDeclare:
      // After the initialiser: in `float x = x`, it means the outer x.
      out.offset = declare(stmt.variable, false);
      out.bytes = bytes_of(stmt.variable->type);
      break;
    case StmtKind::kStore:
    case StmtKind::kStoreElement:
      out.moves = moves_of(stmt.value->type, stmt.layout, stmt.row_major);
      out.access = access_of(stmt.value->type, stmt.layout, stmt.row_major);
      break;
    case StmtKind::kAtomic:
      out.access = access_of(stmt.value->type, Layout::kStructured, false);
      out.atomic = find_atomic(stmt.atomic, stmt.value->type->scalar);
      break;
    case StmtKind::kCall:
      out.callee = codes_[stmt.function];
      callee_stack_bytes_ = std::max(callee_stack_bytes_, out.callee->stack_bytes);
      reads_hit_kind_ = reads_hit_kind_ || out.callee->reads_hit_kind;
      statics_.insert(out.callee->statics.begin(), out.callee->statics.end());
      break;
    default:
      break;
  }
  out.body = block(stmt.body);
  out.orelse = block(stmt.orelse);
  out.step = block(stmt.step);
  for (const SwitchCase& c : stmt.cases) {
    out.cases.push_back({c.labels, c.is_default, block(c.body)});
  }
  return &out;
}

Actions Compiler::block(const Block& body) {
  Actions out;
  for (const Stmt* stmt : body) out.push_back(action(*stmt));
  return out;
}

void Compiler::function(const Function& function) {
  variable_bytes_ = temporary_bytes_ = most_temporary_bytes_ = callee_stack_bytes_ = 0;
  reads_hit_kind_ = false;
  statics_.clear();
  Code& code = program_.codes.emplace_back();
  code.function = &function;
  for (const Variable* parameter : function.parameters) {
    code.parameters.push_back(declare(parameter, parameter->mode != ParameterMode::kIn));
    code.parameter_bytes.push_back(bytes_of(parameter->type));
  }
  code.body = block(function.body);
  code.variable_bytes = align(variable_bytes_, 16);
  code.temporary_bytes = align(most_temporary_bytes_, 16);
  code.result_bytes = bytes_of(function.result);
  code.stack_bytes = code.variable_bytes + code.temporary_bytes + callee_stack_bytes_ + 16;
  for (const Variable* variable : program_.module->globals) {
    if (statics_.count(variable) != 0) code.statics.push_back(variable);
  }
  code.reads_hit_kind = reads_hit_kind_;
  codes_[&function] = &code;
}

EntryCode Compiler::entry(const EntryPoint& entry) {
  EntryCode out;
  out.entry = &entry;
  out.code = codes_[entry.function];
  out.path_words = program_.wave_paths->length(*entry.function);
  for (size_t i = 0; i < entry.parameters.size() && entry.is_graphics(); ++i) {
    out.output_offsets.push_back(out.output_bytes);
    if (entry.parameters[i] == EntryParameter::kOutput) {
      out.output_bytes += align(bytes_of(entry.function->parameters[i]->type), 16);
    }
  }
  out.payload_bytes = entry.payload != nullptr ? bytes_of(entry.payload) : 0;
  most_temporary_bytes_ = 0;
  statics_.clear();
  statics_.insert(out.code->statics.begin(), out.code->statics.end());
  // In reverse order, because an initialiser reads globals that come before it.
  std::vector<StaticInitialiser> backwards;
  const auto& globals = program_.module->globals;
  for (auto it = globals.rbegin(); it != globals.rend(); ++it) {
    const Variable* variable = *it;
    if (variable->storage != Storage::kStaticGlobal || statics_.count(variable) == 0) continue;
    temporary_bytes_ = 0;
    backwards.push_back(
        {node(variable->initialiser), places_[variable].offset, bytes_of(variable->type)});
  }
  out.statics.assign(backwards.rbegin(), backwards.rend());
  out.temporary_bytes = align(most_temporary_bytes_, 16);
  out.static_bytes = out.statics.empty() ? 0 : program_.static_bytes;
  return out;
}

void Compiler::place_globals() {
  for (const Variable* variable : program_.module->globals) {
    const Extent extent = extent_of(variable->type);
    Place& global = places_[variable];
    if (variable->storage == Storage::kConstant) {
      // Its initialiser consists of constants, so it is evaluated here, once.
      std::vector<std::byte>& bytes = program_.constants.emplace_back(std::max(extent.bytes, 1u));
      global.data = bytes.data();
      if (variable->initialiser == nullptr) continue;
      temporary_bytes_ = 0;
      const Node* value = node(variable->initialiser);
      if (!program_.error.empty()) return;
      std::vector<std::byte> temporaries(temporary_bytes_ + 16);
      Context context;
      context.program = &program_;
      Frame frame{&context, nullptr, temporaries.data(), nullptr};
      std::copy_n(evaluate(*value, frame), extent.bytes, bytes.data());
      continue;
    }
    global.offset =
        place(extent, variable->storage == Storage::kGroupShared ? program_.shared_bytes
                                                                 : program_.static_bytes);
  }
  program_.shared_bytes = std::max(align(program_.shared_bytes, 16), 1u);
  program_.static_bytes = align(program_.static_bytes, 16);
}

void Compiler::run() {
  place_globals();
  if (!program_.error.empty()) return;
  for (const Function* each : program_.module->functions) function(*each);
  for (const EntryPoint& each : program_.module->entry_points) {
    program_.entries.push_back(entry(each));
  }
}

std::unique_ptr<Program> make_program(std::shared_ptr<const Module> module,
                                      const InterpretOptions& options) {
  auto program = std::make_unique<Program>();
  program->module = std::move(module);
  program->options = options;
  program->checked = program->module->check_access;
  program->covered = std::make_unique<uint8_t[]>(program->module->coverage.size());
  program->wave_paths = std::make_unique<WavePaths>(*program->module);
  Compiler(*program).run();
  return program;
}

}  // namespace kaamos::hlsl::interpret
