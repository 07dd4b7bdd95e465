// SPDX-License-Identifier: MIT
// ID3D12GraphicsCommandList over rtapi::CommandList.
#pragma once

#include <rtapi/rtapi.h>

#include <vector>

#include "d3d12/objects/command_allocator.h"
#include "d3d12/objects/device_child.h"

namespace kaamos::d3d12 {

/// A list of any type but bundles (bundle.h). Its methods are in graphics_command_list.cpp (life,
/// state, root arguments, dispatches), list_barriers.cpp (enhanced ones), list_copies.cpp,
/// list_draws.cpp and list_raytracing.cpp.
/// Errors are rtapi's: a call that breaks a rule records nothing, and Close reports all of them.
class GraphicsCommandList final : public DeviceChild<ID3D12GraphicsCommandListEntries> {
 public:
  /// `list` is open; with an allocator it stays so.
  GraphicsCommandList(ID3D12Device* device, rtapi::CommandList list, D3D12_COMMAND_LIST_TYPE type,
                      CommandAllocator* allocator);

  const rtapi::CommandList& rtapi_list() const { return list_; }

  // Life
  D3D12_COMMAND_LIST_TYPE STDMETHODCALLTYPE GetType() override { return type_; }
  HRESULT STDMETHODCALLTYPE Close() override;
  HRESULT STDMETHODCALLTYPE Reset(ID3D12CommandAllocator* allocator,
                                  ID3D12PipelineState* initial_state) override;
  void STDMETHODCALLTYPE ClearState(ID3D12PipelineState* pipeline) override;

  // State and root arguments
  void STDMETHODCALLTYPE SetPipelineState(ID3D12PipelineState* pipeline) override;
  void STDMETHODCALLTYPE SetPipelineState1(ID3D12StateObject* state_object) override;
  void STDMETHODCALLTYPE SetDescriptorHeaps(UINT count,
                                            ID3D12DescriptorHeap* const* heaps) override;
  void STDMETHODCALLTYPE ResourceBarrier(UINT count,
                                         const D3D12_RESOURCE_BARRIER* barriers) override;
  void STDMETHODCALLTYPE Barrier(UINT32 count, const D3D12_BARRIER_GROUP* groups) override;
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

  // Dispatches
  void STDMETHODCALLTYPE Dispatch(UINT x, UINT y, UINT z) override;
  void STDMETHODCALLTYPE DispatchRays(const D3D12_DISPATCH_RAYS_DESC* desc) override;
  void STDMETHODCALLTYPE ExecuteIndirect(ID3D12CommandSignature* signature, UINT max_count,
                                         ID3D12Resource* arguments, UINT64 arguments_offset,
                                         ID3D12Resource* count, UINT64 count_offset) override;

  void STDMETHODCALLTYPE ExecuteBundle(ID3D12GraphicsCommandList* bundle) override;

  // Acceleration structures
  void STDMETHODCALLTYPE BuildRaytracingAccelerationStructure(
      const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC* desc, UINT postbuild_count,
      const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC* postbuild) override;
  void STDMETHODCALLTYPE EmitRaytracingAccelerationStructurePostbuildInfo(
      const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC* desc, UINT count,
      const D3D12_GPU_VIRTUAL_ADDRESS* sources) override;
  void STDMETHODCALLTYPE CopyRaytracingAccelerationStructure(
      D3D12_GPU_VIRTUAL_ADDRESS dest, D3D12_GPU_VIRTUAL_ADDRESS source,
      D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE mode) override;

  // Copies, clears, queries
  void STDMETHODCALLTYPE CopyBufferRegion(ID3D12Resource* dest, UINT64 dest_offset,
                                          ID3D12Resource* source, UINT64 source_offset,
                                          UINT64 bytes) override;
  void STDMETHODCALLTYPE ResolveSubresource(ID3D12Resource* dest, UINT dest_subresource,
                                            ID3D12Resource* source, UINT source_subresource,
                                            DXGI_FORMAT format) override;
  void STDMETHODCALLTYPE ResolveSubresourceRegion(ID3D12Resource* dest, UINT dest_subresource,
                                                  UINT x, UINT y, ID3D12Resource* source,
                                                  UINT source_subresource, D3D12_RECT* source_rect,
                                                  DXGI_FORMAT format,
                                                  D3D12_RESOLVE_MODE mode) override;
  void STDMETHODCALLTYPE CopyTextureRegion(const D3D12_TEXTURE_COPY_LOCATION* dest, UINT x, UINT y,
                                           UINT z, const D3D12_TEXTURE_COPY_LOCATION* source,
                                           const D3D12_BOX* box) override;
  void STDMETHODCALLTYPE CopyResource(ID3D12Resource* dest, ID3D12Resource* source) override;
  void STDMETHODCALLTYPE ClearUnorderedAccessViewUint(D3D12_GPU_DESCRIPTOR_HANDLE gpu,
                                                      D3D12_CPU_DESCRIPTOR_HANDLE cpu,
                                                      ID3D12Resource* resource,
                                                      const UINT values[4], UINT rect_count,
                                                      const D3D12_RECT* rects) override;
  void STDMETHODCALLTYPE ClearUnorderedAccessViewFloat(D3D12_GPU_DESCRIPTOR_HANDLE gpu,
                                                       D3D12_CPU_DESCRIPTOR_HANDLE cpu,
                                                       ID3D12Resource* resource,
                                                       const FLOAT values[4], UINT rect_count,
                                                       const D3D12_RECT* rects) override;
  void STDMETHODCALLTYPE
  WriteBufferImmediate(UINT count, const D3D12_WRITEBUFFERIMMEDIATE_PARAMETER* parameters,
                       const D3D12_WRITEBUFFERIMMEDIATE_MODE* modes) override;
  // A discarded resource keeps its values here.
  void STDMETHODCALLTYPE DiscardResource(ID3D12Resource*, const D3D12_DISCARD_REGION*) override {}
  void STDMETHODCALLTYPE BeginQuery(ID3D12QueryHeap* heap, D3D12_QUERY_TYPE type,
                                    UINT index) override;
  void STDMETHODCALLTYPE EndQuery(ID3D12QueryHeap* heap, D3D12_QUERY_TYPE type,
                                  UINT index) override;
  void STDMETHODCALLTYPE ResolveQueryData(ID3D12QueryHeap* heap, D3D12_QUERY_TYPE type, UINT start,
                                          UINT count, ID3D12Resource* dest,
                                          UINT64 dest_offset) override;
  void STDMETHODCALLTYPE SetPredication(ID3D12Resource* buffer, UINT64 offset,
                                        D3D12_PREDICATION_OP operation) override;
  void STDMETHODCALLTYPE SetMarker(UINT, const void*, UINT) override {}
  void STDMETHODCALLTYPE BeginEvent(UINT metadata, const void* data, UINT size) override;
  void STDMETHODCALLTYPE EndEvent() override;

  // Draws
  void STDMETHODCALLTYPE DrawInstanced(UINT vertices, UINT instances, UINT start_vertex,
                                       UINT start_instance) override;
  void STDMETHODCALLTYPE DrawIndexedInstanced(UINT indices, UINT instances, UINT start_index,
                                              INT base_vertex, UINT start_instance) override;
  void STDMETHODCALLTYPE IASetPrimitiveTopology(D3D12_PRIMITIVE_TOPOLOGY topology) override;
  void STDMETHODCALLTYPE IASetIndexBuffer(const D3D12_INDEX_BUFFER_VIEW* view) override;
  void STDMETHODCALLTYPE IASetVertexBuffers(UINT start_slot, UINT count,
                                            const D3D12_VERTEX_BUFFER_VIEW* views) override;
  void STDMETHODCALLTYPE RSSetViewports(UINT count, const D3D12_VIEWPORT* viewports) override;
  void STDMETHODCALLTYPE RSSetScissorRects(UINT count, const D3D12_RECT* rects) override;
  void STDMETHODCALLTYPE OMSetRenderTargets(UINT count, const D3D12_CPU_DESCRIPTOR_HANDLE* targets,
                                            BOOL single_handle,
                                            const D3D12_CPU_DESCRIPTOR_HANDLE* depth) override;
  void STDMETHODCALLTYPE OMSetBlendFactor(const FLOAT factor[4]) override;
  void STDMETHODCALLTYPE OMSetStencilRef(UINT reference) override;
  void STDMETHODCALLTYPE OMSetFrontAndBackStencilRef(UINT front, UINT back) override;
  void STDMETHODCALLTYPE ClearRenderTargetView(D3D12_CPU_DESCRIPTOR_HANDLE view,
                                               const FLOAT color[4], UINT rect_count,
                                               const D3D12_RECT* rects) override;
  void STDMETHODCALLTYPE ClearDepthStencilView(D3D12_CPU_DESCRIPTOR_HANDLE view,
                                               D3D12_CLEAR_FLAGS flags, FLOAT depth, UINT8 stencil,
                                               UINT rect_count, const D3D12_RECT* rects) override;
  void STDMETHODCALLTYPE BeginRenderPass(UINT count,
                                         const D3D12_RENDER_PASS_RENDER_TARGET_DESC* targets,
                                         const D3D12_RENDER_PASS_DEPTH_STENCIL_DESC* depth,
                                         D3D12_RENDER_PASS_FLAGS flags) override;
  void STDMETHODCALLTYPE EndRenderPass() override;

 protected:
  ~GraphicsCommandList() override;

 private:
  void drop_allocator();
  // Reports what cannot be recorded; Close returns the first such code.
  void refuse(ErrorId id, const std::string& detail);

  // What a target of the render pass is resolved to at its end.
  struct PassResolve {
    D3D12_RENDER_PASS_ENDING_ACCESS_RESOLVE_PARAMETERS desc;
    std::vector<D3D12_RENDER_PASS_ENDING_ACCESS_RESOLVE_SUBRESOURCE_PARAMETERS> subresources;
    D3D12_RESOURCE_STATES source_state;
  };
  void note_resolve(const D3D12_RENDER_PASS_ENDING_ACCESS& access, D3D12_RESOURCE_STATES state);

  std::vector<PassResolve> pass_resolves_;
  rtapi::CommandList list_;
  D3D12_COMMAND_LIST_TYPE type_;
  UINT open_events_ = 0;
  HRESULT refused_ = S_OK;
  Held<CommandAllocator> allocator_;  // while the list records
};

}  // namespace kaamos::d3d12
