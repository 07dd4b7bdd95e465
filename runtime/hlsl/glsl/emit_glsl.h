// SPDX-License-Identifier: MIT
//
// Prints one entry point of a module of the intermediate representation, and everything it reaches,
// as GLSL 4.60 with GL_EXT_ray_tracing on top of the prelude in runtime/hlsl/glsl/prelude. The
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
  // The number that spirv_interface.h gives to the specialization constant with constant_id i;
  // those numbers are beyond what glslang accepts.
  std::vector<uint32_t> constants;
};

// The module must have passed the checker without errors; emission cannot fail.
GlslShader emit_glsl(const ir::Module& module, const ir::EntryPoint& entry);

// The twin of an any-hit, intersection, closest-hit or miss shader, a callable shader that
// functions of HitObject run in its place: in libraries of Shader Model 6.9.
bool has_twin(const ir::Module& module, const ir::EntryPoint& entry);
GlslShader emit_glsl_twin(const ir::Module& module, const ir::EntryPoint& entry);

}  // namespace kaamos::hlsl
