// SPDX-License-Identifier: MIT
// ID3D12Resource over rtapi's buffers and textures.
#pragma once

#include <functional>

#include <rtapi/rtapi.h>

#include "d3d12/com/report.h"
#include "d3d12/objects/device_child.h"
#include "d3d12/objects/heap.h"

namespace kaamos::d3d12 {

class Device;

/// Where a resource lies: in a heap of the program's, in one that a committed resource has for
/// itself so that another device can open it, or, without any, in memory of its own.
struct HeapPlace {
  Heap* heap = nullptr;  ///< the program's
  rtapi::Heap memory = {};
  uint64_t offset = 0;  ///< bytes
};

/// A committed or placed resource.
class Resource final : public DeviceChild<ID3D12ResourceEntries> {
 public:
  Resource(ID3D12Device* device, rtapi::Resource resource, const D3D12_RESOURCE_DESC1& desc,
           const D3D12_HEAP_PROPERTIES& heap, D3D12_HEAP_FLAGS heap_flags, const HeapPlace& place);

  const rtapi::Resource& rtapi_resource() const { return resource_; }
  bool is_buffer() const { return std::holds_alternative<rtapi::Buffer>(resource_); }
  /// Empty if the resource is of the other kind.
  rtapi::Buffer buffer() const;
  rtapi::Texture texture() const;
  /// The memory that a committed resource shares with other devices; empty if it shares none.
  const rtapi::Heap& shared_memory() const { return shared_memory_; }

  HRESULT STDMETHODCALLTYPE Map(UINT subresource, const D3D12_RANGE* read_range,
                                void** data) override;
  void STDMETHODCALLTYPE Unmap(UINT, const D3D12_RANGE*) override {}
  HRESULT STDMETHODCALLTYPE WriteToSubresource(UINT subresource, const D3D12_BOX* box,
                                               const void* source, UINT row_pitch,
                                               UINT slice_pitch) override;
  HRESULT STDMETHODCALLTYPE ReadFromSubresource(void* dest, UINT row_pitch, UINT slice_pitch,
                                                UINT subresource, const D3D12_BOX* box) override;
  D3D12_RESOURCE_DESC STDMETHODCALLTYPE GetDesc() override;
  D3D12_RESOURCE_DESC1 STDMETHODCALLTYPE GetDesc1() override { return desc_; }
  D3D12_GPU_VIRTUAL_ADDRESS STDMETHODCALLTYPE GetGPUVirtualAddress() override;
  HRESULT STDMETHODCALLTYPE GetHeapProperties(D3D12_HEAP_PROPERTIES* properties,
                                              D3D12_HEAP_FLAGS* flags) override;
  HRESULT STDMETHODCALLTYPE GetProtectedResourceSession(REFIID, void** session) override {
    if (session != nullptr) *session = nullptr;
    return DXGI_ERROR_NOT_FOUND;
  }

 protected:
  void rename(const std::string& name) override;

 private:
  // The rows of a box in a subresource, `count` to a slice.
  struct TexelRows {
    std::byte* first = nullptr;
    uint64_t row_pitch = 0;
    uint64_t slice_pitch = 0;
    uint64_t bytes = 0;  // of a row of the box
    uint64_t count = 0;
    uint64_t slices = 0;

    std::byte* at(uint64_t y, uint64_t z) const { return first + z * slice_pitch + y * row_pitch; }
  };

  bool cpu_sees_texels() const;
  // `move` returns whether it wrote.
  HRESULT move_texels(const char* call, UINT subresource, const D3D12_BOX* box,
                      const std::function<bool(const TexelRows&)>& move);

  rtapi::Resource resource_;
  D3D12_RESOURCE_DESC1 desc_;
  D3D12_HEAP_PROPERTIES heap_;
  D3D12_HEAP_FLAGS heap_flags_;
  Held<Heap> placed_in_;
  rtapi::Heap shared_memory_;
};

/// Returns the object behind an interface of this library; an empty handle for null.
///@{
inline rtapi::Resource rtapi_resource(ID3D12Resource* resource) {
  return resource != nullptr ? static_cast<Resource*>(resource)->rtapi_resource()
                             : rtapi::Resource{};
}
inline rtapi::Buffer rtapi_buffer(ID3D12Resource* resource) {
  return resource != nullptr ? static_cast<Resource*>(resource)->buffer() : rtapi::Buffer{};
}
inline rtapi::Texture rtapi_texture(ID3D12Resource* resource) {
  return resource != nullptr ? static_cast<Resource*>(resource)->texture() : rtapi::Texture{};
}
///@}

/// The desc of GetDesc1 for that of GetDesc.
D3D12_RESOURCE_DESC1 with_sampler_feedback(const D3D12_RESOURCE_DESC& desc);

/// Whether the description of a buffer is one. [D3D12: D3D12_RESOURCE_DESC]
/// @errors KA4011.
rtapi::Status check_buffer_desc(const D3D12_RESOURCE_DESC1& desc);

/// The room that a resource takes in a heap, with the alignment that `desc` asks for.
/// @errors KA4011; for textures those of rtapi::GetResourceAllocationInfo.
rtapi::Result<rtapi::ResourceAllocationInfo> allocation_info(const rtapi::Device& device,
                                                             const D3D12_RESOURCE_DESC1& desc);

/// Makes the resource of `desc`, which lies at `place`.
/// @errors KA4010 the heap, KA4011 `desc`; those of rtapi.
HRESULT make_resource(Device& device, const D3D12_HEAP_PROPERTIES& heap, D3D12_HEAP_FLAGS flags,
                      const D3D12_RESOURCE_DESC1& desc, D3D12_RESOURCE_STATES state,
                      const D3D12_CLEAR_VALUE* clear, const HeapPlace& place, REFIID riid,
                      void** resource);

/// rtapi's description of a texture. Refuses what rtapi has no member for: several samples, unknown
/// layouts.
/// @errors KA4011.
rtapi::Result<rtapi::TextureDesc> texture_desc(const D3D12_RESOURCE_DESC1& desc);

}  // namespace kaamos::d3d12
