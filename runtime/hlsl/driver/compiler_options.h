// SPDX-License-Identifier: MIT
//
// The options with which the C++ compiler is called for emitted code at run time: those that
// kaamos_add_shader_library gives it at build time. The list is in cmake/KaamosShaders.cmake.
#pragma once

#include <string>
#include <vector>

#include <kaamos/shader/cpu_level.h>

namespace kaamos::hlsl {

enum class Optimisation {
  kNone,   // -O0
  kDebug,  // -Og -g
  kQuick,  // -O1
  kFull,   // as in a release build
};

// The options that a compiler knows.
enum class OptionSet {
  kGnu,  // those of g++ from version 12 on
  kAny,  // those of every g++ and clang: code is slower and does the same
};

// The options for code that runs at `level`; those that make a shared object of it are among them.
std::vector<std::string> compiler_options(Optimisation optimisation, OptionSet known,
                                          shader::CpuLevel level = shader::cpu_level());

}  // namespace kaamos::hlsl
