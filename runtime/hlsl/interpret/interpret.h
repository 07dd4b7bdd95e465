// SPDX-License-Identifier: MIT
//
// Runs the intermediate representation directly. This executor needs no C++ compiler and can
// observe every step. A module becomes a library of the ABI in memory whose entry points are native
// function pointers, so any backend that runs native code can run it unchanged.
//
// Values are laid out as the C++ emitter's types are, so payloads, attributes and callable data
// pass between interpreted and compiled libraries; the arithmetic is that of the shader prelude.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/hlsl/ir/ir.h"
#include "runtime/hlsl/ir/result.h"

namespace kaamos::shader {
struct CoverageDesc;
struct Invocation;
struct LibraryDesc;
}  // namespace kaamos::shader

namespace kaamos::hlsl {

// The position in a shader when a hook is called.
struct InterpretPlace {
  const ir::Module* module = nullptr;
  const ir::EntryPoint* entry = nullptr;
  ir::Location location;
  const shader::Invocation* invocation = nullptr;
};

// Something a shader did that HLSL leaves undefined, and how the interpreter handled it.
enum class InterpretFinding : uint8_t {
  kIndexOutOfRange,  // of an array, vector or matrix: reads zero, writes nothing
  kNoRay,            // a ray system value where there is no ray: zero
  kStepLimit,        // the shader ran for too long: the device is removed
};

// Called on the thread that runs the shader, possibly on several at once. The owner of `user` must
// keep it alive as long as the library. Hooks must not throw. Null members are not called.
struct InterpretHooks {
  void* user = nullptr;
  // Before each statement.
  void (*statement)(void* user, const InterpretPlace& place) = nullptr;
  void (*finding)(void* user, InterpretFinding finding, const InterpretPlace& place) = nullptr;
};

struct InterpretOptions {
  // Number of statements and loop iterations that one invocation may run before the device is
  // removed, so that an endless loop ends. The default takes about half a minute.
  uint64_t step_limit = uint64_t{1} << 30;
  InterpretHooks hooks;
  // The SPIR-V of each entry point (spirv.h), for the table; if empty, the library has none.
  std::vector<std::vector<uint32_t>> spirv;
};

// The library's table and everything it refers to. The table is valid as long as this object.
class InterpretedLibrary {
 public:
  // The module must have passed the checker without errors. Fails if the system does not
  // allow functions to be made at run time.
  static Result<std::shared_ptr<const InterpretedLibrary>> create(
      std::shared_ptr<const ir::Module> module, const InterpretOptions& options);
  ~InterpretedLibrary();
  InterpretedLibrary(const InterpretedLibrary&) = delete;
  InterpretedLibrary& operator=(const InterpretedLibrary&) = delete;

  const shader::LibraryDesc& desc() const;
  const shader::CoverageDesc* coverage() const;  // null: the module has none

 private:
  InterpretedLibrary();
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

}  // namespace kaamos::hlsl
