// SPDX-License-Identifier: MIT
/// @file
/// Heaps, and resources that are placed in them: memory that several resources share in turn.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <rtapi/command_queue.h>
#include <rtapi/device.h>

namespace rtapi {

namespace detail {
struct HeapImpl;
}

/// Describes a heap for CreateHeap. [D3D12: D3D12_HEAP_DESC]
struct HeapDesc {
  uint64_t SizeInBytes = 0;  ///< 1 to 2^40; rounded up to 64 KiB. The memory starts at zero
  HeapType Type = HeapType::kDefault;  ///< of the buffers in it
  std::string Name = {};               ///< for messages
};

/// Memory that resources are placed in. A copyable handle; resources outlive their heap.
///
/// Resources that overlap share their bytes, and each has an address of its own. What a program may
/// do with them is D3D12's: one of them is in use at a time, an aliasing barrier or an
/// ExecuteCommandLists stands between, and targets and depth buffers start with a clear, a discard
/// or a copy. Block-compressed textures share no memory, nor does anything on Vulkan devices that
/// are not on the processor. [D3D12: ID3D12Heap; memory aliasing and data inheritance]
class Heap {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same heap.
  ///@{
  Heap() = default;
  explicit Heap(std::shared_ptr<detail::HeapImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Heap&) const = default;
  ///@}

  /// Returns the desc that the heap was created with. Valid as long as the heap lives. An empty
  /// handle has a default HeapDesc.
  const HeapDesc& GetDesc() const;

  /// For the library.
  const std::shared_ptr<detail::HeapImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::HeapImpl> impl_;
};

/// The room that a resource takes in a heap. [D3D12: D3D12_RESOURCE_ALLOCATION_INFO]
struct ResourceAllocationInfo {
  uint64_t SizeInBytes = 0;  ///< a multiple of Alignment
  uint64_t Alignment = 0;    ///< of its offset, in bytes: 4 KiB, 64 KiB or 4 MiB
};

/// Makes a heap of zeros. [D3D12: CreateHeap]
/// @errors KA0904 an empty device; KA0576 size or type; KA0990 no memory; the reason if the device
/// is removed.
Result<Heap> CreateHeap(const Device& device, const HeapDesc& desc);

/// The memory of a heap as a heap of another device, of the same process and any backend. Their
/// resources share bytes; fences order what the devices do. [D3D12: OpenSharedHandle]
/// @errors KA0904 an empty handle; the reason if the device is removed.
Result<Heap> OpenHeap(const Device& device, const Heap& heap);

/// The value of a fence as a fence of another device, of the same process and any backend. A queue
/// of either device signals and waits for it. [D3D12: OpenSharedHandle]
/// @errors KA0904 an empty handle.
Result<Fence> OpenFence(const Device& device, const Fence& fence);

/// The room that such a texture takes. `alignment`: 0, or the smaller one of two that D3D12 has for
/// small textures that are no targets (4 KiB), and for multisampled ones (64 KiB).
/// [D3D12: GetResourceAllocationInfo; D3D12_RESOURCE_DESC, Alignment]
/// @errors KA0904 an empty device; KA0576 an alignment that it cannot have; those of
/// Device::CreateTexture: KA0570, KA0571, KA0573, KA0907-0909.
Result<ResourceAllocationInfo> GetResourceAllocationInfo(const Device& device,
                                                         const TextureDesc& desc,
                                                         uint64_t alignment = 0);

/// Makes a buffer of the bytes at `offset_bytes`, a multiple of 64 KiB, of a heap, as they are.
/// `desc.Heap` is the heap's type. [D3D12: CreatePlacedResource]
/// @errors KA0904 an empty heap; KA0576 another heap type, offset, or bytes that are not in the
/// heap; those of Device::CreateBuffer: KA0545, KA0905-0907, KA0956, KA0990; the reason if the
/// device is removed.
Result<Buffer> CreatePlacedResource(const Heap& heap, uint64_t offset_bytes,
                                    const BufferDesc& desc);
/// Makes a texture of the bytes at `offset_bytes` of a heap of any type, as they are: a multiple of
/// the alignment, and as many as GetResourceAllocationInfo says. Texels lie there in an order of
/// the backend's own, equal for equal descs. [D3D12: CreatePlacedResource]
/// @errors KA0904 an empty heap; KA0576 the offset, the alignment, or bytes that are not in the
/// heap; those of Device::CreateTexture: KA0570, KA0571, KA0573, KA0726, KA0907-0909, KA0960,
/// KA0990; the reason if the device is removed.
Result<Texture> CreatePlacedResource(const Heap& heap, uint64_t offset_bytes,
                                     const TextureDesc& desc, uint64_t alignment = 0);

}  // namespace rtapi
