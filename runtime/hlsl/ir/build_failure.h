// SPDX-License-Identifier: MIT
//
// Why a library could not be made of sound IR.
#pragma once

#include <cstdint>
#include <string>

namespace kaamos::hlsl {

inline constexpr uint16_t kSpirvFailed = 2760;    // a fault of the emitter
inline constexpr uint16_t kSpirvBindings = 2761;  // more bindings than SPIR-V takes

struct BuildFailure {
  uint16_t id = 0;   // the number of rtapi/ERRORS.md; 0: it has none of its own
  std::string text;  // without the id; empty: no failure

  explicit operator bool() const { return !text.empty(); }
  // "KA2760 text", or the text alone.
  std::string message() const { return id == 0 ? text : "KA" + std::to_string(id) + " " + text; }
};

}  // namespace kaamos::hlsl
