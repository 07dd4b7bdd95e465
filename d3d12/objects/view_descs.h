// SPDX-License-Identifier: MIT
// Descriptions of views and samplers, from D3D12's to rtapi's.
#pragma once

#include <directx/d3d12.h>

#include <rtapi/rtapi.h>

namespace kaamos::d3d12 {

/// Each refuses dimensions that rtapi does not offer (several samples, 1-D and 3-D targets).
/// @errors KA4013.
///@{
rtapi::Result<rtapi::ShaderResourceViewDesc> view_desc(const D3D12_SHADER_RESOURCE_VIEW_DESC& desc);
rtapi::Result<rtapi::UnorderedAccessViewDesc> view_desc(
    const D3D12_UNORDERED_ACCESS_VIEW_DESC& desc);
rtapi::Result<rtapi::RenderTargetViewDesc> view_desc(const D3D12_RENDER_TARGET_VIEW_DESC& desc);
rtapi::Result<rtapi::DepthStencilViewDesc> view_desc(const D3D12_DEPTH_STENCIL_VIEW_DESC& desc);
///@}

rtapi::SamplerDesc sampler_desc(const D3D12_SAMPLER_DESC& desc);

}  // namespace kaamos::d3d12
