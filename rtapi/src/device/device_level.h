// SPDX-License-Identifier: MIT
//
// What a device of a lower ray tracing tier or shader model refuses.
#pragma once

#include <string>
#include <string_view>

#include <kaamos/shader/abi.h>
#include <rtapi/device_level.h>
#include <rtapi/result.h>
#include <rtapi/shader_library.h>

namespace rtapi {
struct DeviceDesc;
}

namespace rtapi::detail {

struct DeviceImpl;

// Fails if the tier or the shader model is not offered, or the tier needs a higher shader model.
// [DXR: D3D12_RAYTRACING_TIER]
Status check_device_level(const DeviceDesc& desc);

// Returns "but this device was created with tier 1.0".
std::string but_tier(const DeviceImpl& device);

// Everything of ray tracing needs a device whose tier is not kNotSupported; `what` names it.
Status check_has_raytracing(const DeviceImpl& device, std::string_view what);

// A library needs a device of the shader model that it was compiled for.
// [D3D12: D3D12_FEATURE_DATA_SHADER_MODEL]
Status check_shader_model(const DeviceImpl& device, const ShaderLibrary& library);

// Inline ray tracing, and the SKIP ray flags where they are constants, need a device of tier 1.1.
// `where` names the export.
Status check_shader_tier(const DeviceImpl& device, const kaamos::shader::ExportDesc& code,
                         const std::string& where);

}  // namespace rtapi::detail
