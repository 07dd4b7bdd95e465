// SPDX-License-Identifier: MIT
// ID3D12Debug: whether devices get the debug layer.
#pragma once

#include <directx/d3d12.h>

namespace kaamos::d3d12 {

/// Returns whether devices that are made from now on have the debug layer, which is rtapi's checked
/// mode: after EnableDebugLayer, or where the environment variable KAAMOS_D3D12_DEBUG is 1.
bool debug_layer_enabled();

/// The debug object as the interface asked for.
HRESULT get_debug_interface(REFIID riid, void** debug);

}  // namespace kaamos::d3d12
