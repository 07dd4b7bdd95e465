// SPDX-License-Identifier: MIT
//
// HLSL's operators, conversions, intrinsics and resource accesses as GLSL functions: what
// kaamos/shader/prelude.h is for emitted C++. The text is in runtime/hlsl/glsl; its README tells
// what is there and how the blocks are written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kaamos::hlsl {

struct GlslPrelude {
  std::string text;                  // #extension lines, then declarations
  std::vector<std::string> missing;  // k_* names of `body` that the prelude lacks
};

// What a shader of text `body` needs before it, behind `#version` and before anything else: the
// definitions of the names k_* that occur in it, and of what these use. Overloads for 16-bit,
// 64-bit integer and double types are there if the body speaks of such a type; so an ordinary
// shader asks for no capability that it does not use.
GlslPrelude glsl_prelude(std::string_view body);

// Names of all blocks, in the order of the text, each once.
std::vector<std::string> glsl_prelude_names();

}  // namespace kaamos::hlsl
