// SPDX-License-Identifier: MIT
//
// The base that the parts which make entry points share.
#pragma once

#include <initializer_list>
#include <string>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/program.h"

namespace kaamos::hlsl {

struct StagePart {
  StagePart(Program& program, Lowerer& lowerer)
      : program_(program),
        bench_(program.bench),
        lower_(lowerer),
        messages_(bench_.messages),
        types_(bench_.types),
        build_(bench_.build) {}

 protected:
  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {}) {
    messages_.report(id, location, arguments);
  }
  ir::Location locate(SourceLocation location) { return messages_.locate(location); }
  void at(SourceLocation location) { build_.location = locate(location); }

  Program& program_;
  Workbench& bench_;
  Lowerer& lower_;
  Messages& messages_;
  TypeTable& types_;
  IrBuilder& build_;
};

}  // namespace kaamos::hlsl
