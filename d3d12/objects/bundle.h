// SPDX-License-Identifier: MIT
// Bundles: lists that other lists execute.
#pragma once

#include <functional>
#include <vector>

#include "d3d12/objects/command_allocator.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

/// Keeps calls, and makes them on the list that executes it. What bundles may not call is not
/// implemented here. [D3D12: bundles]
class Bundle final : public DeviceChild<ID3D12GraphicsCommandListEntries> {
 public:
  /// `allocator`, of bundles: null for a closed one.
  Bundle(ID3D12Device* device, CommandAllocator* allocator);

  bool is_open() const { return open_; }
  void execute(ID3D12GraphicsCommandList4* list) const;

  D3D12_COMMAND_LIST_TYPE STDMETHODCALLTYPE GetType() override {
    return D3D12_COMMAND_LIST_TYPE_BUNDLE;
  }
  HRESULT STDMETHODCALLTYPE Close() override;
  HRESULT STDMETHODCALLTYPE Reset(ID3D12CommandAllocator* allocator,
                                  ID3D12PipelineState* initial_state) override;

  void STDMETHODCALLTYPE SetPipelineState(ID3D12PipelineState* pipeline) override;
  void STDMETHODCALLTYPE SetPipelineState1(ID3D12StateObject* state_object) override;
  void STDMETHODCALLTYPE SetDescriptorHeaps(UINT count,
                                            ID3D12DescriptorHeap* const* heaps) override;
  void STDMETHODCALLTYPE SetComputeRootSignature(ID3D12RootSignature* root_signature) override;
  void STDMETHODCALLTYPE SetGraphicsRootSignature(ID3D12RootSignature* root_signature) override;
  void STDMETHODCALLTYPE SetComputeRootDescriptorTable(UINT parameter,
                                                       D3D12_GPU_DESCRIPTOR_HANDLE base) override;
  void STDMETHODCALLTYPE SetGraphicsRootDescriptorTable(UINT parameter,
                                                        D3D12_GPU_DESCRIPTOR_HANDLE base) override;
  void STDMETHODCALLTYPE SetComputeRoot32BitConstant(UINT parameter, UINT value,
                                                     UINT offset) override;
  void STDMETHODCALLTYPE SetGraphicsRoot32BitConstant(UINT parameter, UINT value,
                                                      UINT offset) override;
  void STDMETHODCALLTYPE SetComputeRoot32BitConstants(UINT parameter, UINT count,
                                                      const void* values, UINT offset) override;
  void STDMETHODCALLTYPE SetGraphicsRoot32BitConstants(UINT parameter, UINT count,
                                                       const void* values, UINT offset) override;
  void STDMETHODCALLTYPE
  SetComputeRootConstantBufferView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) override;
  void STDMETHODCALLTYPE
  SetGraphicsRootConstantBufferView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) override;
  void STDMETHODCALLTYPE
  SetComputeRootShaderResourceView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) override;
  void STDMETHODCALLTYPE
  SetGraphicsRootShaderResourceView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) override;
  void STDMETHODCALLTYPE
  SetComputeRootUnorderedAccessView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) override;
  void STDMETHODCALLTYPE
  SetGraphicsRootUnorderedAccessView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) override;
  void STDMETHODCALLTYPE IASetPrimitiveTopology(D3D12_PRIMITIVE_TOPOLOGY topology) override;
  void STDMETHODCALLTYPE IASetIndexBuffer(const D3D12_INDEX_BUFFER_VIEW* view) override;
  void STDMETHODCALLTYPE IASetVertexBuffers(UINT start_slot, UINT count,
                                            const D3D12_VERTEX_BUFFER_VIEW* views) override;
  void STDMETHODCALLTYPE OMSetBlendFactor(const FLOAT factor[4]) override;
  void STDMETHODCALLTYPE OMSetStencilRef(UINT value) override;
  void STDMETHODCALLTYPE Dispatch(UINT x, UINT y, UINT z) override;
  void STDMETHODCALLTYPE DispatchRays(const D3D12_DISPATCH_RAYS_DESC* desc) override;
  void STDMETHODCALLTYPE DrawInstanced(UINT vertices, UINT instances, UINT start_vertex,
                                       UINT start_instance) override;
  void STDMETHODCALLTYPE DrawIndexedInstanced(UINT indices, UINT instances, UINT start_index,
                                              INT base_vertex, UINT start_instance) override;
  void STDMETHODCALLTYPE ExecuteIndirect(ID3D12CommandSignature* signature, UINT max_count,
                                         ID3D12Resource* arguments, UINT64 arguments_offset,
                                         ID3D12Resource* count, UINT64 count_offset) override;
  void STDMETHODCALLTYPE SetMarker(UINT, const void*, UINT) override {}
  void STDMETHODCALLTYPE BeginEvent(UINT, const void*, UINT) override {}
  void STDMETHODCALLTYPE EndEvent() override {}

 protected:
  ~Bundle() override;

 private:
  using Call = std::function<void(ID3D12GraphicsCommandList4*)>;

  // `call` gets the list that executes the bundle.
  void keep(Call call);
  void drop_allocator();

  std::vector<Call> calls_;
  bool open_;
  Held<CommandAllocator> allocator_;  // while the bundle records
};

}  // namespace kaamos::d3d12
