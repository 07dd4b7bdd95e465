// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::test {

// Runs each entry point of the module once by the interpreter: resources are small buffers and
// textures of one colour, rays hit nothing, a few thousand steps are enough. Whatever the shader
// does, it must stay inside its memory. Empty, or what went wrong.
std::string interpret_input(std::shared_ptr<const hlsl::ir::Module> module);

}  // namespace kaamos::test
