// SPDX-License-Identifier: MIT
// Finds out what a device can do with a format, by trying it.
#pragma once

#include <directx/d3d12.h>

#include <rtapi/rtapi.h>

namespace kaamos::d3d12 {

/// Support1 and Support2 of a format. A format without information in rtapi supports nothing.
/// [D3D12: D3D12_FEATURE_DATA_FORMAT_SUPPORT]
D3D12_FEATURE_DATA_FORMAT_SUPPORT format_support(const rtapi::Device& device, DXGI_FORMAT format);

}  // namespace kaamos::d3d12
