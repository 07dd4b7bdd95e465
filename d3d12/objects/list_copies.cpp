// SPDX-License-Identifier: MIT
// Copies, clears of unordered access views, queries, predication.
#include "d3d12/objects/device.h"
#include "d3d12/objects/graphics_command_list.h"
#include "d3d12/objects/pipeline_objects.h"
#include "d3d12/objects/resource.h"
#include "d3d12/objects/same_bytes.h"

namespace kaamos::d3d12 {

namespace {

rtapi::TextureCopyLocation copy_location(const D3D12_TEXTURE_COPY_LOCATION& location) {
  if (location.Type == D3D12_TEXTURE_COPY_TYPE_SUBRESOURCE_INDEX) {
    return {rtapi_texture(location.pResource), location.SubresourceIndex};
  }
  rtapi::PlacedSubresourceFootprint footprint;
  static_assert(sizeof(footprint) == sizeof(location.PlacedFootprint));
  std::memcpy(static_cast<void*>(&footprint), &location.PlacedFootprint, sizeof(footprint));
  return {rtapi_buffer(location.pResource), footprint};
}

}  // namespace

void GraphicsCommandList::CopyBufferRegion(ID3D12Resource* dest, UINT64 dest_offset,
                                           ID3D12Resource* source, UINT64 source_offset,
                                           UINT64 bytes) {
  list_.CopyBufferRegion(rtapi_buffer(dest), dest_offset, rtapi_buffer(source), source_offset,
                         bytes);
}

void GraphicsCommandList::CopyTextureRegion(const D3D12_TEXTURE_COPY_LOCATION* dest, UINT x, UINT y,
                                            UINT z, const D3D12_TEXTURE_COPY_LOCATION* source,
                                            const D3D12_BOX* box) {
  if (dest == nullptr || source == nullptr) {
    refuse(ErrorId::kNullPointer, "CopyTextureRegion: pDst or pSrc.");
    return;
  }
  rtapi::Box source_box;
  if (box != nullptr) {
    source_box = {box->left, box->top, box->front, box->right, box->bottom, box->back};
  }
  list_.CopyTextureRegion(copy_location(*dest), x, y, z, copy_location(*source),
                          box != nullptr ? &source_box : nullptr);
}

void GraphicsCommandList::CopyResource(ID3D12Resource* dest, ID3D12Resource* source) {
  list_.CopyResource(rtapi_resource(dest), rtapi_resource(source));
}

void GraphicsCommandList::ResolveSubresource(ID3D12Resource* dest, UINT dest_subresource,
                                             ID3D12Resource* source, UINT source_subresource,
                                             DXGI_FORMAT format) {
  list_.ResolveSubresource(rtapi_texture(dest), dest_subresource, rtapi_texture(source),
                           source_subresource, static_cast<rtapi::Format>(format));
}

void GraphicsCommandList::ResolveSubresourceRegion(ID3D12Resource* dest, UINT dest_subresource,
                                                   UINT x, UINT y, ID3D12Resource* source,
                                                   UINT source_subresource, D3D12_RECT* source_rect,
                                                   DXGI_FORMAT format, D3D12_RESOLVE_MODE mode) {
  const rtapi::Rect rect = source_rect != nullptr
                               ? rtapi::Rect{source_rect->left, source_rect->top,
                                             source_rect->right, source_rect->bottom}
                               : rtapi::Rect{};
  list_.ResolveSubresourceRegion(rtapi_texture(dest), dest_subresource, x, y, rtapi_texture(source),
                                 source_subresource, source_rect != nullptr ? &rect : nullptr,
                                 static_cast<rtapi::Format>(format),
                                 static_cast<rtapi::ResolveMode>(mode));
}

void GraphicsCommandList::ClearUnorderedAccessViewUint(D3D12_GPU_DESCRIPTOR_HANDLE gpu,
                                                       D3D12_CPU_DESCRIPTOR_HANDLE cpu,
                                                       ID3D12Resource* resource,
                                                       const UINT values[4], UINT rect_count,
                                                       const D3D12_RECT* rects) {
  list_.ClearUnorderedAccessViewUint({gpu.ptr}, {cpu.ptr}, rtapi_resource(resource), values,
                                     same_bytes<rtapi::Rect>(rects, rect_count));
}

void GraphicsCommandList::ClearUnorderedAccessViewFloat(D3D12_GPU_DESCRIPTOR_HANDLE gpu,
                                                        D3D12_CPU_DESCRIPTOR_HANDLE cpu,
                                                        ID3D12Resource* resource,
                                                        const FLOAT values[4], UINT rect_count,
                                                        const D3D12_RECT* rects) {
  list_.ClearUnorderedAccessViewFloat({gpu.ptr}, {cpu.ptr}, rtapi_resource(resource), values,
                                      same_bytes<rtapi::Rect>(rects, rect_count));
}

void GraphicsCommandList::WriteBufferImmediate(
    UINT count, const D3D12_WRITEBUFFERIMMEDIATE_PARAMETER* parameters,
    const D3D12_WRITEBUFFERIMMEDIATE_MODE* modes) {
  list_.WriteBufferImmediate(
      same_bytes<rtapi::WriteBufferImmediateParameter>(parameters, count),
      same_bytes<rtapi::WriteBufferImmediateMode>(modes, modes != nullptr ? count : 0));
}

void GraphicsCommandList::BeginQuery(ID3D12QueryHeap* heap, D3D12_QUERY_TYPE type, UINT index) {
  list_.BeginQuery(rtapi_heap(heap), static_cast<rtapi::QueryType>(type), index);
}

void GraphicsCommandList::EndQuery(ID3D12QueryHeap* heap, D3D12_QUERY_TYPE type, UINT index) {
  list_.EndQuery(rtapi_heap(heap), static_cast<rtapi::QueryType>(type), index);
}

void GraphicsCommandList::ResolveQueryData(ID3D12QueryHeap* heap, D3D12_QUERY_TYPE type, UINT start,
                                           UINT count, ID3D12Resource* dest, UINT64 dest_offset) {
  list_.ResolveQueryData(rtapi_heap(heap), static_cast<rtapi::QueryType>(type), start, count,
                         rtapi_buffer(dest), dest_offset);
}

void GraphicsCommandList::SetPredication(ID3D12Resource* buffer, UINT64 offset,
                                         D3D12_PREDICATION_OP operation) {
  list_.SetPredication(rtapi_resource(buffer), offset,
                       static_cast<rtapi::PredicationOp>(operation));
}

HRESULT Device::CreateQueryHeap(const D3D12_QUERY_HEAP_DESC* desc, REFIID riid, void** heap) {
  if (heap != nullptr) *heap = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateQueryHeap: pDesc.");
  auto made = device_.CreateQueryHeap(
      {.Type = static_cast<rtapi::QueryHeapType>(desc->Type), .Count = desc->Count});
  if (!made) return fail(made.error());
  return hand_out(new QueryHeap(this, *made), riid, heap);
}

}  // namespace kaamos::d3d12
