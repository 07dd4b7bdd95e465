// SPDX-License-Identifier: MIT
//
// Type-checks a syntax tree and lowers it to the intermediate representation.
//
// Signatures, types and globals are always checked; the body of a function only if an entry point
// or an exported function reaches it.
#pragma once

#include <memory>

#include "runtime/hlsl/check/names/options.h"
#include "runtime/hlsl/front/ast.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

class DiagnosticEngine;
class SourceManager;

std::unique_ptr<ir::Module> check_linked(const Link& link, const SourceManager& sources,
                                         DiagnosticEngine& diagnostics);

// Returns null after an error, which is then in the engine. A function without a body that the code
// of a library calls becomes an import.
std::unique_ptr<ir::Module> check(const TranslationUnit& unit, const CheckOptions& options,
                                  const SourceManager& sources, DiagnosticEngine& diagnostics);

}  // namespace kaamos::hlsl
