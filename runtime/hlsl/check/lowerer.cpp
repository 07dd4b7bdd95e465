// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lowerer.h"

#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {

Lowerer::Lowerer(Checker& checker)
    : block_(&no_block_), checker_(checker), types_(checker.types_), build_(checker.build_) {}

void Lowerer::report(CheckId id, SourceLocation location,
                     std::initializer_list<std::string> arguments) {
  checker_.report(id, location, arguments);
}

ir::Location Lowerer::locate(SourceLocation location) {
  return checker_.locate(location);
}

bool Lowerer::has_errors() const {
  return checker_.has_errors();
}

}  // namespace kaamos::hlsl
