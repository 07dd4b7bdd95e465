// SPDX-License-Identifier: MIT
// The private part of a shader's container: the options and every file that the compiler read, so
// that the shader can be compiled for either backend where it is used.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <rtapi/shader_compiler.h>

#include "d3d12/container/container.h"

namespace kaamos::d3d12 {

inline constexpr uint32_t kSourcePart = fourcc("KAAM");

/// Returns whether a part is of the kind that a program asks for. The source stands for DXIL.
inline bool is_part(const Part& part, uint32_t kind) {
  return part.fourcc == kind || (kind == fourcc("DXIL") && part.fourcc == kSourcePart);
}

struct ShaderSource {
  rtapi::ShaderCompileOptions options;  // Source holds the main file; ReadFile is empty
  std::vector<rtapi::ShaderSourceFile> files;
};

std::vector<std::byte> write_source(const ShaderSource& source);
/// @errors KA4020 the part was made by another version of this library, or is damaged.
rtapi::Result<ShaderSource> read_source(std::span<const std::byte> part);

/// The source of a container.
/// @errors KA4020 it is no container, or one of another compiler.
rtapi::Result<ShaderSource> source_of_container(const void* bytes, size_t size);

/// The options with the files as what `#include` finds.
rtapi::ShaderCompileOptions compile_options(ShaderSource source);

}  // namespace kaamos::d3d12
