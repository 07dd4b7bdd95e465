// SPDX-License-Identifier: MIT
// The parts that the D3D12 examples share: the command line, the device, buffers, and the picture
// file.
#pragma once

#include <d3d12.h>
#include <d3dx12.h>
#include <windows.h>
#include <wrl/client.h>

#include <string>
#include <vector>

#include "shader_table.h"

using Microsoft::WRL::ComPtr;

// Throws std::runtime_error, which names the call and the code, if a call failed.
void ThrowIfFailed(HRESULT result, const char* call);
#define CHECK(call) ThrowIfFailed((call), #call)

struct Options {
  UINT width = 640;
  UINT height = 360;
  std::string file = "picture.ppm";
};
// [--size WxH] [--out FILE.ppm]
Options ParseOptions(int argc, char** argv);

// A device under the debug layer, with a queue and one open list.
class Program {
 public:
  explicit Program(const Options& options);
  // Writes a texture of R8G8B8A8_UNORM, which is in this state, to the picture file.
  void WritePicture(ID3D12Resource* texture, D3D12_RESOURCE_STATES state);

 protected:
  ComPtr<ID3D12Resource> CreateBuffer(UINT64 bytes, D3D12_HEAP_TYPE type,
                                      D3D12_RESOURCE_STATES state,
                                      D3D12_RESOURCE_FLAGS flags = D3D12_RESOURCE_FLAG_NONE);
  // A buffer on the upload heap with these bytes.
  ComPtr<ID3D12Resource> Upload(const void* data, size_t bytes);
  // A texture of the picture's size.
  ComPtr<ID3D12Resource> CreateTexture(DXGI_FORMAT format, D3D12_RESOURCE_FLAGS flags,
                                       D3D12_RESOURCE_STATES state, const wchar_t* name);
  ComPtr<ID3D12DescriptorHeap> CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE type, UINT count);
  // Slot `index` of a heap.
  D3D12_CPU_DESCRIPTOR_HANDLE Slot(ID3D12DescriptorHeap* heap, UINT index);
  ComPtr<ID3D12RootSignature> CreateRootSignature(const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc);
  // A table of one record: the identifier of an export.
  ComPtr<ID3D12Resource> CreateShaderTable(ID3D12StateObject* pipeline, const wchar_t* name);
  ComPtr<ID3D12Resource> Upload(const ShaderTable& table) {
    return Upload(table.Records().data(), table.Records().size());
  }
  // A texture that shaders write as u0 of a table, in state UNORDERED_ACCESS.
  struct Image {
    ComPtr<ID3D12Resource> texture;
    ComPtr<ID3D12DescriptorHeap> heap;
  };
  Image CreateImage();

  // Records a build and its barrier.
  ComPtr<ID3D12Resource> BuildAccelerationStructure(
      const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS& inputs);
  ComPtr<ID3D12Resource> BuildBottomLevel(
      const std::vector<D3D12_RAYTRACING_GEOMETRY_DESC>& geometries);
  ComPtr<ID3D12Resource> BuildTopLevel(
      const std::vector<D3D12_RAYTRACING_INSTANCE_DESC>& instances);

  // Runs what is recorded, waits for it, and opens the list again.
  void Execute();

  Options options_;
  ComPtr<ID3D12Device5> device_;
  ComPtr<ID3D12CommandQueue> queue_;
  ComPtr<ID3D12CommandAllocator> allocator_;
  ComPtr<ID3D12GraphicsCommandList4> list_;

 private:
  ComPtr<ID3D12Fence> fence_;
  UINT64 fence_value_ = 0;
  HANDLE event_ = nullptr;
  std::vector<ComPtr<ID3D12Resource>> in_flight_;  // what recorded builds need until Execute
};

// An instance of a bottom level at a position, which any ray sees.
D3D12_RAYTRACING_INSTANCE_DESC InstanceAt(ID3D12Resource* bottom_level, float x, float y, float z);

// Runs `render(options)` and prints what it throws; the exit code.
int RunProgram(int argc, char** argv, void (*render)(const Options&));
