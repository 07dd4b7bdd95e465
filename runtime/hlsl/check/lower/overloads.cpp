// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/overloads.h"

#include <algorithm>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/signatures.h"

namespace kaamos::hlsl {

namespace {

std::string describe(const std::vector<Value>& arguments) {
  std::string text = "(";
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) text += ", ";
    const Value& value = arguments[i];
    text += value.type                           ? to_string(value.type)
            : value.kind == ValueKind::kInitList ? "{..}"
            : value.kind == ValueKind::kHeap     ? "a heap element"
                                                 : "?";
  }
  return text + ")";
}

}  // namespace

bool Overloads::is_viable(FunctionInfo* function, const std::vector<Value>& arguments,
                          ConversionCost& cost) {
  const auto& parameters = function->parameters;
  if (function->signature_failed || arguments.size() > parameters.size()) return false;
  for (size_t i = arguments.size(); i < parameters.size(); ++i) {
    if (!parameters[i].default_value) return false;
  }
  cost = 0;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Value& argument = arguments[i];
    const ParameterInfo& parameter = parameters[i];
    if (parameter.is_in) {
      const ConversionRank in = lower_.conversions.rank(argument, parameter.type);
      if (!in.possible) return false;
      cost += in.cost;
    }
    if (parameter.is_out && !argument.failed()) {
      if (!argument.type) return false;
      const ConversionRank out = lower_.conversions.rank(parameter.type, argument.type);
      if (!out.possible) return false;
      cost += out.cost;
    }
  }
  return true;
}

FunctionInfo* Overloads::resolve_overload(const std::vector<FunctionInfo*>& candidates,
                                          const NamePart& part, const std::vector<Value>& arguments,
                                          SourceLocation location, bool quiet,
                                          ConversionCost* lowest) {
  struct Viable {
    FunctionInfo* function;
    ConversionCost cost;
    bool is_instance;
  };
  std::vector<Viable> viable;
  for (FunctionInfo* candidate : candidates) {
    if (candidate->sequence > names_.view().visible) continue;
    FunctionInfo* function = candidate;
    if (candidate->is_template) {
      function =
          names_.instantiate_function(candidate, part.template_arguments, body_.scope, arguments);
      if (!function) continue;
    } else if (part.has_template_arguments) {
      continue;
    }
    ConversionCost cost = 0;
    if (is_viable(function, arguments, cost)) {
      const bool repeated = std::any_of(viable.begin(), viable.end(), [&](const Viable& other) {
        return other.function == function;
      });
      if (!repeated) viable.push_back({function, cost, candidate->is_template});
    }
  }
  // Between equal costs, a function that is not a template wins; DXC calls them ambiguous.
  const auto better = [](const Viable& a, const Viable& b) {
    return a.cost < b.cost || (a.cost == b.cost && !a.is_instance && b.is_instance);
  };
  std::vector<const Viable*> best;
  for (const Viable& one : viable) {
    const bool beaten = std::any_of(viable.begin(), viable.end(), [&](const Viable& other) {
      return &other != &one && better(other, one);
    });
    if (!beaten) best.push_back(&one);
  }
  if (best.size() == 1) {
    const bool ties = std::any_of(viable.begin(), viable.end(), [&](const Viable& other) {
      return &other != best[0] && other.cost == best[0]->cost;
    });
    if (ties && !quiet) {
      report(CheckId::kAmbiguousStrict, location,
             {std::string(part.identifier), describe(arguments)});
    }
    if (lowest) *lowest = best[0]->cost;
    return best[0]->function;
  }
  if (quiet) return nullptr;
  const std::string name(part.identifier);
  std::vector<std::pair<SourceLocation, std::string>> notes;
  if (!best.empty()) {
    for (const Viable* one : best) {
      notes.push_back({one->function->decl->location, "candidate: " + describe(*one->function)});
    }
    messages_.report_with_notes(CheckId::kAmbiguousCall, location, {name, describe(arguments)},
                                notes);
    return nullptr;
  }
  for (const FunctionInfo* candidate : candidates) {
    if (!candidate->other_stage) continue;
    names_.resolve_type(candidate->other_stage, candidate->scope);
    return nullptr;
  }
  for (FunctionInfo* candidate : candidates) {
    if (notes.size() == 8) break;
    const bool hidden = candidate->sequence > names_.view().visible;
    notes.push_back({candidate->decl->location,
                     (hidden ? "declared only here: " : "candidate: ") + describe(*candidate)});
  }
  messages_.report_with_notes(CheckId::kNoOverload, location, {name, describe(arguments)}, notes);
  return nullptr;
}

}  // namespace kaamos::hlsl
