// SPDX-License-Identifier: MIT
//
// HLSL's operators, conversions, intrinsics and resource accesses as GLSL functions: what
// kaamos/shader/prelude.h is for emitted C++. The text is in runtime/hlsl/glsl/prelude; the README
// there says what it contains and how the blocks are written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kaamos::hlsl {

struct GlslPrelude {
  std::string text;                  // #extension lines, then declarations
  std::vector<std::string> missing;  // k_* names in `body` that the prelude lacks
};

// Returns what a shader with the text `body` needs directly after `#version`: the definitions of
// the k_* names in it, and of those they use. Overloads for 16-bit, 64-bit integer and double types
// are included only if the body mentions such a type, so that an ordinary shader requires no
// capability that it does not use.
GlslPrelude glsl_prelude(std::string_view body);

// The names of all blocks in text order, without duplicates.
std::vector<std::string> glsl_prelude_names();

}  // namespace kaamos::hlsl
