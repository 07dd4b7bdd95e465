// SPDX-License-Identifier: MIT
//
// Prints one entry point of a module of the intermediate representation as GLSL 4.60 with
// GL_EXT_ray_tracing: what the entry point reaches, on top of the prelude of runtime/hlsl/glsl. The
// interface with a backend is <kaamos/shader/spirv_interface.h>.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct GlslShader {
  std::string text;
  uint32_t stage = 0;  // one ir::StageBits
  // What the specialization constant with constant_id i stands for: the number that
  // spirv_interface.h gives it, which is beyond what glslang takes.
  std::vector<uint32_t> constants;
};

// The module must come from the checker without errors; emission cannot fail.
GlslShader emit_glsl(const ir::Module& module, const ir::EntryPoint& entry);

}  // namespace kaamos::hlsl
