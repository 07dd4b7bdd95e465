// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/check.h"

#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

Checker::Checker(const CheckOptions& options, const SourceManager& sources,
                 DiagnosticEngine& diagnostics)
    : options_(&options),
      sources_(sources),
      diagnostics_(diagnostics),
      module_(std::make_unique<ir::Module>()),
      ir_types_(*module_),
      types_(ir_types_),
      build_(*module_, ir_types_),
      lower_(*this) {
  global_ = make_scope(ScopeKind::kGlobal, nullptr);
  unit_scopes_ = {global_};
  lower_.scope_ = global_;
}

void Checker::report_with_notes(CheckId id, SourceLocation location,
                                const std::vector<std::string>& arguments,
                                const std::vector<std::pair<SourceLocation, std::string>>& notes) {
  const bool is_error =
      diagnostic_info(id).severity == DiagnosticClass::kError ||
      (diagnostic_info(id).severity == DiagnosticClass::kStrict && options_->strict);
  if (is_error) ++error_count_;
  if (muted_ > 0) return;
  has_errors_ = has_errors_ || is_error;
  // An expression that is lowered several times (a default argument, an initialiser) is reported
  // once.
  if (!reported_.insert({static_cast<uint32_t>(id), location.raw, arguments}).second) return;
  std::string_view views[8];
  const size_t count = std::min<size_t>(arguments.size(), 8);
  for (size_t i = 0; i < count; ++i) views[i] = arguments[i];
  auto report = [&] {
    switch (count) {
      case 0:
        return diagnostics_.report(id, location);
      case 1:
        return diagnostics_.report(id, location, {views[0]});
      case 2:
        return diagnostics_.report(id, location, {views[0], views[1]});
      case 3:
        return diagnostics_.report(id, location, {views[0], views[1], views[2]});
      case 4:
        return diagnostics_.report(id, location, {views[0], views[1], views[2], views[3]});
      default:
        return diagnostics_.report(id, location,
                                   {views[0], views[1], views[2], views[3], views[4]});
    }
  }();
  for (const auto& [note_location, text] : notes) report.note(note_location, text);
}

void Checker::report(CheckId id, SourceLocation location,
                     std::initializer_list<std::string> arguments) {
  report_with_notes(id, location, std::vector<std::string>(arguments), {});
}

ir::Location Checker::locate(SourceLocation location) {
  ir::Location result;
  if (!location.is_valid()) return result;
  const ResolvedLocation resolved = sources_.resolve(location);
  result.line = resolved.line;
  result.column = resolved.column;
  const auto [entry, is_new] =
      files_.try_emplace(std::string(resolved.path), static_cast<uint32_t>(module_->files.size()));
  if (is_new) module_->files.emplace_back(resolved.path);
  result.file = entry->second;
  return result;
}

std::unique_ptr<ir::Module> Checker::run(const TranslationUnit& unit) {
  module_->name = options_->name;
  module_->target = options_->target;
  declare_builtins();
  declare_all(unit.declarations, global_);
  check_initialisers();
  find_entry_points();
  if (options_->target.starts_with("lib")) add_library_functions();
  check_initialisers();
  finish();
  if (!has_errors()) check_payload_uses();
  if (!has_errors()) warn_skipped();
  if (has_errors() || diagnostics_.has_errors()) return nullptr;
  set_aside_unlinked(*module_);
  return std::move(module_);
}

std::unique_ptr<ir::Module> Checker::run(const Link& link) {
  link_ = &link;
  module_->name = options_->name;
  module_->target = options_->target;
  declare_builtins();
  builtin_symbols_ = global_->symbols;
  for (uint32_t unit = 0; unit < link.units.size(); ++unit) {
    if (unit > 0) {
      global_ = make_scope(ScopeKind::kGlobal, nullptr);
      global_->unit = unit;
      global_->symbols = builtin_symbols_;
      unit_scopes_.push_back(global_);
      globals_buffer_ = nullptr;
      globals_offset_ = 0;
    }
    enter_unit(unit);
    lower_.scope_ = global_;
    declare_all(link.units[unit].tree->declarations, global_);
  }
  assign_known_registers();
  enter_unit(0);
  lower_.scope_ = global_ = unit_scopes_[0];
  check_initialisers();
  find_entry_points();
  check_initialisers();
  finish();
  if (has_errors() || diagnostics_.has_errors()) return nullptr;
  return std::move(module_);
}

std::unique_ptr<ir::Module> check_linked(const Link& link, const SourceManager& sources,
                                         DiagnosticEngine& diagnostics) {
  Checker checker(link.units[0].options, sources, diagnostics);
  return checker.run(link);
}

std::unique_ptr<ir::Module> check(const TranslationUnit& unit, const CheckOptions& options,
                                  const SourceManager& sources, DiagnosticEngine& diagnostics) {
  Checker checker(options, sources, diagnostics);
  return checker.run(unit);
}

}  // namespace kaamos::hlsl
