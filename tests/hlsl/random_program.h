// SPDX-License-Identifier: MIT
//
// Programs that nobody would write, on which executors must agree.
#pragma once

#include <cstdint>
#include <string>

namespace kaamos::test {

// A compute shader of 8 threads with the bindings of fixtures.h: random locals, structs, arrays,
// matrices, swizzles, functions with inout parameters, loops and switches. Kaamos' rules define the
// result of everything in it, including indices out of range and division by zero, and make it
// exact: floating-point arithmetic is limited to what can only round one way. Equal seeds give
// equal programs with the same compiler.
std::string random_program(uint64_t seed);

}  // namespace kaamos::test
