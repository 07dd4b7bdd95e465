// SPDX-License-Identifier: MIT
// Heaps and resources.
#include "d3d12/objects/device.h"
#include "d3d12/objects/heap.h"
#include "d3d12/objects/resource.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint64_t kPlacement = D3D12_DEFAULT_RESOURCE_PLACEMENT_ALIGNMENT;

// Custom heaps choose pages and a pool, of which L1 is memory that the CPU does not see; the others
// leave both unknown. [D3D12: D3D12_HEAP_PROPERTIES]
bool fits_its_type(const D3D12_HEAP_PROPERTIES& heap) {
  const bool pages = heap.CPUPageProperty != D3D12_CPU_PAGE_PROPERTY_UNKNOWN;
  const bool pool = heap.MemoryPoolPreference != D3D12_MEMORY_POOL_UNKNOWN;
  if (heap.Type != D3D12_HEAP_TYPE_CUSTOM) return !pages && !pool;
  return pages && pool &&
         (heap.MemoryPoolPreference != D3D12_MEMORY_POOL_L1 ||
          heap.CPUPageProperty == D3D12_CPU_PAGE_PROPERTY_NOT_AVAILABLE);
}

// Returns which of rtapi's heap types has these properties. A custom heap is told by its page
// property. [D3D12: D3D12_HEAP_PROPERTIES]
rtapi::Result<rtapi::HeapType> heap_type(const D3D12_HEAP_PROPERTIES& heap) {
  if (!fits_its_type(heap)) {
    return make_error(ErrorId::kHeap,
                      "heap type " + std::to_string(heap.Type) + " with CPUPageProperty " +
                          std::to_string(heap.CPUPageProperty) + " and MemoryPoolPreference " +
                          std::to_string(heap.MemoryPoolPreference) +
                          "; CUSTOM heaps (4) have both, and L1 (2) only with NOT_AVAILABLE (1); "
                          "the others have neither.");
  }
  switch (heap.Type) {
    case D3D12_HEAP_TYPE_DEFAULT:
      return rtapi::HeapType::kDefault;
    case D3D12_HEAP_TYPE_UPLOAD:
      return rtapi::HeapType::kUpload;
    case D3D12_HEAP_TYPE_READBACK:
      return rtapi::HeapType::kReadback;
    case D3D12_HEAP_TYPE_CUSTOM:
      switch (heap.CPUPageProperty) {
        case D3D12_CPU_PAGE_PROPERTY_NOT_AVAILABLE:
          return rtapi::HeapType::kDefault;
        case D3D12_CPU_PAGE_PROPERTY_WRITE_COMBINE:
        case D3D12_CPU_PAGE_PROPERTY_WRITE_BACK:
          return rtapi::HeapType::kCustom;
        default:
          break;
      }
      break;
    default:
      break;
  }
  return make_error(ErrorId::kHeap,
                    "heap type " + std::to_string(heap.Type) + " with CPUPageProperty " +
                        std::to_string(heap.CPUPageProperty) +
                        "; use DEFAULT, UPLOAD, READBACK, or CUSTOM with a page property.");
}

rtapi::Result<rtapi::Resource> make_buffer(const rtapi::Device& device,
                                           const D3D12_HEAP_PROPERTIES& heap,
                                           const D3D12_RESOURCE_DESC1& desc,
                                           D3D12_RESOURCE_STATES state, const HeapPlace& place) {
  if (const auto checked = check_buffer_desc(desc); !checked.ok()) return checked.error();
  const auto type = heap_type(heap);
  if (!type) return type.error();
  // What the GPU writes lies on the default heap. [D3D12: D3D12_HEAP_TYPE]
  constexpr UINT kWritten =
      D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET | D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
  if ((desc.Flags & kWritten) != 0 &&
      (heap.Type == D3D12_HEAP_TYPE_UPLOAD || heap.Type == D3D12_HEAP_TYPE_READBACK)) {
    return make_error(ErrorId::kResource,
                      "a buffer on heap type " + std::to_string(heap.Type) + " has Flags " +
                          std::to_string(desc.Flags) +
                          "; ALLOW_RENDER_TARGET (1) and ALLOW_UNORDERED_ACCESS (4) need the "
                          "default heap (1).");
  }
  rtapi::BufferDesc out;
  out.SizeInBytes = desc.Width;
  out.Heap = *type;
  out.Flags =
      static_cast<rtapi::ResourceFlags>(desc.Flags & D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  out.InitialState = static_cast<rtapi::ResourceStates>(state);
  auto buffer = place.memory ? rtapi::CreatePlacedResource(place.memory, place.offset, out)
                             : device.CreateBuffer(out);
  if (!buffer) return buffer.error();
  return rtapi::Resource(*buffer);
}

rtapi::Result<rtapi::Resource> make_texture(const rtapi::Device& device,
                                            const D3D12_HEAP_PROPERTIES& heap,
                                            const D3D12_RESOURCE_DESC1& desc,
                                            D3D12_RESOURCE_STATES state,
                                            const D3D12_CLEAR_VALUE* clear,
                                            const HeapPlace& place) {
  const auto type = heap_type(heap);
  if (!type) return type.error();
  // WriteToSubresource and ReadFromSubresource need a custom heap.
  if (*type != rtapi::HeapType::kDefault && heap.Type != D3D12_HEAP_TYPE_CUSTOM) {
    return make_error(ErrorId::kResource, "a texture on heap type " + std::to_string(heap.Type) +
                                              "; textures lie on the default heap (1).");
  }
  auto out = texture_desc(desc);
  if (!out) return out.error();
  out->InitialState = static_cast<rtapi::ResourceStates>(state);
  if (clear != nullptr) {
    out->OptimizedClearValue.Format = static_cast<rtapi::Format>(clear->Format);
    if (rtapi::IsDepthFormat(out->OptimizedClearValue.Format)) {
      out->OptimizedClearValue.Depth = clear->DepthStencil.Depth;
      out->OptimizedClearValue.Stencil = clear->DepthStencil.Stencil;
    } else {
      std::copy_n(clear->Color, 4, out->OptimizedClearValue.Color);
    }
  }
  auto texture = place.memory
                     ? rtapi::CreatePlacedResource(place.memory, place.offset, *out, desc.Alignment)
                     : device.CreateTexture(*out);
  if (!texture) return texture.error();
  return rtapi::Resource(*texture);
}

// Memory for a committed resource that other devices may open.
rtapi::Result<rtapi::Heap> memory_to_share(const rtapi::Device& device,
                                           const D3D12_HEAP_PROPERTIES& heap,
                                           const D3D12_RESOURCE_DESC1& desc) {
  const auto type = heap_type(heap);
  if (!type) return type.error();
  const auto info = allocation_info(device, desc);
  if (!info.ok()) return info.error();
  return rtapi::CreateHeap(device, {info->SizeInBytes, *type, "a shared resource"});
}

}  // namespace

HRESULT make_resource(Device& device, const D3D12_HEAP_PROPERTIES& heap, D3D12_HEAP_FLAGS flags,
                      const D3D12_RESOURCE_DESC1& desc, D3D12_RESOURCE_STATES state,
                      const D3D12_CLEAR_VALUE* clear, const HeapPlace& place, REFIID riid,
                      void** resource) {
  const bool is_target = (desc.Flags & (D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET |
                                        D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL)) != 0;
  if (clear != nullptr && !is_target) {
    return device.reporter().fail(ErrorId::kResource,
                                  "pOptimizedClearValue is given for a resource without "
                                  "ALLOW_RENDER_TARGET and ALLOW_DEPTH_STENCIL; pass null.");
  }
  auto made = desc.Dimension == D3D12_RESOURCE_DIMENSION_BUFFER
                  ? make_buffer(device.rtapi_device(), heap, desc, state, place)
                  : make_texture(device.rtapi_device(), heap, desc, state, clear, place);
  if (!made) return device.reporter().fail(made.error());
  const auto info = allocation_info(device.rtapi_device(), desc);
  if (!info.ok()) return device.reporter().fail(info.error());
  D3D12_RESOURCE_DESC1 stored = desc;
  stored.Alignment = info->Alignment;
  return hand_out(new Resource(&device, *std::move(made), stored, heap, flags, place), riid,
                  resource);
}

HRESULT Device::CreateCommittedResource2(const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags,
                                         const D3D12_RESOURCE_DESC1* desc,
                                         D3D12_RESOURCE_STATES state,
                                         const D3D12_CLEAR_VALUE* clear,
                                         ID3D12ProtectedResourceSession*, REFIID riid,
                                         void** resource) {
  if (resource != nullptr) *resource = nullptr;
  if (heap == nullptr || desc == nullptr) {
    return fail(ErrorId::kNullPointer, "CreateCommittedResource: pHeapProperties or pDesc.");
  }
  HeapPlace place;
  if ((flags & D3D12_HEAP_FLAG_SHARED) != 0) {
    auto memory = memory_to_share(device_, *heap, *desc);
    if (!memory.ok()) return fail(memory.error());
    place.memory = *std::move(memory);
  }
  return make_resource(*this, *heap, flags, *desc, state, clear, place, riid, resource);
}

HRESULT Device::CreateCommittedResource1(const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags,
                                         const D3D12_RESOURCE_DESC* desc,
                                         D3D12_RESOURCE_STATES state,
                                         const D3D12_CLEAR_VALUE* clear,
                                         ID3D12ProtectedResourceSession* session, REFIID riid,
                                         void** resource) {
  const D3D12_RESOURCE_DESC1 desc1 =
      desc != nullptr ? with_sampler_feedback(*desc) : D3D12_RESOURCE_DESC1{};
  return CreateCommittedResource2(heap, flags, desc != nullptr ? &desc1 : nullptr, state, clear,
                                  session, riid, resource);
}

HRESULT Device::CreateCommittedResource(const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags,
                                        const D3D12_RESOURCE_DESC* desc,
                                        D3D12_RESOURCE_STATES state, const D3D12_CLEAR_VALUE* clear,
                                        REFIID riid, void** resource) {
  return CreateCommittedResource1(heap, flags, desc, state, clear, nullptr, riid, resource);
}

namespace {

// The state that a layout stands for, and that a buffer has without one. [D3D12: enhanced barriers]
D3D12_RESOURCE_STATES state_of(D3D12_BARRIER_LAYOUT layout, const D3D12_HEAP_PROPERTIES& heap,
                               const D3D12_RESOURCE_DESC1& desc) {
  if (desc.Dimension == D3D12_RESOURCE_DIMENSION_BUFFER) {
    if ((desc.Flags & D3D12_RESOURCE_FLAG_RAYTRACING_ACCELERATION_STRUCTURE) != 0) {
      return D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE;
    }
    const auto type = heap_type(heap);
    if (type.ok() && *type == rtapi::HeapType::kUpload) return D3D12_RESOURCE_STATE_GENERIC_READ;
    if (type.ok() && *type == rtapi::HeapType::kReadback) return D3D12_RESOURCE_STATE_COPY_DEST;
    return D3D12_RESOURCE_STATE_COMMON;
  }
  return static_cast<D3D12_RESOURCE_STATES>(
      rtapi::StatesOfLayout(static_cast<rtapi::BarrierLayout>(layout)));
}

}  // namespace

// Formats that views may cast to are those of the format's family, whatever the program lists.
HRESULT Device::CreateCommittedResource3(const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags,
                                         const D3D12_RESOURCE_DESC1* desc,
                                         D3D12_BARRIER_LAYOUT layout,
                                         const D3D12_CLEAR_VALUE* clear,
                                         ID3D12ProtectedResourceSession* session, UINT32,
                                         DXGI_FORMAT*, REFIID riid, void** resource) {
  const D3D12_RESOURCE_STATES state = heap != nullptr && desc != nullptr
                                          ? state_of(layout, *heap, *desc)
                                          : D3D12_RESOURCE_STATE_COMMON;
  return CreateCommittedResource2(heap, flags, desc, state, clear, session, riid, resource);
}

HRESULT Device::CreatePlacedResource2(ID3D12Heap* heap, UINT64 offset,
                                      const D3D12_RESOURCE_DESC1* desc, D3D12_BARRIER_LAYOUT layout,
                                      const D3D12_CLEAR_VALUE* clear, UINT32, DXGI_FORMAT*,
                                      REFIID riid, void** resource) {
  const D3D12_RESOURCE_STATES state = heap != nullptr && desc != nullptr
                                          ? state_of(layout, heap->GetDesc().Properties, *desc)
                                          : D3D12_RESOURCE_STATE_COMMON;
  return CreatePlacedResource1(heap, offset, desc, state, clear, riid, resource);
}

HRESULT Device::CreateHeap1(const D3D12_HEAP_DESC* desc, ID3D12ProtectedResourceSession*,
                            REFIID riid, void** heap) {
  if (heap != nullptr) *heap = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateHeap: pDesc.");
  const auto type = heap_type(desc->Properties);
  if (!type) return fail(type.error());
  if (desc->SizeInBytes == 0) return fail(ErrorId::kHeap, "SizeInBytes is 0.");
  if (desc->Alignment != 0 && desc->Alignment != kPlacement &&
      desc->Alignment != D3D12_DEFAULT_MSAA_RESOURCE_PLACEMENT_ALIGNMENT) {
    return fail(ErrorId::kHeap,
                "Alignment is " + std::to_string(desc->Alignment) + "; it is 0, 65536 or 4194304.");
  }
  if ((desc->Flags & D3D12_HEAP_FLAG_ALLOW_DISPLAY) != 0) {
    return fail(ErrorId::kHeap,
                "Flags has ALLOW_DISPLAY (8), which only committed resources have.");
  }
  D3D12_HEAP_DESC stored = *desc;
  if (stored.Properties.CreationNodeMask == 0) stored.Properties.CreationNodeMask = 1;
  if (stored.Properties.VisibleNodeMask == 0) stored.Properties.VisibleNodeMask = 1;
  if (stored.Alignment == 0) stored.Alignment = kPlacement;
  // A heap's memory is whole multiples of its alignment. [D3D12: D3D12_HEAP_DESC]
  uint64_t bytes = stored.SizeInBytes;
  const uint64_t past = bytes % stored.Alignment;
  if (past != 0 && bytes < UINT64_MAX - stored.Alignment) bytes += stored.Alignment - past;
  auto memory = rtapi::CreateHeap(device_, {bytes, *type});
  if (!memory.ok()) return fail(memory.error());
  return hand_out(new Heap(this, *std::move(memory), stored), riid, heap);
}

HRESULT Device::CreateHeap(const D3D12_HEAP_DESC* desc, REFIID riid, void** heap) {
  return CreateHeap1(desc, nullptr, riid, heap);
}

HRESULT Device::CreatePlacedResource1(ID3D12Heap* heap, UINT64 offset,
                                      const D3D12_RESOURCE_DESC1* desc, D3D12_RESOURCE_STATES state,
                                      const D3D12_CLEAR_VALUE* clear, REFIID riid,
                                      void** resource) {
  if (resource != nullptr) *resource = nullptr;
  if (heap == nullptr || desc == nullptr) {
    return fail(ErrorId::kNullPointer, "CreatePlacedResource: pHeap or pDesc.");
  }
  const D3D12_HEAP_DESC heap_desc = heap->GetDesc();
  const bool is_target = (desc->Flags & (D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET |
                                         D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL)) != 0;
  const D3D12_HEAP_FLAGS denied = desc->Dimension == D3D12_RESOURCE_DIMENSION_BUFFER
                                      ? D3D12_HEAP_FLAG_DENY_BUFFERS
                                  : is_target ? D3D12_HEAP_FLAG_DENY_RT_DS_TEXTURES
                                              : D3D12_HEAP_FLAG_DENY_NON_RT_DS_TEXTURES;
  if ((heap_desc.Flags & denied) != 0) {
    return fail(ErrorId::kHeap,
                "CreatePlacedResource: Flags of the heap, " + std::to_string(heap_desc.Flags) +
                    ", deny this kind of resource by flag " + std::to_string(denied) + ".");
  }
  auto* placed_in = static_cast<Heap*>(heap);
  return make_resource(*this, heap_desc.Properties, heap_desc.Flags, *desc, state, clear,
                       {placed_in, placed_in->rtapi_heap(), offset}, riid, resource);
}

HRESULT Device::CreatePlacedResource(ID3D12Heap* heap, UINT64 offset,
                                     const D3D12_RESOURCE_DESC* desc, D3D12_RESOURCE_STATES state,
                                     const D3D12_CLEAR_VALUE* clear, REFIID riid, void** resource) {
  const D3D12_RESOURCE_DESC1 desc1 =
      desc != nullptr ? with_sampler_feedback(*desc) : D3D12_RESOURCE_DESC1{};
  return CreatePlacedResource1(heap, offset, desc != nullptr ? &desc1 : nullptr, state, clear, riid,
                               resource);
}

D3D12_HEAP_PROPERTIES Device::GetCustomHeapProperties(UINT, D3D12_HEAP_TYPE type) {
  const D3D12_CPU_PAGE_PROPERTY page =
      type == D3D12_HEAP_TYPE_UPLOAD     ? D3D12_CPU_PAGE_PROPERTY_WRITE_COMBINE
      : type == D3D12_HEAP_TYPE_READBACK ? D3D12_CPU_PAGE_PROPERTY_WRITE_BACK
                                         : D3D12_CPU_PAGE_PROPERTY_NOT_AVAILABLE;
  const D3D12_MEMORY_POOL pool =
      type == D3D12_HEAP_TYPE_DEFAULT ? D3D12_MEMORY_POOL_L1 : D3D12_MEMORY_POOL_L0;
  return {D3D12_HEAP_TYPE_CUSTOM, page, pool, 1, 1};
}

}  // namespace kaamos::d3d12
