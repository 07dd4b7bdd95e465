// SPDX-License-Identifier: MIT
// Heaps and resources.
#include "d3d12/objects/device.h"
#include "d3d12/objects/heap.h"
#include "d3d12/objects/resource.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint64_t kPlacement = D3D12_DEFAULT_RESOURCE_PLACEMENT_ALIGNMENT;
constexpr uint64_t kSmallPlacement = D3D12_SMALL_RESOURCE_PLACEMENT_ALIGNMENT;

// Returns which of rtapi's three heap types has these properties. A custom heap is told by its page
// property. [D3D12: D3D12_HEAP_PROPERTIES]
rtapi::Result<rtapi::HeapType> heap_type(const D3D12_HEAP_PROPERTIES& heap) {
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
          return rtapi::HeapType::kUpload;
        case D3D12_CPU_PAGE_PROPERTY_WRITE_BACK:
          return rtapi::HeapType::kReadback;
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
                                           D3D12_RESOURCE_STATES state) {
  if (desc.Layout != D3D12_TEXTURE_LAYOUT_ROW_MAJOR || desc.Height != 1 ||
      desc.DepthOrArraySize != 1 || desc.MipLevels != 1 || desc.Format != DXGI_FORMAT_UNKNOWN ||
      desc.SampleDesc.Count != 1) {
    return make_error(
        ErrorId::kResource,
        "a buffer has Layout ROW_MAJOR (1), Height, DepthOrArraySize, MipLevels and "
        "SampleDesc.Count 1, and Format UNKNOWN (0); here: " +
            std::to_string(desc.Layout) + ", " + std::to_string(desc.Height) + ", " +
            std::to_string(desc.DepthOrArraySize) + ", " + std::to_string(desc.MipLevels) + ", " +
            std::to_string(desc.SampleDesc.Count) + ", " + std::to_string(desc.Format) + ".");
  }
  const auto type = heap_type(heap);
  if (!type) return type.error();
  rtapi::BufferDesc out;
  out.SizeInBytes = desc.Width;
  out.Heap = *type;
  out.Flags =
      static_cast<rtapi::ResourceFlags>(desc.Flags & D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS);
  out.InitialState = static_cast<rtapi::ResourceStates>(state);
  auto buffer = device.CreateBuffer(out);
  if (!buffer) return buffer.error();
  return rtapi::Resource(*buffer);
}

rtapi::Result<rtapi::Resource> make_texture(const rtapi::Device& device,
                                            const D3D12_HEAP_PROPERTIES& heap,
                                            const D3D12_RESOURCE_DESC1& desc,
                                            D3D12_RESOURCE_STATES state,
                                            const D3D12_CLEAR_VALUE* clear) {
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
  auto texture = device.CreateTexture(*out);
  if (!texture) return texture.error();
  return rtapi::Resource(*texture);
}

HRESULT make_resource(Device& device, const D3D12_HEAP_PROPERTIES& heap, D3D12_HEAP_FLAGS flags,
                      const D3D12_RESOURCE_DESC1& desc, D3D12_RESOURCE_STATES state,
                      const D3D12_CLEAR_VALUE* clear, Heap* placed_in, REFIID riid,
                      void** resource) {
  const bool is_target = (desc.Flags & (D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET |
                                        D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL)) != 0;
  if (clear != nullptr && !is_target) {
    return device.reporter().fail(ErrorId::kResource,
                                  "pOptimizedClearValue is given for a resource without "
                                  "ALLOW_RENDER_TARGET and ALLOW_DEPTH_STENCIL; pass null.");
  }
  auto made = desc.Dimension == D3D12_RESOURCE_DIMENSION_BUFFER
                  ? make_buffer(device.rtapi_device(), heap, desc, state)
                  : make_texture(device.rtapi_device(), heap, desc, state, clear);
  if (!made) return device.reporter().fail(made.error());
  return hand_out(new Resource(&device, *std::move(made), desc, heap, flags, placed_in), riid,
                  resource);
}

uint64_t round_up(uint64_t value, uint64_t to) {
  return (value + to - 1) / to * to;
}

}  // namespace

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
  return make_resource(*this, *heap, flags, *desc, state, clear, nullptr, riid, resource);
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
  if (const auto type = heap_type(desc->Properties); !type) return fail(type.error());
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
  return hand_out(new Heap(this, stored), riid, heap);
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
  const D3D12_RESOURCE_ALLOCATION_INFO info = GetResourceAllocationInfo2(0, 1, desc, nullptr);
  if (info.SizeInBytes == UINT64_MAX) {
    return fail(ErrorId::kResource, "CreatePlacedResource: the desc describes no resource.");
  }
  if (offset % info.Alignment != 0 || offset > heap_desc.SizeInBytes ||
      info.SizeInBytes > heap_desc.SizeInBytes - offset) {
    return fail(ErrorId::kHeap, "CreatePlacedResource: bytes " + std::to_string(offset) + " to " +
                                    std::to_string(offset + info.SizeInBytes) + " of a heap of " +
                                    std::to_string(heap_desc.SizeInBytes) +
                                    "; the offset is a multiple of " +
                                    std::to_string(info.Alignment) + ".");
  }
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
  return make_resource(*this, heap_desc.Properties, heap_desc.Flags, *desc, state, clear,
                       static_cast<Heap*>(heap), riid, resource);
}

HRESULT Device::CreatePlacedResource(ID3D12Heap* heap, UINT64 offset,
                                     const D3D12_RESOURCE_DESC* desc, D3D12_RESOURCE_STATES state,
                                     const D3D12_CLEAR_VALUE* clear, REFIID riid, void** resource) {
  const D3D12_RESOURCE_DESC1 desc1 =
      desc != nullptr ? with_sampler_feedback(*desc) : D3D12_RESOURCE_DESC1{};
  return CreatePlacedResource1(heap, offset, desc != nullptr ? &desc1 : nullptr, state, clear, riid,
                               resource);
}

namespace {

// Bytes of a resource's contents.
rtapi::Result<uint64_t> content_bytes(const rtapi::Device& device,
                                      const D3D12_RESOURCE_DESC1& desc) {
  if (desc.Dimension == D3D12_RESOURCE_DIMENSION_BUFFER) return uint64_t{desc.Width};
  const auto texture = texture_desc(desc);
  if (!texture) return texture.error();
  // A chain of mips that rtapi is to count itself has at most 15 levels.
  const uint32_t slices =
      desc.Dimension == D3D12_RESOURCE_DIMENSION_TEXTURE3D ? 1 : desc.DepthOrArraySize;
  uint32_t mips = desc.MipLevels;
  for (uint32_t side = std::max<uint32_t>({static_cast<uint32_t>(desc.Width), desc.Height, 1});
       desc.MipLevels == 0 && side != 0; side /= 2) {
    ++mips;
  }
  const uint32_t planes = rtapi::HasStencil(rtapi::GetDepthFormat(texture->Format)) ? 2 : 1;
  std::vector<rtapi::PlacedSubresourceFootprint> layouts;
  const uint32_t samples = texture->SampleDesc.Count;
  if (samples == 1) {
    return device.GetCopyableFootprints(*texture, 0, mips * slices * planes, 0, &layouts);
  }
  rtapi::TextureDesc one = *texture;
  one.SampleDesc = {};
  const auto bytes = device.GetCopyableFootprints(one, 0, slices * planes, 0, &layouts);
  if (!bytes) return bytes.error();
  return *bytes * samples;
}

// Returns the alignment that the desc asks for, of which textures may have 4 KiB if they are small
// and no targets. Multisampled ones have 4 MiB, or 64 KiB if they are asked for and they fit in 4
// MiB. [D3D12: GetResourceAllocationInfo; D3D12_RESOURCE_DESC, Alignment]
rtapi::Result<uint64_t> placement(const D3D12_RESOURCE_DESC1& desc, uint64_t bytes) {
  const bool plain = desc.Dimension != D3D12_RESOURCE_DIMENSION_BUFFER &&
                     (desc.Flags & (D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET |
                                    D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL)) == 0;
  constexpr uint64_t kMultisampled = D3D12_DEFAULT_MSAA_RESOURCE_PLACEMENT_ALIGNMENT;
  if (desc.SampleDesc.Count > 1) {
    if (desc.Alignment == 0 || desc.Alignment == kMultisampled) return kMultisampled;
    if (desc.Alignment == kPlacement && bytes <= kMultisampled) return kPlacement;
    return make_error(ErrorId::kResource,
                      "Alignment is " + std::to_string(desc.Alignment) +
                          " with several samples; it is 0, 4194304, or 65536 for textures of up to "
                          "4194304 bytes.");
  }
  if (desc.Alignment == 0 || desc.Alignment == kPlacement) return kPlacement;
  if (desc.Alignment == kSmallPlacement && plain && bytes <= kPlacement) return kSmallPlacement;
  return make_error(ErrorId::kResource,
                    "Alignment is " + std::to_string(desc.Alignment) +
                        "; it is 0, 65536, or 4096 for textures of up to 65536 bytes that are no "
                        "targets.");
}

}  // namespace

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo2(
    UINT, UINT count, const D3D12_RESOURCE_DESC1* descs, D3D12_RESOURCE_ALLOCATION_INFO1* infos) {
  D3D12_RESOURCE_ALLOCATION_INFO all = {0, 1};
  for (UINT i = 0; i < count; ++i) {
    const auto bytes = content_bytes(device_, descs[i]);
    const auto alignment = bytes.ok() ? placement(descs[i], *bytes) : bytes;
    if (!alignment.ok()) {
      fail(alignment.error());
      return {UINT64_MAX, kPlacement};
    }
    const uint64_t size = round_up(std::max<uint64_t>(*bytes, 1), *alignment);
    const uint64_t offset = round_up(all.SizeInBytes, *alignment);
    if (infos != nullptr) infos[i] = {offset, *alignment, size};
    all.SizeInBytes = offset + size;
    all.Alignment = std::max(all.Alignment, *alignment);
  }
  all.SizeInBytes = round_up(all.SizeInBytes, all.Alignment);
  return all;
}

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo1(
    UINT visible_mask, UINT count, const D3D12_RESOURCE_DESC* descs,
    D3D12_RESOURCE_ALLOCATION_INFO1* infos) {
  std::vector<D3D12_RESOURCE_DESC1> descs1;
  for (UINT i = 0; i < count; ++i) descs1.push_back(with_sampler_feedback(descs[i]));
  return GetResourceAllocationInfo2(visible_mask, count, descs1.data(), infos);
}

D3D12_RESOURCE_ALLOCATION_INFO Device::GetResourceAllocationInfo(UINT visible_mask, UINT count,
                                                                 const D3D12_RESOURCE_DESC* descs) {
  return GetResourceAllocationInfo1(visible_mask, count, descs, nullptr);
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

void Device::GetCopyableFootprints1(const D3D12_RESOURCE_DESC1* desc, UINT first, UINT count,
                                    UINT64 base_offset, D3D12_PLACED_SUBRESOURCE_FOOTPRINT* layouts,
                                    UINT* row_counts, UINT64* row_sizes, UINT64* total) {
  if (desc == nullptr) return;
  std::vector<rtapi::PlacedSubresourceFootprint> placed;
  std::vector<uint32_t> rows;
  std::vector<uint64_t> bytes;
  rtapi::Result<uint64_t> end = uint64_t{0};
  if (desc->Dimension == D3D12_RESOURCE_DIMENSION_BUFFER) {
    // One row of bytes.
    rtapi::PlacedSubresourceFootprint footprint;
    footprint.Offset = base_offset;
    footprint.Footprint = {rtapi::Format::kUnknown, static_cast<uint32_t>(desc->Width), 1, 1,
                           static_cast<uint32_t>(round_up(desc->Width, 256))};
    placed.push_back(footprint);
    rows.push_back(1);
    bytes.push_back(desc->Width);
    end = desc->Width;
  } else if (const auto texture = texture_desc(*desc); !texture) {
    end = texture.error();
  } else {
    end =
        device_.GetCopyableFootprints(*texture, first, count, base_offset, &placed, &rows, &bytes);
  }
  // D3D12 reports a failure as all bits set.
  if (!end) fail(end.error());
  static_assert(sizeof(rtapi::PlacedSubresourceFootprint) ==
                sizeof(D3D12_PLACED_SUBRESOURCE_FOOTPRINT));
  for (UINT i = 0; i < count; ++i) {
    const bool known = end.ok() && i < placed.size();
    if (layouts != nullptr) {
      std::memset(&layouts[i], 0xFF, sizeof(layouts[i]));
      if (known) std::memcpy(&layouts[i], &placed[i], sizeof(layouts[i]));
    }
    if (row_counts != nullptr) row_counts[i] = known ? rows[i] : UINT32_MAX;
    if (row_sizes != nullptr) row_sizes[i] = known ? bytes[i] : UINT64_MAX;
  }
  if (total != nullptr) *total = end.ok() ? *end : UINT64_MAX;
}

void Device::GetCopyableFootprints(const D3D12_RESOURCE_DESC* desc, UINT first, UINT count,
                                   UINT64 base_offset, D3D12_PLACED_SUBRESOURCE_FOOTPRINT* layouts,
                                   UINT* row_counts, UINT64* row_sizes, UINT64* total) {
  if (desc == nullptr) return;
  const D3D12_RESOURCE_DESC1 desc1 = with_sampler_feedback(*desc);
  GetCopyableFootprints1(&desc1, first, count, base_offset, layouts, row_counts, row_sizes, total);
}

}  // namespace kaamos::d3d12
