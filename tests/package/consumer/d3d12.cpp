// SPDX-License-Identifier: MIT
// A D3D12 program against an installed Kaamos: a device, and a ray tracing pipeline of a compiled
// library.
#include <D3D12.h>
#include <D3Dx12.h>
#include <Windows.h>
#include <wrl/client.h>

#include <cstdio>

#include "squares.hlsl.h"

using Microsoft::WRL::ComPtr;

int main() {
  ComPtr<ID3D12Device5> device;
  if (FAILED(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(&device)))) return 1;
  CD3DX12_ROOT_PARAMETER parameter;
  parameter.InitAsUnorderedAccessView(0);
  const CD3DX12_ROOT_SIGNATURE_DESC desc(1, &parameter);
  ComPtr<ID3DBlob> blob;
  if (FAILED(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, &blob, nullptr)))
    return 2;
  ComPtr<ID3D12RootSignature> root_signature;
  if (FAILED(device->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                         IID_PPV_ARGS(&root_signature)))) {
    return 3;
  }
  CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  const D3D12_SHADER_BYTECODE bytecode = {g_squares, sizeof(g_squares)};
  pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
  pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(4, 8);
  pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
  pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
      root_signature.Get());
  ComPtr<ID3D12StateObject> state_object;
  if (FAILED(device->CreateStateObject(pipeline, IID_PPV_ARGS(&state_object)))) return 4;
  ComPtr<ID3D12StateObjectProperties> properties;
  state_object.As(&properties);
  if (properties->GetShaderIdentifier(L"Squares") == nullptr) return 5;
  std::printf("D3D12: a pipeline with Squares\n");
  return 0;
}
