// SPDX-License-Identifier: MIT
//
// Programs that nobody would write, for executors to agree on.
#pragma once

#include <cstdint>
#include <string>

namespace kaamos::test {

// A compute shader of 8 threads with the bindings of fixtures.h: locals, structs, arrays, matrices,
// swizzles, functions with inout parameters, loops and switches at random. What it does is defined
// by Kaamos' rules for all of it, indices out of range and division by zero included, and exact:
// of floating-point arithmetic only what rounds one way. Equal seeds give equal programs, of one
// compiler.
std::string random_program(uint64_t seed);

}  // namespace kaamos::test
