// SPDX-License-Identifier: MIT
//
// Which root argument feeds which HLSL resource.
#pragma once

#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/result.h>
#include <rtapi/root_signature.h>

namespace rtapi::detail {

struct DeviceImpl;

// One slot per binding of the library; those that the export does not reach stay unbound. Either
// signature may be empty. `where` names the export in messages. [DXR: D3D12_LOCAL_ROOT_SIGNATURE]
Result<std::vector<kaamos::shader::BindingSlot>> ResolveBindings(
    const kaamos::shader::LibraryDesc& library, const kaamos::shader::ExportDesc& code,
    const RootSignature& global, const RootSignature& local, const std::string& where);

// Registers that both define; ok if either is empty.
Status CheckRootSignaturesDisjoint(const RootSignature& global, const RootSignature& local,
                                   const std::string& where);

// Inline ray tracing and the SKIP ray flags, as far as they are constants, need a device of
// tier 1.1.
Status CheckTier(const DeviceImpl& device, const kaamos::shader::ExportDesc& code,
                 const std::string& where);

}  // namespace rtapi::detail
