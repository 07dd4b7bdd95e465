// SPDX-License-Identifier: MIT
//
// Why a library could not be built from valid IR.
#pragma once

#include <cstdint>
#include <string>

namespace kaamos::hlsl {

inline constexpr uint16_t kSpirvFailed = 2760;    // an error in the emitter
inline constexpr uint16_t kSpirvBindings = 2761;  // too many bindings for SPIR-V

struct BuildFailure {
  uint16_t id = 0;   // as in rtapi/ERRORS.md; 0: no id of its own
  std::string text;  // without the id; empty: no failure

  explicit operator bool() const { return !text.empty(); }
  // "KA2760 text", or the text alone.
  std::string message() const { return id == 0 ? text : "KA" + std::to_string(id) + " " + text; }
};

}  // namespace kaamos::hlsl
