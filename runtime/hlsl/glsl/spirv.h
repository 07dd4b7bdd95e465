// SPDX-License-Identifier: MIT
//
// From GLSL to SPIR-V, by glslang as a library.
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

// The entry point of the module is "main", for Vulkan 1.3. `name` is the export's, for the error.
SpirvModule compile_spirv(const GlslShader& shader, const std::string& name);

// Every entry point of a module, in its order. The error is the first one's.
struct SpirvLibrary {
  std::vector<std::vector<uint32_t>> modules;
  BuildFailure error;
};
SpirvLibrary compile_spirv(const ir::Module& module);

// Names how GLSL becomes SPIR-V, glslang's version included, for keys of caches.
std::string spirv_version();

// What glslang gives, changed to mean what HLSL means: floating-point operations are not contracted
// or rearranged and keep NaNs, infinities and the sign of zero; specialization constants get their
// numbers; names and other debug information go.
std::vector<uint32_t> finish_spirv(const std::vector<uint32_t>& words,
                                   const std::vector<uint32_t>& constants);

}  // namespace kaamos::hlsl
