// SPDX-License-Identifier: MIT
//
// The parts of the names room, which call each other: a type may define a struct, whose template
// may have to be instantiated, whose arguments are types.
#pragma once

#include <initializer_list>
#include <string>

#include "runtime/hlsl/check/names/program.h"

namespace kaamos::hlsl {

struct NameParts;

struct NamesPart {
  explicit NamesPart(NameParts& parts);

 protected:
  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {}) {
    messages_.report(id, location, arguments);
  }
  ir::Location locate(SourceLocation location) { return messages_.locate(location); }
  void at(SourceLocation location) { build_.location = locate(location); }

  NameParts& parts_;
  Program& program_;
  Workbench& bench_;
  Scopes& scopes_;
  Messages& messages_;
  TypeTable& types_;
  IrBuilder& build_;
};

}  // namespace kaamos::hlsl
