// SPDX-License-Identifier: MIT
// The device: a factory over rtapi::Device.
#pragma once

#include <rtapi/rtapi.h>

#include "d3d12/com/private_data.h"
#include "d3d12/com/report.h"
#include "d3d12/objects/info_queue.h"
#include "d3d12/objects/live_objects.h"
#include "d3d12/objects/removed_data.h"
#include "d3d12/objects/shader_identifiers.h"

namespace kaamos::d3d12 {

/// A device. Its methods are in device.cpp, device_resources.cpp, device_views.cpp,
/// device_pipelines.cpp and device_features.cpp. Thread-safe, as rtapi::Device is.
class Device final : public NamedObject<ID3D12DeviceEntries, InfoQueue, DebugDevice, RemovedData> {
 public:
  /// `debug`: whether the debug layer is on, whose interfaces are hidden otherwise.
  /// `reporter`: that of the messages of `device`.
  Device(rtapi::Device device, std::shared_ptr<Reporter> reporter, bool debug, LUID luid);

  const rtapi::Device& rtapi_device() const { return device_; }
  LiveObjects& live_objects() { return live_objects_; }
  ShaderIdentifiers& shader_identifiers() { return shader_identifiers_; }
  Reporter& reporter() const override { return *reporter_; }
  HRESULT removed_reason() override { return GetDeviceRemovedReason(); }

  // Queues, lists, fences
  HRESULT STDMETHODCALLTYPE CreateCommandQueue(const D3D12_COMMAND_QUEUE_DESC* desc, REFIID riid,
                                               void** queue) override;
  HRESULT STDMETHODCALLTYPE CreateCommandQueue1(const D3D12_COMMAND_QUEUE_DESC* desc,
                                                REFIID creator, REFIID riid, void** queue) override;
  HRESULT STDMETHODCALLTYPE CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE type, REFIID riid,
                                                   void** allocator) override;
  HRESULT STDMETHODCALLTYPE CreateCommandList(UINT node_mask, D3D12_COMMAND_LIST_TYPE type,
                                              ID3D12CommandAllocator* allocator,
                                              ID3D12PipelineState* initial_state, REFIID riid,
                                              void** list) override;
  HRESULT STDMETHODCALLTYPE CreateCommandList1(UINT node_mask, D3D12_COMMAND_LIST_TYPE type,
                                               D3D12_COMMAND_LIST_FLAGS flags, REFIID riid,
                                               void** list) override;
  HRESULT STDMETHODCALLTYPE CreateFence(UINT64 initial_value, D3D12_FENCE_FLAGS flags, REFIID riid,
                                        void** fence) override;
  HRESULT STDMETHODCALLTYPE SetEventOnMultipleFenceCompletion(ID3D12Fence* const* fences,
                                                              const UINT64* values, UINT count,
                                                              D3D12_MULTIPLE_FENCE_WAIT_FLAGS flags,
                                                              HANDLE event) override;
  HRESULT STDMETHODCALLTYPE CreateQueryHeap(const D3D12_QUERY_HEAP_DESC* desc, REFIID riid,
                                            void** heap) override;
  HRESULT STDMETHODCALLTYPE CreateCommandSignature(const D3D12_COMMAND_SIGNATURE_DESC* desc,
                                                   ID3D12RootSignature* root_signature, REFIID riid,
                                                   void** signature) override;

  // The device itself
  UINT STDMETHODCALLTYPE GetNodeCount() override { return 1; }
  HRESULT STDMETHODCALLTYPE GetDeviceRemovedReason() override;
  void STDMETHODCALLTYPE RemoveDevice() override;
  LUID STDMETHODCALLTYPE GetAdapterLuid() override { return luid_; }
  HRESULT STDMETHODCALLTYPE CheckFeatureSupport(D3D12_FEATURE feature, void* data,
                                                UINT size) override;
  HRESULT STDMETHODCALLTYPE SetStablePowerState(BOOL) override { return S_OK; }
  HRESULT STDMETHODCALLTYPE MakeResident(UINT, ID3D12Pageable* const*) override { return S_OK; }
  HRESULT STDMETHODCALLTYPE Evict(UINT, ID3D12Pageable* const*) override { return S_OK; }
  HRESULT STDMETHODCALLTYPE EnqueueMakeResident(D3D12_RESIDENCY_FLAGS flags, UINT count,
                                                ID3D12Pageable* const* objects, ID3D12Fence* fence,
                                                UINT64 value) override;
  HRESULT STDMETHODCALLTYPE SetResidencyPriority(UINT, ID3D12Pageable* const*,
                                                 const D3D12_RESIDENCY_PRIORITY*) override {
    return S_OK;
  }
  HRESULT STDMETHODCALLTYPE SetBackgroundProcessingMode(D3D12_BACKGROUND_PROCESSING_MODE mode,
                                                        D3D12_MEASUREMENTS_ACTION action,
                                                        HANDLE event, BOOL* more) override;
  HRESULT STDMETHODCALLTYPE EnumerateMetaCommands(UINT* count, D3D12_META_COMMAND_DESC*) override {
    if (count == nullptr) return fail(ErrorId::kNullPointer, "EnumerateMetaCommands: the count.");
    *count = 0;
    return S_OK;
  }

  // The debug layer. Of objects the same is stored and printed.
  HRESULT STDMETHODCALLTYPE ReportLiveDeviceObjects(D3D12_RLDO_FLAGS flags) override;

  // Resources
  HRESULT STDMETHODCALLTYPE CreateCommittedResource(const D3D12_HEAP_PROPERTIES* heap,
                                                    D3D12_HEAP_FLAGS flags,
                                                    const D3D12_RESOURCE_DESC* desc,
                                                    D3D12_RESOURCE_STATES state,
                                                    const D3D12_CLEAR_VALUE* clear, REFIID riid,
                                                    void** resource) override;
  HRESULT STDMETHODCALLTYPE CreateCommittedResource1(
      const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags, const D3D12_RESOURCE_DESC* desc,
      D3D12_RESOURCE_STATES state, const D3D12_CLEAR_VALUE* clear,
      ID3D12ProtectedResourceSession* session, REFIID riid, void** resource) override;
  HRESULT STDMETHODCALLTYPE CreateCommittedResource2(
      const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags, const D3D12_RESOURCE_DESC1* desc,
      D3D12_RESOURCE_STATES state, const D3D12_CLEAR_VALUE* clear,
      ID3D12ProtectedResourceSession* session, REFIID riid, void** resource) override;
  HRESULT STDMETHODCALLTYPE CreateHeap(const D3D12_HEAP_DESC* desc, REFIID riid,
                                       void** heap) override;
  HRESULT STDMETHODCALLTYPE CreateHeap1(const D3D12_HEAP_DESC* desc,
                                        ID3D12ProtectedResourceSession* session, REFIID riid,
                                        void** heap) override;
  HRESULT STDMETHODCALLTYPE CreatePlacedResource(ID3D12Heap* heap, UINT64 offset,
                                                 const D3D12_RESOURCE_DESC* desc,
                                                 D3D12_RESOURCE_STATES state,
                                                 const D3D12_CLEAR_VALUE* clear, REFIID riid,
                                                 void** resource) override;
  HRESULT STDMETHODCALLTYPE CreatePlacedResource1(ID3D12Heap* heap, UINT64 offset,
                                                  const D3D12_RESOURCE_DESC1* desc,
                                                  D3D12_RESOURCE_STATES state,
                                                  const D3D12_CLEAR_VALUE* clear, REFIID riid,
                                                  void** resource) override;
  HRESULT STDMETHODCALLTYPE CreateCommittedResource3(
      const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags, const D3D12_RESOURCE_DESC1* desc,
      D3D12_BARRIER_LAYOUT layout, const D3D12_CLEAR_VALUE* clear,
      ID3D12ProtectedResourceSession* session, UINT32 castable_count, DXGI_FORMAT* castable,
      REFIID riid, void** resource) override;
  HRESULT STDMETHODCALLTYPE CreatePlacedResource2(ID3D12Heap* heap, UINT64 offset,
                                                  const D3D12_RESOURCE_DESC1* desc,
                                                  D3D12_BARRIER_LAYOUT layout,
                                                  const D3D12_CLEAR_VALUE* clear,
                                                  UINT32 castable_count, DXGI_FORMAT* castable,
                                                  REFIID riid, void** resource) override;
  D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE
  GetResourceAllocationInfo2(UINT visible_mask, UINT count, const D3D12_RESOURCE_DESC1* descs,
                             D3D12_RESOURCE_ALLOCATION_INFO1* infos) override;
  D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE GetResourceAllocationInfo(
      UINT visible_mask, UINT count, const D3D12_RESOURCE_DESC* descs) override;
  D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE
  GetResourceAllocationInfo1(UINT visible_mask, UINT count, const D3D12_RESOURCE_DESC* descs,
                             D3D12_RESOURCE_ALLOCATION_INFO1* infos) override;
  // Formats that views may cast to need no memory.
  D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE GetResourceAllocationInfo3(
      UINT visible_mask, UINT count, const D3D12_RESOURCE_DESC1* descs, const UINT32*,
      const DXGI_FORMAT* const*, D3D12_RESOURCE_ALLOCATION_INFO1* infos) override {
    return GetResourceAllocationInfo2(visible_mask, count, descs, infos);
  }
  HRESULT STDMETHODCALLTYPE CreateSharedHandle(ID3D12DeviceChild* object,
                                               const SECURITY_ATTRIBUTES* attributes, DWORD access,
                                               LPCWSTR name, HANDLE* handle) override;
  HRESULT STDMETHODCALLTYPE OpenSharedHandle(HANDLE handle, REFIID riid, void** object) override;
  HRESULT STDMETHODCALLTYPE OpenSharedHandleByName(LPCWSTR name, DWORD access,
                                                   HANDLE* handle) override;
  D3D12_HEAP_PROPERTIES STDMETHODCALLTYPE GetCustomHeapProperties(UINT node_mask,
                                                                  D3D12_HEAP_TYPE type) override;
  void STDMETHODCALLTYPE GetCopyableFootprints(const D3D12_RESOURCE_DESC* desc, UINT first,
                                               UINT count, UINT64 base_offset,
                                               D3D12_PLACED_SUBRESOURCE_FOOTPRINT* layouts,
                                               UINT* row_counts, UINT64* row_sizes,
                                               UINT64* total) override;
  void STDMETHODCALLTYPE GetCopyableFootprints1(const D3D12_RESOURCE_DESC1* desc, UINT first,
                                                UINT count, UINT64 base_offset,
                                                D3D12_PLACED_SUBRESOURCE_FOOTPRINT* layouts,
                                                UINT* row_counts, UINT64* row_sizes,
                                                UINT64* total) override;

  // Descriptors
  HRESULT STDMETHODCALLTYPE CreateDescriptorHeap(const D3D12_DESCRIPTOR_HEAP_DESC* desc,
                                                 REFIID riid, void** heap) override;
  UINT STDMETHODCALLTYPE GetDescriptorHandleIncrementSize(D3D12_DESCRIPTOR_HEAP_TYPE) override {
    return rtapi::kDescriptorHandleIncrementSize;
  }
  void STDMETHODCALLTYPE CreateConstantBufferView(const D3D12_CONSTANT_BUFFER_VIEW_DESC* desc,
                                                  D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CreateShaderResourceView(ID3D12Resource* resource,
                                                  const D3D12_SHADER_RESOURCE_VIEW_DESC* desc,
                                                  D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CreateUnorderedAccessView(ID3D12Resource* resource,
                                                   ID3D12Resource* counter,
                                                   const D3D12_UNORDERED_ACCESS_VIEW_DESC* desc,
                                                   D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CreateRenderTargetView(ID3D12Resource* resource,
                                                const D3D12_RENDER_TARGET_VIEW_DESC* desc,
                                                D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CreateDepthStencilView(ID3D12Resource* resource,
                                                const D3D12_DEPTH_STENCIL_VIEW_DESC* desc,
                                                D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CreateSampler(const D3D12_SAMPLER_DESC* desc,
                                       D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CreateSampler2(const D3D12_SAMPLER_DESC2* desc,
                                        D3D12_CPU_DESCRIPTOR_HANDLE dest) override;
  void STDMETHODCALLTYPE CopyDescriptors(UINT dest_count,
                                         const D3D12_CPU_DESCRIPTOR_HANDLE* dest_starts,
                                         const UINT* dest_sizes, UINT source_count,
                                         const D3D12_CPU_DESCRIPTOR_HANDLE* source_starts,
                                         const UINT* source_sizes,
                                         D3D12_DESCRIPTOR_HEAP_TYPE type) override;
  void STDMETHODCALLTYPE CopyDescriptorsSimple(UINT count, D3D12_CPU_DESCRIPTOR_HANDLE dest,
                                               D3D12_CPU_DESCRIPTOR_HANDLE source,
                                               D3D12_DESCRIPTOR_HEAP_TYPE type) override;

  // Pipelines
  HRESULT STDMETHODCALLTYPE CreateRootSignature(UINT node_mask, const void* blob, SIZE_T size,
                                                REFIID riid, void** root_signature) override;
  HRESULT STDMETHODCALLTYPE CreateRootSignatureFromSubobjectInLibrary(
      UINT node_mask, const void* blob, SIZE_T size, LPCWSTR subobject, REFIID riid,
      void** root_signature) override;
  HRESULT STDMETHODCALLTYPE CreateComputePipelineState(
      const D3D12_COMPUTE_PIPELINE_STATE_DESC* desc, REFIID riid, void** pipeline) override;
  HRESULT STDMETHODCALLTYPE CreateGraphicsPipelineState(
      const D3D12_GRAPHICS_PIPELINE_STATE_DESC* desc, REFIID riid, void** pipeline) override;
  HRESULT STDMETHODCALLTYPE CreatePipelineState(const D3D12_PIPELINE_STATE_STREAM_DESC* desc,
                                                REFIID riid, void** pipeline) override;
  HRESULT STDMETHODCALLTYPE CreatePipelineLibrary(const void* blob, SIZE_T size, REFIID riid,
                                                  void** library) override;
  HRESULT STDMETHODCALLTYPE CreateStateObject(const D3D12_STATE_OBJECT_DESC* desc, REFIID riid,
                                              void** state_object) override;
  HRESULT STDMETHODCALLTYPE AddToStateObject(const D3D12_STATE_OBJECT_DESC* addition,
                                             ID3D12StateObject* parent, REFIID riid,
                                             void** state_object) override;

  // Acceleration structures
  void STDMETHODCALLTYPE GetRaytracingAccelerationStructurePrebuildInfo(
      const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS* desc,
      D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO* info) override;
  D3D12_DRIVER_MATCHING_IDENTIFIER_STATUS STDMETHODCALLTYPE CheckDriverMatchingIdentifier(
      D3D12_SERIALIZED_DATA_TYPE type,
      const D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER* identifier) override;

 protected:
  void rename(const std::string& name) override;
  bool offers(REFIID riid) const override;

 private:
  // `depth_stencil` counts instead of the one in `desc`.
  HRESULT create_graphics(const D3D12_GRAPHICS_PIPELINE_STATE_DESC& desc,
                          const D3D12_DEPTH_STENCIL_DESC2& depth_stencil, REFIID riid,
                          void** pipeline);
  HRESULT create_compute(const D3D12_COMPUTE_PIPELINE_STATE_DESC& desc, REFIID riid,
                         void** pipeline);

  std::shared_ptr<Reporter> reporter_;
  rtapi::Device device_;
  bool debug_;
  LUID luid_;
  LiveObjects live_objects_;
  ShaderIdentifiers shader_identifiers_;
};

/// The device behind an interface that this library handed out.
inline Device& device_of(ID3D12Device* device) {
  return *static_cast<Device*>(device);
}
inline const rtapi::Device& rtapi_device(ID3D12Device* device) {
  return device_of(device).rtapi_device();
}

}  // namespace kaamos::d3d12
