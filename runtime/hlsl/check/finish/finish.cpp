// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/finish/finish.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/builder/finish/payload_uses.h"
#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {
namespace {

constexpr size_t kNamesShown = 5;

class Reports final : public FinishReport, public PayloadReport {
 public:
  explicit Reports(Messages& messages) : messages_(messages) {}

  bool has_errors() const override { return messages_.has_any_errors(); }

  ir::Location locate(SourcePlace place) override { return messages_.locate({place}); }

  void stage_use(const StageUse& use, const ir::EntryPoint& entry) override {
    if (!reported_.insert({use.place, entry.stage}).second) return;
    if (use.is_implicit_level && entry.stage != ir::kStageVertex) {
      messages_.report(CheckId::kImplicitLevel, {use.place}, {std::string(use.name)});
      return;
    }
    messages_.report(use.is_lenient ? CheckId::kStageStrict : CheckId::kStage, {use.place},
                     {std::string(use.name), stage_list(use.stages),
                      std::string(stage_name(entry.stage)), entry.name});
  }

  void no_quads(const StageUse& use, const ir::EntryPoint& entry) override {
    if (use.is_implicit_level) return stage_use(use, entry);
    if (!reported_.insert({use.place, entry.stage}).second) return;
    std::string size;
    for (const uint32_t number : entry.thread_group) {
      size += (size.empty() ? "" : ", ") + std::to_string(number);
    }
    messages_.report(CheckId::kNoQuads, {use.place}, {std::string(use.name), entry.name, size});
  }

  // The memory that the groups of one shader share is limited. [D3D12]
  void reached(const std::vector<GlobalFacts*>& globals, const ir::EntryPoint& entry) override {
    uint64_t bytes = 0;
    const VariableInfo* last = nullptr;
    for (const GlobalFacts* global : globals) {
      if (global->variable->storage != ir::Storage::kGroupShared) continue;
      const auto* variable = static_cast<const VariableInfo*>(global);
      bytes += layout_of(variable->type, ir::Layout::kStructured).size;
      if (!last || last->decl->location.raw < variable->decl->location.raw) last = variable;
    }
    if (bytes <= entry.groupshared_limit) return;
    messages_.report(CheckId::kGroupsharedSize, last->decl->location,
                     {entry.name, std::to_string(bytes), std::to_string(entry.groupshared_limit)});
  }

  void no_register(const BindingFacts& binding) override {
    messages_.report(CheckId::kNoRegister, {binding.place}, {binding.name});
  }

  void overlap(const BindingFacts& first, const BindingFacts& second,
               const std::string& shared_register, const ir::EntryPoint& entry) override {
    messages_.report_with_notes(
        CheckId::kOverlap, {second.place},
        {second.name, first.name, shared_register, std::to_string(second.space), entry.name},
        {{{first.place}, "'" + first.name + "' is declared here"}});
  }

  void payload_fault(PayloadFault fault, SourcePlace place, std::string_view field,
                     uint8_t stage) override {
    const std::string name(field);
    switch (fault) {
      case PayloadFault::kDropped:
        return messages_.report(CheckId::kPayloadDropped, {place},
                                {name, payload_stage_name(stage)});
      case PayloadFault::kDataLoss:
        return messages_.report(CheckId::kPayloadDataLoss, {place},
                                {name, payload_stage_name(stage)});
      case PayloadFault::kNotReturned:
        return messages_.report(CheckId::kPayloadNotReturned, {place}, {name});
      case PayloadFault::kUndefined:
        return messages_.report(CheckId::kPayloadUndefined, {place},
                                {name, payload_stage_name(stage)});
      case PayloadFault::kNotPassed:
        return messages_.report(CheckId::kPayloadNotPassed, {place}, {name});
    }
  }

 private:
  Messages& messages_;
  std::set<std::pair<uint32_t, uint32_t>> reported_;
};

}  // namespace

void Finish::run() {
  for (FunctionInfo* function : lower_.calls.lowered) program_.facts.functions.push_back(function);
  for (VariableInfo& variable : program_.variables) {
    if (variable.kind == VariableKind::kGlobal) program_.facts.globals.push_back(&variable);
  }
  for (BindingInfo& binding : program_.bindings) program_.facts.bindings.push_back(&binding);
  program_.facts.reserve_unused = program_.options->reserve_unused;
  program_.facts.is_helper = bench_.is_helper;
  program_.facts.square_quads = shader_model_minor(program_.options->target) >= 6;
  Reports reports(messages_);
  check_resources();
  finish_module(bench_.module, build_, program_.facts, reports);
  check_input_reads();
  check_unreached();
}

// Parameters of functions that a pixel shader calls are no inputs.
void Finish::check_input_reads() {
  for (const FunctionInfo& function : program_.functions) {
    if (function.is_pixel_entry || (function.stages & ir::kStagePixel) == 0) continue;
    for (const InputRead& read : function.input_reads) {
      report(CheckId::kVertexAttribute, read.location,
             {read.of_vertices ? "GetAttributeAtVertex" : "EvaluateAttribute",
              "an input of the pixel shader itself"});
    }
  }
}

// What a static resource refers to has to be said somewhere.
void Finish::check_resources() {
  for (const VariableInfo& variable : program_.variables) {
    const bool is_used = variable.kind == VariableKind::kGlobal && variable.variable &&
                         variable.type && variable.decl && !variable.decl->initializer &&
                         variable.references != 0;
    if (is_used && contains_resource(variable.type) &&
        !lower_.places.is_assigned(variable.variable)) {
      report(CheckId::kUnassignedResource, variable.decl->location, {std::string(variable.name)});
    }
  }
}

// DXC checks what no entry point reaches, too.
void Finish::check_unreached() {
  if (!program_.options->strict || program_.link) return;
  messages_.enter_unreached();
  lower_unreached();
  messages_.leave_unreached();
}

// Functions that nothing reaches have lines, too; mistakes in them do not count.
void Finish::cover_unreached() {
  if (!program_.options->coverage || program_.link) return;
  messages_.mute();
  lower_unreached();
  messages_.unmute();
}

void Finish::lower_unreached() {
  const size_t imports = bench_.module.imports.size();
  const size_t prints = bench_.module.prints.size();
  for (size_t i = 0; i < program_.functions.size(); ++i) {
    FunctionInfo& function = program_.functions[i];
    const bool is_whole = function.definition && !function.is_template &&
                          function.template_suffix.empty() && !function.signature_failed &&
                          std::none_of(function.parameters.begin(), function.parameters.end(),
                                       [](const ParameterInfo& one) { return one.is_unbounded(); });
    if (is_whole && function.state == FunctionInfo::State::kPending) {
      lower_.calls.lower_function(&function, function.definition->location);
    }
  }
  bench_.module.imports.resize(imports);
  bench_.module.prints.resize(prints);
}

void Finish::check_payload_uses() {
  if (bench_.payloads.structs.empty()) return;
  Reports reports(messages_);
  for (const auto& [facts, index] : program_.facts.entries) {
    const ir::EntryPoint& entry = bench_.module.entry_points[index];
    if (!entry.imports.empty() || !facts->ir) continue;
    const FunctionInfo& function = *static_cast<const FunctionInfo*>(facts);
    const ir::Struct* payload = nullptr;
    SourceLocation parameter;
    if (payload_stage_of(entry.stage) != kPayloadCaller && !function.parameters.empty()) {
      const StructInfo& structure = *function.parameters[0].type->structure;
      if (structure.is_payload) payload = structure.ir;
      parameter = function.parameters[0].decl->location;
    }
    hlsl::check_payload_uses(bench_.payloads, *function.ir, entry.stage, payload, parameter.raw,
                             reports);
  }
}

void Finish::warn_skipped() {
  size_t count = 0;
  std::string names;
  SourceLocation first;
  for (const FunctionInfo& function : program_.functions) {
    const bool skipped = function.definition && !function.is_template &&
                         function.template_suffix.empty() &&
                         function.state == FunctionInfo::State::kPending;
    // It is normal that a library does not use everything in the files it includes.
    if (!skipped || messages_.sources().include_location(function.definition->location).is_valid())
      continue;
    if (count == 0) first = function.definition->location;
    if (count < kNamesShown) names += (count ? ", " : "") + function.qualified;
    ++count;
  }
  if (count == 0) return;
  if (count > kNamesShown) names += ", ..";
  report(CheckId::kSkipped, first, {std::to_string(count), names});
}

}  // namespace kaamos::hlsl
