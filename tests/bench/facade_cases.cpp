// SPDX-License-Identifier: MIT
//
// facade/dispatch: a frame of small dispatches by D3D12's calls, over the same by rtapi's.
#include <d3dcompiler.h>
#include <windows.h>

#include <directx/d3d12.h>
#include <dxguids/dxguids.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <wrl/client.h>

#include <cstring>
#include <stdexcept>

#include "fixtures.h"

namespace kaamos::bench {
namespace {

using Microsoft::WRL::ComPtr;

constexpr uint32_t kDispatches = 100;
constexpr uint32_t kGroups = 4;  // of 64 threads
constexpr uint32_t kWords = kDispatches * kGroups * 64;

// Two kernels, so that every dispatch changes the pipeline.
constexpr const char* kKernels[2] = {
    R"(cbuffer Constants : register(b0) { uint first; uint factor; };
RWByteAddressBuffer results : register(u0);
[numthreads(64, 1, 1)] void main(uint i : SV_DispatchThreadID) {
  results.Store(4 * (first + i), i * factor);
})",
    R"(cbuffer Constants : register(b0) { uint first; uint factor; };
RWByteAddressBuffer results : register(u0);
[numthreads(64, 1, 1)] void main(uint i : SV_DispatchThreadID) {
  results.Store(4 * (first + i), i ^ factor);
})"};

struct Constants {
  uint32_t first;
  uint32_t factor;
};

Constants constants(uint32_t dispatch) {
  return {dispatch * kGroups * 64, dispatch + 3};
}

class ByRtapi {
 public:
  ByRtapi() {
    rtapi::RootSignatureDesc desc;
    desc.Parameters.push_back(rtapi::RootParameter::Constants32(2, 0));
    desc.Parameters.push_back(rtapi::RootParameter::Uav(0));
    root_ = device_.CreateRootSignature(desc).value();
    for (int i = 0; i < 2; ++i) {
      const auto compiled = rtapi::CompileShaderLibrary(
          {.File = "kernel.hlsl", .Source = kKernels[i], .Target = "cs_6_0", .EntryPoint = "main"});
      compiled.Status.value();
      pipelines_[i] = device_.CreateComputePipelineState({root_, compiled.Library, "", ""}).value();
    }
    results_ = device_
                   .CreateBuffer({.SizeInBytes = 4 * kWords,
                                  .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess})
                   .value();
    list_ = device_.CreateCommandList().value();
    list_.Close().value();
  }

  void frame() {
    list_.Reset().value();
    for (uint32_t i = 0; i < kDispatches; ++i) {
      list_.SetComputeRootSignature(root_);
      list_.SetPipelineState(pipelines_[i % 2]);
      list_.SetComputeRoot32BitConstants(0, constants(i));
      list_.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
      list_.Dispatch(kGroups, 1, 1);
      list_.ResourceBarrier(rtapi::ResourceBarrier::Uav(results_));
    }
    list_.Close().value();
    queue_.ExecuteCommandLists({list_}).value();
    queue_.Signal(fence_, ++value_).value();
    fence_.Wait(value_).value();
  }

  std::vector<std::byte> results() {
    return rtapi::ReadbackBuffer(device_, queue_, results_).value();
  }

 private:
  rtapi::Device device_ = rtapi::CreateDevice({.Backend = "embree"}).value();
  rtapi::CommandQueue queue_ = device_.CreateCommandQueue().value();
  rtapi::Fence fence_ = device_.CreateFence(0).value();
  uint64_t value_ = 0;
  rtapi::RootSignature root_;
  rtapi::PipelineState pipelines_[2];
  rtapi::Buffer results_;
  rtapi::CommandList list_;
};

void check(HRESULT result) {
  if (FAILED(result)) throw std::runtime_error("a D3D12 call failed; its message is above");
}

class ByD3d12 {
 public:
  ByD3d12() {
    check(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_0, IID_PPV_ARGS(device_.GetAddressOf())));
    D3D12_COMMAND_QUEUE_DESC queue = {};
    check(device_->CreateCommandQueue(&queue, IID_PPV_ARGS(queue_.GetAddressOf())));
    check(device_->CreateFence(0, D3D12_FENCE_FLAG_NONE, IID_PPV_ARGS(fence_.GetAddressOf())));
    check(device_->CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE_DIRECT,
                                          IID_PPV_ARGS(allocator_.GetAddressOf())));
    check(device_->CreateCommandList(0, D3D12_COMMAND_LIST_TYPE_DIRECT, allocator_.Get(), nullptr,
                                     IID_PPV_ARGS(list_.GetAddressOf())));
    check(list_->Close());
    create_pipelines();
    results_ = create_buffer(D3D12_HEAP_TYPE_DEFAULT, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                             D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  }

  void frame() {
    check(allocator_->Reset());
    check(list_->Reset(allocator_.Get(), nullptr));
    D3D12_RESOURCE_BARRIER barrier = {};
    barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_UAV;
    barrier.UAV.pResource = results_.Get();
    for (uint32_t i = 0; i < kDispatches; ++i) {
      const Constants values = constants(i);
      list_->SetComputeRootSignature(root_.Get());
      list_->SetPipelineState(pipelines_[i % 2].Get());
      list_->SetComputeRoot32BitConstants(0, 2, &values, 0);
      list_->SetComputeRootUnorderedAccessView(1, results_->GetGPUVirtualAddress());
      list_->Dispatch(kGroups, 1, 1);
      list_->ResourceBarrier(1, &barrier);
    }
    execute();
  }

  std::vector<std::byte> results() {
    const auto readback = create_buffer(D3D12_HEAP_TYPE_READBACK, D3D12_RESOURCE_STATE_COPY_DEST,
                                        D3D12_RESOURCE_FLAG_NONE);
    check(list_->Reset(allocator_.Get(), nullptr));
    D3D12_RESOURCE_BARRIER barrier = {};
    barrier.Transition = {results_.Get(), 0, D3D12_RESOURCE_STATE_UNORDERED_ACCESS,
                          D3D12_RESOURCE_STATE_COPY_SOURCE};
    list_->ResourceBarrier(1, &barrier);
    list_->CopyResource(readback.Get(), results_.Get());
    std::swap(barrier.Transition.StateBefore, barrier.Transition.StateAfter);
    list_->ResourceBarrier(1, &barrier);
    execute();
    void* data = nullptr;
    check(readback->Map(0, nullptr, &data));
    const auto* bytes = static_cast<const std::byte*>(data);
    return {bytes, bytes + 4 * kWords};
  }

 private:
  void create_pipelines() {
    D3D12_ROOT_PARAMETER parameters[2] = {};
    parameters[0].ParameterType = D3D12_ROOT_PARAMETER_TYPE_32BIT_CONSTANTS;
    parameters[0].Constants.Num32BitValues = 2;
    parameters[1].ParameterType = D3D12_ROOT_PARAMETER_TYPE_UAV;
    const D3D12_ROOT_SIGNATURE_DESC desc = {2, parameters, 0, nullptr,
                                            D3D12_ROOT_SIGNATURE_FLAG_NONE};
    ComPtr<ID3DBlob> blob;
    check(D3D12SerializeRootSignature(&desc, D3D_ROOT_SIGNATURE_VERSION_1, blob.GetAddressOf(),
                                      nullptr));
    check(device_->CreateRootSignature(0, blob->GetBufferPointer(), blob->GetBufferSize(),
                                       IID_PPV_ARGS(root_.GetAddressOf())));
    for (int i = 0; i < 2; ++i) {
      ComPtr<ID3DBlob> code;
      check(D3DCompile(kKernels[i], std::strlen(kKernels[i]), "kernel.hlsl", nullptr, nullptr,
                       "main", "cs_6_0", 0, 0, code.GetAddressOf(), nullptr));
      D3D12_COMPUTE_PIPELINE_STATE_DESC pipeline = {};
      pipeline.pRootSignature = root_.Get();
      pipeline.CS = {code->GetBufferPointer(), code->GetBufferSize()};
      check(device_->CreateComputePipelineState(&pipeline,
                                                IID_PPV_ARGS(pipelines_[i].GetAddressOf())));
    }
  }

  ComPtr<ID3D12Resource> create_buffer(D3D12_HEAP_TYPE type, D3D12_RESOURCE_STATES state,
                                       D3D12_RESOURCE_FLAGS flags) {
    D3D12_HEAP_PROPERTIES heap = {};
    heap.Type = type;
    D3D12_RESOURCE_DESC desc = {};
    desc.Dimension = D3D12_RESOURCE_DIMENSION_BUFFER;
    desc.Width = 4 * kWords;
    desc.Height = desc.DepthOrArraySize = desc.MipLevels = 1;
    desc.SampleDesc.Count = 1;
    desc.Layout = D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
    desc.Flags = flags;
    ComPtr<ID3D12Resource> out;
    check(device_->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc, state, nullptr,
                                           IID_PPV_ARGS(out.GetAddressOf())));
    return out;
  }

  void execute() {
    check(list_->Close());
    ID3D12CommandList* lists[] = {list_.Get()};
    queue_->ExecuteCommandLists(1, lists);
    check(queue_->Signal(fence_.Get(), ++value_));
    check(fence_->SetEventOnCompletion(value_, nullptr));  // waits
  }

  ComPtr<ID3D12Device> device_;
  ComPtr<ID3D12CommandQueue> queue_;
  ComPtr<ID3D12Fence> fence_;
  UINT64 value_ = 0;
  ComPtr<ID3D12CommandAllocator> allocator_;
  ComPtr<ID3D12GraphicsCommandList> list_;
  ComPtr<ID3D12RootSignature> root_;
  ComPtr<ID3D12PipelineState> pipelines_[2];
  ComPtr<ID3D12Resource> results_;
};

Line dispatch(Fixtures&, const Measure& measure) {
  ByRtapi rtapi;
  ByD3d12 d3d12;
  rtapi.frame();
  d3d12.frame();
  if (rtapi.results() != d3d12.results()) {
    throw std::runtime_error("the dispatches write something else through D3D12");
  }
  const Pairs times = time_pairs(
      measure, [&] { d3d12.frame(); }, [&] { rtapi.frame(); });
  return {"facade/dispatch",        1 / times.ratio,
          kDispatches / times.ours, kDispatches / times.baseline,
          "dispatches/s",           true};
}

}  // namespace

std::vector<Case> facade_cases() {
  return {{"facade/dispatch", dispatch}};
}

}  // namespace kaamos::bench
