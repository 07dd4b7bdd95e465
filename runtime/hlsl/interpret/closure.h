// SPDX-License-Identifier: MIT
//
// Native functions made at run time that run an interpreted entry point.
#pragma once

#include <memory>

#include "runtime/hlsl/interpret/program.h"

namespace kaamos::hlsl::interpret {

class Closure {
 public:
  // Null if the system does not provide executable memory.
  static std::unique_ptr<Closure> create(const Program& program, const EntryCode& entry);
  ~Closure();
  Closure(const Closure&) = delete;
  Closure& operator=(const Closure&) = delete;

  // Has the ABI's type for the entry's stage; for compute, ComputeThreadFn if it has barriers, else
  // ComputeGroupFn; for pixels, PixelThreadFn if it has derivatives, else PixelFn.
  shader::AnyFn function() const { return function_; }

  struct Target {
    const Program* program = nullptr;
    const EntryCode* entry = nullptr;
  };

 private:
  Closure() = default;
  struct Call;
  std::unique_ptr<Call> call_;
  shader::AnyFn function_ = nullptr;
};

}  // namespace kaamos::hlsl::interpret
