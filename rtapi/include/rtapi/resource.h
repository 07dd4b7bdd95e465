// SPDX-License-Identifier: MIT
//
// Buffers, textures, their states and barriers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>

#include <rtapi/result.h>
#include <rtapi/types.h>

namespace rtapi {

namespace detail {
struct BufferImpl;
struct TextureImpl;
}  // namespace detail

enum class HeapType : uint32_t { kDefault = 1, kUpload = 2, kReadback = 3 };

enum class ResourceDimension : uint32_t {
  kUnknown = 0,
  kBuffer = 1,
  kTexture1D = 2,
  kTexture2D = 3,
  kTexture3D = 4,
};

enum class ResourceFlags : uint32_t {
  kNone = 0,
  kAllowUnorderedAccess = 0x4,
};
template <>
inline constexpr bool kIsFlags<ResourceFlags> = true;

enum class ResourceStates : uint32_t {
  kCommon = 0,
  kVertexAndConstantBuffer = 0x1,
  kUnorderedAccess = 0x8,
  kNonPixelShaderResource = 0x40,
  kPixelShaderResource = 0x80,
  kIndirectArgument = 0x200,
  kCopyDest = 0x400,
  kCopySource = 0x800,
  kGenericRead = 0xAC3,
  kAllShaderResource = 0xC0,
  // For the whole life of a resource: no transition into it or out of it.
  // [DXR: Acceleration structure memory restrictions]
  kRaytracingAccelerationStructure = 0x400000,
};
template <>
inline constexpr bool kIsFlags<ResourceStates> = true;

struct BufferDesc {
  uint64_t SizeInBytes = 0;  // 1 .. 2^40; memory starts at zero
  HeapType Heap = HeapType::kDefault;
  ResourceFlags Flags = ResourceFlags::kNone;  // unordered access: default heap only
  // Upload heaps are always generic read, readback heaps always copy destination: kCommon stands
  // for either. kRaytracingAccelerationStructure needs the default heap and kAllowUnorderedAccess.
  ResourceStates InitialState = ResourceStates::kCommon;
  std::string Name = {};  // for messages
};

// Linear memory with a GPU virtual address, aligned to 64 KiB as D3D12's are. A copyable handle;
// the memory lives as long as one handle or an unfinished command list refers to it.
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::shared_ptr<detail::BufferImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Buffer&) const = default;

  const BufferDesc& GetDesc() const;  // of an empty handle: a default BufferDesc
  uint64_t size() const { return GetDesc().SizeInBytes; }
  GpuVirtualAddress GetGPUVirtualAddress() const;  // of an empty handle: 0
  const std::string& name() const { return GetDesc().Name; }
  void SetName(std::string name);

  // The memory of an upload or readback buffer; it stays mapped. Default heap: KA0911.
  Result<std::span<std::byte>> Map() const;
  void Unmap() const {}

  // The mapped memory as elements; empty if it cannot be mapped.
  template <class T>
  std::span<T> data() const {
    auto bytes = mapped_bytes();
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  const std::shared_ptr<detail::BufferImpl>& impl() const { return impl_; }

 private:
  std::span<std::byte> mapped_bytes() const;
  std::shared_ptr<detail::BufferImpl> impl_;
};

struct TextureDesc {
  ResourceDimension Dimension = ResourceDimension::kTexture2D;
  uint32_t Width = 1;
  uint32_t Height = 1;
  uint16_t DepthOrArraySize = 1;  // depth of a 3-D texture, else array elements; 6 for a cube
  uint16_t MipLevels = 1;         // 0: the full chain
  rtapi::Format Format = rtapi::Format::kUnknown;
  ResourceFlags Flags = ResourceFlags::kNone;
  ResourceStates InitialState = ResourceStates::kCommon;
  std::string Name = {};
};

// A texture on the default heap; contents start at zero. Filled and read through
// CommandList::CopyTextureRegion, or UploadTexture/ReadbackTexture of upload.h.
class Texture {
 public:
  Texture() = default;
  explicit Texture(std::shared_ptr<detail::TextureImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Texture&) const = default;

  const TextureDesc& GetDesc() const;  // MipLevels resolved
  // mip + array_element * MipLevels; 3-D textures have one subresource per mip.
  uint32_t subresource_count() const;
  const std::string& name() const { return GetDesc().Name; }
  void SetName(std::string name);

  const std::shared_ptr<detail::TextureImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::TextureImpl> impl_;
};

using Resource = std::variant<std::monostate, Buffer, Texture>;

// ---------------------------------------------------------------------------------------------
// Barriers

enum class ResourceBarrierType : uint32_t { kTransition = 0, kAliasing = 1, kUav = 2 };

struct ResourceBarrier {
  ResourceBarrierType Type = ResourceBarrierType::kUav;
  // Empty in a UAV barrier: every resource. [DXR: Synchronizing acceleration structure memory
  // writes/reads]
  rtapi::Resource Resource = {};
  uint32_t Subresource = kResourceBarrierAllSubresources;
  ResourceStates StateBefore = ResourceStates::kCommon;
  ResourceStates StateAfter = ResourceStates::kCommon;

  static ResourceBarrier Transition(rtapi::Resource resource, ResourceStates before,
                                    ResourceStates after,
                                    uint32_t subresource = kResourceBarrierAllSubresources) {
    return {ResourceBarrierType::kTransition, std::move(resource), subresource, before, after};
  }
  static ResourceBarrier Uav(rtapi::Resource resource = {}) {
    return {ResourceBarrierType::kUav, std::move(resource), kResourceBarrierAllSubresources,
            ResourceStates::kCommon, ResourceStates::kCommon};
  }
};

// ---------------------------------------------------------------------------------------------
// Copies between buffers and textures

struct SubresourceFootprint {
  rtapi::Format Format = rtapi::Format::kUnknown;
  uint32_t Width = 0;
  uint32_t Height = 0;
  uint32_t Depth = 0;
  uint32_t RowPitch = 0;  // bytes, a multiple of 256
};

struct PlacedSubresourceFootprint {
  uint64_t Offset = 0;  // bytes, a multiple of 512
  SubresourceFootprint Footprint = {};
};

enum class TextureCopyType : uint32_t { kSubresourceIndex = 0, kPlacedFootprint = 1 };

struct TextureCopyLocation {
  TextureCopyLocation(Texture texture, uint32_t subresource)
      : pResource(std::move(texture)),
        Type(TextureCopyType::kSubresourceIndex),
        SubresourceIndex(subresource) {}
  TextureCopyLocation(Buffer buffer, const PlacedSubresourceFootprint& footprint)
      : pResource(std::move(buffer)),
        Type(TextureCopyType::kPlacedFootprint),
        PlacedFootprint(footprint) {}

  Resource pResource;
  TextureCopyType Type;
  PlacedSubresourceFootprint PlacedFootprint;
  uint32_t SubresourceIndex = 0;
};

// Texels [left, right) x [top, bottom) x [front, back).
struct Box {
  uint32_t left = 0;
  uint32_t top = 0;
  uint32_t front = 0;
  uint32_t right = 0;
  uint32_t bottom = 0;
  uint32_t back = 0;
};

}  // namespace rtapi
