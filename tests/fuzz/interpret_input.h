// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::test {

// Runs each entry point of the module once in the interpreter, for at most a few thousand steps:
// resources are small buffers and textures of a single colour, and rays hit nothing. Whatever the
// shader does, it must stay inside its memory. Returns what went wrong; empty if nothing did.
std::string interpret_input(std::shared_ptr<const hlsl::ir::Module> module);

}  // namespace kaamos::test
