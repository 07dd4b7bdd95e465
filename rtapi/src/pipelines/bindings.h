// SPDX-License-Identifier: MIT
//
// Finds the root argument that feeds each HLSL resource.
#pragma once

#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/result.h>
#include <rtapi/root_signature.h>

namespace rtapi::detail {

struct DeviceImpl;

// Returns one slot per binding of the library; bindings that the export does not reach stay
// unbound. Either signature may be empty. `where` names the export in messages. Parameters that are
// visible to another stage only are not looked at. [DXR: D3D12_LOCAL_ROOT_SIGNATURE]
Result<std::vector<kaamos::shader::BindingSlot>> resolve_bindings(
    const kaamos::shader::LibraryDesc& library, const kaamos::shader::ExportDesc& code,
    const RootSignature& global, const RootSignature& local, const std::string& where,
    ShaderVisibility stage = ShaderVisibility::kAll);

// Fails if both signatures define the same register. Either may be empty.
Status check_root_signatures_disjoint(const RootSignature& global, const RootSignature& local,
                                      const std::string& where);

}  // namespace rtapi::detail
