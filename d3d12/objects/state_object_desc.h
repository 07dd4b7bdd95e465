// SPDX-License-Identifier: MIT
// Descriptions of state objects, from D3D12's to rtapi's.
#pragma once

#include <directx/d3d12.h>

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

/// Subobjects keep their order; associations, which point to a subobject, name
/// its index. As in native runtimes, a null local root signature
/// is an empty one, and a null global one is not there. Libraries are compiled or found in the
/// cache, with what load_shader tells `reporter`.
/// @errors KA4022 a subobject of an unknown type, a null pointer, an association with a subobject
/// that is not in the array; KA4020 bytecode; what compiling reports.
rtapi::Result<rtapi::StateObjectDesc> state_object_desc(const rtapi::Device& device,
                                                        const D3D12_STATE_OBJECT_DESC& desc,
                                                        Reporter& reporter);

}  // namespace kaamos::d3d12
