// SPDX-License-Identifier: MIT
// What a method says that this library does not have.
#pragma once

#include <winerror.h>

namespace kaamos::d3d12 {

/// Reports KA4000 for a method, "ID3D12Device5::CreateMetaCommand": once for each method.
void missing(const char* method);
/// The same, and E_NOTIMPL.
HRESULT missing_result(const char* method);

}  // namespace kaamos::d3d12
