// SPDX-License-Identifier: MIT
// A program of a Visual Studio project: every part of the project that the import must bring is
// needed.
#include <d3d12.h>
#include <d3dx12.h>
#include <windows.h>
#include <wrl/client.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "CompiledShaders\Squares.hlsl.h"

#if !defined(UNICODE) || ANSWER != 42 || FORCED != 7
#error "the project's definitions and forced include are missing"
#endif

using Microsoft::WRL::ComPtr;

// What the file holds that the project puts beside the program.
std::vector<char> beside(const std::string& name) {
  WCHAR path[512];
  const DWORD length = GetModuleFileName(nullptr, path, 512);
  std::string folder(path, path + length);
  folder.resize(folder.find_last_of("/\\") + 1);
  std::ifstream in(folder + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

int main() {
  if (beside("copied.txt").empty() || beside("src/data/kept.txt").empty()) return 1;
  ComPtr<ID3D12Device5> device;
  if (FAILED(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(&device)))) return 2;
  CD3DX12_ROOT_PARAMETER parameter;
  parameter.InitAsUnorderedAccessView(0);
  const CD3DX12_ROOT_SIGNATURE_DESC desc(1, &parameter);
  ComPtr<ID3DBlob> blob;
  D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, &blob, nullptr);
  ComPtr<ID3D12RootSignature> root_signature;
  if (FAILED(device->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                         IID_PPV_ARGS(&root_signature)))) {
    return 3;
  }

  const std::vector<char> fill = beside("Shaders/fill.cso");
  D3D12_COMPUTE_PIPELINE_STATE_DESC compute = {};
  compute.pRootSignature = root_signature.Get();
  compute.CS = {fill.data(), fill.size()};
  ComPtr<ID3D12PipelineState> compute_pipeline;
  if (FAILED(device->CreateComputePipelineState(&compute, IID_PPV_ARGS(&compute_pipeline))))
    return 4;

  CD3DX12_STATE_OBJECT_DESC pipeline(D3D12_STATE_OBJECT_TYPE_RAYTRACING_PIPELINE);
  const D3D12_SHADER_BYTECODE bytecode = {g_pSquares, sizeof(g_pSquares)};
  pipeline.CreateSubobject<CD3DX12_DXIL_LIBRARY_SUBOBJECT>()->SetDXILLibrary(&bytecode);
  pipeline.CreateSubobject<CD3DX12_RAYTRACING_SHADER_CONFIG_SUBOBJECT>()->Config(4, 8);
  pipeline.CreateSubobject<CD3DX12_RAYTRACING_PIPELINE_CONFIG_SUBOBJECT>()->Config(1);
  pipeline.CreateSubobject<CD3DX12_GLOBAL_ROOT_SIGNATURE_SUBOBJECT>()->SetRootSignature(
      root_signature.Get());
  ComPtr<ID3D12StateObject> state_object;
  if (FAILED(device->CreateStateObject(pipeline, IID_PPV_ARGS(&state_object)))) return 5;
  ComPtr<ID3D12StateObjectProperties> properties;
  state_object.As(&properties);
  if (properties->GetShaderIdentifier(L"Cubes") == nullptr) return 6;
  std::printf("imported: %d\n", ANSWER);
  return 0;
}
