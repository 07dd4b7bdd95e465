// SPDX-License-Identifier: MIT
//
// All parts of the names room together.
#pragma once

#include <functional>

#include "runtime/hlsl/check/names/bindings.h"
#include "runtime/hlsl/check/names/declarations.h"
#include "runtime/hlsl/check/names/enums.h"
#include "runtime/hlsl/check/names/evaluator.h"
#include "runtime/hlsl/check/names/functions.h"
#include "runtime/hlsl/check/names/payload_rules.h"
#include "runtime/hlsl/check/names/program.h"
#include "runtime/hlsl/check/names/resolver.h"
#include "runtime/hlsl/check/names/specializations.h"
#include "runtime/hlsl/check/names/split_structs.h"
#include "runtime/hlsl/check/names/structs.h"
#include "runtime/hlsl/check/names/templates.h"
#include "runtime/hlsl/check/names/variables.h"

namespace kaamos::hlsl {

struct NameParts {
  NameParts(Program& in, Evaluator& with) : program(in), evaluator(with) {}
  NameParts(const NameParts&) = delete;
  NameParts& operator=(const NameParts&) = delete;

  Program& program;
  Evaluator& evaluator;
  std::function<void(const SubobjectDecl*)> on_subobject;  // in the order of the source

  Resolver resolver{*this};
  Declarations declarations{*this};
  Variables variables{*this};
  Functions functions{*this};
  Enums enums{*this};
  Structs structs{*this};
  PayloadRules payload_rules{*this};
  Templates templates{*this};
  Specializations specializations{*this};
  Bindings bindings{*this};
  SplitStructs split_structs{*this};
};

}  // namespace kaamos::hlsl
