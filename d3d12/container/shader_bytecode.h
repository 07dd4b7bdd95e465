// SPDX-License-Identifier: MIT
// From the bytes that programs pass as D3D12_SHADER_BYTECODE to a library.
#pragma once

#include <cstddef>

#include <rtapi/shader_library.h>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

/// Compiles what a container of kaamos-dxc or of this library's dxcompiler holds, for both
/// backends. The same bytes give the same library for as long as the process lives, on any thread,
/// and a compiled one comes from rtapi's cache on disk. Where it cannot be built (KA2750, KA2751)
/// the shader is interpreted; the `reporter` of the first call with these bytes gets KA4025.
/// @errors KA4020 the bytes are no such container; what rtapi::CompileShaderLibrary refuses.
rtapi::Result<rtapi::ShaderLibrary> load_shader(const void* bytes, size_t size, Reporter& reporter);

}  // namespace kaamos::d3d12
