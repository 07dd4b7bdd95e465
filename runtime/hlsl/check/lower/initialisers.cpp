// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/initialisers.h"

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {

void Initialisers::initialise(VariableInfo* variable) {
  if (variable->state == VariableInfo::State::kDone) return;
  if (variable->state == VariableInfo::State::kRunning) {
    report(CheckId::kSelfInitialised, variable->decl->location, {std::string(variable->name)});
    return;
  }
  variable->state = VariableInfo::State::kRunning;
  if (!variable->decl->initializer) {
    if (variable->is_const) {
      report(CheckId::kConstWithoutValue, variable->decl->location, {std::string(variable->name)});
    }
    variable->state = VariableInfo::State::kDone;
    return;
  }
  variable->initialiser_info = std::make_unique<FunctionInfo>();
  variable->initialiser = variable->initialiser_info.get();
  {
    const BodyScope saved(lower_, variable->initialiser_info.get(), &variable->start_up,
                          variable->scope);
    names_.see(variable->sequence);
    at(variable->decl->location);
    const ir::Expr* value =
        lower_.locals.initial_value(variable->decl->initializer, variable->type);
    if (value && !variable->start_up.empty()) {
      body_.assign(variable->variable, value);
    } else if (value) {
      variable->variable->initialiser = value;
      if (variable->is_const && is_constant(value)) {
        variable->variable->storage = ir::Storage::kConstant;
      }
    }
  }
  check_initialiser_imports(*variable);
  variable->state = VariableInfo::State::kDone;
}

// [DXC: static global initializers]
void Initialisers::check_initialiser_imports(const VariableInfo& variable) {
  if (!variable.initialiser) return;
  const std::vector<uint32_t> imports = imports_of(bench_.module, *variable.initialiser);
  if (imports.empty()) return;
  report(CheckId::kInitialiserImport, variable.decl->location,
         {std::string(variable.name), bench_.module.imports[imports[0]].signature});
}

}  // namespace kaamos::hlsl
