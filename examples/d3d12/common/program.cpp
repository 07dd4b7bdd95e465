// SPDX-License-Identifier: MIT
#include "program.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

void ThrowIfFailed(HRESULT result, const char* call) {
  if (FAILED(result)) {
    char text[256];
    snprintf(text, sizeof(text), "%s failed: 0x%08X", call, static_cast<unsigned>(result));
    throw std::runtime_error(text);
  }
}

Options ParseOptions(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    const char* value = i + 1 < argc ? argv[i + 1] : "";
    if (name == "--size" && sscanf(value, "%ux%u", &options.width, &options.height) == 2) continue;
    if (name != "--out" || *value == '\0') {
      throw std::runtime_error("usage: " + std::string(argv[0]) + " [--size WxH] [--out FILE.ppm]");
    }
    options.file = value;
  }
  return options;
}

Program::Program(const Options& options) : options_(options) {
  ComPtr<ID3D12Debug> debug;
  if (SUCCEEDED(D3D12GetDebugInterface(IID_PPV_ARGS(&debug)))) debug->EnableDebugLayer();
  CHECK(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_1, IID_PPV_ARGS(&device_)));
  D3D12_FEATURE_DATA_D3D12_OPTIONS5 features = {};
  CHECK(device_->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS5, &features, sizeof(features)));
  if (features.RaytracingTier < D3D12_RAYTRACING_TIER_1_0) {
    throw std::runtime_error("this device has no ray tracing");
  }
  const D3D12_COMMAND_QUEUE_DESC queue = {};
  CHECK(device_->CreateCommandQueue(&queue, IID_PPV_ARGS(&queue_)));
  CHECK(device_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT, IID_PPV_ARGS(&allocator_)));
  CHECK(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator_.Get(), nullptr,
                                   IID_PPV_ARGS(&list_)));
  CHECK(device_->CreateFence(0, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(&fence_)));
  event_ = CreateEvent(nullptr, FALSE, FALSE, nullptr);
}

ComPtr<ID3D12Resource> Program::CreateBuffer(UINT64 bytes, D3D12_HEAP_TYPE type,
                                             D3D12_RESOURCE_STATES state,
                                             D3D12_RESOURCE_FLAGS flags) {
  const auto desc = CD3DX12_RESOURCE_DESC::Buffer(bytes, flags);
  const CD3DX12_HEAP_PROPERTIES properties(type);
  ComPtr<ID3D12Resource> out;
  CHECK(device_->CreateCommittedResource(&properties, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                         IID_PPV_ARGS(&out)));
  return out;
}

ComPtr<ID3D12Resource> Program::Upload(const void* data, size_t bytes) {
  ComPtr<ID3D12Resource> out =
      CreateBuffer(bytes, D3D12_HEAP_TYPE_UPLOAD, D3D12_RESOURCE_STATE_GENERIC_READ);
  void* mapped = nullptr;
  const CD3DX12_RANGE nothing(0, 0);
  CHECK(out->Map(0, &nothing, &mapped));
  memcpy(mapped, data, bytes);
  out->Unmap(0, nullptr);
  return out;
}

ComPtr<ID3D12Resource> Program::CreateTexture(DXGI_FORMAT format, D3D12_RESOURCE_FLAGS flags,
                                              D3D12_RESOURCE_STATES state, const wchar_t* name) {
  const auto desc =
      CD3DX12_RESOURCE_DESC::Tex2D(format, options_.width, options_.height, 1, 1, 1, 0, flags);
  const CD3DX12_HEAP_PROPERTIES properties(D3D12_HEAP_TYPE_DEFAULT);
  ComPtr<ID3D12Resource> out;
  CHECK(device_->CreateCommittedResource(&properties, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                         IID_PPV_ARGS(&out)));
  CHECK(out->SetName(name));
  return out;
}

ComPtr<ID3D12DescriptorHeap> Program::CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE type,
                                                           UINT count) {
  D3D12_DESCRIPTOR_HEAP_DESC desc = {};
  desc.Type = type;
  desc.NumDescriptors = count;
  if (type == D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV) {
    desc.Flags = D3D12_DESCRIPTOR_HEAP_FLAG_SHADER_VISIBLE;
  }
  ComPtr<ID3D12DescriptorHeap> out;
  CHECK(device_->CreateDescriptorHeap(&desc, IID_PPV_ARGS(&out)));
  return out;
}

D3D12_CPU_DESCRIPTOR_HANDLE Program::Slot(ID3D12DescriptorHeap* heap, UINT index) {
  return CD3DX12_CPU_DESCRIPTOR_HANDLE(
      heap->GetCPUDescriptorHandleForHeapStart(), static_cast<INT>(index),
      device_->GetDescriptorHandleIncrementSize(heap->GetDesc().Type));
}

ComPtr<ID3D12RootSignature> Program::CreateRootSignature(
    const D3D12_VERSIONED_ROOT_SIGNATURE_DESC& desc) {
  ComPtr<ID3DBlob> blob, errors;
  CHECK(D3D12SerializeVersionedRootSignature(&desc, &blob, &errors));
  ComPtr<ID3D12RootSignature> out;
  CHECK(device_->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                     IID_PPV_ARGS(&out)));
  return out;
}

ComPtr<ID3D12Resource> Program::CreateShaderTable(ID3D12StateObject* pipeline,
                                                  const wchar_t* name) {
  ShaderTable table(pipeline);
  table.AddRecord(name);
  return Upload(table);
}

Program::Image Program::CreateImage() {
  Image image;
  image.texture =
      CreateTexture(DXGI_FORMAT_R8G8B8A8_UNORM, D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS,
                    D3D12_RESOURCE_STATE_UNORDERED_ACCESS, L"image");
  image.heap = CreateDescriptorHeap(D3D12_DESCRIPTOR_HEAP_TYPE_CBV_SRV_UAV, 1);
  D3D12_UNORDERED_ACCESS_VIEW_DESC view = {};
  view.ViewDimension = D3D12_UAV_DIMENSION_TEXTURE2D;
  device_->CreateUnorderedAccessView(image.texture.Get(), nullptr, &view,
                                     Slot(image.heap.Get(), 0));
  return image;
}

ComPtr<ID3D12Resource> Program::BuildAccelerationStructure(
    const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS& inputs) {
  D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO info = {};
  device_->GetRaytracingAccelerationStructurePrebuildInfo(&inputs, &info);
  in_flight_.push_back(CreateBuffer(info.ScratchDataSizeInBytes, D3D12_HEAP_TYPE_DEFAULT,
                                    D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                                    D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS));
  ComPtr<ID3D12Resource> result =
      CreateBuffer(info.ResultDataMaxSizeInBytes, D3D12_HEAP_TYPE_DEFAULT,
                   D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE,
                   D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC desc = {};
  desc.Inputs = inputs;
  desc.DestAccelerationStructureData = result->GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = in_flight_.back()->GetGPUVirtualAddress();
  list_->BuildRaytracingAccelerationStructure(&desc, 0, nullptr);
  const auto built = CD3DX12_RESOURCE_BARRIER::UAV(result.Get());
  list_->ResourceBarrier(1, &built);
  return result;
}

ComPtr<ID3D12Resource> Program::BuildBottomLevel(
    const std::vector<D3D12_RAYTRACING_GEOMETRY_DESC>& geometries) {
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS inputs = {};
  inputs.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL;
  inputs.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
  inputs.NumDescs = static_cast<UINT>(geometries.size());
  inputs.pGeometryDescs = geometries.data();
  return BuildAccelerationStructure(inputs);
}

ComPtr<ID3D12Resource> Program::BuildTopLevel(
    const std::vector<D3D12_RAYTRACING_INSTANCE_DESC>& instances) {
  in_flight_.push_back(Upload(instances.data(), instances.size() * sizeof(instances[0])));
  D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS inputs = {};
  inputs.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL;
  inputs.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
  inputs.NumDescs = static_cast<UINT>(instances.size());
  inputs.InstanceDescs = in_flight_.back()->GetGPUVirtualAddress();
  return BuildAccelerationStructure(inputs);
}

void Program::Execute() {
  CHECK(list_->Close());
  ID3D12CommandList* lists[] = {list_.Get()};
  queue_->ExecuteCommandLists(1, lists);
  CHECK(queue_->Signal(fence_.Get(), ++fence_value_));
  CHECK(fence_->SetEventOnCompletion(fence_value_, event_));
  WaitForSingleObject(event_, INFINITE);
  CHECK(device_->GetDeviceRemovedReason());
  in_flight_.clear();
  CHECK(allocator_->Reset());
  CHECK(list_->Reset(allocator_.Get(), nullptr));
}

void Program::WritePicture(ID3D12Resource* texture, D3D12_RESOURCE_STATES state) {
  if (state != D3D12_RESOURCE_STATE_COPY_SOURCE) {
    const auto to_copy =
        CD3DX12_RESOURCE_BARRIER::Transition(texture, state, D3D12_RESOURCE_STATE_COPY_SOURCE);
    list_->ResourceBarrier(1, &to_copy);
  }
  const D3D12_RESOURCE_DESC desc = texture->GetDesc();
  D3D12_PLACED_SUBRESOURCE_FOOTPRINT footprint = {};
  UINT64 bytes = 0;
  device_->GetCopyableFootprints(&desc, 0, 1, 0, &footprint, nullptr, nullptr, &bytes);
  const ComPtr<ID3D12Resource> readback =
      CreateBuffer(bytes, D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST);
  const CD3DX12_TEXTURE_COPY_LOCATION to(readback.Get(), footprint);
  const CD3DX12_TEXTURE_COPY_LOCATION from(texture, 0);
  list_->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
  Execute();

  FILE* file = fopen(options_.file.c_str(), "wb");
  if (file == nullptr) throw std::runtime_error("cannot write " + options_.file);
  fprintf(file, "P6\n%u %u\n255\n", options_.width, options_.height);
  BYTE* texels = nullptr;
  CHECK(readback->Map(0, nullptr, reinterpret_cast<void**>(&texels)));
  for (UINT y = 0; y < options_.height; ++y) {
    const BYTE* row = texels + y * footprint.Footprint.RowPitch;
    for (UINT x = 0; x < options_.width; ++x) fwrite(row + 4 * x, 1, 3, file);
  }
  readback->Unmap(0, nullptr);
  if (fclose(file) != 0) throw std::runtime_error("cannot write " + options_.file);
}

D3D12_RAYTRACING_INSTANCE_DESC InstanceAt(ID3D12Resource* bottom_level, float x, float y, float z) {
  D3D12_RAYTRACING_INSTANCE_DESC instance = {};
  const float position[3] = {x, y, z};
  for (int row = 0; row < 3; ++row) {
    instance.Transform[row][row] = 1;
    instance.Transform[row][3] = position[row];
  }
  instance.InstanceMask = 0xFF;
  instance.AccelerationStructure = bottom_level->GetGPUVirtualAddress();
  return instance;
}

int RunProgram(int argc, char** argv, void (*render)(const Options&)) {
  try {
    render(ParseOptions(argc, argv));
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
