// SPDX-License-Identifier: MIT
#include "d3d12/objects/pipeline_identity.h"

#include <windows.h>

#include <string_view>
#include <type_traits>
#include <vector>

#include "d3d12/container/checksum.h"
#include "d3d12/objects/pipeline_objects.h"

namespace kaamos::d3d12 {
namespace {

// Descriptions have padding, so that their members are added one by one.
class Members {
 public:
  explicit Members(std::string_view kind) { add_bytes(kind.data(), kind.size()); }

  template <class... Values>
  void add(const Values&... values) {
    (add_value(values), ...);
  }
  // With its size, so that what follows cannot be taken for it.
  void add_bytes(const void* data, size_t size) {
    add_value(static_cast<uint64_t>(size));
    const auto* bytes = static_cast<const std::byte*>(data);
    if (bytes != nullptr) bytes_.insert(bytes_.end(), bytes, bytes + size);
  }
  void add_shader(const D3D12_SHADER_BYTECODE& shader) {
    add_bytes(shader.pShaderBytecode, shader.BytecodeLength);
  }
  void add_root_signature(ID3D12RootSignature* root_signature) {
    // Without one it is that of a shader, whose bytes are here.
    if (root_signature == nullptr) return add(false);
    add(true);
    for (uint32_t word : static_cast<RootSignature*>(root_signature)->identity()) add(word);
  }
  Identity identity() const { return md5(bytes_); }

 private:
  template <class Value>
  void add_value(const Value& value) {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }

  std::vector<std::byte> bytes_;
};

void add_blend(Members& members, const D3D12_BLEND_DESC& desc) {
  members.add(desc.AlphaToCoverageEnable, desc.IndependentBlendEnable);
  for (const D3D12_RENDER_TARGET_BLEND_DESC& target : desc.RenderTarget) {
    members.add(target.BlendEnable, target.LogicOpEnable, target.SrcBlend, target.DestBlend,
                target.BlendOp, target.SrcBlendAlpha, target.DestBlendAlpha, target.BlendOpAlpha,
                target.LogicOp, target.RenderTargetWriteMask);
  }
}

void add_depth_stencil(Members& members, const D3D12_DEPTH_STENCIL_DESC2& desc) {
  members.add(desc.DepthEnable, desc.DepthWriteMask, desc.DepthFunc, desc.StencilEnable,
              desc.DepthBoundsTestEnable);
  for (const D3D12_DEPTH_STENCILOP_DESC1& face : {desc.FrontFace, desc.BackFace}) {
    members.add(face.StencilFailOp, face.StencilDepthFailOp, face.StencilPassOp, face.StencilFunc,
                face.StencilReadMask, face.StencilWriteMask);
  }
}

void add_input_layout(Members& members, const D3D12_INPUT_LAYOUT_DESC& layout) {
  members.add(layout.NumElements);
  if (layout.pInputElementDescs == nullptr) return;
  for (UINT i = 0; i < layout.NumElements; ++i) {
    const D3D12_INPUT_ELEMENT_DESC& element = layout.pInputElementDescs[i];
    const std::string_view name = element.SemanticName != nullptr ? element.SemanticName : "";
    members.add_bytes(name.data(), name.size());
    members.add(element.SemanticIndex, element.Format, element.InputSlot, element.AlignedByteOffset,
                element.InputSlotClass, element.InstanceDataStepRate);
  }
}

void add_stream_output(Members& members, const D3D12_STREAM_OUTPUT_DESC& desc) {
  // A pipeline with more is not made.
  members.add(desc.NumEntries, desc.NumStrides, desc.RasterizedStream);
}

}  // namespace

Identity root_signature_identity(const void* blob, size_t size) {
  return blob == nullptr ? Identity{} : md5({static_cast<const std::byte*>(blob), size});
}

Identity pipeline_identity(const D3D12_COMPUTE_PIPELINE_STATE_DESC& desc) {
  Members members("compute");
  members.add_root_signature(desc.pRootSignature);
  members.add_shader(desc.CS);
  return members.identity();
}

Identity pipeline_identity(const D3D12_GRAPHICS_PIPELINE_STATE_DESC& desc,
                           const D3D12_DEPTH_STENCIL_DESC2& depth_stencil) {
  Members members("graphics");
  members.add_root_signature(desc.pRootSignature);
  for (const D3D12_SHADER_BYTECODE& shader : {desc.VS, desc.PS, desc.DS, desc.HS, desc.GS}) {
    members.add_shader(shader);
  }
  add_stream_output(members, desc.StreamOutput);
  add_blend(members, desc.BlendState);
  const D3D12_RASTERIZER_DESC& raster = desc.RasterizerState;
  members.add(desc.SampleMask, raster.FillMode, raster.CullMode, raster.FrontCounterClockwise,
              raster.DepthBias, raster.DepthBiasClamp, raster.SlopeScaledDepthBias,
              raster.DepthClipEnable, raster.MultisampleEnable, raster.AntialiasedLineEnable,
              raster.ForcedSampleCount, raster.ConservativeRaster);
  add_depth_stencil(members, depth_stencil);
  add_input_layout(members, desc.InputLayout);
  members.add(desc.IBStripCutValue, desc.PrimitiveTopologyType, desc.NumRenderTargets);
  for (const DXGI_FORMAT format : desc.RTVFormats) members.add(format);
  members.add(desc.DSVFormat, desc.SampleDesc.Count, desc.SampleDesc.Quality);
  return members.identity();
}

}  // namespace kaamos::d3d12
