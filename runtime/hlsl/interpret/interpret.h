// SPDX-License-Identifier: MIT
//
// Runs the intermediate representation itself: the executor that needs no C++ compiler and can look
// at every step. A module becomes a living library of the ABI whose entry points are native
// function pointers, so that any backend that runs native code runs it without knowing.
//
// Values lie in memory as the C++ emitter's types do, so payloads, attributes and callable data
// pass between interpreted and compiled libraries; the arithmetic is that of the shader prelude.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::shader {
struct Invocation;
struct LibraryDesc;
}  // namespace kaamos::shader

namespace kaamos::hlsl {

// Where a shader stands when a hook is called.
struct InterpretPlace {
  const ir::Module* module = nullptr;
  const ir::EntryPoint* entry = nullptr;
  ir::Location location;
  const shader::Invocation* invocation = nullptr;
};

// What the interpreter saw a shader do that HLSL leaves undefined, and what it gave it instead.
enum class InterpretFinding : uint8_t {
  kIndexOutOfRange,  // of an array, vector or matrix: reads zero, writes nothing
  kNoRay,            // a system value of a ray where there is none: zero
  kStepLimit,        // the shader ran for too long: the device is removed
};

// Called on the thread that runs the shader, on several at once. Whoever listens keeps `user`
// alive as long as the library, and must not throw. Null members are not called.
struct InterpretHooks {
  void* user = nullptr;
  // Before each statement.
  void (*statement)(void* user, const InterpretPlace& place) = nullptr;
  void (*finding)(void* user, InterpretFinding finding, const InterpretPlace& place) = nullptr;
};

struct InterpretOptions {
  // Statements and turns of loops that one invocation may run; then the device is removed, so that
  // an endless loop ends. Half a minute or so.
  uint64_t step_limit = uint64_t{1} << 30;
  InterpretHooks hooks;
  // The SPIR-V of each entry point (spirv.h), for the table; empty: a library without it.
  std::vector<std::vector<uint32_t>> spirv;
};

// The library's table and all that it refers to. The table is valid as long as this object.
class InterpretedLibrary {
 public:
  // The module must come from the checker without errors. Null with `error` where the system does
  // not let a program make functions at run time.
  static std::shared_ptr<const InterpretedLibrary> create(std::shared_ptr<const ir::Module> module,
                                                          const InterpretOptions& options,
                                                          std::string& error);
  ~InterpretedLibrary();
  InterpretedLibrary(const InterpretedLibrary&) = delete;
  InterpretedLibrary& operator=(const InterpretedLibrary&) = delete;

  const shader::LibraryDesc& desc() const;

 private:
  InterpretedLibrary();
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

}  // namespace kaamos::hlsl
