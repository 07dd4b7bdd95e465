// SPDX-License-Identifier: MIT
// From DXC's arguments and a source to a container.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <rtapi/shader_compiler.h>

#include "d3d12/compiler/arguments.h"
#include "d3d12/container/container.h"

namespace kaamos::d3d12 {

inline constexpr uint32_t kHashPart = fourcc("HASH");

/// Part HASH, and DXC_OUT_SHADER_HASH. [DXC: DxcShaderHash]
struct ShaderHash {
  uint32_t flags = 0;
  std::array<uint32_t, 4> digest = {};
};

struct CompiledSource {
  bool ok = false;
  std::string messages;              // every diagnostic as DXC prints it
  std::vector<std::byte> container;  // empty on error
  // A container of the [RootSignature] of the entry point, or of the only one; else empty.
  std::vector<std::byte> root_signature;
  ShaderHash hash;
  rtapi::ShaderReflection reflection;
  std::vector<std::string> dependencies;  // every file read, the main one first
};

/// Checks the source and writes it into a container. The front end runs, which takes milliseconds;
/// code is made where the container is used.
CompiledSource compile_source(const DxcArguments& arguments);

struct PreprocessedSource {
  bool ok = false;
  std::string messages;
  std::string text;
};

/// -P: macros are expanded and files included.
PreprocessedSource preprocess_source(const DxcArguments& arguments);

/// A listing of exports and bindings, each line a comment of `;`.
std::string list_reflection(const rtapi::ShaderReflection& reflection, const std::string& target);

/// The bytes of a file; none if there is no such file, or it is a folder.
std::optional<std::string> read_file(const std::string& path);

}  // namespace kaamos::d3d12
