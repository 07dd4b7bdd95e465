// SPDX-License-Identifier: MIT
#include "d3d12/objects/view_descs.h"

#include <algorithm>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

namespace {

rtapi::Error no_dimension(const char* kind, UINT dimension) {
  return make_error(ErrorId::kView, std::string(kind) + " dimension " + std::to_string(dimension) +
                                        " is not offered: targets are 2-D textures and arrays of "
                                        "them.");
}

}  // namespace

rtapi::Result<rtapi::ShaderResourceViewDesc> view_desc(
    const D3D12_SHADER_RESOURCE_VIEW_DESC& desc) {
  rtapi::ShaderResourceViewDesc out;
  out.Format = static_cast<rtapi::Format>(desc.Format);
  out.ViewDimension = static_cast<rtapi::SrvDimension>(desc.ViewDimension);
  out.Shader4ComponentMapping = desc.Shader4ComponentMapping;
  switch (desc.ViewDimension) {
    case D3D12_SRV_DIMENSION_BUFFER:
      out.Buffer = {desc.Buffer.FirstElement, desc.Buffer.NumElements,
                    desc.Buffer.StructureByteStride,
                    static_cast<rtapi::BufferSrvFlags>(desc.Buffer.Flags)};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE1D:
      out.Texture1D = {desc.Texture1D.MostDetailedMip, desc.Texture1D.MipLevels,
                       desc.Texture1D.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE1DARRAY:
      out.Texture1DArray = {desc.Texture1DArray.MostDetailedMip, desc.Texture1DArray.MipLevels,
                            desc.Texture1DArray.FirstArraySlice, desc.Texture1DArray.ArraySize,
                            desc.Texture1DArray.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE2D:
      out.Texture2D = {desc.Texture2D.MostDetailedMip, desc.Texture2D.MipLevels,
                       desc.Texture2D.PlaneSlice, desc.Texture2D.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE2DARRAY:
      out.Texture2DArray = {
          desc.Texture2DArray.MostDetailedMip, desc.Texture2DArray.MipLevels,
          desc.Texture2DArray.FirstArraySlice, desc.Texture2DArray.ArraySize,
          desc.Texture2DArray.PlaneSlice,      desc.Texture2DArray.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE2DMS:
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE2DMSARRAY:
      out.Texture2DMSArray = {desc.Texture2DMSArray.FirstArraySlice,
                              desc.Texture2DMSArray.ArraySize};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURE3D:
      out.Texture3D = {desc.Texture3D.MostDetailedMip, desc.Texture3D.MipLevels,
                       desc.Texture3D.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURECUBE:
      out.TextureCube = {desc.TextureCube.MostDetailedMip, desc.TextureCube.MipLevels,
                         desc.TextureCube.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_TEXTURECUBEARRAY:
      out.TextureCubeArray = {
          desc.TextureCubeArray.MostDetailedMip, desc.TextureCubeArray.MipLevels,
          desc.TextureCubeArray.First2DArrayFace, desc.TextureCubeArray.NumCubes,
          desc.TextureCubeArray.ResourceMinLODClamp};
      return out;
    case D3D12_SRV_DIMENSION_RAYTRACING_ACCELERATION_STRUCTURE:
      out.RaytracingAccelerationStructure = {desc.RaytracingAccelerationStructure.Location};
      return out;
    default:
      return no_dimension("shader resource view", desc.ViewDimension);
  }
}

rtapi::Result<rtapi::UnorderedAccessViewDesc> view_desc(
    const D3D12_UNORDERED_ACCESS_VIEW_DESC& desc) {
  rtapi::UnorderedAccessViewDesc out;
  out.Format = static_cast<rtapi::Format>(desc.Format);
  out.ViewDimension = static_cast<rtapi::UavDimension>(desc.ViewDimension);
  switch (desc.ViewDimension) {
    case D3D12_UAV_DIMENSION_BUFFER:
      out.Buffer = {desc.Buffer.FirstElement, desc.Buffer.NumElements,
                    desc.Buffer.StructureByteStride, desc.Buffer.CounterOffsetInBytes,
                    static_cast<rtapi::BufferUavFlags>(desc.Buffer.Flags)};
      return out;
    case D3D12_UAV_DIMENSION_TEXTURE1D:
      out.Texture1D = {desc.Texture1D.MipSlice};
      return out;
    case D3D12_UAV_DIMENSION_TEXTURE1DARRAY:
      out.Texture1DArray = {desc.Texture1DArray.MipSlice, desc.Texture1DArray.FirstArraySlice,
                            desc.Texture1DArray.ArraySize};
      return out;
    case D3D12_UAV_DIMENSION_TEXTURE2D:
      out.Texture2D = {desc.Texture2D.MipSlice, desc.Texture2D.PlaneSlice};
      return out;
    case D3D12_UAV_DIMENSION_TEXTURE2DARRAY:
      out.Texture2DArray = {desc.Texture2DArray.MipSlice, desc.Texture2DArray.FirstArraySlice,
                            desc.Texture2DArray.ArraySize, desc.Texture2DArray.PlaneSlice};
      return out;
    case D3D12_UAV_DIMENSION_TEXTURE3D:
      out.Texture3D = {desc.Texture3D.MipSlice, desc.Texture3D.FirstWSlice, desc.Texture3D.WSize};
      return out;
    default:
      return no_dimension("unordered access view", desc.ViewDimension);
  }
}

rtapi::Result<rtapi::RenderTargetViewDesc> view_desc(const D3D12_RENDER_TARGET_VIEW_DESC& desc) {
  rtapi::RenderTargetViewDesc out;
  out.Format = static_cast<rtapi::Format>(desc.Format);
  out.ViewDimension = static_cast<rtapi::RtvDimension>(desc.ViewDimension);
  switch (desc.ViewDimension) {
    case D3D12_RTV_DIMENSION_UNKNOWN:
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE1D:
      out.Texture2DArray.MipSlice = desc.Texture1D.MipSlice;
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE1DARRAY:
      out.Texture2DArray = {desc.Texture1DArray.MipSlice, desc.Texture1DArray.FirstArraySlice,
                            desc.Texture1DArray.ArraySize};
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE3D:
      out.Texture2DArray = {desc.Texture3D.MipSlice, desc.Texture3D.FirstWSlice,
                            desc.Texture3D.WSize};
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE2D:
      out.Texture2DArray.MipSlice = desc.Texture2D.MipSlice;
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE2DARRAY:
      out.Texture2DArray = {desc.Texture2DArray.MipSlice, desc.Texture2DArray.FirstArraySlice,
                            desc.Texture2DArray.ArraySize};
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE2DMS:
      return out;
    case D3D12_RTV_DIMENSION_TEXTURE2DMSARRAY:
      out.Texture2DArray = {0, desc.Texture2DMSArray.FirstArraySlice,
                            desc.Texture2DMSArray.ArraySize};
      return out;
    default:
      return no_dimension("render target view", desc.ViewDimension);
  }
}

rtapi::Result<rtapi::DepthStencilViewDesc> view_desc(const D3D12_DEPTH_STENCIL_VIEW_DESC& desc) {
  rtapi::DepthStencilViewDesc out;
  out.Format = static_cast<rtapi::Format>(desc.Format);
  out.ViewDimension = static_cast<rtapi::DsvDimension>(desc.ViewDimension);
  out.Flags = static_cast<rtapi::DsvFlags>(desc.Flags);
  switch (desc.ViewDimension) {
    case D3D12_DSV_DIMENSION_UNKNOWN:
      return out;
    case D3D12_DSV_DIMENSION_TEXTURE2D:
      out.Texture2DArray.MipSlice = desc.Texture2D.MipSlice;
      return out;
    case D3D12_DSV_DIMENSION_TEXTURE2DARRAY:
      out.Texture2DArray = {desc.Texture2DArray.MipSlice, desc.Texture2DArray.FirstArraySlice,
                            desc.Texture2DArray.ArraySize};
      return out;
    case D3D12_DSV_DIMENSION_TEXTURE2DMS:
      return out;
    case D3D12_DSV_DIMENSION_TEXTURE2DMSARRAY:
      out.Texture2DArray = {0, desc.Texture2DMSArray.FirstArraySlice,
                            desc.Texture2DMSArray.ArraySize};
      return out;
    default:
      return no_dimension("depth-stencil view", desc.ViewDimension);
  }
}

rtapi::SamplerDesc sampler_desc(const D3D12_SAMPLER_DESC& desc) {
  rtapi::SamplerDesc out;
  out.Filter = static_cast<rtapi::Filter>(desc.Filter);
  out.AddressU = static_cast<rtapi::TextureAddressMode>(desc.AddressU);
  out.AddressV = static_cast<rtapi::TextureAddressMode>(desc.AddressV);
  out.AddressW = static_cast<rtapi::TextureAddressMode>(desc.AddressW);
  out.MipLODBias = desc.MipLODBias;
  out.MaxAnisotropy = desc.MaxAnisotropy;
  out.ComparisonFunc = static_cast<rtapi::ComparisonFunc>(desc.ComparisonFunc);
  std::copy_n(desc.BorderColor, 4, out.BorderColor);
  out.MinLOD = desc.MinLOD;
  out.MaxLOD = desc.MaxLOD;
  return out;
}

}  // namespace kaamos::d3d12
