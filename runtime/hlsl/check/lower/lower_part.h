// SPDX-License-Identifier: MIT
//
// The parts of the lowerer, which call each other as expressions nest.
#pragma once

#include <initializer_list>
#include <string>

#include "runtime/hlsl/check/lower/body.h"
#include "runtime/hlsl/check/lower/values.h"
#include "runtime/hlsl/check/names/names.h"
#include "runtime/hlsl/check/names/workbench.h"

namespace kaamos::hlsl {

class Lowerer;

struct LowerPart {
  explicit LowerPart(Lowerer& lowerer);

 protected:
  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {}) {
    messages_.report(id, location, arguments);
  }
  ir::Location locate(SourceLocation location) { return messages_.locate(location); }
  void at(SourceLocation location) { build_.location = locate(location); }

  Lowerer& lower_;
  Body& body_;
  Names& names_;
  Workbench& bench_;
  Messages& messages_;
  TypeTable& types_;
  IrBuilder& build_;
};

}  // namespace kaamos::hlsl
