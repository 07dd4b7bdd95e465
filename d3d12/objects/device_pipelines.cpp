// SPDX-License-Identifier: MIT
// Root signatures, compute and graphics pipelines, libraries of them, command signatures.
#include <windows.h>

#include <algorithm>

#include <directx/d3dx12.h>

#include "d3d12/com/blob.h"
#include "d3d12/com/text.h"
#include "d3d12/container/container.h"
#include "d3d12/container/root_signature_blob.h"
#include "d3d12/container/shader_bytecode.h"
#include "d3d12/container/shader_source.h"
#include "d3d12/objects/cached_pipeline.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/pipeline_library.h"
#include "d3d12/objects/pipeline_objects.h"
#include "d3d12/objects/pipeline_stream.h"

namespace kaamos::d3d12 {

namespace {

// Returns whether a blob is a library that can only have a root signature as a subobject, which is
// no part of the container.
bool declares_root_signature(const void* blob, size_t size) {
  if (blob == nullptr) return false;
  const auto parts = read_container(blob, size);
  if (!parts) return false;
  const auto has = [&](uint32_t kind) {
    return std::any_of(parts->begin(), parts->end(),
                       [&](const Part& part) { return part.fourcc == kind; });
  };
  return has(kSourcePart) && !has(fourcc("RTS0"));
}

// A library's only global one. [D3D12: CreateRootSignature]
rtapi::Result<rtapi::RootSignature> declared_root_signature(const rtapi::Device& device,
                                                            const void* blob, size_t size,
                                                            Reporter& reporter) {
  const auto library = load_shader(blob, size, reporter);
  if (!library) return library.error();
  return device.CreateRootSignature(*library);
}

rtapi::Result<rtapi::RootSignature> serialized_root_signature(const rtapi::Device& device,
                                                              const void* blob, size_t size) {
  const auto desc = root_signature_of_blob(blob, size);
  if (!desc) return desc.error();
  return device.CreateRootSignature(*desc);
}

// The root signature that a pipeline names, or else that of one of its shaders.
// [D3D12: pRootSignature]
rtapi::Result<rtapi::RootSignature> root_signature_for(const rtapi::Device& device,
                                                       ID3D12RootSignature* named,
                                                       const D3D12_SHADER_BYTECODE& shader) {
  if (named != nullptr) return rtapi_root_signature(named);
  return serialized_root_signature(device, shader.pShaderBytecode, shader.BytecodeLength);
}

rtapi::BlendDesc blend_desc(const D3D12_BLEND_DESC& desc) {
  rtapi::BlendDesc out;
  out.AlphaToCoverageEnable = desc.AlphaToCoverageEnable != FALSE;
  out.IndependentBlendEnable = desc.IndependentBlendEnable != FALSE;
  for (size_t i = 0; i < out.RenderTarget.size(); ++i) {
    const D3D12_RENDER_TARGET_BLEND_DESC& from = desc.RenderTarget[i];
    rtapi::RenderTargetBlendDesc& to = out.RenderTarget[i];
    to.BlendEnable = from.BlendEnable != FALSE;
    to.LogicOpEnable = from.LogicOpEnable != FALSE;
    to.SrcBlend = static_cast<rtapi::Blend>(from.SrcBlend);
    to.DestBlend = static_cast<rtapi::Blend>(from.DestBlend);
    to.BlendOp = static_cast<rtapi::BlendOp>(from.BlendOp);
    to.SrcBlendAlpha = static_cast<rtapi::Blend>(from.SrcBlendAlpha);
    to.DestBlendAlpha = static_cast<rtapi::Blend>(from.DestBlendAlpha);
    to.BlendOpAlpha = static_cast<rtapi::BlendOp>(from.BlendOpAlpha);
    to.LogicOp = static_cast<rtapi::LogicOp>(from.LogicOp);
    to.RenderTargetWriteMask = static_cast<rtapi::ColorWriteEnable>(from.RenderTargetWriteMask);
  }
  return out;
}

rtapi::RasterizerDesc rasterizer_desc(const D3D12_RASTERIZER_DESC& desc) {
  rtapi::RasterizerDesc out;
  out.FillMode = static_cast<rtapi::FillMode>(desc.FillMode);
  out.CullMode = static_cast<rtapi::CullMode>(desc.CullMode);
  out.FrontCounterClockwise = desc.FrontCounterClockwise != FALSE;
  out.DepthBias = desc.DepthBias;
  out.DepthBiasClamp = desc.DepthBiasClamp;
  out.SlopeScaledDepthBias = desc.SlopeScaledDepthBias;
  out.DepthClipEnable = desc.DepthClipEnable != FALSE;
  out.MultisampleEnable = desc.MultisampleEnable != FALSE;
  return out;
}

rtapi::DepthStencilOpDesc stencil_face(const D3D12_DEPTH_STENCILOP_DESC1& desc) {
  rtapi::DepthStencilOpDesc out;
  out.StencilFailOp = static_cast<rtapi::StencilOp>(desc.StencilFailOp);
  out.StencilDepthFailOp = static_cast<rtapi::StencilOp>(desc.StencilDepthFailOp);
  out.StencilPassOp = static_cast<rtapi::StencilOp>(desc.StencilPassOp);
  out.StencilFunc = static_cast<rtapi::ComparisonFunc>(desc.StencilFunc);
  out.StencilReadMask = desc.StencilReadMask;
  out.StencilWriteMask = desc.StencilWriteMask;
  return out;
}

rtapi::DepthStencilDesc depth_stencil_desc(const D3D12_DEPTH_STENCIL_DESC2& desc) {
  rtapi::DepthStencilDesc out;
  out.DepthEnable = desc.DepthEnable != FALSE;
  out.DepthWriteMask = static_cast<rtapi::DepthWriteMask>(desc.DepthWriteMask);
  out.DepthFunc = static_cast<rtapi::ComparisonFunc>(desc.DepthFunc);
  out.StencilEnable = desc.StencilEnable != FALSE;
  out.FrontFace = stencil_face(desc.FrontFace);
  out.BackFace = stencil_face(desc.BackFace);
  return out;
}

// Refuses what rtapi's description has no member for. What it has a member for, rtapi refuses
// itself.
rtapi::Status check_graphics(const D3D12_GRAPHICS_PIPELINE_STATE_DESC& desc) {
  const auto refuse = [](const std::string& detail) {
    return rtapi::Status(make_error(ErrorId::kPipeline, detail));
  };
  if (desc.HS.BytecodeLength != 0 || desc.DS.BytecodeLength != 0) {
    return refuse("HS and DS: hull and domain shaders are not supported.");
  }
  if (desc.StreamOutput.NumEntries != 0 || desc.StreamOutput.NumStrides != 0) {
    return refuse("StreamOutput: there is no stream output here.");
  }
  if (desc.NumRenderTargets > D3D12_SIMULTANEOUS_RENDER_TARGET_COUNT) {
    return refuse("NumRenderTargets is " + std::to_string(desc.NumRenderTargets) +
                  "; there are at most 8.");
  }
  if (desc.RasterizerState.ConservativeRaster != D3D12_CONSERVATIVE_RASTERIZATION_MODE_OFF) {
    return refuse("RasterizerState.ConservativeRaster is on; it is not offered.");
  }
  if (desc.InputLayout.NumElements != 0 && desc.InputLayout.pInputElementDescs == nullptr) {
    return refuse("InputLayout.pInputElementDescs is null.");
  }
  return {};
}

}  // namespace

HRESULT Device::CreateRootSignature(UINT, const void* blob, SIZE_T size, REFIID riid,
                                    void** root_signature) {
  if (root_signature != nullptr) *root_signature = nullptr;
  auto made = declares_root_signature(blob, size)
                  ? declared_root_signature(device_, blob, size, reporter())
                  : serialized_root_signature(device_, blob, size);
  if (!made) return fail(made.error());
  return hand_out(new RootSignature(this, *made, root_signature_identity(blob, size)), riid,
                  root_signature);
}

HRESULT Device::CreateRootSignatureFromSubobjectInLibrary(UINT, const void* blob, SIZE_T size,
                                                          LPCWSTR subobject, REFIID riid,
                                                          void** root_signature) {
  if (root_signature != nullptr) *root_signature = nullptr;
  if (blob == nullptr || subobject == nullptr || *subobject == 0) {
    fail(ErrorId::kNullPointer,
         "CreateRootSignatureFromSubobjectInLibrary: pLibraryBlob or subobjectName, which has no "
         "default.");
    return E_INVALIDARG;
  }
  const auto library = load_shader(blob, size, reporter());
  if (!library) return fail(library.error());
  const std::string name = to_utf8(subobject);
  auto made = device_.CreateRootSignature(*library, name);
  if (!made) {
    fail(made.error());
    return E_INVALIDARG;
  }
  const std::string named = std::string(static_cast<const char*>(blob), size) + name;
  const Identity identity = root_signature_identity(named.data(), named.size());
  return hand_out(new RootSignature(this, *made, identity), riid, root_signature);
}

HRESULT Device::create_compute(const D3D12_COMPUTE_PIPELINE_STATE_DESC& desc, REFIID riid,
                               void** pipeline) {
  const Identity identity = pipeline_identity(desc);
  const HRESULT cached = check_cached_pipeline(device_, desc.CachedPSO, identity, reporter());
  if (FAILED(cached)) return cached;
  const auto shader = load_shader(desc.CS.pShaderBytecode, desc.CS.BytecodeLength, reporter());
  if (!shader) return fail(shader.error());
  const auto root_signature = root_signature_for(device_, desc.pRootSignature, desc.CS);
  if (!root_signature) return fail(root_signature.error());
  auto made =
      device_.CreateComputePipelineState({.pRootSignature = *root_signature, .CS = *shader});
  if (!made) return fail(made.error());
  return hand_out(new PipelineState(this, *made, identity), riid, pipeline);
}

HRESULT Device::create_graphics(const D3D12_GRAPHICS_PIPELINE_STATE_DESC& desc,
                                const D3D12_DEPTH_STENCIL_DESC2& depth_stencil, REFIID riid,
                                void** pipeline) {
  if (const rtapi::Status status = check_graphics(desc); !status) return fail(status.error());
  if (depth_stencil.DepthBoundsTestEnable != FALSE) {
    return fail(ErrorId::kPipeline, "DepthBoundsTestEnable is true; there is no such test here.");
  }
  const Identity identity = pipeline_identity(desc, depth_stencil);
  const HRESULT cached = check_cached_pipeline(device_, desc.CachedPSO, identity, reporter());
  if (FAILED(cached)) return cached;
  rtapi::GraphicsPipelineStateDesc out;
  for (auto [bytecode, shader] :
       {std::pair{&desc.VS, &out.VS}, std::pair{&desc.GS, &out.GS}, std::pair{&desc.PS, &out.PS}}) {
    if (bytecode->BytecodeLength == 0) continue;
    auto library = load_shader(bytecode->pShaderBytecode, bytecode->BytecodeLength, reporter());
    if (!library) return fail(library.error());
    shader->Library = *std::move(library);
  }
  const auto root_signature = root_signature_for(device_, desc.pRootSignature, desc.VS);
  if (!root_signature) return fail(root_signature.error());
  out.pRootSignature = *root_signature;
  out.BlendState = blend_desc(desc.BlendState);
  out.SampleMask = desc.SampleMask;
  out.RasterizerState = rasterizer_desc(desc.RasterizerState);
  out.DepthStencilState = depth_stencil_desc(depth_stencil);
  for (UINT i = 0; i < desc.InputLayout.NumElements; ++i) {
    const D3D12_INPUT_ELEMENT_DESC& element = desc.InputLayout.pInputElementDescs[i];
    out.InputLayout.push_back({element.SemanticName != nullptr ? element.SemanticName : "",
                               element.SemanticIndex, static_cast<rtapi::Format>(element.Format),
                               element.InputSlot, element.AlignedByteOffset,
                               static_cast<rtapi::InputClassification>(element.InputSlotClass),
                               element.InstanceDataStepRate});
  }
  out.IBStripCutValue = static_cast<rtapi::IndexBufferStripCutValue>(desc.IBStripCutValue);
  out.PrimitiveTopologyType = static_cast<rtapi::PrimitiveTopologyType>(desc.PrimitiveTopologyType);
  for (UINT i = 0; i < desc.NumRenderTargets; ++i) {
    out.RTVFormats.push_back(static_cast<rtapi::Format>(desc.RTVFormats[i]));
  }
  out.DSVFormat = static_cast<rtapi::Format>(desc.DSVFormat);
  out.SampleDesc = {std::max(desc.SampleDesc.Count, 1u), desc.SampleDesc.Quality};
  auto made = device_.CreateGraphicsPipelineState(out);
  if (!made) return fail(made.error());
  return hand_out(new PipelineState(this, *made, identity), riid, pipeline);
}

HRESULT Device::CreateComputePipelineState(const D3D12_COMPUTE_PIPELINE_STATE_DESC* desc,
                                           REFIID riid, void** pipeline) {
  if (pipeline != nullptr) *pipeline = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateComputePipelineState: pDesc.");
  return create_compute(*desc, riid, pipeline);
}

HRESULT Device::CreateGraphicsPipelineState(const D3D12_GRAPHICS_PIPELINE_STATE_DESC* desc,
                                            REFIID riid, void** pipeline) {
  if (pipeline != nullptr) *pipeline = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateGraphicsPipelineState: pDesc.");
  return create_graphics(*desc, CD3DX12_DEPTH_STENCIL_DESC2(desc->DepthStencilState), riid,
                         pipeline);
}

HRESULT Device::CreatePipelineState(const D3D12_PIPELINE_STATE_STREAM_DESC* desc, REFIID riid,
                                    void** pipeline) {
  if (pipeline != nullptr) *pipeline = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreatePipelineState: pDesc.");
  const auto parsed = parse_pipeline_stream(*desc, "CreatePipelineState");
  if (!parsed) return fail(parsed.error());
  if (parsed->compute) return create_compute(*parsed->compute, riid, pipeline);
  return create_graphics(*parsed->graphics, parsed->depth_stencil, riid, pipeline);
}

HRESULT PipelineState::GetCachedBlob(ID3DBlob** blob) {
  if (blob == nullptr) return fail(ErrorId::kNullPointer, "GetCachedBlob: ppBlob.");
  *blob = new Blob(write_cached_pipeline(rtapi_device(device()), identity_));
  return S_OK;
}

HRESULT Device::CreatePipelineLibrary(const void* blob, SIZE_T size, REFIID riid, void** library) {
  if (library != nullptr) *library = nullptr;
  NamedIdentities pipelines;
  if (size != 0) {  // an empty file, as programs map it, is an empty library
    const HRESULT result = read_pipeline_library(device_, blob, size, pipelines, reporter());
    if (FAILED(result)) return result;
  }
  return hand_out(new PipelineLibrary(this, pipelines), riid, library);
}

HRESULT Device::CreateCommandSignature(const D3D12_COMMAND_SIGNATURE_DESC* desc,
                                       ID3D12RootSignature* root_signature, REFIID riid,
                                       void** signature) {
  if (signature != nullptr) *signature = nullptr;
  if (desc == nullptr || (desc->NumArgumentDescs != 0 && desc->pArgumentDescs == nullptr)) {
    return fail(ErrorId::kNullPointer, "CreateCommandSignature: pDesc or pArgumentDescs.");
  }
  static_assert(sizeof(rtapi::IndirectArgumentDesc) == sizeof(D3D12_INDIRECT_ARGUMENT_DESC));
  const auto* arguments =
      reinterpret_cast<const rtapi::IndirectArgumentDesc*>(desc->pArgumentDescs);
  auto made = device_.CreateCommandSignature(
      {.ByteStride = desc->ByteStride,
       .ArgumentDescs = {arguments, arguments + desc->NumArgumentDescs}},
      rtapi_root_signature(root_signature));
  if (!made) return fail(made.error());
  return hand_out(new CommandSignature(this, *made), riid, signature);
}

}  // namespace kaamos::d3d12
