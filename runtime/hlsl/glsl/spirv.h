// SPDX-License-Identifier: MIT
//
// From GLSL to SPIR-V, with glslang as a library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/glsl/emit_glsl.h"
#include "runtime/hlsl/ir/build_failure.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct SpirvModule {
  std::vector<uint32_t> words;  // empty on failure
  BuildFailure error;           // kSpirvFailed: the export, glslang's messages; kSpirvBindings
};

// The module is for Vulkan 1.3 and its entry point is "main". `name` is the export, for the error.
SpirvModule compile_spirv(const GlslShader& shader, const std::string& name);

// Every entry point of a module, in order. The error is that of the first one that fails.
struct SpirvLibrary {
  std::vector<std::vector<uint32_t>> modules;
  BuildFailure error;
};
SpirvLibrary compile_spirv(const ir::Module& module);

// Identifies how GLSL becomes SPIR-V, including glslang's version, for cache keys.
std::string spirv_version();

// Changes glslang's output to mean what HLSL means: floating-point operations are not contracted or
// rearranged and keep NaNs, infinities and the sign of zero; specialization constants get their
// numbers; names and other debug information are removed.
std::vector<uint32_t> finish_spirv(const std::vector<uint32_t>& words,
                                   const std::vector<uint32_t>& constants);

}  // namespace kaamos::hlsl
