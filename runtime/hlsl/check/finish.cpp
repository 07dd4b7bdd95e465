// SPDX-License-Identifier: MIT
// What the whole module shows: builder/finish finds it, here are the words.
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {
namespace {

constexpr size_t kNamesShown = 5;

}  // namespace

class Checker::Reports final : public FinishReport, public PayloadReport {
 public:
  explicit Reports(Checker& checker) : checker_(checker) {}

  bool has_errors() const override {
    return checker_.has_errors_ || checker_.diagnostics_.has_errors();
  }

  ir::Location locate(SourcePlace place) override { return checker_.locate({place}); }

  void stage_use(const StageUse& use, const ir::EntryPoint& entry) override {
    if (!reported_.insert({use.place, entry.stage}).second) return;
    if (use.is_implicit_level && entry.stage != ir::kStageVertex) {
      checker_.report(CheckId::kImplicitLevel, {use.place}, {std::string(use.name)});
      return;
    }
    checker_.report(CheckId::kStage, {use.place},
                    {std::string(use.name), stage_list(use.stages),
                     std::string(stage_name(entry.stage)), entry.name});
  }

  void no_register(const BindingFacts& binding) override {
    checker_.report(CheckId::kNoRegister, {binding.place}, {binding.name});
  }

  void overlap(const BindingFacts& first, const BindingFacts& second,
               const std::string& shared_register, const ir::EntryPoint& entry) override {
    checker_.report_with_notes(
        CheckId::kOverlap, {second.place},
        {second.name, first.name, shared_register, std::to_string(second.space), entry.name},
        {{{first.place}, "'" + first.name + "' is declared here"}});
  }

  void payload_fault(PayloadFault fault, SourcePlace place, std::string_view field,
                     uint8_t stage) override {
    const std::string name(field);
    switch (fault) {
      case PayloadFault::kDropped:
        return checker_.report(CheckId::kPayloadDropped, {place},
                               {name, payload_stage_name(stage)});
      case PayloadFault::kDataLoss:
        return checker_.report(CheckId::kPayloadDataLoss, {place},
                               {name, payload_stage_name(stage)});
      case PayloadFault::kNotReturned:
        return checker_.report(CheckId::kPayloadNotReturned, {place}, {name});
      case PayloadFault::kUndefined:
        return checker_.report(CheckId::kPayloadUndefined, {place},
                               {name, payload_stage_name(stage)});
      case PayloadFault::kNotPassed:
        return checker_.report(CheckId::kPayloadNotPassed, {place}, {name});
    }
  }

 private:
  Checker& checker_;
  std::set<std::pair<uint32_t, uint32_t>> reported_;
};

void Checker::finish() {
  for (FunctionInfo* function : lower_.lowered_functions_) facts_.functions.push_back(function);
  for (VariableInfo& variable : variables_) {
    if (variable.kind == VariableKind::kGlobal) facts_.globals.push_back(&variable);
  }
  for (BindingInfo& binding : bindings_) facts_.bindings.push_back(&binding);
  Reports reports(*this);
  finish_module(*module_, build_, facts_, reports);
}

void Checker::check_payload_uses() {
  if (payloads_.structs.empty()) return;
  Reports reports(*this);
  for (const auto& [facts, index] : facts_.entries) {
    const ir::EntryPoint& entry = module_->entry_points[index];
    if (!entry.imports.empty() || !facts->ir) continue;
    const FunctionInfo& function = *static_cast<const FunctionInfo*>(facts);
    const ir::Struct* payload = nullptr;
    SourceLocation parameter;
    if (payload_stage_of(entry.stage) != kPayloadCaller && !function.parameters.empty()) {
      const StructInfo& structure = *function.parameters[0].type->structure;
      if (structure.is_payload) payload = structure.ir;
      parameter = function.parameters[0].decl->location;
    }
    hlsl::check_payload_uses(payloads_, *function.ir, entry.stage, payload, parameter.raw, reports);
  }
}

void Checker::warn_skipped() {
  size_t count = 0;
  std::string names;
  SourceLocation first;
  for (const FunctionInfo& function : functions_) {
    const bool skipped = function.definition && !function.is_template &&
                         function.template_suffix.empty() &&
                         function.state == FunctionInfo::State::kPending;
    // It is normal that a library does not use everything in the files it includes.
    if (!skipped || sources_.include_location(function.definition->location).is_valid()) continue;
    if (count == 0) first = function.definition->location;
    if (count < kNamesShown) names += (count ? ", " : "") + function.qualified;
    ++count;
  }
  if (count == 0) return;
  if (count > kNamesShown) names += ", ..";
  report(CheckId::kSkipped, first, {std::to_string(count), names});
}

}  // namespace kaamos::hlsl
