// SPDX-License-Identifier: MIT
//
// Wave operations, and the paths that say which lanes take part (wave_paths.h).
#include "runtime/hlsl/cpp/emitter.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {

using namespace ir;

std::string CppEmitter::wave_facts(const EntryPoint& entry, const std::string& lanes) {
  if (!entry.function->has_waves && entry.most_wave_lanes == 0) return "";
  return ", " + lanes + (entry.function->has_waves ? ", true, " : ", false, ") +
         std::to_string(entry.least_wave_lanes) + ", " + std::to_string(entry.most_wave_lanes);
}

std::string CppEmitter::wave_depth(const Stmt& stmt, uint32_t more) const {
  return "ctx.wave_depth + " + std::to_string(wave_paths_.find(stmt)->depth + more) + "u";
}

void CppEmitter::enter_wave_path(const Stmt& stmt) {
  line("ctx.wave_path[" + wave_depth(stmt, 0) +
       "] = " + std::to_string(wave_paths_.find(stmt)->number) + "u;");
}

void CppEmitter::enter_wave_call(const Stmt& stmt) {
  const WavePlace* const place = wave_paths_.find(stmt);
  if (place == nullptr) return;
  enter_wave_path(stmt);
  line("ctx.wave_depth += " + std::to_string(place->depth + 1) + "u;");
}

void CppEmitter::leave_wave_call(const Stmt& stmt) {
  const WavePlace* const place = wave_paths_.find(stmt);
  if (place != nullptr) line("ctx.wave_depth -= " + std::to_string(place->depth + 1) + "u;");
}

void CppEmitter::enter_wave_loop(const Stmt& stmt) {
  if (wave_paths_.find(stmt) == nullptr) return;
  enter_wave_path(stmt);
  line("ctx.wave_path[" + wave_depth(stmt, 1) + "] = 0u;");
}

void CppEmitter::begin_wave_iteration(const Stmt& stmt) {
  if (wave_paths_.find(stmt) != nullptr) line("++ctx.wave_path[" + wave_depth(stmt, 1) + "];");
}

std::string CppEmitter::wave_operation(const Stmt& stmt) const {
  return "/*" + std::string(wave_function_name(stmt.wave)) + "*/ ks::WaveOp{" +
         std::to_string(static_cast<int>(stmt.wave)) + "}";
}

void CppEmitter::wave(const Stmt& stmt) {
  enter_wave_path(stmt);
  std::string text = "ks::wave_operation<" + wave_operation(stmt) + ", " + type(stmt.result->type);
  if (!stmt.operands.empty()) text += ", " + type(stmt.operands[0]->type);
  text += ">(ctx.invocation, ctx.group, ctx.wave_path, " + wave_depth(stmt, 1);
  for (const Expr* operand : stmt.operands) text += ", " + value(operand);
  line(variable(stmt.result) + " = " + text + ");");
}

}  // namespace kaamos::hlsl
