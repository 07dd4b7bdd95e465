// SPDX-License-Identifier: MIT
// ID3D12ShaderReflection and ID3D12LibraryReflection of a container.
#pragma once

#include <cstddef>

#include <directx/d3d12.h>

namespace kaamos::d3d12 {

/// Reads the sources of a container again, which takes milliseconds. A library has
/// ID3D12LibraryReflection, another profile ID3D12ShaderReflection.
HRESULT create_reflection(const void* bytes, size_t size, REFIID riid, void** reflection);

}  // namespace kaamos::d3d12
